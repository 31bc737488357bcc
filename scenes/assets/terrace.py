# Makes terrace.glb with Blender 3.4: a round table under a cloth, which falls onto it, a chair, tiles and a low wall.
#
#   blender --background --factory-startup --python scenes/assets/terrace.py -- scenes/assets/terrace.glb
#
# Lengths are in decimetres, as in drinks_in_the_sun.json, whose glasses stand on the cloth at z = 0.0003.
import math
import random
import sys

import bpy

TABLE_RADIUS = 3.0
TABLE_HEIGHT = 7.2
CLOTH_SIDE = 9.2
CLOTH_SEGMENTS = 112
STANDS_AT = 0.0003


def image(name, width, height, pixel, is_data=False):
    made = bpy.data.images.new(name, width, height)
    if is_data:
        made.colorspace_settings.name = "Non-Color"
    values = []
    for y in range(height):
        for x in range(width):
            values += pixel(x, y)
    made.pixels = values
    made.pack()
    return made


def material(name, color=None, roughness=0.8, metallic=0.0, picture=None, rough_picture=None):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Roughness"].default_value = roughness
    shader.inputs["Metallic"].default_value = metallic
    if color:
        shader.inputs["Base Color"].default_value = (*color, 1)
    for source, socket in ((picture, "Base Color"), (rough_picture, "Roughness")):
        if source:
            node = made.node_tree.nodes.new("ShaderNodeTexImage")
            node.image = source
            made.node_tree.links.new(node.outputs["Color"], shader.inputs[socket])
    return made


