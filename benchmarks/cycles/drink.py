"""Models a drink in Blender: a glass, a liquid that reaches 0.3 mm into it, three ice cubes and a straw.

    blender --background --factory-startup --python-exit-code 1 --python drink.py -- FOLDER

Writes drink.glb, by Blender's own exporter, for `phasetree import`, and drink.blend for Cycles. Both have the same
meshes: 200,000 triangles, without smooth normals. Lengths are in metres.
"""
import math
import os
import random
import sys

import bpy
from mathutils import Euler, Vector

REACH = 0.0003  # how far the liquid reaches into the glass
AROUND = 300  # vertices around the axis


def divided(profile, longest):
    """A profile whose segments are at most so long."""
    points = [profile[0]]
    for end in profile[1:]:
        start = points[-1]
        parts = max(1, math.ceil(math.dist(start, end) / longest))
        points += [tuple(a + (b - a) * i / parts for a, b in zip(start, end)) for i in range(1, parts + 1)]
    return points


def arc(r, z, radius, start, end, steps=12):
    angles = [math.radians(start + (end - start) * i / steps) for i in range(steps + 1)]
    return [(r + radius * math.cos(a), z + radius * math.sin(a)) for a in angles]


def lathe(profile, around=AROUND):
    """A closed surface around the z axis, from points (radius, z) whose first and last are on the axis."""
    rings = profile[1:-1]
    vertices = [(r * math.cos(2 * math.pi * i / around), r * math.sin(2 * math.pi * i / around), z)
                for r, z in rings for i in range(around)]
    faces = []
    for k in range(len(rings) - 1):
        for i in range(around):
            a, b = k * around + i, k * around + (i + 1) % around
            faces.append((a, b, b + around, a + around))
    for ring, (_, z), turned in ((0, profile[0], True), (len(rings) - 1, profile[-1], False)):
        vertices.append((0.0, 0.0, z))
        for i in range(around):
            a, b = ring * around + i, ring * around + (i + 1) % around
            faces.append((len(vertices) - 1, b, a) if turned else (len(vertices) - 1, a, b))
    return vertices, faces


def glass():
    outer = [(0, 0)] + arc(0.0275, 0.0035, 0.0035, -90, 0) + [(0.0370, 0.118)]
    inner = [(0.0348, 0.118), (0.0292, 0.014)] + arc(0.0252, 0.014, 0.004, 0, -90)[1:] + [(0, 0.010)]
    return lathe(divided(outer + arc(0.0359, 0.118, 0.0011, 0, 180)[1:-1] + inner, 0.0025))


def liquid(level=0.088):
    wall = 0.0292 + (0.0348 - 0.0292) * (level - 0.014) / (0.118 - 0.014)
    bottom = arc(0.0252, 0.014, 0.004 + REACH, -90, 0)
    # The meniscus rises by a millimetre towards the glass.
    surface = [(wall + REACH - 0.004 * t, level + 0.001 * (1 - t) ** 3) for t in (i / 12 for i in range(13))]
    return lathe(divided([(0, 0.010 - REACH)] + bottom + surface + [(0, level)], 0.0025))


def cube(seed, half=0.0093, edge=0.0020, steps=32):
    """A cube with round edges and slightly uneven faces."""
    waves = random.Random(seed)
    phases = [[waves.uniform(0, 6) for _ in range(3)] for _ in range(3)]
    points, faces = {}, []

    def vertex(p):
        core = [max(-half + edge, min(half - edge, x)) for x in p]
        away = Vector(p) - Vector(core)
        on = Vector(core) + edge * away.normalized()
        dent = [0.00035 * math.sin(160 * on[(i + 1) % 3] + phases[i][0]) * math.sin(190 * on[(i + 2) % 3] + phases[i][1])
                for i in range(3)]
        key = tuple(round(x, 7) for x in on)
        return points.setdefault(key, (len(points), on + Vector(dent)))[0]

    for axis in range(3):
        for side in (-1, 1):
            grid = []
            for i in range(steps + 1):
                for k in range(steps + 1):
                    p = [0.0, 0.0, 0.0]
                    p[axis] = side * half
                    p[(axis + 1) % 3], p[(axis + 2) % 3] = (half * math.sin(math.pi / 2 * (2 * n / steps - 1)) for n in (i, k))
                    grid.append(vertex(p))
            for i in range(steps):
                for k in range(steps):
                    a = i * (steps + 1) + k
                    quad = (grid[a], grid[a + steps + 1], grid[a + steps + 2], grid[a + 1])
                    faces.append(quad if side > 0 else quad[::-1])
    return [p for _, p in points.values()], faces


