"""Write a still life at a bar as glTF for `phasetree import`, and add lights and a camera to the imported scene.

    python3 scenes/assets/bar.py bar.glb
    phasetree import bar.glb -o bar.json
    python3 scenes/assets/bar.py --light bar.json
    phasetree render bar.json

Each drink meets its glass in one of the three ways that occur in practice: the vermouth overlaps its glass by 0.3 mm,
the wall of the whisky is exactly the inner wall of its tumbler, and a gap of 0.1 mm separates the tonic from its glass.
The olives, the pick, the straw, the coaster, the cork and the label are opaque, and touch clear objects. The cow is a
mesh from another source (spot.ply). Lengths are in metres; y is up.
"""

import argparse
import json
import math
import os
import random
import struct
import sys

import drink
from drink import Glb, arc, lathe, rotation

REACH, GAP = 0.0003, 0.0001
drink.STEPS = 256  # around the axis


def smooth(points, parts=8):
    """A Catmull-Rom spline through points (radius, height)."""
    ends = [points[0]] + points + [points[-1]]
    result = [points[0]]
    for a, b, c, d in zip(ends, ends[1:], ends[2:], ends[3:]):
        for i in range(1, parts + 1):
            t = i / parts
            result.append(tuple(0.5 * (2 * q + (r - p) * t + (2 * p - 5 * q + 4 * r - s) * t * t +
                                       (3 * q - p - 3 * r + s) * t ** 3) for p, q, r, s in zip(a, b, c, d)))
    return result


def offset(profile, distance):
    """A profile moved to the right of its direction, which is outward if it runs upward."""
    result = []
    for i, (r, y) in enumerate(profile):
        (r0, y0), (r1, y1) = profile[max(i - 1, 0)], profile[min(i + 1, len(profile) - 1)]
        length = math.hypot(r1 - r0, y1 - y0)
        result.append((max(r + distance * (y1 - y0) / length, 0), y - distance * (r1 - r0) / length))
    return result


def filled(wall, level, outward):
    """A liquid in a cavity whose wall runs upward from the axis, with a meniscus. `outward` moves its wall."""
    below = [p for p in wall if p[1] < level]
    (r0, y0), (r1, y1) = below[-1], wall[len(below)]
    rim = r0 + (r1 - r0) * (level - y0) / (y1 - y0)
    below = offset(below, outward) if outward else below
    below[0] = (0, below[0][1])
    surface = [(rim + outward - 0.004 * t, level + 0.0012 * (1 - t) ** 3) for t in (i / 12 for i in range(13))]
    return lathe(below + surface + [(0, level)])


def vessel(outer, wall):
    """Glass between two profiles that run upward from the axis, with a round rim between their ends."""
    (ro, yo), (ri, yi) = outer[-1], wall[-1]
    middle, radius = ((ro + ri) / 2, (yo + yi) / 2), math.hypot(ro - ri, yo - yi) / 2
    return lathe(outer + arc(*middle, radius, 0, 180, 12)[1:-1] + wall[::-1])


TUMBLER_WALL = [(0, 0.016)] + arc(0.0290, 0.021, 0.005, -90, 0, 12) + [(0.0355, 0.050), (0.0366, 0.086)]
TUMBLER = [(0, 0.0015), (0.026, 0.0015)] + arc(0.033, 0.004, 0.004, -90, 0, 12) + [(0.0381, 0.050), (0.0388, 0.086)]
HIGHBALL_WALL = [(0, 0.012)] + arc(0.0225, 0.017, 0.005, -90, 0, 12) + [(0.0285, 0.085), (0.0290, 0.150)]
HIGHBALL = [(0, 0.001), (0.022, 0.001)] + arc(0.0262, 0.004, 0.0035, -90, 0, 12) + [(0.0302, 0.085), (0.0306, 0.150)]
COUPE_WALL = smooth([(0, 0.088), (0.010, 0.0895), (0.026, 0.099), (0.0385, 0.115), (0.0440, 0.137)])
COUPE = [(0, 0)] + arc(0.0345, 0.0010, 0.0010, -90, 60) + smooth(
    [(0.030, 0.0024), (0.014, 0.0042), (0.0060, 0.0085), (0.0036, 0.018), (0.0031, 0.045), (0.0034, 0.070),
     (0.0060, 0.082), (0.012, 0.0875), (0.0268, 0.0978), (0.0398, 0.1145), (0.0454, 0.137)])
