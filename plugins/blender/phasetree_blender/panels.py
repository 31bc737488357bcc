"""Panels: settings of the render, the report, and what becomes of an object and of a material."""

import re

import bpy

from . import last_report
from .notes import Kind, Notes
from .translate.materials import surface_of
from .translate.shapes import WITH_MESHES

ICONS = {Kind.ERROR: "CANCEL", Kind.UNSUPPORTED: "ERROR", Kind.APPROXIMATE: "INFO", Kind.INFORMATION: "DOT"}


def characters_per_line():
    """About how many characters fit into a line of the panel that is drawn."""
    pixels = 6.5 * bpy.context.preferences.system.ui_scale
    return max(20, int(bpy.context.region.width / pixels) - 6) if bpy.context.region else 60


def wrapped(text, width):
    """The text in lines of whole words."""
    lines = [""]
    for word in text.split():
        if lines[-1] and len(lines[-1]) + 1 + len(word) > width:
            lines.append("")
        lines[-1] += (" " if lines[-1] else "") + word
    return lines


def draw_text(layout, text, icon="NONE"):
    column = layout.column(align=True)
    for number, line in enumerate(wrapped(text, characters_per_line())):
        column.label(text=line, icon=icon if number == 0 else "BLANK1" if icon != "NONE" else "NONE")


def draw_notes(layout, notes, with_subjects=True):
    for note in notes:
        subject = f"{note.subject}: " if with_subjects and note.subject else ""
        draw_text(layout, subject + note.text, ICONS[note.kind])


def draw_phases(layout, report):
    """The report of `phasetree import`: a table of the objects, and sentences on overlaps and gaps."""
    for line in report.splitlines():
        cells = re.split(r"  +", line.strip())
        if len(cells) == 5:
            row = layout.split(factor=0.4)
            for cell in cells[1:4]:
                row.label(text=cell)
        else:
            draw_text(layout, line)


class PhasetreePanel:
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    COMPAT_ENGINES = {"PHASETREE"}

    @classmethod
    def poll(cls, context):
        return context.engine in cls.COMPAT_ENGINES


class PHASETREE_PT_sampling(PhasetreePanel, bpy.types.Panel):
    bl_label = "Sampling"
    bl_context = "render"

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        for name in ("samples", "seed", "denoise", "update_interval", "viewport_scale", "keeps_checkpoints"):
            self.layout.prop(context.scene.phasetree, name)
        if context.scene.phasetree.keeps_checkpoints:
            self.layout.prop(context.scene.phasetree, "checkpoint_folder")


class PHASETREE_PT_light_paths(PhasetreePanel, bpy.types.Panel):
    bl_label = "Light Paths"
    bl_context = "render"

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        for name in ("caustics", "guiding", "spectral", "max_depth"):
            self.layout.prop(context.scene.phasetree, name)


class PHASETREE_PT_phases(PhasetreePanel, bpy.types.Panel):
    bl_label = "Phases"
    bl_context = "render"

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        self.layout.prop(context.scene.phasetree, "closes_gaps")
        report = last_report.of(context.scene.name)
        if report and report.phases:
            draw_text(self.layout, "Where objects overlap, the first keeps the space:")
            draw_phases(self.layout.column(align=True), report.phases)
        self.layout.operator("phasetree.select_reported")


class PHASETREE_PT_motion_blur(PhasetreePanel, bpy.types.Panel):
    bl_label = "Motion Blur"
    bl_context = "render"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_header(self, context):
        self.layout.prop(context.scene.render, "use_motion_blur", text="")

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.active = context.scene.render.use_motion_blur
        blenders = hasattr(context.scene.render, "motion_blur_position")
        self.layout.prop(context.scene.render if blenders else context.scene.phasetree, "motion_blur_position")
        self.layout.prop(context.scene.render, "motion_blur_shutter")
        self.layout.prop(context.scene.phasetree, "motion_steps")


class PHASETREE_PT_film(PhasetreePanel, bpy.types.Panel):
    bl_label = "Film"
    bl_context = "render"

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.prop(context.scene.render, "film_transparent", text="Transparent")


class PHASETREE_PT_report(PhasetreePanel, bpy.types.Panel):
    bl_label = "Report"
    bl_context = "render"

    def draw(self, context):
        self.layout.operator("phasetree.check")
        report = last_report.of(context.scene.name)
        if report is None:
            draw_text(self.layout, "Render or check the scene to see what is unsupported or approximated.")
        elif not report.notes:
            self.layout.label(text="Everything is supported.", icon="CHECKMARK")
        else:
            draw_notes(self.layout, report.notes)


