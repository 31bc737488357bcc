"""Objects that carry a tree: operators that read its numbers and mesh it for the viewport, and the panel."""

import json
import os
import re
import struct
import tempfile

import bpy
import numpy as np
from bpy_extras.io_utils import ImportHelper

from . import command, preferences
from .notes import Notes, TranslationError
from .panels import PhasetreePanel, draw_text
from .translate import scene_text, trees
from .translate.images import linear
from .translate.python_trees import SHARED


def read_ply(path):
    """The mesh that `phasetree export` writes: vertices, triangles, the phase of each triangle, {phase: name}, colours."""
    with open(path, "rb") as file:
        data = file.read()
    head, _, body = data.partition(b"end_header\n")
    names = {int(i): name for i, name in re.findall(r"comment phase (\d+) (.*)", head.decode())}
    vertices, faces = (int(re.search(rf"element {kind} (\d+)", head.decode())[1]) for kind in ("vertex", "face"))
    points = np.frombuffer(body, "<f4", 3 * vertices).reshape(-1, 3)
    kind = np.dtype([("n", "u1"), ("v", "<u4", 3), ("behind", "u1"), ("front", "u1"), ("color", "u1", 3)])
    rows = np.frombuffer(body, kind, faces, offset=12 * vertices)
    phases = np.where(rows["behind"] != 0, rows["behind"], rows["front"])
    colors = {int(p): rows["color"][phases == p][0] / 255 for p in np.unique(phases)}
    return points, rows["v"].astype(np.int32), phases, names, colors


def write_mesh(item, path):
    """Replaces an object's mesh by that of a file. Each phase gets a material for the viewport."""
    points, triangles, phases, names, colors = read_ply(path)
    mesh = item.data
    mesh.clear_geometry()
    mesh.vertices.add(len(points))
    mesh.vertices.foreach_set("co", points.reshape(-1))
    mesh.loops.add(triangles.size)
    mesh.loops.foreach_set("vertex_index", triangles.reshape(-1))
    mesh.polygons.add(len(triangles))
    mesh.polygons.foreach_set("loop_start", np.arange(0, triangles.size, 3, dtype=np.int32))
    if bpy.app.version < (4, 1):
        mesh.polygons.foreach_set("loop_total", np.full(len(triangles), 3, dtype=np.int32))
    shown = np.unique(phases)
    mesh.materials.clear()
    for phase in shown:
        name = f"{item.name}: {names[int(phase)]}"
        material = bpy.data.materials.get(name) or bpy.data.materials.new(name)
        material.diffuse_color = (*linear(colors[int(phase)]), 1)
        mesh.materials.append(material)
    mesh.polygons.foreach_set("material_index", np.searchsorted(shown, phases).astype(np.int32))
    mesh.update(calc_edges=True)
    mesh.validate()


def update_mesh(item, depsgraph, notes):
    """Meshes an object's tree for the viewport. Raises TranslationError."""
    program = preferences.found_command()
    with tempfile.TemporaryDirectory(prefix="phasetree_") as folder:
        scene, mesh = os.path.join(folder, "scene.json"), os.path.join(folder, "mesh.ply")
        with open(scene, "w", encoding="utf-8") as file:
            json.dump(trees.scene_of(item.evaluated_get(depsgraph), program, notes), file)
        bounds = json.loads(ran([program, "info", scene, "--json"], scene)).get("bounds")
        if not bounds:
            raise TranslationError(f'the tree of "{item.name}" is not one bounded object, so it has no mesh')
        side = max(high - low for low, high in zip(*bounds))
        ran([program, "export", scene, "-o", mesh, "--spacing", f"{side / item.phasetree.detail:.9g}"], scene)
        write_mesh(item, mesh)


def ran(arguments, scene):
    """What a command prints. Raises TranslationError."""
    done = command.run(arguments, lambda: False)
    if done.returncode != 0:
        raise TranslationError(command.message_of(done.stderr, scene))
    return done.stdout


def add_number(item, name, pointer, value):
    """Adds a number of the tree, and the custom property with its value."""
    number = item.phasetree.numbers.get(name) or item.phasetree.numbers.add()
    number.name, number.pointer = name, pointer
    if name not in item:
        item[name] = float(value)
        item.id_properties_ui(name).update(default=float(value), description=pointer or "A number of the tree")


def free_name(item, pointer):
    """A short name for a number: the last words of its path that no other number has."""
    steps = pointer.split("/")[1:]
    for count in range(1, len(steps) + 1):
        name = " ".join(steps[-count:])
        if name not in item and not name.isdigit():
            return name[:63]
    return pointer[-63:]


