"""The add-on's preferences: where the command and a Python interpreter are."""

import os
import shutil

import bpy

from . import command
from .notes import TranslationError


class PhasetreePreferences(bpy.types.AddonPreferences):
    bl_idname = __package__

    command: bpy.props.StringProperty(
        name="Command",
        description="Path of the command phasetree. If empty, PHASETREE_COMMAND or else the program on PATH is used",
        subtype="FILE_PATH",
    )

    python: bpy.props.StringProperty(
        name="Python",
        description="Interpreter that has the package phasetree, for objects whose tree is Python code. If empty, "
        "PHASETREE_PYTHON or else python3 on PATH is used",
        subtype="FILE_PATH",
    )

    def draw(self, _context):
        self.layout.prop(self, "command")
        try:
            self.layout.label(text=f"Renders with {command.find(bpy.path.abspath(self.command))}", icon="CHECKMARK")
        except TranslationError as error:
            self.layout.label(text=str(error), icon="ERROR")
        self.layout.prop(self, "python")


def found_command():
    """The path of the command. Raises TranslationError, whose message says how to install it."""
    addon = bpy.context.preferences.addons.get(__package__)
    return command.find(bpy.path.abspath(addon.preferences.command) if addon and addon.preferences else "")


def found_python():
    """The path of the interpreter for trees in Python. Raises TranslationError."""
    addon = bpy.context.preferences.addons.get(__package__)
    preferred = bpy.path.abspath(addon.preferences.python) if addon and addon.preferences else ""
    wanted = preferred or os.environ.get("PHASETREE_PYTHON") or "python3"
    found = shutil.which(wanted)
    if not found:
        raise TranslationError(f"{wanted} is not a program; correct the file of Python in the add-on's preferences")
    return found


def register():
    bpy.utils.register_class(PhasetreePreferences)


def unregister():
    bpy.utils.unregister_class(PhasetreePreferences)
