"""A drink in Blender, from the default scene: the steps of tracer/manual/tutorials/drink-in-blender.md.

    blender -b --factory-startup --python drink.py -- drink.blend
"""

import math
import os
import sys

import bpy


def choose_engine():
    bpy.ops.preferences.addon_enable(module="phasetree_blender")
    scene = bpy.context.scene
    scene.render.engine = "PHASETREE"
    scene.phasetree.samples = 256
    scene.render.resolution_x, scene.render.resolution_y = 900, 900


def material(name, color, roughness, transmission=0.0, ior=1.5):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    inputs = made.node_tree.nodes["Principled BSDF"].inputs
    inputs["Base Color"].default_value = (*color, 1)
    inputs["Roughness"].default_value = roughness
    inputs["Transmission Weight" if "Transmission Weight" in inputs else "Transmission"].default_value = transmission
    inputs["IOR"].default_value = ior
    return made


def name_object(name, its_material):
    bpy.context.object.name = name
    bpy.context.object.data.materials.append(its_material)
    return bpy.context.object


def add_table():
    bpy.data.objects.remove(bpy.data.objects["Cube"])
    bpy.ops.mesh.primitive_plane_add(size=60, location=(0, 0, 0))
    name_object("Table", material("Oak", (0.4, 0.2, 0.09), 0.6))


def add_glass():
    bpy.ops.mesh.primitive_cylinder_add(vertices=256, radius=0.85, depth=2.2, location=(0, 0, 1.09))
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.mesh.select_mode(type="FACE")
    bpy.ops.object.mode_set(mode="OBJECT")
    for face in bpy.context.object.data.polygons:
        face.select = face.normal.z > 0.9
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.delete(type="FACE")
    bpy.ops.object.mode_set(mode="OBJECT")
    wall = bpy.context.object.modifiers.new("Solidify", "SOLIDIFY")
    wall.thickness, wall.use_even_offset = 0.09, True
    edges = bpy.context.object.modifiers.new("Bevel", "BEVEL")
    edges.width, edges.segments = 0.03, 4
    name_object("Tumbler", material("Glass", (1, 1, 1), 0, transmission=1, ior=1.5))


def add_water():
    bpy.ops.mesh.primitive_cylinder_add(vertices=256, radius=0.80, depth=1.45, location=(0, 0, 0.78))
    water = material("Lemonade", (1, 1, 1), 0, transmission=1, ior=1.34)
    tree = water.node_tree
    absorption = tree.nodes.new("ShaderNodeVolumeAbsorption")
    absorption.inputs["Color"].default_value = (1.0, 0.86, 0.3, 1)
    absorption.inputs["Density"].default_value = 1.2
    tree.links.new(absorption.outputs["Volume"], tree.nodes["Material Output"].inputs["Volume"])
    name_object("Lemonade", water)


def add_ice():
    ice = material("Ice", (1, 1, 1), 0, transmission=1, ior=1.31)
    for number, (x, y, angles) in enumerate(((-0.3, -0.2, (20, 30, 10)), (0.33, 0.12, (-25, 15, 50)))):
        bpy.ops.mesh.primitive_cube_add(size=0.5, location=(x, y, 1.42), rotation=[math.radians(a) for a in angles])
        edges = bpy.context.object.modifiers.new("Bevel", "BEVEL")
        edges.width, edges.segments = 0.06, 4
        name_object(f"Ice cube {number + 1}", ice)


def add_straw():
    bpy.ops.mesh.primitive_cylinder_add(vertices=48, radius=0.06, depth=2.7, location=(0.05, 0.3, 1.5))
    bpy.context.object.rotation_euler = (math.radians(4), math.radians(17), 0)
    bpy.ops.object.shade_smooth()
    name_object("Straw", material("Paper", (0.75, 0.06, 0.08), 0.6))


def light_it():
    light = bpy.data.objects["Light"]
    light.data.type, light.data.size, light.data.energy = "AREA", 2.5, 700
    light.location = (-4, 2.5, 5)
    light.rotation_euler = (math.radians(50), 0, math.radians(-122))
    world = bpy.context.scene.world.node_tree.nodes["Background"].inputs
    world["Color"].default_value, world["Strength"].default_value = (0.75, 0.85, 1, 1), 0.5
    camera = bpy.data.objects["Camera"]
    camera.location, camera.data.lens = (3.6, -4.4, 3.6), 60
    camera.rotation_euler = (math.radians(65.5), 0, math.radians(39.3))


STEPS = (choose_engine, add_table, add_glass, add_water, add_ice, add_straw, light_it)

if __name__ == "__main__":
    for step in STEPS:
        step()
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    if arguments:
        bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(arguments[0]))