BOTTLE = [(0, 0.002), (0.024, 0.002)] + arc(0.0345, 0.0045, 0.0045, -90, 0, 12) + [(0.0390, 0.060)] + smooth(
    [(0.0390, 0.130), (0.0388, 0.142), (0.0350, 0.157), (0.0230, 0.172), (0.0150, 0.185), (0.0138, 0.200)]) + [
        (0.0138, 0.225)] + arc(0.0140, 0.229, 0.0030, -90, 90, 10) + [(0.0136, 0.233)]
BOTTLE_WALL = [(0, 0.014)] + arc(0.0302, 0.0195, 0.0055, -90, 0, 12) + [(0.0357, 0.060)] + smooth(
    [(0.0357, 0.130), (0.0354, 0.141), (0.0316, 0.1545), (0.0200, 0.1685), (0.0115, 0.184), (0.0098, 0.200)]) + [
        (0.0098, 0.2325)]


def ice(half, edge, seed, steps=24):
    """A cube with round edges and slightly uneven faces."""
    waves = random.Random(seed)
    phase = [waves.uniform(0, 6) for _ in range(9)]
    places, triangles = drink.cube(half, edge, steps)
    dented = []
    for p in places:
        dent = 0.022 * half * sum(math.sin((2.1 + 0.4 * i) * p[i] / half + phase[i]) *
                                  math.sin((1.7 + 0.5 * i) * p[(i + 1) % 3] / half + phase[3 + i]) for i in range(3))
        dented.append(tuple(x * (1 + dent / half) for x in p))
    return dented, triangles


def tube(path, radius, around=48, hollow=0.0):
    """A tube along a path. Discs close its ends, or rings if it is hollow."""
    radii = [radius, hollow] if hollow else [radius]
    places, triangles, n = [], [], len(path)
    for r in radii:
        for i, p in enumerate(path):
            q, s = path[max(i - 1, 0)], path[min(i + 1, n - 1)]
            t = [b - a for a, b in zip(q, s)]
            length = math.sqrt(sum(x * x for x in t))
            t = [x / length for x in t]
            x = [-t[1], t[0], 0.0]  # across the path, which must never run along z
            length = math.hypot(*x)
            x = [c / length for c in x]
            y = [t[1] * x[2] - t[2] * x[1], t[2] * x[0] - t[0] * x[2], t[0] * x[1] - t[1] * x[0]]
            for k in range(around):
                a = 2 * math.pi * k / around
                places.append(tuple(c + r * (math.cos(a) * u + math.sin(a) * v) for c, u, v in zip(p, x, y)))
    for layer in range(len(radii)):
        for i in range(n - 1):
            for k in range(around):
                a, b = (layer * n + i) * around + k, (layer * n + i) * around + (k + 1) % around
                quad = [(a, b, b + around), (a, b + around, a + around)]
                triangles += quad if layer == 0 else [t[::-1] for t in quad]
    for ring, turned in ((0, True), (n - 1, False)):
        if not hollow:
            places.append(path[0] if turned else path[-1])
        for k in range(around):
            a, b = ring * around + k, ring * around + (k + 1) % around
            if hollow:
                new = [(a, b, b + n * around), (a, b + n * around, a + n * around)]
            else:
                new = [(a, b, len(places) - 1)]
            triangles += [t[::-1] for t in new] if turned else new
    return places, triangles


def olive():
    points = [(0.0088 * math.sin(a), -0.0112 * math.cos(a)) for a in (math.pi * i / 32 for i in range(33))]
    return lathe([(0, points[0][1])] + points[1:-1] + [(0, points[-1][1])])


