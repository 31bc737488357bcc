"""Computes the ink of ink.json: a stream of it that sinks in still water, as a stack of images, ink/ink_###.png.

    python3 scenes/assets/ink.py        # needs numpy, scipy and Pillow; about a quarter of an hour on one core

By Boussinesq's approximation ink is a little heavier than water, and has no other part in how the water flows (fluid.py).
"""

import pathlib

import numpy as np

import fluid

SHAPE = (128, 128, 224)
SCALE = 1.6  # The numbers below were found with a grid of fewer cells. One of its lengths is this many here.
TIME_STEP = 0.6
STEPS = 190
STREAM_ENDS = 62.0  # when the pouring of ink ends
# The acceleration by which ink of density 1 sinks, and how strongly eddies are spun up. The latter is meant for cells of
# any size: what it makes up for is smaller where cells are.
HEAVINESS, CONFINEMENT = 0.05, 0.10
# Levels of grey below the first are empty. The box that is written holds all that are above the second.
LEAST_LEVEL, LEAST_LEVEL_IN_BOX = 3, 5


def pour(box, ink, faces, time, noise):
    """Sets ink and velocities at the stream's end below the surface: a ball that wanders, pulses, and pushes down. The
    velocities have divergence until the step's end."""
    x, y, z = box.cells
    middle = SHAPE[0] * (0.5 + 0.035 * np.sin(0.22 * time)), SHAPE[1] * (0.49 + 0.035 * np.cos(0.18 * time + 1))
    radius = (5.0 + 1.2 * np.sin(0.31 * time)) * SCALE
    distance = np.sqrt((x - middle[0]) ** 2 + (y - middle[1]) ** 2 + (0.7 * (z - 0.93 * SHAPE[2])) ** 2) / radius
    there = np.clip((1.1 - distance - 0.08 * np.roll(noise, int(2 * time), axis=2)) / 0.25, 0, 1)
    np.maximum(ink, there * (0.75 + 0.25 * np.sin(0.47 * time)), out=ink)
    faces[2] = faces[2] * (1 - there) - 1.1 * SCALE * there


def computed():
    box = fluid.Box(SHAPE, TIME_STEP)
    noise = box.smooth_noise(1, 6 * SCALE) + 0.6 * box.smooth_noise(2, 3 * SCALE)
    ink, faces = box.zeros(), [box.zeros() for _ in fluid.AXES]
    for step in range(STEPS):
        time = step * TIME_STEP
        if time < STREAM_ENDS:
            pour(box, ink, faces, time, noise)
        velocity = fluid.at_centres(faces)
        forces = fluid.confinement(velocity, CONFINEMENT)
        forces[2] = forces[2] - HEAVINESS * SCALE * ink
        ink, velocity = box.advected(ink, velocity), [box.advected(v, velocity) for v in velocity]
        faces = box.without_divergence(fluid.at_faces([v + TIME_STEP * f for v, f in zip(velocity, forces)]))
        if step % 10 == 9:
            print(f"step {step + 1} of {STEPS}", flush=True)
    return ink


def main():
    levels = np.round(255 * np.clip(computed(), 0, 1)).astype(np.uint8)
    levels[levels < LEAST_LEVEL] = 0
    box = fluid.box_around(levels, LEAST_LEVEL_IN_BOX)
    fluid.write_layers(levels[box], pathlib.Path(__file__).parent / "ink", "ink")
    middle = [0.5 * (s.start + min(s.stop, n) - n) for s, n in zip(box, SHAPE)]
    print("the box's middle, from that of all cells, in cells:", middle, "and its size:", levels[box].shape)


if __name__ == "__main__":
    main()
