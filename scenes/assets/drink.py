"""Write a drink as glTF, to be imported by `phasetree import`: a tumbler, water that reaches 0.3 mm into its wall, three
ice cubes half in the water, a wooden board, a camera and a lamp.

    python3 scenes/assets/drink.py drink.glb
"""

import json
import math
import struct
import sys

REACH = 0.0003  # how far the water reaches into the glass, in metres
STEPS = 96  # around the axis


def lathe(profile):
    """A closed surface from a profile of (radius, height), whose first and last points are on the axis; y is up."""
    rings = [(r, y) for r, y in profile if r > 0]
    places, triangles = [], []
    for r, y in rings:
        for i in range(STEPS):
            a = 2 * math.pi * i / STEPS
            places.append((r * math.cos(a), y, -r * math.sin(a)))
    for k in range(len(rings) - 1):
        for i in range(STEPS):
            a, b = k * STEPS + i, k * STEPS + (i + 1) % STEPS
            triangles += [(a, b, b + STEPS), (a, b + STEPS, a + STEPS)]
    for end, ring in ((profile[0], 0), (profile[-1], len(rings) - 1)):
        centre = len(places)
        places.append((0.0, end[1], 0.0))
        for i in range(STEPS):
            a, b = ring * STEPS + i, ring * STEPS + (i + 1) % STEPS
            triangles.append((centre, b, a) if ring == 0 else (centre, a, b))
    return places, triangles


def arc(r, y, radius, start, end, steps=8):
    angles = [math.radians(start + (end - start) * i / steps) for i in range(steps + 1)]
    return [(r + radius * math.cos(a), y + radius * math.sin(a)) for a in angles]


def tumbler():
    outer = [(0, 0)] + arc(0.029, 0.004, 0.004, -90, 0) + [(0.0355, 0.094)]
    inner = [(0.0330, 0.094)] + [(0.0305, 0.013)] + arc(0.0265, 0.013, 0.004, 0, -90)[1:] + [(0, 0.009)]
    return lathe(outer + arc(0.03425, 0.094, 0.00125, 0, 180)[1:-1] + inner)


def water(level=0.070):
    wall = 0.0305 + (0.0330 - 0.0305) * (level - 0.013) / (0.094 - 0.013)
    bottom = arc(0.0265, 0.013, 0.004 + REACH, -90, 0)
    return lathe([(0, 0.009 - REACH)] + bottom + [(wall + REACH, level), (0, level)])


def cube(half=0.0095, edge=0.0018, steps=6):
    """A cube with round edges: points of a finely divided cube, projected onto it."""
    places, triangles = [], []
    for axis in range(3):
        for side in (-1, 1):
            first = len(places)
            for i in range(steps + 1):
                for k in range(steps + 1):
                    # More points near the edges.
                    u, v = (math.sin(math.pi / 2 * (2 * n / steps - 1)) for n in (i, k))
                    p = [0.0, 0.0, 0.0]
                    p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3] = side * half, u * half, v * half
                    core = [max(-half + edge, min(half - edge, x)) for x in p]
                    away = [x - c for x, c in zip(p, core)]
                    length = math.sqrt(sum(x * x for x in away))
                    places.append(tuple(round(c + edge * x / length, 9) for c, x in zip(core, away)))
            for i in range(steps):
                for k in range(steps):
                    a = first + i * (steps + 1) + k
                    b, c, d = a + 1, a + steps + 2, a + steps + 1
                    triangles += [(a, d, c), (a, c, b)] if side > 0 else [(a, c, d), (a, b, c)]
    return places, triangles


def board():
    x, z, low, high = 0.16, 0.11, -0.012, 0.0002  # it reaches slightly into the glass
    places = [(sx * x, y, sz * z) for y in (low, high) for sz in (1, -1) for sx in (-1, 1)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (3, 2, 6, 7), (1, 3, 7, 5), (2, 0, 4, 6)]
    return places, [t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))]


def rotation(axis, degrees):
    half = math.radians(degrees) / 2
    length = math.sqrt(sum(x * x for x in axis))
    return [x / length * math.sin(half) for x in axis] + [math.cos(half)]