def disc(radius, low, high, edge):
    return lathe([(0, low)] + arc(radius - edge, low + edge, edge, -90, 0) + arc(radius - edge, high - edge, edge, 0, 90) +
                 [(0, high)])


def slab(x, low, high, near, far):
    places = [(sx * x, y, z) for y in (low, high) for z in (near, far) for sx in (-1, 1)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (3, 2, 6, 7), (1, 3, 7, 5), (2, 0, 4, 6)]
    return places, [t for a, b, c, d in faces for t in ((a, b, c), (a, c, d))]


def label(radius, low, high, half_angle, steps=64):
    """A sheet of paper around a bottle, from 0.3 mm inside its outer wall to 0.15 mm outside."""
    places, triangles = [], []
    for r in (radius - 0.0003, radius + 0.00015):
        for y in (low, high):
            for i in range(steps + 1):
                a = math.radians(-half_angle + 2 * half_angle * i / steps)
                places.append((r * math.sin(a), y, r * math.cos(a)))
    n = steps + 1

    def quad(a, b, c, d):
        triangles.extend([(a, b, c), (a, c, d)])
    for i in range(steps):
        quad(2 * n + i, 2 * n + i + 1, 3 * n + i + 1, 3 * n + i)  # outside
        quad(i + 1, i, n + i, n + i + 1)  # inside
        quad(n + i, 3 * n + i, 3 * n + i + 1, n + i + 1)  # above
        quad(2 * n + i, i, i + 1, 2 * n + i + 1)  # below
    quad(0, 2 * n, 3 * n, n)
    quad(2 * n + steps, steps, n + steps, 3 * n + steps)
    return places, triangles


def cow(size):
    """spot.ply, standing on the bar."""
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), "spot.ply"), "rb") as file:
        data = file.read()
    header, body = data.split(b"end_header\n", 1)
    counts = [int(line.split()[2]) for line in header.splitlines() if line.startswith(b"element")]
    places = [struct.unpack_from("<3f", body, 12 * i) for i in range(counts[0])]
    faces, at = [], 12 * counts[0]
    for _ in range(counts[1]):
        faces.append(struct.unpack_from("<3H", body, at + 1))
        at += 7
    low, high = min(p[1] for p in places), max(p[1] for p in places)
    scale = size / (high - low)
    return [(scale * x, scale * (y - low), scale * z) for x, y, z in places], faces


