# Makes ivy.glb with Blender 3.4: an old wall of bricks, flagstones, and ivy whose leaves are cut out of rectangles by
# alpha. Bricks and stones have maps of normals, and so have the leaves.
#
#   blender --background --factory-startup --python scenes/assets/ivy.py -- scenes/assets/ivy.glb
#
# Lengths are in decimetres. The ground is z = 0, and the wall y = 1.7.
import math
import random
import sys

import bpy
import mathutils
import numpy as np

WALL_AT = 1.7


def image(name, pixels, is_data=False):
    """`pixels` has rows from the lower one, and three or four channels."""
    height, width, channels = pixels.shape
    made = bpy.data.images.new(name, width, height, alpha=channels == 4)
    if is_data:
        made.colorspace_settings.name = "Non-Color"
    filled = np.ones((height, width, 4), np.float32)
    filled[:, :, :channels] = np.clip(pixels, 0, 1)
    made.pixels = filled.ravel()
    made.pack()
    return made


def normals_of(height):
    """The normals of a height in pixels, which goes on beyond its edges."""
    dx = (np.roll(height, -1, 1) - np.roll(height, 1, 1)) / 2
    dy = (np.roll(height, -1, 0) - np.roll(height, 1, 0)) / 2
    n = np.stack([-dx, -dy, np.ones_like(height)], 2)
    n /= np.linalg.norm(n, axis=2, keepdims=True)
    return 0.5 * n + 0.5


