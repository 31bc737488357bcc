#!/usr/bin/env python3
"""Makes the segmented volume of scenes/pomegranate.json: a stack of grey images, one for each layer of voxels.

    python3 scenes/assets/pomegranate.py scenes/assets/pomegranate

It replaces a scan that somebody has segmented. The fruit is a ball with a crown, cut across near its top. Within its
rind six membranes part it into chambers, and in these are the seeds: cells of a Voronoi diagram of points that keep away from
each other, shrunk and rounded, each with a kernel. Seeds that the cut would go through stay whole. The same numbers come
out each time: 1 skin, 2 pith, 3 the flesh of seeds, 4 their kernels, 0 air.
"""

import struct
import sys
import zlib
from pathlib import Path

import numpy as np

SIZE = (144, 144, 112)  # voxels along x, y and z
RADIUS = 66.0  # of the fruit, in voxels; its middle is the origin
MIDDLE = np.array([71.5, 71.5, 62.0])
CUT = 22.0  # the height of the cut above the middle
SKIN, PITH, FLESH, KERNEL = 1, 2, 3, 4
CHAMBERS = 6


def smooth_noise(p, rng, waves):
    """A sum of waves of random directions, from about -1 to 1."""
    total = np.zeros(p.shape[:-1], np.float32)
    for _ in range(8):
        direction = rng.normal(size=3)
        direction *= waves / np.linalg.norm(direction)
        total += np.sin(p @ direction.astype(np.float32) + rng.uniform(0, 2 * np.pi))
    return total / 4


def to_membranes(p, rng):
    """How far a point is from the nearest of the walls between chambers, which meet in the axis."""
    angle = np.arctan2(p[..., 1] + 5, p[..., 0] - 3) + 0.3 * smooth_noise(p, rng, 2.2 / RADIUS)
    around = np.hypot(p[..., 0] - 3, p[..., 1] + 5)
    sector = 2 * np.pi / CHAMBERS
    off = np.abs((angle / sector) % 1 - 0.5)  # 0.5 on a wall
    return around * np.sin((0.5 - off) * sector)


def seeds_among(candidates, apart, rng):
    """Points of a list, in random order, that are at least so far from those before."""
    chosen = np.empty((0, 3))
    for p in candidates[rng.permutation(len(candidates))]:
        if len(chosen) == 0 or np.min(np.sum((chosen - p) ** 2, axis=1)) > apart * apart:
            chosen = np.vstack([chosen, p])
    return chosen