def bar():
    glb = Glb()
    glb.json["asset"]["generator"] = "bar.py"
    glb.json["extensionsUsed"] = ["KHR_materials_transmission", "KHR_materials_volume", "KHR_materials_ior"]

    def clear(name, ior, color=(1, 1, 1), distance=0.1):
        return glb.material(name, [1, 1, 1], 0, transmission={"transmissionFactor": 1}, ior={"ior": ior}, volume={
            "thicknessFactor": 0.01, "attenuationColor": list(color), "attenuationDistance": distance})

    def add(name, surface, material, place=(0, 0, 0), **more):
        glb.node(name=name, mesh=glb.mesh(surface, material), translation=list(place), **more)

    glass, crystal = clear("Glass", 1.51, (0.93, 0.98, 0.96)), clear("Crystal", 1.55, (0.97, 0.99, 1.0))
    frozen, water = clear("Ice", 1.31, (0.95, 0.99, 1.0)), clear("Water", 1.333, (0.9, 0.97, 0.98))
    whisky = clear("Whisky", 1.358, (0.84, 0.36, 0.05), 0.045)
    vermouth = clear("Vermouth", 1.345, (0.93, 0.88, 0.58), 0.06)
    tonic = clear("Tonic", 1.34, (0.90, 0.98, 0.97), 0.1)
    wood = glb.material("Walnut", [0.10, 0.045, 0.020], 0.30)
    plaster = glb.material("Wall", [0.10, 0.055, 0.035], 0.9)
    steel = glb.material("Steel", [0.75, 0.74, 0.72], 0.18)
    glb.json["materials"][steel]["pbrMetallicRoughness"]["metallicFactor"] = 1
    add("Bar", slab(0.9, -0.04, 0.0002, 0.45, -0.5), wood)
    add("Wall", slab(3, -1, 2, -1.6, -1.7), plaster)

    # Whisky on a cork coaster: liquid and glass share their wall. A film of water lies below the glass.
    x, z, up = 0.022, 0.022, 0.004
    add("Coaster", disc(0.049, 0, up, 0.0012), glb.material("Cork", [0.30, 0.165, 0.075], 0.85), (x, 0, z))
    add("Film of water", disc(0.0425, up - 0.0004, up + 0.0022, 0.0009), water, (x, 0, z))
    add("Tumbler", vessel(TUMBLER, TUMBLER_WALL), glass, (x, up - 0.0005, z))
    add("Whisky", filled(TUMBLER_WALL, 0.050, 0), whisky, (x, up - 0.0005, z))
    add("Large ice", ice(0.0178, 0.0032, 1), frozen, (x + 0.004, 0.0515, z - 0.001), rotation=rotation((0.35, 1, 0.2), 34))
    add("Small ice", ice(0.0095, 0.0024, 5), frozen, (x - 0.0205, 0.0515, z + 0.009), rotation=rotation((1, 0.4, 0.6), 52))

    # Vermouth with an olive: the liquid reaches into the glass.
    x, z = -0.120, 0.010
    add("Coupe", vessel(COUPE, COUPE_WALL), glass, (x, 0, z))
    add("Vermouth", filled(COUPE_WALL, 0.124, REACH), vermouth, (x, 0, z))
    green = glb.material("Olive", [0.20, 0.23, 0.035], 0.22)
    low, high = (0.012, 0.1045, 0.006), (-0.052, 0.1485, -0.010)
    along = [h - l for l, h in zip(low, high)]
    length = math.sqrt(sum(a * a for a in along))
    turn = rotation((along[2], 0, -along[0]), math.degrees(math.acos(along[1] / length)))
    for name, t in (("Olive", 0.22), ("Second olive", 0.52)):
        add(name, olive(), green, [c + l + t * a for c, l, a in zip((x, 0, z), low, along)], rotation=turn)
    add("Pick", tube([[c + l + (i / 20) * a for c, l, a in zip((x, 0, z), low, along)] for i in range(21)], 0.0007), steel)
    add("Knob", drink_ball(0.0028), steel, [c + h for c, h in zip((x, 0, z), high)])

    # Tonic with ice and a straw: there is a gap between liquid and glass.
    x, z = 0.122, -0.050
    add("Highball", vessel(HIGHBALL, HIGHBALL_WALL), glass, (x, 0, z))
    add("Tonic", filled(HIGHBALL_WALL, 0.118, -GAP), tonic, (x, 0, z))
    for i, (dx, y, dz, axis, angle) in enumerate(((-0.008, 0.041, 0.004, (1, 2, 3), 35), (0.006, 0.068, -0.006, (2, -1, 1), 65),
                                                  (-0.007, 0.094, -0.003, (-1, 1, 2), 20), (0.009, 0.113, 0.007, (1, 1, -1), 50))):
        add(f"Ice cube {i + 1}", ice(0.0118, 0.0026, 11 + i), frozen, (x + dx, y, z + dz), rotation=rotation(axis, angle))
    red = glb.material("Straw", [0.55, 0.02, 0.02], 0.3)
    add("Straw", tube([(x - 0.014 + 0.045 * t, 0.0135 + 0.178 * t, z + 0.017 - 0.012 * t) for t in (i / 40 for i in range(41))],
                      0.0031, hollow=0.0027), red)

    # A bottle behind the drinks, and a glass cow in front.
    x, z = -0.048, -0.105
    add("Bottle", vessel(BOTTLE, BOTTLE_WALL), glass, (x, 0, z))
    add("Bottled whisky", filled(BOTTLE_WALL, 0.138, REACH), whisky, (x, 0, z))
    add("Cork", lathe([(0, 0.212), (0.0100, 0.212), (0.0100, 0.234), (0.0150, 0.2345), (0.0155, 0.236), (0.0155, 0.250),
                       (0.0145, 0.252), (0, 0.252)]), glb.material("Stopper", [0.05, 0.03, 0.02], 0.4), (x, 0, z))
    add("Label", label(0.0390, 0.052, 0.112, 62), glb.material("Paper", [0.62, 0.54, 0.40], 0.7), (x, 0, z),
        rotation=rotation((0, 1, 0), 8))
    add("Band", label(0.0390, 0.078, 0.0815, 61.5), glb.material("Ink", [0.10, 0.015, 0.012], 0.5), (x, 0, z + 0.0001),
        rotation=rotation((0, 1, 0), 8))
    add("Crystal cow", cow(0.056), crystal, (0.104, 0.0001, 0.046), rotation=rotation((0, 1, 0), -42))
    return glb.bytes()


