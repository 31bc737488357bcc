"""Objects that carry a tree: a scene file, or Python code in a text block."""

import hashlib
import json
import os
import sys

import bpy

from .. import preferences
from ..notes import TranslationError
from . import scene_text
from .python_trees import SHARED
from .scene_objects import is_flat

# Digests of code that the user ran by a button in this session.
_approved = set()


def is_tree(item):
    """Whether an object, evaluated or not, carries a tree."""
    return item.original.phasetree.source != "NONE"


def digest_of(code):
    return hashlib.sha256(code.encode()).hexdigest()


def approve(code):
    """Lets code run in this session, although Blender's preferences do not allow the scripts of files."""
    _approved.add(digest_of(code))


def may_run(code):
    """Whether code in a file may run: by Blender's preferences, its command line, or because the user ran it."""
    words = sys.argv[: sys.argv.index("--")] if "--" in sys.argv else sys.argv
    return (
        digest_of(code) in _approved
        or bpy.context.preferences.filepaths.use_scripts_auto_execute
        or "-y" in words
        or "--enable-autoexec" in words
    )


def code_of(item):
    text = item.original.phasetree.text
    if text is None:
        raise TranslationError(f'"{item.name}" has no text block; choose one in Object > phasetree Object')
    return text.as_string(), text.name


def file_of(item):
    file = item.original.phasetree.file
    if not file:
        raise TranslationError(f'"{item.name}" has no scene file; choose one in Object > phasetree Object')
    return os.path.normpath(bpy.path.abspath(file, library=item.original.library))


def scene_of(item, command, notes, cancelled=lambda: False):
    """The scene whose tree an object carries, with the object's numbers. Files are named absolutely."""
    settings = item.original.phasetree
    if settings.source == "TEXT":
        code, name = code_of(item)
        if not may_run(code):
            raise TranslationError(
                f'the code of "{item.name}" was not run, because the preferences do not allow scripts of files; read it, and '
                "press Update in Object > phasetree Object"
            )
        numbers = {key: number_of(item, key) for key in number_names(item) if key in item.original}
        text = SHARED.scene(code, name, numbers, preferences.found_python(), command, cancelled)
        return scene_text.with_absolute_files(scene_text.parsed(text, name), blend_folder())
    path = file_of(item)
    document = scene_text.with_absolute_files(scene_text.read(path), os.path.dirname(path))
    for number in settings.numbers:
        if number.name not in item.original:
            notes.unsupported(f'its property "{number.name}" was removed; the number in the scene file is used')
        elif not scene_text.with_number(document, number.pointer, number_of(item, number.name)):
            notes.unsupported(f"{os.path.basename(path)} has no number at {number.pointer}")
    return document


def blend_folder():
    return os.path.dirname(bpy.data.filepath) or os.getcwd()


def is_animated(item, key):
    """Whether a custom property may differ between an object and its evaluated copy."""
    animation = item.original.animation_data
    if animation is None:
        return False
    curves = [*animation.drivers, *(animation.action.fcurves if animation.action else ())]
    path = f'["{bpy.utils.escape_identifier(key)}"]'
    return bool(animation.nla_tracks) or any(curve.data_path == path for curve in curves)


def number_names(item):
    return [number.name for number in item.original.phasetree.numbers]


def number_of(item, key):
    # Setting a property from Python does not update the evaluated copy.
    value = (item if is_animated(item, key) else item.original)[key]
    if not scene_text.is_number(value):
        raise TranslationError(f'the property "{key}" of "{item.name}" is not a number')
    return value


class TreeWriter:
    """Adds objects that carry a tree to the objects of the scene. Instances share one tree."""

    def __init__(self, objects, command, notes, names):
        self._objects, self._command, self._notes, self._material_names = objects, command, notes, names
        self._names, self.digests = {}, []

    def add(self, item, matrix, matrices):
        """Adds an evaluated object at a place. `matrices`: its places while the shutter is open, or None."""
        notes = self._notes.about(f'object "{item.name}"')
        if is_flat(matrix):
            notes.unsupported("is scaled to nothing, so it is left out")
            return
        key = item.original.as_pointer()
        if key not in self._names:
            scene = scene_of(item, self._command, notes)
            text = json.dumps(scene, indent=1, ensure_ascii=False)
            name = self._names[key] = self._objects.add(item.name, {"file": self._file_of(item, text)})
            for phase in scene.get("phases", ()):
                self._material_names.add(f"{name}.{phase}", item.name, f"{name}.{phase}")
            self.digests.append(digest_of(text))
        self._objects.place(self._names[key], matrix, matrices)

    def _file_of(self, item, text):
        """A scene file with the text. A file without changed numbers is used itself, so that messages name its lines."""
        settings = item.original.phasetree
        if settings.source == "FILE" and not settings.numbers:
            return file_of(item)
        file = f"{self._objects.stem}.tree{len(self._objects) + 1}.json"
        with open(os.path.join(self._objects.folder, file), "w", encoding="utf-8") as out:
            out.write(text)
        return file
