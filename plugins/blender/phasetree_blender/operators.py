"""Check Scene, and Export Scene: the translation without the render."""

import os
import tempfile

import bpy
from bpy_extras.io_utils import ExportHelper

from . import last_report, preferences
from .notes import Kind, Notes, TranslationError
from .translate.scene import write_scene


def translate(context, path):
    """Writes the scene file, evaluated as for the viewport. Returns the notes."""
    notes, phases = Notes(), ""
    try:
        depsgraph = context.evaluated_depsgraph_get()
        phases = write_scene(depsgraph, path, preferences.found_command(), notes).report
    except TranslationError as error:
        notes.error(str(error))
    last_report.keep(context.scene.name, notes, phases)
    return notes


def tell(operator, notes):
    """Reports the notes of an operator. Returns its result."""
    errors = notes.of_kind(Kind.ERROR)
    for note in errors:
        operator.report({"ERROR"}, note.text)
    if not errors:
        operator.report({"INFO"}, f"{len(notes)} notes; see Render properties > Report" if len(notes) else "Nothing is lost")
    return {"CANCELLED"} if errors else {"FINISHED"}


class PHASETREE_OT_check(bpy.types.Operator):
    bl_idname = "phasetree.check"
    bl_label = "Check Scene"
    bl_description = "Report what of this scene is lost or approximated, and which clear object wins where two overlap"

    def execute(self, context):
        with tempfile.TemporaryDirectory(prefix="phasetree_") as folder:
            return tell(self, translate(context, os.path.join(folder, "scene.json")))


class PHASETREE_OT_export(bpy.types.Operator, ExportHelper):
    bl_idname = "phasetree.export_scene"
    bl_label = "Export phasetree Scene"
    bl_description = "Write a scene file for the command phasetree, with its meshes beside it"

    filename_ext = ".json"
    filter_glob: bpy.props.StringProperty(default="*.json", options={"HIDDEN"})

    def execute(self, context):
        return tell(self, translate(context, self.filepath))


def menu_entry(self, _context):
    self.layout.operator(PHASETREE_OT_export.bl_idname, text="phasetree Scene (.json)")


def register():
    bpy.utils.register_class(PHASETREE_OT_check)
    bpy.utils.register_class(PHASETREE_OT_export)
    bpy.types.TOPBAR_MT_file_export.append(menu_entry)


def unregister():
    bpy.types.TOPBAR_MT_file_export.remove(menu_entry)
    bpy.utils.unregister_class(PHASETREE_OT_export)
    bpy.utils.unregister_class(PHASETREE_OT_check)
    last_report.clear()