def drink_ball(radius):
    points = [(radius * math.sin(a), -radius * math.cos(a)) for a in (math.pi * i / 24 for i in range(25))]
    return lathe([(0, -radius)] + points[1:-1] + [(0, radius)])


def light(scene):
    """Add lamps far behind, out of focus, a glow on the wall, three softboxes and a camera; z is up here."""
    lamps = random.Random(4)
    warm, cool = [], []
    for _ in range(26):
        place = [round(lamps.uniform(-0.75, 0.75), 3), round(lamps.uniform(1.15, 1.5), 3), round(lamps.uniform(0.02, 0.42), 3)]
        (warm if lamps.random() < 0.75 else cool).append(place)
    scene["lights"] = [
        {"rectangle": {"centre": [-0.55, 0.30, 0.42], "target": [0, 0, 0.07], "width": 0.22, "height": 0.55,
                       "radiance": [1, 0.9, 0.78], "intensity": 9}},
        {"rectangle": {"centre": [0.62, 0.12, 0.30], "target": [0, 0, 0.08], "width": 0.10, "height": 0.50,
                       "radiance": [0.75, 0.86, 1], "intensity": 7}},
        {"rectangle": {"centre": [0.05, -0.15, 0.85], "target": [0, 0, 0.05], "width": 0.5, "height": 0.3,
                       "radiance": [1, 0.92, 0.82], "intensity": 2.2}},
        {"sphere": {"centre": [-0.05, 1.25, 0.06], "radius": 0.06, "radiance": [1, 0.55, 0.22], "intensity": 90,
                    "visible_to_camera": False}},
        {"spheres": {"centres": warm, "radius": 0.009, "radiance": [1, 0.52, 0.18], "intensity": 30}},
        {"spheres": {"centres": cool, "radius": 0.007, "radiance": [1, 0.80, 0.55], "intensity": 34}},
        {"constant": {"radiance": [0.012, 0.013, 0.018]}},
    ]
    scene["camera"] = {"thin_lens": {"position": [0.01, -0.66, 0.180], "look_at": [0, 0, 0.093], "fov": 26.5,
                                     "lens_radius": 0.006, "focus_at": [0, -0.03, 0.06]}}
    scene["render"] = {"width": 1200, "height": 900, "samples": 256, "exposure": 0, "caustics": True}
    return scene


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("file", help="the glTF file to write (.glb), or the scene to light")
    parser.add_argument("--light", action="store_true", help="replace lights, camera and render settings of a scene")
    arguments = parser.parse_args()
    try:
        if not arguments.light:
            with open(arguments.file, "wb") as out:
                out.write(bar())
            return
        with open(arguments.file, encoding="utf-8") as file:
            imported = json.load(file)
        if not isinstance(imported, dict):
            raise ValueError("not a scene")
        text = json.dumps(light(imported), indent=1)
        with open(arguments.file, "w", encoding="utf-8") as out:
            out.write(text)
    except (OSError, ValueError) as error:
        sys.exit(f"bar.py: {arguments.file}: {error.strerror if isinstance(error, OSError) else error}")


if __name__ == "__main__":
    main()