class OfTree:
    """What operators of the active object's tree share."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return context.object is not None and trees.is_tree(context.object)

    def execute(self, context):
        notes = Notes()
        try:
            self.run(context, context.object, notes)
        except TranslationError as error:
            self.report({"ERROR"}, f"phasetree: {error}")
            return {"CANCELLED"}
        for note in notes:
            self.report({"WARNING"}, f"phasetree: {note.text}")
        return {"FINISHED"}


class PHASETREE_OT_update_tree(OfTree, bpy.types.Operator):
    bl_idname = "phasetree.update_tree"
    bl_label = "Update"
    bl_description = "Read the numbers of the tree, and show its mesh in the viewport. Runs the code of the text block, if any"

    def run(self, context, item, notes):
        if item.phasetree.source == "TEXT":
            code, name = trees.code_of(item)
            trees.approve(code)
            known = SHARED.parameters(code, name, preferences.found_python(), preferences.found_command())
            for number in [n.name for n in item.phasetree.numbers if n.name not in known]:
                item.phasetree.numbers.remove(item.phasetree.numbers.find(number))
            for key, value in known.items():
                add_number(item, key, "", value)
        depsgraph = context.evaluated_depsgraph_get()
        if item.type == "MESH":
            update_mesh(item, depsgraph, notes)


class PHASETREE_OT_add_number(OfTree, bpy.types.Operator):
    bl_idname = "phasetree.add_number"
    bl_label = "Add Number"
    bl_description = "Show a number of the scene file as a custom property, which can be driven and keyframed"
    bl_property = "pointer"

    _found = []  # Blender does not keep the strings of items

    def items(self, context):
        item = context.object if context else None
        if item is None or item.phasetree.source != "FILE":
            return []
        taken = {number.pointer for number in item.phasetree.numbers}
        try:
            numbers = scene_text.numbers_of_trees(scene_text.read(trees.file_of(item)))
        except TranslationError:
            return []
        PHASETREE_OT_add_number._found = [(p, f"{p[1:]} = {v:.6g}", "") for p, v in numbers.items() if p not in taken]
        return PHASETREE_OT_add_number._found

    pointer: bpy.props.EnumProperty(name="Number", items=items)
    name: bpy.props.StringProperty(name="Name", description="Name of the property; if empty, the end of the path")

    def invoke(self, context, _event):
        context.window_manager.invoke_search_popup(self)
        return {"RUNNING_MODAL"}

    def run(self, context, item, notes):
        value = scene_text.numbers_of_trees(scene_text.read(trees.file_of(item))).get(self.pointer)
        if value is None:
            raise TranslationError(f"there is no number at {self.pointer}")
        add_number(item, self.name or free_name(item, self.pointer), self.pointer, value)


class PHASETREE_OT_remove_number(OfTree, bpy.types.Operator):
    bl_idname = "phasetree.remove_number"
    bl_label = "Remove Number"
    bl_description = "Use the number in the scene file again, and remove the property"

    name: bpy.props.StringProperty()

    def run(self, context, item, notes):
        item.phasetree.numbers.remove(item.phasetree.numbers.find(self.name))
        item.pop(self.name, None)


class PHASETREE_OT_add_tree(bpy.types.Operator, ImportHelper):
    bl_idname = "phasetree.add_tree"
    bl_label = "Add phasetree Object"
    bl_description = "Add an object that is rendered from the tree of a scene file"
    bl_options = {"REGISTER", "UNDO"}

    filename_ext = ".json"
    filter_glob: bpy.props.StringProperty(default="*.json", options={"HIDDEN"})

    def execute(self, context):
        name = os.path.splitext(os.path.basename(self.filepath))[0]
        item = bpy.data.objects.new(name, bpy.data.meshes.new(name))
        item.location = context.scene.cursor.location
        item.phasetree.source, item.phasetree.file = "FILE", self.filepath
        context.collection.objects.link(item)
        for other in context.selected_objects:
            other.select_set(False)
        item.select_set(True)
        context.view_layer.objects.active = item
        return bpy.ops.phasetree.update_tree()


class PHASETREE_PT_tree(PhasetreePanel, bpy.types.Panel):
    bl_label = "phasetree Object"
    bl_context = "object"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.object is not None and context.object.type in ("MESH", "EMPTY")

    def draw(self, context):
        item, layout = context.object, self.layout
        layout.use_property_split = True
        layout.prop(item.phasetree, "source")
        if item.phasetree.source == "NONE":
            return
        layout.prop(item.phasetree, "file" if item.phasetree.source == "FILE" else "text")
        if item.type == "MESH":
            layout.prop(item.phasetree, "detail")
        for number in item.phasetree.numbers:
            row = layout.row(align=True)
            if number.name in item:
                row.prop(item, f'["{bpy.utils.escape_identifier(number.name)}"]', text=number.name)
            else:
                row.label(text=f"{number.name} (removed)", icon="ERROR")
            if item.phasetree.source == "FILE":
                row.operator(PHASETREE_OT_remove_number.bl_idname, text="", icon="X").name = number.name
        if item.phasetree.source == "FILE":
            layout.operator(PHASETREE_OT_add_number.bl_idname, icon="ADD")
        layout.operator(PHASETREE_OT_update_tree.bl_idname, icon="FILE_REFRESH")
        draw_text(layout, "Renders show the tree with these numbers. The mesh in the viewport is that of the last update.")


CLASSES = (PHASETREE_OT_update_tree, PHASETREE_OT_add_number, PHASETREE_OT_remove_number, PHASETREE_OT_add_tree,
           PHASETREE_PT_tree)  # fmt: skip


def menu_entry(self, _context):
    self.layout.operator(PHASETREE_OT_add_tree.bl_idname, text="phasetree Object (.json)", icon="MESH_ICOSPHERE")


def register():
    for made in CLASSES:
        bpy.utils.register_class(made)
    bpy.types.VIEW3D_MT_add.append(menu_entry)


def unregister():
    bpy.types.VIEW3D_MT_add.remove(menu_entry)
    for made in reversed(CLASSES):
        bpy.utils.unregister_class(made)
