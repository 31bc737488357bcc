"""phasetree as a render engine: clear objects become phases of one tree, so that glass and liquid touch exactly."""

bl_info = {
    "name": "phasetree",
    "author": "The phasetree authors",
    "version": (0, 10, 0),
    "blender": (3, 4, 0),
    "location": "Render properties > Render Engine",
    "description": "Path tracer for clear objects in exact contact, such as drinks",
    "category": "Render",
}

try:
    import numpy  # noqa: F401
except ImportError as error:
    raise ImportError(
        "phasetree: Blender's Python has no NumPy. Blender from blender.org includes it. With Debian's "
        "Blender, install python3-numpy and do not start Blender from a virtual environment"
    ) from error

from . import compatible_panels, engine, operators, panels, preferences, settings, trees_ui

PARTS = (preferences, settings, operators, engine, panels, trees_ui, compatible_panels)


def register():
    for part in PARTS:
        part.register()


def unregister():
    for part in reversed(PARTS):
        part.unregister()