class Glb:
    def __init__(self):
        self.data = b""
        self.json = {"asset": {"version": "2.0", "generator": "drink.py"}, "scene": 0, "scenes": [{"nodes": []}],
                     "nodes": [], "meshes": [], "materials": [], "accessors": [], "bufferViews": []}

    def accessor(self, rows, code, component, kind, **more):
        blob = b"".join(struct.pack("<" + code, *row) for row in rows)
        self.json["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(blob)})
        self.data += blob + b"\0" * (-len(blob) % 4)
        self.json["accessors"].append({"bufferView": len(self.json["bufferViews"]) - 1, "componentType": component,
                                       "count": len(rows), "type": kind, **more})
        return len(self.json["accessors"]) - 1

    def mesh(self, surface, material):
        places, triangles = surface
        position = self.accessor(places, "3f", 5126, "VEC3", min=[min(p[i] for p in places) for i in range(3)],
                                 max=[max(p[i] for p in places) for i in range(3)])
        indices = self.accessor([(i,) for t in triangles for i in t], "I", 5125, "SCALAR")
        self.json["meshes"].append({"primitives": [{"attributes": {"POSITION": position}, "indices": indices,
                                                    "material": material}]})
        return len(self.json["meshes"]) - 1

    def material(self, name, color, roughness, **extensions):
        made = {"name": name, "pbrMetallicRoughness": {"baseColorFactor": color + [1], "metallicFactor": 0,
                                                       "roughnessFactor": roughness}}
        if extensions:
            made["extensions"] = {"KHR_materials_" + key: value for key, value in extensions.items()}
        self.json["materials"].append(made)
        return len(self.json["materials"]) - 1

    def node(self, **members):
        self.json["nodes"].append(members)
        self.json["scenes"][0]["nodes"].append(len(self.json["nodes"]) - 1)

    def bytes(self):
        self.json["buffers"] = [{"byteLength": len(self.data)}]
        text = json.dumps(self.json).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(self.data), 0x4E4942) + self.data
        return b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks


def drink():
    glb = Glb()
    glb.json["extensionsUsed"] = ["KHR_materials_transmission", "KHR_materials_volume", "KHR_materials_ior",
                                  "KHR_lights_punctual"]
    clear = {"transmission": {"transmissionFactor": 1}}
    wood = glb.material("Wood", [0.42, 0.22, 0.09], 0.4)
    glass = glb.material("Glass", [1, 1, 1], 0, ior={"ior": 1.5}, volume={"thicknessFactor": 0.003}, **clear)
    liquid = glb.material("Water", [1, 1, 1], 0, ior={"ior": 1.33}, volume={
        "thicknessFactor": 0.06, "attenuationColor": [0.75, 0.9, 0.93], "attenuationDistance": 0.1}, **clear)
    ice = glb.material("Ice", [1, 1, 1], 0.0, ior={"ior": 1.31}, volume={"thicknessFactor": 0.02}, **clear)
    glb.node(name="Board", mesh=glb.mesh(board(), wood))
    glb.node(name="Water", mesh=glb.mesh(water(), liquid))
    glb.node(name="Tumbler", mesh=glb.mesh(tumbler(), glass))
    cubes = glb.mesh(cube(), ice)
    for i, (x, z, axis, degrees) in enumerate(((0.014, 0.007, (1, 2, 3), 35), (-0.0145, 0.009, (2, -1, 1), 65),
                                               (-0.001, -0.017, (-1, 1, 2), 20))):
        glb.node(name=f"Ice cube {i + 1}", mesh=cubes, translation=[x, 0.070, z], rotation=rotation(axis, degrees))
    tilt = rotation((1, 0, 0), -17)
    glb.json["cameras"] = [{"type": "perspective", "perspective": {"yfov": math.radians(24), "aspectRatio": 0.8,
                                                                   "znear": 0.01}}]
    distance, aim = 0.36, 0.043
    glb.node(name="Camera", camera=0, rotation=tilt, translation=[
        0, aim + distance * math.sin(math.radians(17)), distance * math.cos(math.radians(17))])
    glb.json["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "point", "color": [1, 0.95, 0.9],
                                                                  "intensity": 40}]}}
    glb.node(name="Lamp", translation=[-0.35, 0.5, 0.1], extensions={"KHR_lights_punctual": {"light": 0}})
    return glb.bytes()


if __name__ == "__main__":
    with open(sys.argv[1], "wb") as out:
        out.write(drink())
