#!/usr/bin/env python3
"""Write the images and meshes that the examples of the reference use. Run it in scenes/reference; it needs no packages.

    python3 assets.py
"""

import math
import struct
import zlib


def write_png(name: str, size: int, color_at) -> None:
    """A square image; color_at(x, y) returns red, green and blue from 0 to 1, for x and y from 0 to 1, y up."""
    rows = b""
    for j in range(size):
        rows += b"\0"
        for i in range(size):
            color = color_at((i + 0.5) / size, 1 - (j + 0.5) / size)
            rows += bytes(round(255 * min(max(c, 0), 1)) for c in color)
    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    with open(name, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", size, size, 8, 2, 0, 0, 0))
                   + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def tiles(x: float, y: float) -> tuple[float, ...]:
    """Four tiles with a star of petals in each, and mortar between them."""
    u, v = 2 * x % 1 - 0.5, 2 * y % 1 - 0.5
    if max(abs(u), abs(v)) > 0.46:
        return 0.75, 0.72, 0.66
    radius, angle = math.hypot(u, v), math.atan2(v, u)
    if radius < 0.1:
        return 0.93, 0.75, 0.25
    if radius < 0.2 + 0.16 * math.cos(4 * angle) ** 2:
        return 0.95, 0.93, 0.86
    return (0.13, 0.31, 0.58) if (int(2 * x) + int(2 * y)) % 2 else (0.1, 0.45, 0.47)


def studs(x: float, y: float) -> tuple[float, ...]:
    """The normals of a round stud, from −1 … 1 to 0 … 1."""
    u, v = (x - 0.5) / 0.4, (y - 0.5) / 0.4
    square = u * u + v * v
    normal = (0.8 * u, 0.8 * v, math.sqrt(1 - 0.64 * square)) if square < 1 else (0, 0, 1)
    return tuple(0.5 + 0.5 * n for n in normal)


def write_vase(name: str) -> None:
    """A vase, open at the top, with texture coordinates."""
    around, up = 24, 16
    with open(name, "w", encoding="utf-8") as file:
        print("# A vase about the z axis, from z = 0 to 1.6.", file=file)
        for j in range(up + 1):
            t = j / up
            radius = 0.34 + 0.26 * math.sin(math.pi * (0.15 + 1.25 * t)) + 0.1 * t ** 6
            for i in range(around + 1):
                angle = 2 * math.pi * i / around
                print(f"v {radius * math.cos(angle):.3f} {radius * math.sin(angle):.3f} {1.6 * t:.3f}", file=file)
        for j in range(up + 1):
            for i in range(around + 1):
                print(f"vt {3 * i / around:.3f} {2 * j / up:.3f}", file=file)
        for j in range(up):
            for i in range(around):
                a = j * (around + 1) + i + 1
                b = a + around + 1
                print("f " + " ".join(f"{k}/{k}" for k in (a, a + 1, b + 1, b)), file=file)


def write_shell(name: str) -> None:
    """A sea shell whose vertices have colours."""
    around, along = 10, 44
    vertices, faces = [], []
    for j in range(along + 1):
        turn = 2.6 * 2 * math.pi * j / along
        growth = 0.035 * math.exp(0.19 * turn)
        for i in range(around):
            angle = 2 * math.pi * i / around
            distance = growth * (2 + 1.25 * math.cos(angle))
            band = 0.5 + 0.5 * math.sin(5 * turn)
            color = [0.95 - 0.45 * band, 0.82 - 0.5 * band, 0.66 - 0.45 * band]
            vertices.append((distance * math.cos(turn), distance * math.sin(turn),
                             1.25 - 4.4 * growth + 1.25 * growth * math.sin(angle), *(round(255 * c) for c in color)))
    for j in range(along):
        for i in range(around):
            a, b = j * around + i, j * around + (i + 1) % around
            faces.append((a, b, b + around, a + around))
    with open(name, "w", encoding="utf-8") as file:
        print("ply\nformat ascii 1.0\n" + f"element vertex {len(vertices)}", file=file)
        for axis in "xyz":
            print(f"property float {axis}", file=file)
        for color in ("red", "green", "blue"):
            print(f"property uchar {color}", file=file)
        print(f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header", file=file)
        for x, y, z, *color in vertices:
            print(f"{x:.3f} {y:.3f} {z:.3f}", *color, file=file)
        for face in faces:
            print(4, *face, file=file)


def write_gem(name: str) -> None:
    """A faceted stone: a crown over a pavilion, with eight sides."""
    def ring(radius: float, z: float, shift: float) -> list[tuple[float, float, float]]:
        return [(radius * math.cos((i + shift) * math.pi / 4), radius * math.sin((i + shift) * math.pi / 4), z)
                for i in range(8)]
    girdle, table, top, bottom = ring(1, 0, 0), ring(0.6, 0.4, 0.5), (0, 0, 0.4), (0, 0, -0.9)
    triangles = []
    for i in range(8):
        k = (i + 1) % 8
        triangles += [(girdle[i], girdle[k], table[i]), (table[i], girdle[k], table[k]), (table[i], table[k], top),
                      (girdle[k], girdle[i], bottom)]
    with open(name, "w", encoding="utf-8") as file:
        print("solid gem", file=file)
        for triangle in triangles:
            print("facet normal 0 0 0\nouter loop", file=file)
            for x, y, z in triangle:
                print(f"vertex {x:.4f} {y:.4f} {z:.4f}", file=file)
            print("endloop\nendfacet", file=file)
        print("endsolid gem", file=file)


def write_lamps(name: str) -> None:
    """An environment as a Radiance file: a dim room with three lamps."""
    width, height = 64, 32
    lamps = ((14, 9, 5, 4, (1.0, 0.85, 0.65), 9), (40, 8, 3, 5, (0.6, 0.8, 1.0), 7), (54, 14, 1, 6, (1.0, 0.5, 0.3), 9))
    with open(name, "wb") as file:
        file.write(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width))
        for j in range(height):
            for i in range(width):
                shade = 0.12 + 0.25 * (1 - j / height)
                color = [shade, shade * 1.02, shade * 1.08] if j < height // 2 else [0.13, 0.11, 0.1]
                for x, y, w, h, tint, radiance in lamps:
                    if abs(i - x) <= w and abs(j - y) <= h:
                        color = [radiance * t for t in tint]
                exponent = math.frexp(max(color))[1]
                file.write(bytes([*(int(256 * math.ldexp(c, -exponent)) for c in color), exponent + 128]))


write_png("textures/tiles.png", 96, tiles)
write_png("normal-maps/studs.png", 48, studs)
write_vase("meshes/vase.obj")
write_shell("meshes/shell.ply")
write_gem("meshes/gem.stl")
write_lamps("lights/lamps.hdr")
