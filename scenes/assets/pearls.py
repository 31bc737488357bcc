#!/usr/bin/env python3
"""Makes pearls.ply: sugar pearls that have settled in a jar, and some that lie on the table beside it.

    python3 scenes/assets/pearls.py scenes/assets/pearls.ply

Balls that are dropped at random places are pushed apart where they overlap, and sink where nothing holds them, until hardly
any overlaps. The same numbers come out each time. Needs NumPy and SciPy.
"""

import struct
import sys

import numpy
from scipy.spatial import cKDTree

JAR = 0.555  # the radius of the jar's inside, its floor at z = 0.05; lengths are in decimetres
FLOOR = 0.05
COUNT = 13000
BESIDE = 90
SHARES = (0.40, 0.25, 0.20, 0.15)  # of the four colours


def pushed_apart(places, radii, within):
    """One step: half of each overlap is taken from both balls."""
    pairs = cKDTree(places).query_pairs(2 * radii.max(), output_type="ndarray")
    apart = places[pairs[:, 0]] - places[pairs[:, 1]]
    length = numpy.maximum(numpy.linalg.norm(apart, axis=1), 1e-9)
    overlap = radii[pairs].sum(axis=1) - length
    is_met = overlap > 0
    push = apart[is_met] * (0.5 * overlap[is_met] / length[is_met])[:, None]
    moved = places.copy()
    numpy.add.at(moved, pairs[is_met, 0], push)
    numpy.add.at(moved, pairs[is_met, 1], -push)
    return within(moved), overlap[is_met].max(initial=0)


def in_jar(radii):
    def within(places):
        across = numpy.linalg.norm(places[:, :2], axis=1)
        shrink = numpy.minimum(1, (JAR - radii) / numpy.maximum(across, 1e-9))
        places[:, :2] *= shrink[:, None]
        places[:, 2] = numpy.maximum(places[:, 2], FLOOR + radii)
        return places

    return within


def settled(random):
    radii = random.uniform(0.0185, 0.0215, COUNT)
    angle, across = random.uniform(0, 2 * numpy.pi, COUNT), JAR * numpy.sqrt(random.uniform(0, 1, COUNT))
    # A heap: higher in the middle.
    height = FLOOR + random.uniform(0, 1, COUNT) * (0.93 - 0.25 * (across / JAR) ** 2)
    places = numpy.stack([across * numpy.cos(angle), across * numpy.sin(angle), height], axis=1)
    within = in_jar(radii)
    for step in range(3000):
        sink = 0.0004 * max(0.0, 1 - step / 1200)
        places[:, 2] -= sink
        places, overlap = pushed_apart(places, radii, within)
        if step % 300 == 0:
            print(step, f"largest overlap {overlap:.5f}, highest {places[:, 2].max():.3f}", file=sys.stderr)
    return places, radii


def beside(random):
    places, radii = [], []
    while len(places) < BESIDE:
        angle, away = random.uniform(-2.9, 0.4), 0.70 + abs(random.normal(0, 0.32))
        radius = random.uniform(0.0185, 0.0215)
        place = numpy.array([away * numpy.cos(angle), away * numpy.sin(angle), radius])
        if all(numpy.linalg.norm(place - p) > radius + r for p, r in zip(places, radii)):
            places.append(place)
            radii.append(radius)
    return numpy.array(places), numpy.array(radii)


def main():
    random = numpy.random.default_rng(20)
    places, radii = (numpy.concatenate(both) for both in zip(settled(random), beside(random)))
    colors = random.choice(len(SHARES), size=len(radii), p=SHARES)
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(radii)}\n"
    head += "".join(f"property float {name}\n" for name in ("x", "y", "z", "radius")) + "property uchar phase\nend_header\n"
    with open(sys.argv[1], "wb") as out:
        out.write(head.encode())
        for p, r, c in zip(places, radii, colors):
            out.write(struct.pack("<ffffB", *p, r, c))


if __name__ == "__main__":
    main()
