"""A still life on a bar: a bottle of whisky, a tumbler with ice, and a martini with an olive. Everything is a mesh.

    blender -b --factory-startup --addons phasetree_blender --python bar.py -- bar.blend

Lengths are in decimetres. Liquids reach into their glasses, and the add-on cuts them where the glass begins.
"""

import math
import os
import sys

import bpy
import numpy as np
from mathutils import Vector

AROUND = 192  # clear objects are shaded flat, so round ones need many faces


# Materials


def material(name, color=(0.8, 0.8, 0.8), roughness=0.5, **inputs):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    node = made.node_tree.nodes["Principled BSDF"]
    values = {"Base Color": (*color, 1), "Roughness": roughness, **inputs}
    for key, value in values.items():
        found = node.inputs.get(key) or node.inputs[{"Transmission": "Transmission Weight", "Clearcoat": "Coat Weight",
                                                     "Emission": "Emission Color"}[key]]  # fmt: skip
        found.default_value = value
    return made


def clear(name, ior, absorption=None, density=0.0):
    made = material(name, (1, 1, 1), 0.0, Transmission=1.0, IOR=ior)
    if absorption:
        tree = made.node_tree
        volume = tree.nodes.new("ShaderNodeVolumeAbsorption")
        volume.inputs["Color"].default_value, volume.inputs["Density"].default_value = (*absorption, 1), density
        tree.links.new(volume.outputs["Volume"], tree.nodes["Material Output"].inputs["Volume"])
    return made


def noise(generator, height, width, cells_y, cells_x):
    """Smooth noise from 0 to 1 that repeats."""
    grid = generator.random((cells_y, cells_x))
    y, x = np.mgrid[0:height, 0:width]
    fy, fx = y * cells_y / height, x * cells_x / width
    iy, ix = fy.astype(int), fx.astype(int)
    ty, tx = (t * t * (3 - 2 * t) for t in (fy - iy, fx - ix))
    rows = [grid[(iy + j) % cells_y, ix % cells_x] * (1 - tx) + grid[(iy + j) % cells_y, (ix + 1) % cells_x] * tx for j in (0, 1)]
    return rows[0] * (1 - ty) + rows[1] * ty


def wood_image(size=2048, boards=5):
    """Boards of dark wood, as an image."""
    generator = np.random.default_rng(7)
    y, x = np.mgrid[0:size, 0:size] / size
    board = np.floor(y * boards)
    across = y * boards - board
    warp = 0.35 * noise(generator, size, size, 10, 3) + 0.1 * noise(generator, size, size, 60, 8)
    rings = 0.5 + 0.5 * np.sin(2 * math.pi * (9 * across + 7 * warp + 2.3 * board))
    fibre = noise(generator, size, size, 700, 14)
    own = generator.random(boards)[board.astype(int)]  # of each board
    light = 0.45 + 0.3 * rings**1.5 + 0.3 * (fibre - 0.5) + 0.22 * (own - 0.5)
    light *= np.where(np.minimum(across, 1 - across) < 0.006, 0.25, 1)
    colors = np.ones((size, size, 4), dtype=np.float32)
    colors[..., :3] = np.clip(light, 0.02, 1)[..., None] ** 1.3 * np.array([0.62, 0.37, 0.21])
    image = bpy.data.images.new("wood", size, size)
    image.pixels.foreach_set(colors.ravel())
    image.pack()
    return image


def wood():
    made = material("Wood", roughness=0.38, Clearcoat=0.6)
    tree = made.node_tree
    texture = tree.nodes.new("ShaderNodeTexImage")
    texture.image = wood_image()
    tree.links.new(texture.outputs["Color"], tree.nodes["Principled BSDF"].inputs["Base Color"])
    return made


# Shapes


def mesh_object(name, vertices, faces, its_material, smooth=False):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(v) for v in vertices], [], faces)
    mesh.materials.append(its_material)
    if smooth:
        for face in mesh.polygons:
            face.use_smooth = True
    item = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(item)
    return item


