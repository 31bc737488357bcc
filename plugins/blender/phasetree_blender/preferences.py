"""The add-on's preferences: where the command is."""

import bpy

from . import command
from .notes import TranslationError


class PhasetreePreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    command: bpy.props.StringProperty(
        name="Command",
        description="File of the command phasetree. If empty, PHASETREE_COMMAND or else the program on PATH is used",
        subtype="FILE_PATH",
    )

    def draw(self, _context):
        self.layout.prop(self, "command")
        try:
            self.layout.label(text=f"Renders with {command.find(bpy.path.abspath(self.command))}", icon="CHECKMARK")
        except TranslationError as error:
            self.layout.label(text=str(error), icon="ERROR")


def found_command():
    """The path of the command. Raises TranslationError, whose message says how to install it."""
    addon = bpy.context.preferences.addons.get(__package__)
    return command.find(bpy.path.abspath(addon.preferences.command) if addon and addon.preferences else "")


def register():
    bpy.utils.register_class(PhasetreePreferences)


def unregister():
    bpy.utils.unregister_class(PhasetreePreferences)
