"""Volumes of solids in closed form by three methods: guaranteed intervals, random points, and meshing.

    PYTHONPATH=build/release/plugins/python python3 benchmarks/volumes.py

Prints a row for each solid and tolerance. All methods take about the same processor time: that of `object.measure`.
The widths are fractions of the volume; that of random points contains the volume with a probability of 95 %. A mesh has
no interval: its volume follows from the divergence theorem, and the last column is its actual error.
"""

import time

import numpy as np
import phasetree as pt
from measures import sampled

GLASS = pt.phase("glass")


def solids():
    axis, by = (0.3, 0.5, 0.8), (0.2, -0.1, 0.4)
    turned = lambda field: field.rotate(angle=37, axis=axis).translate(by).set(GLASS)  # noqa: E731
    cap = np.pi * 0.4**2 * (3 - 0.4) / 3
    yield "ball", pt.sphere(1).translate(by).set(GLASS), 4 / 3 * np.pi
    yield "lens", turned(pt.sphere(1).translate((0, 0, 0.6)) & pt.sphere(1).translate((0, 0, -0.6))), 2 * cap
    yield "shell", turned(pt.sphere(1).shell(0.1)), 4 / 3 * np.pi * (1.1**3 - 0.9**3)
    yield "torus", turned(pt.torus(1, 0.25)), 2 * np.pi**2 * 0.25**2
    yield "cone", turned(pt.capped_cone(0.8, 0.3, 1)), np.pi / 3 * (0.8**2 + 0.8 * 0.3 + 0.3**2)


def meshed(obj, seconds):
    """The volume by the divergence theorem, with the finest of some spacings that takes at most this time."""
    found, spacing = None, 0.3
    while True:
        start = time.process_time()
        vertices, triangles = obj.mesh(spacing=spacing).surface("glass")
        a, b, c = (vertices[triangles[:, k]].astype(float) for k in range(3))
        volume = float(np.sum(a * np.cross(b, c)) / 6)
        took = time.process_time() - start
        if found is not None and took > seconds:
            return found
        found = volume
        if took > 0.4 * seconds:
            return found
        spacing *= 0.7


def main():
    print("| solid | seconds | guaranteed interval | its error | random points, 95 % | mesh, error |\n|---|---|---|---|---|---|")
    for name, obj, volume in solids():
        low, high = obj.bounds
        obj.label(np.zeros((1, 3), dtype=np.float32))  # records the program
        for tolerance in (0.1, 0.02):
            start = time.process_time()
            below, above, estimate = obj.measure(tolerance=tolerance).volume[0]
            seconds = time.process_time() - start
            assert below <= volume * (1 + 1e-6) and volume * (1 - 1e-6) <= above
            _, random = sampled(obj, 1, low, high, seconds)
            mesh = abs(meshed(obj, seconds) / volume - 1)
            print(f"| {name} | {seconds:.2f} | {(above - below) / volume:.1e} | {abs(estimate / volume - 1):.1e} | "
                  f"{random / volume:.1e} | {mesh:.1e} |", flush=True)  # fmt: skip


if __name__ == "__main__":
    main()