def make():
    rng = np.random.default_rng(7)
    axes = [np.arange(n, dtype=np.float32) - m for n, m in zip(SIZE, MIDDLE)]
    p = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).astype(np.float32)
    # The fruit is a little flat, with six blunt edges.
    angle = np.arctan2(p[..., 1], p[..., 0])
    bulge = 1 + 0.012 * np.cos(CHAMBERS * angle) + 0.012 * smooth_noise(p, rng, 4 / RADIUS)
    r = np.sqrt(p[..., 0] ** 2 + p[..., 1] ** 2 + (p[..., 2] * 1.12) ** 2) / bulge
    rind = 7.0 + 1.5 * smooth_noise(p, rng, 6 / RADIUS)
    walls = to_membranes(p, rng)
    core = np.hypot(p[..., 0] - 3, p[..., 1] + 5) - (4 + 3 * smooth_noise(p, rng, 5 / RADIUS))

    fruit = (r < RADIUS) & (p[..., 2] < CUT + 1.5 * smooth_noise(p, rng, 3 / RADIUS))
    label = np.zeros(SIZE, np.uint8)
    label[fruit] = PITH
    label[fruit & (r > RADIUS - 3.0)] = SKIN

    # The chambers, where seeds may be; their walls are of pith. Where they have no seeds there is air.
    chamber = (r < RADIUS - rind) & (walls > 1.6) & (core > 0) & (r < RADIUS)
    label[fruit & chamber] = 0
    roomy = (r < RADIUS - rind - 4.5) & (walls > 6.0) & (core > 5.0) & (p[..., 2] < CUT + 1)
    seeds = seeds_among(p[roomy].astype(float), 11.5, rng)
    # Lloyd's algorithm, a few times: seeds fill their chambers evenly.
    inside = p[chamber & (p[..., 2] < CUT + 7)].astype(np.float32)
    for _ in range(4):
        nearest = nearest_two(inside, seeds)[0]
        counts = np.bincount(nearest, minlength=len(seeds))[:, None]
        sums = np.stack([np.bincount(nearest, inside[:, i], len(seeds)) for i in range(3)], axis=1)
        seeds = np.where(counts > 0, 0.6 * sums / np.maximum(counts, 1) + 0.4 * seeds, seeds)

    where = np.argwhere(chamber & (p[..., 2] < CUT + 12))
    at = p[tuple(where.T)]
    first, d1, second, d2 = nearest_two(at, seeds, with_distances=True)
    # The distance to the face between the two nearest, and a ball that rounds the cell off.
    apart = np.linalg.norm(seeds[first] - seeds[second], axis=1)
    face = (d2**2 - d1**2) / (2 * apart)
    near_wall = np.minimum(walls[tuple(where.T)] - 1.6, RADIUS - rind[tuple(where.T)] - r[tuple(where.T)])
    deep = smooth_least([face - 0.75, near_wall - 0.6, 7.6 - d1], 2.2)
    flesh = deep > 0
    label[tuple(where[flesh].T)] = FLESH
    # A kernel is long towards the axis, as seeds grow inward.
    axis = seeds.copy()
    axis[:, 2] *= 0.5
    axis /= np.linalg.norm(axis, axis=1)[:, None]
    offset = at - seeds[first]
    along = np.sum(offset * axis[first], axis=1)
    across = np.sqrt(np.maximum(np.sum(offset**2, axis=1) - along**2, 0))
    kernel = flesh & (deep > 1.7) & ((along / 4.6) ** 2 + (across / 2.3) ** 2 < 1)
    label[tuple(where[kernel].T)] = KERNEL
    return label


def smooth_least(values, r):
    """The least of several numbers, rounded where two are within r."""
    result = values[0]
    for v in values[1:]:
        h = np.maximum(r - np.abs(result - v), 0) / r
        result = np.minimum(result, v) - h**3 * r / 6
    return result


def nearest_two(points, seeds, with_distances=False):
    """The nearest seed of each point; with distances, also the second nearest."""
    n = len(points)
    first, second = np.empty(n, int), np.empty(n, int)
    d1, d2 = np.empty(n), np.empty(n)
    for i in range(0, n, 4096):
        part = points[i : i + 4096].astype(float)
        squared = np.sum((part[:, None] - seeds[None]) ** 2, axis=2)
        two = np.argpartition(squared, 1, axis=1)[:, :2]
        of_two = np.take_along_axis(squared, two, axis=1)
        order = np.argsort(of_two, axis=1, kind="stable")
        two, of_two = np.take_along_axis(two, order, axis=1), np.take_along_axis(of_two, order, axis=1)
        first[i : i + 4096], second[i : i + 4096] = two.T
        d1[i : i + 4096], d2[i : i + 4096] = np.sqrt(of_two.T)
    return (first, d1, second, d2) if with_distances else (first, d1)


def png(grey):
    """A grey image of a byte a pixel as a PNG file (RFC 2083)."""

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    height, width = grey.shape
    rows = b"".join(b"\0" + row.tobytes() for row in grey)
    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: pomegranate.py FOLDER")
    label = make()
    folder = Path(sys.argv[1])
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("layer_*.png"):
        old.unlink()
    layers = [z for z in range(SIZE[2]) if label[:, :, z].any()]
    # A layer of air above and below, so that the surface closes.
    for i, z in enumerate(range(layers[0] - 1, layers[-1] + 2)):
        layer = label[:, :, z] if 0 <= z < SIZE[2] else np.zeros(SIZE[:2], np.uint8)
        # Rows of an image are seen from above: the first is at the largest y.
        (folder / f"layer_{i:03}.png").write_bytes(png(np.ascontiguousarray(layer.T[::-1])))


if __name__ == "__main__":
    main()