class PHASETREE_PT_passes(PhasetreePanel, bpy.types.Panel):
    bl_label = "Passes"
    bl_context = "view_layer"

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        self.layout.prop(context.view_layer, "use_pass_z", text="Depth")
        self.layout.prop(context.view_layer, "use_pass_normal", text="Normal")
        self.layout.prop(context.view_layer.phasetree, "use_pass_albedo")
        column = self.layout.column(heading="Cryptomatte")
        column.prop(context.view_layer, "use_pass_cryptomatte_object", text="Object")
        column.prop(context.view_layer, "use_pass_cryptomatte_material", text="Material")
        column.prop(context.view_layer, "use_pass_cryptomatte_asset", text="Phase (as Asset)")


class PHASETREE_PT_light_groups(PhasetreePanel, bpy.types.Panel):
    bl_label = "Light Groups"
    bl_context = "view_layer"

    def draw(self, context):
        layer, row = context.view_layer, self.layout.row()
        row.template_list("UI_UL_list", "lightgroups", layer, "lightgroups", layer, "active_lightgroup_index", rows=3)
        buttons = row.column(align=True)
        buttons.operator("scene.view_layer_add_lightgroup", icon="ADD", text="")
        buttons.operator("scene.view_layer_remove_lightgroup", icon="REMOVE", text="")


class LightGroupPanel(PhasetreePanel):
    """The light group of a light or a world."""

    bl_label = "Light Group"

    def draw_group(self, owner, layer):
        self.layout.use_property_split = True
        self.layout.prop_search(owner, "lightgroup", layer, "lightgroups", text="Light Group", results_are_suggestions=True)


class PHASETREE_PT_light_group_of_light(LightGroupPanel, bpy.types.Panel):
    bl_context = "data"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.object is not None and context.object.type == "LIGHT"

    def draw(self, context):
        self.draw_group(context.object, context.view_layer)


class PHASETREE_PT_light_group_of_world(LightGroupPanel, bpy.types.Panel):
    bl_context = "world"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.world is not None

    def draw(self, context):
        self.draw_group(context.world, context.view_layer)


class PHASETREE_PT_object(PhasetreePanel, bpy.types.Panel):
    bl_label = "Phase"
    bl_context = "object"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.object is not None and context.object.type in WITH_MESHES

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        self.layout.prop(context.object.phasetree, "role")
        row = self.layout.row()
        row.active = context.object.phasetree.role != "OPAQUE"
        row.prop(context.object.phasetree, "priority")
        if not any(slot.material and surface_of(slot.material, Notes()).is_clear for slot in context.object.material_slots):
            draw_text(self.layout, "No material of this object is clear, so it is rendered as an opaque mesh.", "INFO")


class PHASETREE_PT_material(PhasetreePanel, bpy.types.Panel):
    bl_label = "phasetree"
    bl_context = "material"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.material is not None

    def draw(self, context):
        notes = Notes()
        surface = surface_of(context.material, notes)
        if surface.is_clear:
            draw_text(self.layout, f"Clear, with index {surface.ior:.4g}: closed objects become phases.", "CHECKMARK")
            self.layout.use_property_split = True
            for name in ("medium", "glass"):
                self.layout.prop(context.material.phasetree, name)
        elif max(surface.emission) > 0:
            draw_text(self.layout, "A glowing surface.", "CHECKMARK")
        else:
            draw_text(self.layout, "An opaque surface.", "CHECKMARK")
        draw_notes(self.layout, notes)


CLASSES = (
    PHASETREE_PT_sampling, PHASETREE_PT_light_paths, PHASETREE_PT_motion_blur, PHASETREE_PT_film, PHASETREE_PT_phases,
    PHASETREE_PT_report,
    PHASETREE_PT_passes, PHASETREE_PT_light_groups, PHASETREE_PT_light_group_of_light, PHASETREE_PT_light_group_of_world,
    PHASETREE_PT_object, PHASETREE_PT_material,
)  # fmt: skip


def register():
    for panel in CLASSES:
        bpy.utils.register_class(panel)


def unregister():
    for panel in reversed(CLASSES):
        bpy.utils.unregister_class(panel)