def noise(generator, side, cells, height=None):
    """Smooth noise of mean 0 that repeats; `cells` of it stand side by side."""
    height = height or side
    rows = max(1, cells * height // side)
    values = generator.normal(size=(rows, cells))
    y, x = np.mgrid[0:height, 0:side]
    u, v = x * cells / side, y * rows / height
    i, j = u.astype(int), v.astype(int)
    s, t = u - i, v - j
    s, t = s * s * (3 - 2 * s), t * t * (3 - 2 * t)

    def at(dj, di):
        return values[(j + dj) % rows, (i + di) % cells]

    return (at(0, 0) * (1 - s) + at(0, 1) * s) * (1 - t) + (at(1, 0) * (1 - s) + at(1, 1) * s) * t


def bricks():
    """Eight courses of four bricks."""
    generator = np.random.default_rng(5)
    side, courses, across = 512, 8, 4
    high, wide = side // courses, side // across
    y, x = np.mgrid[0:side, 0:side]
    course = y // high
    shifted = (x + (course % 2) * wide // 2) % side
    brick = shifted // wide
    wobble = 1.6 * noise(generator, side, 48)
    edge = np.minimum.reduce([shifted % wide, wide - 1 - shifted % wide, 1.0 * (y % high), high - 1.0 - y % high]) + wobble
    inside = np.clip((edge - 4) / 5, 0, 1)
    inside = inside * inside * (3 - 2 * inside)
    out = generator.uniform(-1.5, 1.5, (courses, across))[course, brick]
    height = inside * (9 + out) + 0.5 * noise(generator, side, 128) + 0.7 * noise(generator, side, 32)
    tint = generator.uniform(0.72, 1.12, (courses, across))[course, brick]
    hue = generator.uniform(-0.04, 0.05, (courses, across))[course, brick]
    grain = 1 + 0.07 * noise(generator, side, 128) + 0.08 * noise(generator, side, 12)
    color = np.stack([0.50 * tint, (0.31 + hue) * tint, (0.245 + hue) * tint], 2) * grain[:, :, None]
    mortar = np.stack([0.60 * grain, 0.56 * grain, 0.50 * grain], 2)
    return image("bricks", inside[:, :, None] * color + (1 - inside[:, :, None]) * mortar), image(
        "bricks_normal", normals_of(height), True)


def flagstones():
    """Two rows of stones, and how rough they are."""
    generator = np.random.default_rng(8)
    side = 512
    y, x = np.mgrid[0:side, 0:side]
    row = y // 256
    shifted = (x + row * 150) % side
    stone = (shifted > 290).astype(int)
    from_side = np.where(stone == 0, np.minimum(shifted, 290 - shifted), np.minimum(shifted - 290, side - shifted))
    edge = np.minimum(from_side, np.minimum(y % 256, 256 - y % 256)) + 2.5 * noise(generator, side, 24)
    inside = np.clip((edge - 4) / 7, 0, 1)
    inside = inside * inside * (3 - 2 * inside)
    worn = noise(generator, side, 10) + 0.5 * noise(generator, side, 24)
    height = 9 * inside + 1.6 * worn + 0.45 * noise(generator, side, 96)
    tint = np.array([[0.95, 1.1], [1.05, 0.88]])[row, stone] * (1 + 0.05 * worn + 0.04 * noise(generator, side, 128))
    color = np.stack([0.44 * tint, 0.42 * tint, 0.385 * tint], 2)
    joint = np.stack([0.20 * tint, 0.19 * tint, 0.15 * tint], 2)
    rough = np.clip(0.62 - 0.10 * worn, 0.4, 0.95) * inside + 0.97 * (1 - inside)
    return (image("stones", inside[:, :, None] * color + (1 - inside[:, :, None]) * joint),
            image("stones_normal", normals_of(height), True), image("stones_rough", np.stack([rough] * 3, 2), True))


def leaf():
    """An ivy leaf with five lobes, its stalk at the middle of the lower edge."""
    side = 256
    y, x = np.mgrid[0:side, 0:side]
    u, v = (x - side / 2 + 0.5) / (side / 2), (y + 0.5) / side * 2 - 0.62
    radius, angle = np.hypot(u, v), np.arctan2(u, v)
    lobes = [(0.0, 1.28, 0.34), (1.02, 0.86, 0.30), (-1.02, 0.86, 0.30), (2.05, 0.58, 0.42), (-2.05, 0.58, 0.42)]
    outline = np.full_like(radius, 0.40)
    for at, length, width in lobes:
        off = np.abs((angle - at + np.pi) % (2 * np.pi) - np.pi)
        outline = np.maximum(outline, 0.40 + (length - 0.40) * np.exp(-(off / width) ** 1.6))
    inside = np.clip((0.98 * outline - radius) * 60, 0, 1)
    stalk = np.clip((0.022 - np.abs(u)) * 90, 0, 1) * (v < 0.1)
    veins = np.zeros_like(radius)
    for at, length, _ in lobes:
        along, off = u * np.sin(at) + v * np.cos(at), u * np.cos(at) - v * np.sin(at)
        veins = np.maximum(veins, np.exp(-(off / (0.028 * (1.2 - np.clip(along / length, 0, 1)))) ** 2) * (along > 0))
        side_veins = np.abs((along - 0.9 * np.abs(off)) * 7 % 1 - 0.5) * 2
        near = (np.abs(off) < 0.32 * length) & (along > 0.15) & (along < length)
        veins = np.maximum(veins, 0.45 * np.exp(-((1 - side_veins) / 0.16) ** 2) * near * (np.abs(off) > 0.02))
    veins = np.minimum(veins, 1)
    grain = 1 + 0.10 * noise(np.random.default_rng(2), side, 40)
    dark, light = np.array([0.050, 0.150, 0.032]), np.array([0.27, 0.40, 0.14])
    color = (dark + (light - dark) * (0.62 * veins)[:, :, None]) * grain[:, :, None]
    encoded = np.where(color <= 0.0031308, 12.92 * color, 1.055 * np.maximum(color, 1e-6) ** (1 / 2.4) - 0.055)
    pixels = np.concatenate([encoded, np.maximum(inside, stalk)[:, :, None]], 2)
    height = -2.2 * veins + 0.5 * noise(np.random.default_rng(3), side, 32)
    return image("leaf", pixels), image("leaf_normal", normals_of(height), True)


def material(name, color, normals, rough=0.8, rough_image=None, tint=None, alpha=False, strength=1.0):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    tree = made.node_tree
    shader = tree.nodes["Principled BSDF"]
    shader.inputs["Roughness"].default_value = rough

    def picture(of):
        node = tree.nodes.new("ShaderNodeTexImage")
        node.image = of
        return node

    base = picture(color)
    tree.links.new(base.outputs["Color"], shader.inputs["Base Color"])
    if tint:
        mix = tree.nodes.new("ShaderNodeMixRGB")
        mix.blend_type = "MULTIPLY"
        mix.inputs["Fac"].default_value = 1
        mix.inputs["Color2"].default_value = (*tint, 1)
        tree.links.new(base.outputs["Color"], mix.inputs["Color1"])
        tree.links.new(mix.outputs["Color"], shader.inputs["Base Color"])
    if alpha:
        tree.links.new(base.outputs["Alpha"], shader.inputs["Alpha"])
        made.blend_method = "CLIP"
    if rough_image:
        tree.links.new(picture(rough_image).outputs["Color"], shader.inputs["Roughness"])
    bend = tree.nodes.new("ShaderNodeNormalMap")
    bend.inputs["Strength"].default_value = strength
    tree.links.new(picture(normals).outputs["Color"], bend.inputs["Color"])
    tree.links.new(bend.outputs["Normal"], shader.inputs["Normal"])
    return made


def rectangle(name, corners, repeat, made_of):
    """Four corners, anticlockwise from the lower left one of the image."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(corners, [], [(0, 1, 2, 3)])
    layer = mesh.uv_layers.new(name="UVMap")
    for loop, (u, v) in zip(layer.data, ((0, 0), (repeat[0], 0), repeat, (0, repeat[1]))):
        loop.uv = (u, v)
    mesh.materials.append(made_of)
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(thing)


class Leaves:
    """Leaves of one material as one mesh: each a bent rectangle, whose lower edge has its middle at a place."""

    PARTS = 4

    def __init__(self, made_of):
        self.made_of, self.places, self.faces, self.uvs = made_of, [], [], []

    def add(self, at, towards, up, size, bend):
        towards = towards.normalized()
        side = up.cross(towards).normalized()
        along = towards.cross(side)
        first = len(self.places)
        n = self.PARTS
        for j in range(n + 1):
            for i in range(n + 1):
                u, v = i / n - 0.5, j / n
                fold = -bend * (0.55 * abs(u) + 1.1 * v * v) + 0.10 * bend
                self.places.append(at + size * (u * side + v * along + fold * towards))
        for j in range(n):
            for i in range(n):
                a = first + j * (n + 1) + i
                self.faces.append((a, a + 1, a + n + 2, a + n + 1))
                self.uvs += [(i / n, j / n), ((i + 1) / n, j / n), ((i + 1) / n, (j + 1) / n), (i / n, (j + 1) / n)]

    def finish(self, name):
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata([tuple(p) for p in self.places], [], self.faces)
        layer = mesh.uv_layers.new(name="UVMap")
        for loop, uv in zip(layer.data, self.uvs):
            loop.uv = uv
        mesh.materials.append(self.made_of)
        mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
        thing = bpy.data.objects.new(name, mesh)
        bpy.context.collection.objects.link(thing)


def stem(points, made_of):
    curve = bpy.data.curves.new("stem", "CURVE")
    curve.dimensions = "3D"
    curve.bevel_depth = 0.022
    curve.bevel_resolution = 2
    spline = curve.splines.new("POLY")
    spline.points.add(len(points) - 1)
    for point, at in zip(spline.points, points):
        point.co = (*at, 1)
    thing = bpy.data.objects.new("stem", curve)
    bpy.context.collection.objects.link(thing)
    thing.data.materials.append(made_of)
    bpy.context.view_layer.objects.active = thing
    thing.select_set(True)
    bpy.ops.object.convert(target="MESH")
    bpy.ops.object.shade_smooth()
    thing.select_set(False)


def ivy(kinds, bark):
    random.seed(12)
    vector = mathutils.Vector

    def grow(at, direction, length, on_wall):
        """A stem that winds on, and leaves to both sides of it."""
        points, turn = [at.copy()], 0.0
        away = vector((0, -1, 0)) if on_wall else vector((0, 0, 1))
        for step in range(int(length / 0.16)):
            turn = 0.75 * turn + random.gauss(0, 0.16)
            direction = (mathutils.Matrix.Rotation(turn, 3, away) @ direction).normalized()
            at = at + 0.16 * direction
            points.append(at + away * random.uniform(0.02, 0.05))
            if step % 2 == 0 or random.random() < 0.35:
                side = direction.cross(away) * random.choice((-1, 1))
                up = (0.35 * direction + side * random.uniform(0.3, 1.0)).normalized()
                if on_wall:  # leaves of a wall hang
                    up = (up + vector((0, 0, -0.75))).normalized()
                towards = away + vector((random.gauss(0, 0.28), random.gauss(0, 0.2), random.gauss(0, 0.28) + (0.45 if on_wall else 0)))
                size = random.uniform(0.30, 0.52) * (1 - 0.45 * step * 0.16 / length)
                random.choice(kinds).add(at + away * random.uniform(0.06, 0.20), towards, up, size, random.uniform(0.15, 0.5))
        stem(points, bark)

    wall = WALL_AT - 0.05
    for x, z, dx, dz, length in ((-2.9, 0.0, 0.25, 1, 3.6), (-2.5, 0.0, 0.5, 1, 3.4), (-2.1, 0.1, 0.9, 0.8, 2.6), (-3.4, 0.0, 0.1, 1, 3.8),
                                 (-2.7, 1.3, 0.9, 0.55, 2.6), (-2.4, 2.2, 1, 0.3, 2.4), (-1.9, 0.6, 0.6, 0.6, 1.5), (-3.0, 2.4, 1, 0.5, 2.5),
                                 (2.9, 4.0, -0.25, -1, 1.9), (3.4, 4.0, -0.15, -1, 2.6), (2.3, 4.0, -0.3, -1, 1.2), (3.8, 3.6, -0.4, -1, 2.4),
                                 (-3.6, 1.0, 0.6, 1, 3.0), (-1.3, 4.0, 0.4, -1, 0.9), (-2.2, 4.0, 0.1, -1, 1.4)):
        grow(vector((x, wall, z)), vector((dx, 0, dz)), length, True)
    for x, y, dx, dy, length in ((-2.5, 1.5, 0.9, -1, 1.9), (-2.0, 1.5, 1, -0.45, 1.5), (-3.1, 1.4, 0.3, -1, 2.6), (2.9, 1.5, -0.9, -0.6, 1.6),
                                (-2.4, 0.9, 1, -0.35, 1.7), (-3.0, 0.5, 1, -0.25, 1.9)):
        grow(vector((x, y, 0.02)), vector((dx, dy, 0)), length, False)
    # Between the sun and the wall, above what the camera sees: they throw spots of light.
    for x, y, z, dx, dz, length in ((4.9, -2.4, 4.7, -1, -0.2, 1.8), (4.6, -2.5, 4.0, -1, -0.1, 1.6), (5.2, -2.2, 3.7, -1, 0.1, 1.5),
                                    (4.7, -2.6, 5.2, -1, 0.05, 2.2), (4.4, -2.3, 3.3, -0.8, 0.3, 0.8)):
        grow(vector((x, y, z)), vector((dx, 0, dz)), length, True)
    # One has fallen into the mug.
    kinds[1].add(vector((-0.06, -0.14, 0.855)), vector((0.05, -0.08, 1)), vector((0.75, 0.6, 0)), 0.30, -0.12)


bpy.ops.wm.read_factory_settings(use_empty=True)
brick, brick_normal = bricks()
stone, stone_normal, stone_rough = flagstones()
green, green_normal = leaf()
rectangle("wall", [(-8, WALL_AT, -0.2), (8, WALL_AT, -0.2), (8, WALL_AT, 7.8), (-8, WALL_AT, 7.8)], (2.6, 1.9),
          material("bricks", brick, brick_normal, 0.9))
rectangle("ground", [(-8, -8, 0), (8, -8, 0), (8, WALL_AT, 0), (-8, WALL_AT, 0)], (4, 2.425),
          material("stones", stone, stone_normal, 0.7, stone_rough))
kinds = [Leaves(material(name, green, green_normal, rough, tint=tint, alpha=True, strength=0.8))
         for name, rough, tint in (("ivy", 0.38, None), ("young ivy", 0.42, (0.95, 1.0, 0.62)), ("old ivy", 0.5, (0.75, 0.72, 0.80)))]
bark = bpy.data.materials.new("bark")
bark.use_nodes = True
bark.node_tree.nodes["Principled BSDF"].inputs["Base Color"].default_value = (0.12, 0.08, 0.045, 1)
bark.node_tree.nodes["Principled BSDF"].inputs["Roughness"].default_value = 0.9
ivy(kinds, bark)
for kind, name in zip(kinds, ("ivy", "young ivy", "old ivy")):
    kind.finish(name)
bpy.ops.export_scene.gltf(filepath=sys.argv[sys.argv.index("--") + 1], export_format="GLB", export_image_format="AUTO",
                          export_animations=False)