def rounded(points, step):
    """A curve through points (radius, height, rounding): corners become arcs of that size."""
    points = [(np.array(p[:2], dtype=float), p[2] if len(p) > 2 else 0.0) for p in points]
    curve = [points[0][0]]
    for (before, _), (corner, size), (after, _) in zip(points, points[1:], points[2:]):
        if size == 0:
            curve.append(corner)
            continue
        to, onward = before - corner, after - corner
        reach = min(size, 0.5 * np.linalg.norm(to), 0.5 * np.linalg.norm(onward))
        start, end = corner + reach * to / np.linalg.norm(to), corner + reach * onward / np.linalg.norm(onward)
        count = max(3, int(np.linalg.norm(end - start) / step))
        for t in np.linspace(0, 1, count + 1):
            curve.append((1 - t) ** 2 * start + 2 * t * (1 - t) * corner + t**2 * end)
    return [*curve, points[-1][0]]


def lathe(name, points, its_material, place=(0, 0, 0), around=AROUND, step=0.03, smooth=False):
    """A closed solid of revolution. The profile begins and ends on the axis; anticlockwise, with the solid on its left."""
    curve = rounded(points, step)
    angles = 2 * math.pi * np.arange(around) / around
    rings = [(r * math.cos(a), r * math.sin(a), z) for r, z in curve[1:-1] for a in angles]
    vertices = [(0, 0, curve[0][1]), *rings, (0, 0, curve[-1][1])]
    count, last = len(curve) - 2, len(vertices) - 1
    faces = [(0, 1 + (i + 1) % around, 1 + i) for i in range(around)]
    for ring in range(count - 1):
        a, b = 1 + ring * around, 1 + (ring + 1) * around
        faces += [(a + i, a + (i + 1) % around, b + (i + 1) % around, b + i) for i in range(around)]
    top = 1 + (count - 1) * around
    faces += [(last, top + i, top + (i + 1) % around) for i in range(around)]
    item = mesh_object(name, vertices, faces, its_material, smooth)
    item.location = place
    return item


def rounded_box(name, size, its_material, place, rotation, edge, segments=24):
    bpy.ops.mesh.primitive_cube_add(size=1, location=place, rotation=[math.radians(a) for a in rotation])
    item = bpy.context.object
    item.name, item.scale = name, size
    bpy.ops.object.transform_apply(location=False, rotation=False, scale=True)
    bevel = item.modifiers.new("Bevel", "BEVEL")
    bevel.width, bevel.segments, bevel.limit_method = edge, segments, "NONE"
    item.data.materials.append(its_material)
    return item


# Things on the bar


def add_bar():
    size, depth = 16.0, 9.0
    bpy.ops.mesh.primitive_plane_add(size=1, location=(0, 0.6, 0))
    top = bpy.context.object
    top.name, top.scale = "Bar", (size, depth, 1)
    bpy.ops.object.transform_apply(location=False, rotation=False, scale=True)
    for corner in top.data.uv_layers[0].data:
        corner.uv = (corner.uv[0] * size / depth, corner.uv[1])
    top.data.materials.append(wood())


def add_bottle(place):
    glass = clear("Bottle glass", 1.52)
    lathe("Bottle", [
        (0, 0), (0.42, 0.0, 0.05), (0.46, 0.03, 0.06), (0.47, 1.75, 0.35), (0.2, 2.25, 0.3), (0.155, 2.95, 0.03), (0.2, 2.96, 0.02),
        (0.2, 3.12, 0.03), (0.115, 3.13, 0.03), (0.115, 2.4, 0.3), (0.405, 1.72, 0.3), (0.4, 0.16, 0.12), (0.2, 0.13, 0.1), (0, 0.17),
    ], glass, place)  # fmt: skip
    whisky = clear("Whisky", 1.36, (0.93, 0.62, 0.16), 2.4)
    lathe("Whisky in the bottle", [(0, 0.1), (0.3, 0.1, 0.1), (0.43, 0.11, 0.1), (0.43, 1.32), (0, 1.32)], whisky, place)
    lathe("Cork", [(0, 2.86), (0.112, 2.87, 0.01), (0.112, 3.15, 0.0), (0.19, 3.15, 0.02), (0.19, 3.34, 0.05), (0, 3.34)],
          material("Cork", (0.1, 0.045, 0.02), 0.5, Clearcoat=0.5), place, around=128, smooth=True)  # fmt: skip
    return whisky