def gingham():
    """Two rows of threads that cross: white, light and dark red, each thread a little different."""
    random.seed(4)
    side = 256
    across = [random.uniform(0.93, 1.0) for _ in range(side)]
    along = [random.uniform(0.93, 1.0) for _ in range(side)]

    def pixel(x, y):
        stripes = (x < side // 2) + (y < side // 2)
        red, other = ((0.93, 0.90), (0.86, 0.50), (0.74, 0.12))[stripes]
        # In a weave, every second crossing shows the other thread.
        thread = across[x] if (x + y) % 2 else along[y]
        return (red * thread, other * thread, other * thread * 0.96, 1)

    return image("gingham", side, side, pixel)


def tiles():
    """Four terracotta tiles with joints; the second image is how rough they are."""
    random.seed(7)
    side, joint = 256, 5
    tints = [random.uniform(0.85, 1.05) for _ in range(4)]
    spots = [[random.gauss(0, 1) for _ in range(side // 8)] for _ in range(side // 8)]

    def in_joint(x, y):
        return x % (side // 2) < joint or y % (side // 2) < joint

    def color(x, y):
        if in_joint(x, y):
            return (0.42, 0.38, 0.34, 1)
        tint = tints[2 * (y // (side // 2)) + x // (side // 2)] * (1 + 0.03 * spots[y // 8][x // 8])
        return (0.60 * tint, 0.33 * tint, 0.22 * tint, 1)

    def rough(x, y):
        value = 0.95 if in_joint(x, y) else 0.55 + 0.08 * spots[y // 8][x // 8]
        return (value, value, value, 1)

    return image("tiles", side, side, color), image("tiles_rough", side, side, rough, True)


def stones():
    """Rows of stones of different length."""
    random.seed(11)
    width, height, rows = 256, 128, 4
    high = height // rows
    starts = []
    for _ in range(rows):
        row, at = [], random.randint(0, 30)
        while at < width:
            row.append((at, random.uniform(0.8, 1.1)))
            at += random.randint(36, 72)
        starts.append(row)

    def pixel(x, y):
        row = starts[y // high]
        before = [s for s in row if s[0] <= x] or [row[-1]]
        from_side = x - before[-1][0] if before[-1][0] <= x else x + width - before[-1][0]
        if from_side < 3 or y % high < 3:
            return (0.30, 0.28, 0.25, 1)
        tint = before[-1][1] * random.uniform(0.96, 1.04)
        return (0.58 * tint, 0.53 * tint, 0.45 * tint, 1)

    return image("stones", width, height, pixel)


def add(name, made_of, smooth=True):
    thing = bpy.context.object
    thing.name = name
    thing.data.materials.append(made_of)
    if smooth:
        bpy.ops.object.shade_smooth()
    return thing


def repeat_uv(thing, u, v):
    for loop in thing.data.uv_layers.active.data:
        loop.uv = (loop.uv[0] * u, loop.uv[1] * v)


def tube(name, points, radius, made_of, cyclic=False):
    curve = bpy.data.curves.new(name, "CURVE")
    curve.dimensions = "3D"
    curve.bevel_depth = radius
    curve.bevel_resolution = 4
    curve.use_fill_caps = True
    spline = curve.splines.new("BEZIER")
    spline.bezier_points.add(len(points) - 1)
    for point, at in zip(spline.bezier_points, points):
        point.co = at
        point.handle_left_type = point.handle_right_type = "AUTO"
    spline.use_cyclic_u = cyclic
    thing = bpy.data.objects.new(name, curve)
    bpy.context.collection.objects.link(thing)
    thing.data.materials.append(made_of)
    bpy.context.view_layer.objects.active = thing
    thing.select_set(True)
    bpy.ops.object.convert(target="MESH")
    bpy.ops.object.shade_smooth()
    thing.select_set(False)


def chair(x, y, turn, wood):
    """A chair of bent wood, seen from afar."""
    floor, seat = -TABLE_HEIGHT, -TABLE_HEIGHT + 4.5
    cosine, sine = math.cos(turn), math.sin(turn)

    def at(px, py, pz):
        return (x + cosine * px - sine * py, y + sine * px + cosine * py, pz)

    bpy.ops.mesh.primitive_cylinder_add(vertices=64, radius=2.0, depth=0.25, location=at(0, 0, seat))
    bevel = bpy.context.object.modifiers.new("edge", "BEVEL")
    bevel.width, bevel.segments = 0.1, 3
    bpy.ops.object.modifier_apply(modifier="edge")
    add("seat", wood)
    for px, py in ((-1.5, -1.5), (1.5, -1.5), (-1.5, 1.5), (1.5, 1.5)):
        tube("leg", [at(px * 1.1, py * 1.15, floor), at(px * 0.95, py * 0.95, seat)], 0.16, wood)
    for width, top in ((1.75, 5.0), (1.1, 4.1)):
        tube("back", [at(-width, 1.75, seat), at(-width * 1.02, 1.95, seat + 0.6 * top), at(-0.55 * width, 2.1, seat + 0.95 * top),
                      at(0.55 * width, 2.1, seat + 0.95 * top), at(width * 1.02, 1.95, seat + 0.6 * top), at(width, 1.75, seat)],
             0.15, wood)
    tube("ring", [at(1.45 * math.cos(a), 1.45 * math.sin(a), floor + 2.0) for a in [k * math.pi / 4 for k in range(8)]], 0.1, wood, True)


def cloth():
    bpy.ops.mesh.primitive_cylinder_add(vertices=128, radius=TABLE_RADIUS, depth=0.3, location=(0, 0, -0.15))
    table = bpy.context.object
    bevel = table.modifiers.new("edge", "BEVEL")
    bevel.width, bevel.segments = 0.08, 3
    bpy.ops.object.modifier_apply(modifier="edge")
    collision = table.modifiers.new("collision", "COLLISION")
    collision.settings.thickness_outer = 0.02
    collision.settings.cloth_friction = 20

    bpy.ops.mesh.primitive_grid_add(x_subdivisions=CLOTH_SEGMENTS, y_subdivisions=CLOTH_SEGMENTS, size=CLOTH_SIDE,
                                    location=(0.1, 0.0, 0.06), rotation=(0, 0, 0.62))
    sheet = bpy.context.object
    repeat_uv(sheet, 18, 18)
    bpy.ops.object.transform_apply(location=True, rotation=True, scale=True)
    modifier = sheet.modifiers.new("cloth", "CLOTH")
    s = modifier.settings
    s.quality = 10
    s.mass = 0.3
    s.tension_stiffness = s.compression_stiffness = 25
    s.shear_stiffness = 12
    s.bending_stiffness = 1.2
    s.air_damping = 2
    modifier.collision_settings.distance_min = 0.03
    modifier.collision_settings.use_self_collision = True
    modifier.collision_settings.self_distance_min = 0.03
    modifier.point_cache.frame_end = 160
    scene = bpy.context.scene
    scene.gravity = (0, 0, -30)
    for frame in range(1, 161):
        scene.frame_set(frame)
    fallen = bpy.data.meshes.new_from_object(sheet.evaluated_get(bpy.context.evaluated_depsgraph_get()))
    sheet.modifiers.clear()
    sheet.data = fallen
    # On the table the cloth is flat, so that glasses stand on all of it.
    for v in fallen.vertices:
        r = math.hypot(v.co.x, v.co.y)
        part = min(max((TABLE_RADIUS - 0.1 - r) / 0.5, 0), 1)
        part = part * part * (3 - 2 * part)
        v.co.z = part * STANDS_AT + (1 - part) * (v.co.z + STANDS_AT - 0.05)
    fallen.materials.append(material("cloth", picture=gingham(), roughness=1.0))
    bpy.context.view_layer.objects.active = sheet
    bpy.ops.object.shade_smooth()
    bpy.data.objects.remove(table)


def main():
    bpy.ops.wm.read_factory_settings(use_empty=True)
    cloth()
    wood = material("bent wood", (0.10, 0.035, 0.015), roughness=0.35)
    iron = material("iron", (0.03, 0.03, 0.032), roughness=0.6)
    bpy.ops.mesh.primitive_cylinder_add(vertices=96, radius=TABLE_RADIUS - 0.06, depth=0.2, location=(0, 0, -0.25))
    add("table", wood, smooth=False)
    tube("foot", [(0, 0, -TABLE_HEIGHT), (0, 0, -0.3)], 0.3, iron)
    tile, tile_rough = tiles()
    bpy.ops.mesh.primitive_plane_add(size=80, location=(0, 10, -TABLE_HEIGHT))
    repeat_uv(bpy.context.object, 20, 20)
    add("terrace", material("tiles", picture=tile, rough_picture=tile_rough), smooth=False)
    bpy.ops.mesh.primitive_cube_add(size=1, location=(0, 24, -TABLE_HEIGHT + 3.0))
    wall = bpy.context.object
    wall.scale = (80, 2, 6.0)
    bpy.ops.object.transform_apply(scale=True)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.cube_project(cube_size=6)
    bpy.ops.object.mode_set(mode="OBJECT")
    add("wall", material("stones", picture=stones(), roughness=1.0), smooth=False)
    chair(3.6, 6.2, -0.5, wood)
    bpy.ops.export_scene.gltf(filepath=sys.argv[sys.argv.index("--") + 1], export_format="GLB", export_apply=True,
                              export_animations=False)


main()
