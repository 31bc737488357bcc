#!/usr/bin/env python3
"""Write the meshes of scenes/manual/thin_surfaces.json to the folder thin_surfaces: a pane, a plant and a lampshade, each a
single layer of triangles. Run it in scenes/assets; it needs no packages.

    python3 thin_surfaces.py
"""

import math

Point = tuple[float, float, float]


def write_ply(name: str, points: list[Point], faces: list[tuple[int, ...]], colors: list[Point] | None = None) -> None:
    with open(f"thin_surfaces/{name}.ply", "w", encoding="utf-8") as file:
        print(f"ply\nformat ascii 1.0\nelement vertex {len(points)}", file=file)
        for axis in "xyz":
            print(f"property float {axis}", file=file)
        if colors:
            for color in ("red", "green", "blue"):
                print(f"property uchar {color}", file=file)
        print(f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header", file=file)
        for i, p in enumerate(points):
            print(*(f"{c:.4f}" for c in p), *(round(255 * c) for c in (colors[i] if colors else ())), file=file)
        for face in faces:
            print(len(face), *face, file=file)


def pane() -> None:
    """A rectangle in the plane y = 0, with its centre at the origin."""
    x, z = 0.785, 0.535
    write_ply("pane", [(-x, 0, -z), (x, 0, -z), (x, 0, z), (-x, 0, z)], [(0, 1, 2, 3)])


def shade() -> None:
    """A pleated cone about the z axis, open at both ends."""
    pleats, along = 36, 12
    around = 4 * pleats
    points, faces = [], []
    for j in range(along + 1):
        t = j / along
        for i in range(around):
            angle = 2 * math.pi * i / around
            radius = (0.40 - 0.21 * t) * (1 + 0.035 * (abs((i % 4) - 2) - 1))
            points.append((radius * math.cos(angle), radius * math.sin(angle), 0.5 * t))
    for j in range(along):
        for i in range(around):
            a, b = j * around + i, j * around + (i + 1) % around
            faces.append((a, b, b + around, a + around))
    write_ply("shade", points, faces)


def leaf(points: list[Point], faces: list[tuple[int, ...]], colors: list[Point], angle: float, tilt: float,
         length: float, start: float) -> None:
    """A leaf that leaves the z axis at the height `start`, rises by `tilt` and bends down. Veins are lighter."""
    across, along = 14, 32
    first = len(points)
    for j in range(along + 1):
        t = j / along
        width = 0.30 * length * math.sin(math.pi * t ** 0.75) ** 0.9 if 0 < t < 1 else 0.0
        bend = tilt - 1.25 * t
        # The middle of the leaf: an arc that begins with the tilt.
        out = length * (math.sin(tilt) - math.sin(bend)) / 1.25 + 0.05
        up = start + length * (math.cos(bend) - math.cos(tilt)) / 1.25
        for i in range(across + 1):
            s = 2 * i / across - 1
            fold = 0.32 * abs(s) * width + 0.012 * length * math.sin(9 * t + 3 * s) * abs(s)
            x, y, z = out, s * width, up + fold
            points.append((x * math.cos(angle) - y * math.sin(angle), x * math.sin(angle) + y * math.cos(angle), z))
            middle = math.exp(-(s * width / (0.008 * length)) ** 2)
            side = (9 * (t - 0.35 * abs(s))) % 1
            veins = max(middle, 0.75 * math.exp(-((side - 0.5) / 0.07) ** 2) * (1 - abs(s)) ** 0.5)
            colors.append(tuple(a + (b - a) * veins for a, b in zip((0.33, 0.52, 0.10), (0.72, 0.80, 0.42))))
    for j in range(along):
        for i in range(across):
            a = first + j * (across + 1) + i
            faces.append((a, a + 1, a + across + 2, a + across + 1))


def plant() -> None:
    points: list[Point] = []
    faces: list[tuple[int, ...]] = []
    colors: list[Point] = []
    for i in range(11):
        leaf(points, faces, colors, 2.399963 * i + 0.5, 0.25 + 0.09 * ((5 * i) % 11), 0.42 + 0.05 * ((7 * i) % 5),
             0.02 * i)
    write_ply("plant", points, faces, colors)


pane()
shade()
plant()