def straw(around=96, along=86, radius=0.0030, wall=0.0003):
    """A tube from the bottom of the glass over its rim, bent near its upper end."""
    low, high = Vector((-0.018, 0.014, 0.0115)), Vector((0.022, 0.019, 0.135))
    line = (high - low).normalized()
    end = high + 0.03 * (line + Vector((1.1, -0.3, -0.35))).normalized()
    # A quadratic curve that leaves the straight part smoothly.
    path = [low.lerp(high, i / (along // 2)) for i in range(along // 2)]
    bend = high + 0.012 * line
    for i in range(along - along // 2):
        t = i / (along - along // 2 - 1)
        path.append((1 - t) ** 2 * high + 2 * t * (1 - t) * bend + t * t * end)
    vertices, faces = [], []
    for r in (radius, radius - wall):
        for i, p in enumerate(path):
            tangent = (path[min(i + 1, len(path) - 1)] - path[max(i - 1, 0)]).normalized()
            x = tangent.cross(Vector((0, 1, 0))).normalized()
            y = tangent.cross(x)
            vertices += [p + r * (math.cos(a) * x + math.sin(a) * y)
                         for a in (2 * math.pi * k / around for k in range(around))]
    rings = len(path)
    for layer in range(2):
        for i in range(rings - 1):
            for k in range(around):
                a = (layer * rings + i) * around + k
                b = (layer * rings + i) * around + (k + 1) % around
                quad = (a, b, b + around, a + around)
                faces.append(quad if layer == 0 else quad[::-1])
    for ring, turned in ((0, True), (rings - 1, False)):
        for k in range(around):
            a, b = ring * around + k, ring * around + (k + 1) % around
            quad = (a, b, b + rings * around, a + rings * around)
            faces.append(quad[::-1] if turned else quad)
    return vertices, faces


def material(name, color, ior=None, roughness=0.0, absorbed=None, density=0.0):
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    surface = nodes["Principled BSDF"]
    surface.inputs["Base Color"].default_value = (*color, 1)
    surface.inputs["Roughness"].default_value = roughness
    if ior:
        surface.inputs["Transmission"].default_value = 1
        surface.inputs["IOR"].default_value = ior
        # The exporter writes a volume only for a material with a thickness in this group.
        name_of_group = "glTF Material Output"
        group = bpy.data.node_groups.get(name_of_group)
        if not group:
            group = bpy.data.node_groups.new(name_of_group, "ShaderNodeTree")
            group.inputs.new("NodeSocketFloat", "Occlusion")
            group.inputs.new("NodeSocketFloat", "Thickness")
            group.nodes.new("NodeGroupInput")
        settings = nodes.new("ShaderNodeGroup")
        settings.node_tree = group
        settings.inputs["Thickness"].default_value = 0.003
    if absorbed:
        volume = nodes.new("ShaderNodeVolumeAbsorption")
        volume.inputs["Color"].default_value = (*absorbed, 1)
        volume.inputs["Density"].default_value = density
        links.new(volume.outputs[0], nodes["Material Output"].inputs["Volume"])
        made.cycles.homogeneous_volume = True
    return made


def add(name, surface, of):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(*surface[:1], [], surface[1])
    mesh.materials.append(of)
    mesh.validate()
    placed = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(placed)
    return placed


def main():
    folder, = sys.argv[sys.argv.index("--") + 1:]
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    add("Glass", glass(), material("Glass", (1, 1, 1), 1.5))
    add("Tea", liquid(), material("Tea", (1, 1, 1), 1.33, absorbed=(0.86, 0.42, 0.10), density=28))
    ice = material("Ice", (1, 1, 1), 1.31)
    for i, (place, turn) in enumerate((((0.0135, 0.0065, 0.0825), (0.5, 0.3, 0.2)), ((-0.0125, 0.0085, 0.0850), (0.2, 0.9, 0.5)),
                                       ((0.0010, -0.0150, 0.0835), (1.0, 0.4, 1.2)))):
        placed = add(f"Ice cube {i + 1}", cube(i), ice)
        placed.location, placed.rotation_euler = place, Euler(turn)
    add("Straw", straw(), material("Straw", (0.75, 0.05, 0.04), roughness=0.35))
    triangles = sum(len(p.vertices) - 2 for o in bpy.data.objects for p in o.data.polygons)
    print(f"{triangles} triangles")
    bpy.ops.export_scene.gltf(filepath=os.path.join(folder, "drink.glb"), export_format="GLB", export_apply=True)
    bpy.ops.wm.save_as_mainfile(filepath=os.path.join(folder, "drink.blend"))


main()