def add_label(place):
    """A sheet of paper around the front of the bottle, a little outside of it."""
    radius, low, high, half = 0.474, 0.42, 1.3, math.radians(58)
    count = 96
    angles = np.linspace(-math.pi / 2 - half, -math.pi / 2 + half, count + 1)
    vertices = [(radius * math.cos(a), radius * math.sin(a), z) for z in (low, high) for a in angles]
    faces = [(i, i + 1, count + 2 + i, count + 1 + i) for i in range(count)]
    paper = material("Paper", (0.78, 0.7, 0.55), 0.8)
    item = mesh_object("Label", vertices, faces, paper, smooth=True)
    item.location, item.rotation_euler.z = place, math.radians(14)
    band = material("Gold", (0.9, 0.62, 0.25), 0.25, Metallic=1.0)
    narrow, outer = count - 12, 1.003 * radius
    for number, (bottom, top) in enumerate(((0.5, 0.53), (1.19, 1.22))):
        strip = [(outer * math.cos(a), outer * math.sin(a), z) for z in (bottom, top) for a in angles[6:-6]]
        faces = [(i, i + 1, narrow + 2 + i, narrow + 1 + i) for i in range(narrow)]
        item = mesh_object(f"Band {number + 1}", strip, faces, band, smooth=True)
        item.location, item.rotation_euler.z = place, math.radians(14)


def add_tumbler(place, whisky):
    glass, ice = clear("Tumbler glass", 1.52), clear("Ice", 1.31)
    lathe("Tumbler", [
        (0, 0), (0.33, 0.0, 0.04), (0.4, 0.03, 0.08), (0.43, 0.95, 0.025), (0.395, 0.95, 0.025), (0.365, 0.2, 0.1), (0, 0.15),
    ], glass, place)  # fmt: skip
    lathe("Whisky in the tumbler", [(0, 0.1), (0.3, 0.12, 0.05), (0.39, 0.18, 0.05), (0.4, 0.55), (0, 0.55)], whisky, place)
    x, y, z = place
    rounded_box("Ice cube 1", (0.34, 0.34, 0.34), ice, (x - 0.08, y - 0.08, z + 0.44), (14, 8, 25), 0.05)
    rounded_box("Ice cube 2", (0.28, 0.28, 0.28), ice, (x + 0.13, y + 0.13, z + 0.55), (-20, 28, 60), 0.045)


def add_martini(place):
    glass, gin = clear("Martini glass", 1.5), clear("Gin", 1.355, (0.86, 0.95, 0.72), 0.25)
    lathe("Martini", [
        (0, 0), (0.42, 0.0, 0.012), (0.42, 0.025, 0.012), (0.1, 0.055, 0.25), (0.035, 0.18, 0.2), (0.035, 1.0, 0.12),
        (0.1, 1.12, 0.12), (0.62, 1.78, 0.012), (0.6, 1.795, 0.01), (0.06, 1.135, 0.05), (0, 1.13),
    ], glass, place)  # fmt: skip
    lathe("Gin", [(0, 1.1), (0.075, 1.125, 0.05), (0.49, 1.64), (0, 1.64)], gin, place)
    x, y, z = place
    olive = material("Olive", (0.23, 0.27, 0.045), 0.28, Clearcoat=0.4)
    pimento = material("Pimento", (0.55, 0.03, 0.015), 0.3)
    axis = Vector((0.82, 0.12, 0.52)).normalized()
    turn = axis.to_track_quat("Z", "Y")
    centre = Vector((x - 0.06, y - 0.03, z + 1.5))
    lathe("Olive", [
        (0, -0.15), (0.07, -0.143, 0.05), (0.115, -0.08, 0.08), (0.125, 0.0, 0.1), (0.11, 0.09, 0.08), (0.06, 0.14, 0.03), (0, 0.13),
    ], olive, around=96, smooth=True)  # fmt: skip
    lathe("Pimento", [(0, 0.05), (0.042, 0.06, 0.01), (0.04, 0.14, 0.02), (0, 0.155)], pimento, around=64, smooth=True)
    steel = material("Steel", (0.85, 0.84, 0.82), 0.15, Metallic=1.0)
    lathe("Pick", [(0, -0.3), (0.016, -0.22), (0.016, 0.86, 0.005), (0, 0.87)], steel, around=48, smooth=True)
    knob = [(0, 0.84), (0.02, 0.845, 0.01), (0.038, 0.88, 0.03), (0.02, 0.92, 0.02), (0, 0.92)]
    lathe("Knob", knob, steel, around=64, smooth=True)
    for name in ("Olive", "Pimento", "Pick", "Knob"):
        item = bpy.data.objects[name]
        item.location, item.rotation_mode, item.rotation_quaternion = centre, "QUATERNION", turn


