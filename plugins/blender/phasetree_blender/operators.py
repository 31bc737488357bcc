"""Check Scene and Export Scene: the translation without the render."""

import os
import tempfile

import bpy
from bpy_extras.io_utils import ExportHelper

from . import last_report, preferences
from .engine import PhasetreeRenderEngine
from .notes import Kind, Notes, TranslationError
from .translate.scene import write_scene


def tell(operator, scene):
    """Reports the notes about a scene. Returns the result of the operator."""
    notes = last_report.of(scene.name).notes
    errors = [note for note in notes if note.kind is Kind.ERROR]
    for note in errors:
        operator.report({"ERROR"}, note.text)
    if not errors:
        message = f"Notes: {len(notes)}; see Render properties > Report" if notes else "Everything is supported"
        operator.report({"INFO"}, message)
    return {"CANCELLED"} if errors else {"FINISHED"}


class PHASETREE_OT_check(bpy.types.Operator):
    bl_idname = "phasetree.check"
    bl_label = "Check Scene"
    bl_description = (
        "Report which parts of the scene are unsupported or approximated, and which clear object keeps the space of an overlap"
    )

    def execute(self, context):
        notes, phases = Notes(), ""
        with tempfile.TemporaryDirectory(prefix="phasetree_") as folder:
            try:
                depsgraph, path = context.evaluated_depsgraph_get(), os.path.join(folder, "scene.json")
                phases = write_scene(
                    depsgraph, path, preferences.found_command(), notes, evaluated=context.evaluated_depsgraph_get,
                    set_time=lambda frame, subframe: context.scene.frame_set(frame, subframe=subframe),
                ).report  # fmt: skip
            except TranslationError as error:
                notes.error(str(error))
        last_report.keep(context.scene.name, notes, phases)
        return tell(self, context.scene)


class PHASETREE_OT_select_reported(bpy.types.Operator):
    bl_idname = "phasetree.select_reported"
    bl_label = "Select Objects"
    bl_description = "Select the clear objects that overlap, have a gap between them, or are open, by the last check or render"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return last_report.of(context.scene.name) is not None

    def execute(self, context):
        names = last_report.object_names(last_report.of(context.scene.name))
        found = [item for item in context.view_layer.objects if item.name in names]
        for item in context.view_layer.objects:
            item.select_set(item in found)
        if found:
            context.view_layer.objects.active = found[0]
        self.report({"INFO"}, f"Objects that overlap, have gaps or are open: {len(found)}")
        return {"FINISHED"}


class PHASETREE_OT_export(bpy.types.Operator, ExportHelper):
    bl_idname = "phasetree.export_scene"
    bl_label = "Export phasetree Scene"
    bl_description = "Write a scene file for the command phasetree, with its meshes beside it"

    filename_ext = ".json"
    filter_glob: bpy.props.StringProperty(default="*.json", options={"HIDDEN"})

    def execute(self, context):
        scene, before = context.scene, context.scene.render.engine
        last_report.forget(scene.name)
        scene.render.engine, PhasetreeRenderEngine.export_path = "PHASETREE", self.filepath
        try:
            bpy.ops.render.render(scene=scene.name, layer=context.view_layer.name)
        except RuntimeError as error:
            if last_report.of(scene.name) is None:  # Blender did not start the render
                self.report({"ERROR"}, str(error))
                return {"CANCELLED"}
        finally:
            scene.render.engine, PhasetreeRenderEngine.export_path = before, ""
        return tell(self, scene)


def menu_entry(self, _context):
    self.layout.operator(PHASETREE_OT_export.bl_idname, text="phasetree Scene (.json)")


def register():
    bpy.utils.register_class(PHASETREE_OT_check)
    bpy.utils.register_class(PHASETREE_OT_select_reported)
    bpy.utils.register_class(PHASETREE_OT_export)
    bpy.types.TOPBAR_MT_file_export.append(menu_entry)


def unregister():
    bpy.types.TOPBAR_MT_file_export.remove(menu_entry)
    bpy.utils.unregister_class(PHASETREE_OT_export)
    bpy.utils.unregister_class(PHASETREE_OT_select_reported)
    bpy.utils.unregister_class(PHASETREE_OT_check)
    last_report.clear()