def add_room():
    """A dark wall far behind the bar, with lamps out of focus."""
    bpy.ops.mesh.primitive_plane_add(size=60, location=(0, 14, 8), rotation=(math.radians(90), 0, 0))
    bpy.context.object.name = "Wall"
    bpy.context.object.data.materials.append(material("Wall", (0.05, 0.028, 0.02), 0.7))
    generator = np.random.default_rng(3)
    colors = ((1.0, 0.55, 0.2), (1.0, 0.72, 0.4), (1.0, 0.3, 0.12), (0.55, 0.65, 1.0))
    for number in range(26):
        color = colors[int(generator.choice(4, p=(0.5, 0.28, 0.14, 0.08)))]
        lamp = material(f"Lamp {number + 1}", (0, 0, 0), 1.0, Emission=(*color, 1))
        strength = lamp.node_tree.nodes["Principled BSDF"].inputs["Emission Strength"]
        strength.default_value = float(18 + 30 * generator.random())
        x, z = generator.uniform(-5.5, 5.5), generator.uniform(0.6, 5.0)
        place = (x, 9 + 3 * generator.random(), z)
        bpy.ops.mesh.primitive_uv_sphere_add(segments=16, ring_count=8, radius=0.075, location=place)
        bpy.context.object.name = f"Lamp {number + 1}"
        bpy.context.object.data.materials.append(lamp)


def area(name, place, target, size, power, color):
    data = bpy.data.lights.new(name, "AREA")
    data.size, data.energy, data.color = size, power, color
    item = bpy.data.objects.new(name, data)
    item.location = place
    item.rotation_euler = (Vector(target) - Vector(place)).to_track_quat("-Z", "Y").to_euler()
    bpy.context.collection.objects.link(item)


def light_it():
    area("Key", (-3.4, 2.2, 4.4), (0, 0, 0.8), 1.6, 420, (1.0, 0.82, 0.6))
    area("Rim", (3.8, 3.0, 3.0), (0.2, 0, 1.0), 1.4, 260, (1.0, 0.7, 0.42))
    area("Fill", (2.0, -5.5, 4.5), (0, 0, 0.8), 3.0, 90, (0.75, 0.85, 1.0))
    world = bpy.context.scene.world.node_tree.nodes["Background"].inputs
    world["Color"].default_value, world["Strength"].default_value = (0.05, 0.04, 0.06, 1), 0.4


def look_at_it():
    camera = bpy.data.objects["Camera"]
    camera.location = (0.15, -6.9, 2.25)
    camera.rotation_euler = (Vector((0.08, 0, 1.36)) - camera.location).to_track_quat("-Z", "Y").to_euler()
    camera.data.lens, camera.data.clip_start = 56, 0.01
    camera.data.dof.use_dof, camera.data.dof.focus_distance = True, 6.75
    camera.data.dof.aperture_fstop = 0.28  # in the units of decimetres


def render_settings():
    scene = bpy.context.scene
    scene.render.engine = "PHASETREE"
    scene.render.resolution_x, scene.render.resolution_y = 1200, 1000
    scene.phasetree.samples, scene.phasetree.caustics, scene.phasetree.denoise = 256, True, True
    scene.view_settings.view_transform, scene.view_settings.look = "Filmic", "Medium High Contrast"


def make():
    for name in ("Cube", "Light"):
        bpy.data.objects.remove(bpy.data.objects[name])
    add_bar()
    bottle = (-0.95, 0.55, -0.004)
    whisky = add_bottle(bottle)
    add_label(bottle)
    add_tumbler((0.1, -0.35, -0.004), whisky)
    add_martini((1.15, 0.25, -0.004))
    add_room()
    light_it()
    look_at_it()
    render_settings()


if __name__ == "__main__":
    make()
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    if arguments:
        bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath(arguments[0]))
