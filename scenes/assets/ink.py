"""Computes the ink of ink.json: a stream of it that sinks in still water, as a stack of images, ink/ink_###.png.

    python3 scenes/assets/ink.py        # needs numpy, scipy and Pillow; about a quarter of an hour on one core

An incompressible fluid under Boussinesq's approximation: ink is a little heavier than water, and has no other part in how
the water flows. Velocities stand at the faces of the cells (Harlow & Welch 1965). What flows is carried by MacCormack's scheme
(Selle et al. 2008), pressures are found by cosine transforms, since walls are all around, and small eddies that the
grid damps are strengthened (Fedkiw, Stam & Jensen 2001). Lengths are in cells.
"""

import pathlib

import numpy as np
from PIL import Image
from scipy.fft import dctn, idctn
from scipy.ndimage import map_coordinates

SHAPE = (128, 128, 224)
SIZE = 1.6  # of eddies, in the cells of a grid in which the numbers below were found
STEP = 0.6
STEPS = 190
STREAM_ENDS = 62.0
HEAVINESS, CONFINEMENT = 0.05, 0.10

X, Y, Z = np.meshgrid(*(np.arange(n, dtype=np.float32) for n in SHAPE), indexing="ij")
AXES = range(3)


def part(axis, which):
    """The index of a part of an array along an axis: all but the last there, all but the first, or the last."""
    index = [slice(None)] * 3
    index[axis] = {"low": slice(None, -1), "high": slice(1, None), "last": -1}[which]
    return tuple(index)


def smooth_noise(seed, scale):
    """Smooth random numbers that change over so many cells."""
    coarse = np.random.default_rng(seed).standard_normal([max(2, int(n / scale)) for n in SHAPE]).astype(np.float32)
    places = [p * ((m - 1) / (n - 1)) for p, m, n in zip((X, Y, Z), coarse.shape, SHAPE)]
    return map_coordinates(coarse, places, order=1)


def at_centres(faces):
    """Velocities at the cells' centres."""
    centres = [f.copy() for f in faces]
    for axis in AXES:
        centres[axis][part(axis, "high")] += faces[axis][part(axis, "low")]
        centres[axis] *= 0.5
    return centres


def at_faces(centres):
    faces = [f.astype(np.float32) for f in centres]
    for axis in AXES:
        faces[axis][part(axis, "low")] = 0.5 * (centres[axis][part(axis, "low")] + centres[axis][part(axis, "high")])
    return faces


EIGENVALUES = sum(
    (2 * np.cos(np.pi * np.arange(n) / n) - 2).reshape([-1 if i == axis else 1 for i in AXES])
    for axis, n in enumerate(SHAPE)
)
EIGENVALUES[0, 0, 0] = 1


def without_divergence(faces):
    divergence = np.zeros(SHAPE, np.float32)
    for axis in AXES:
        faces[axis][part(axis, "last")] = 0  # the wall
        divergence += faces[axis]
        divergence[part(axis, "high")] -= faces[axis][part(axis, "low")]
    pressure = dctn(divergence, type=2) / EIGENVALUES
    pressure[0, 0, 0] = 0
    pressure = idctn(pressure, type=2).astype(np.float32)
    for axis in AXES:
        faces[axis][part(axis, "low")] -= pressure[part(axis, "high")] - pressure[part(axis, "low")]
    return faces


def at(values, places):
    return map_coordinates(values, places, order=1, mode="nearest")


def carried(values, velocity):
    """What is where after a step: MacCormack's scheme, within the eight values that it came from."""
    origin = [p - STEP * v for p, v in zip((X, Y, Z), velocity)]
    simple = at(values, origin)
    returned = at(simple, [p + STEP * v for p, v in zip((X, Y, Z), velocity)])
    better = simple + 0.5 * (values - returned)
    low_corner = [np.clip(np.floor(o).astype(np.int32), 0, n - 2) for o, n in zip(origin, SHAPE)]
    corners = (values[low_corner[0] + (i & 1), low_corner[1] + (i >> 1 & 1), low_corner[2] + (i >> 2)] for i in range(8))
    least = most = None
    for corner in corners:
        least = corner if least is None else np.minimum(least, corner)
        most = corner if most is None else np.maximum(most, corner)
    return np.where((better < least) | (better > most), simple, better)


def confinement(velocity):
    """The force that spins up eddies."""
    slopes = [np.gradient(f) for f in velocity]
    curl = [slopes[2][1] - slopes[1][2], slopes[0][2] - slopes[2][0], slopes[1][0] - slopes[0][1]]
    towards = np.gradient(np.sqrt(sum(c * c for c in curl)))
    length = np.sqrt(sum(t * t for t in towards)) + 1e-6
    n = [t / length for t in towards]
    return [
        CONFINEMENT * (n[1] * curl[2] - n[2] * curl[1]),
        CONFINEMENT * (n[2] * curl[0] - n[0] * curl[2]),
        CONFINEMENT * (n[0] * curl[1] - n[1] * curl[0]),
    ]


def pour(ink, faces, time, noise):
    """The stream's end below the surface: a disc that wanders, pulses, and pushes down."""
    middle = SHAPE[0] * (0.5 + 0.035 * np.sin(0.22 * time)), SHAPE[1] * (0.49 + 0.035 * np.cos(0.18 * time + 1))
    radius = (5.0 + 1.2 * np.sin(0.31 * time)) * SIZE
    distance = np.sqrt((X - middle[0]) ** 2 + (Y - middle[1]) ** 2 + (0.7 * (Z - 0.93 * SHAPE[2])) ** 2) / radius
    there = np.clip((1.1 - distance - 0.08 * np.roll(noise, int(2 * time), axis=2)) / 0.25, 0, 1)
    np.maximum(ink, there * (0.75 + 0.25 * np.sin(0.47 * time)), out=ink)
    faces[2] = faces[2] * (1 - there) - 1.1 * SIZE * there


def computed():
    noise = smooth_noise(1, 6 * SIZE) + 0.6 * smooth_noise(2, 3 * SIZE)
    ink = np.zeros(SHAPE, np.float32)
    faces = [np.zeros(SHAPE, np.float32) for _ in AXES]
    for step in range(STEPS):
        time = step * STEP
        if time < STREAM_ENDS:
            pour(ink, faces, time, noise)
        velocity = at_centres(faces)
        forces = confinement(velocity)
        forces[2] = forces[2] - HEAVINESS * SIZE * ink
        ink, velocity = carried(ink, velocity), [carried(v, velocity) for v in velocity]
        faces = without_divergence(at_faces([v + STEP * f for v, f in zip(velocity, forces)]))
        if step % 10 == 9:
            print(f"step {step + 1} of {STEPS}", flush=True)
    return ink


def main():
    ink = computed()
    levels = np.round(255 * np.clip(ink, 0, 1)).astype(np.uint8)
    levels[levels < 3] = 0
    box = tuple(slice(max(i.min() - 2, 0), i.max() + 3) for i in np.nonzero(levels > 5))
    folder = pathlib.Path(__file__).parent / "ink"
    folder.mkdir(exist_ok=True)
    for old in folder.glob("ink_*.png"):
        old.unlink()
    for i, layer in enumerate(np.moveaxis(levels[box], 2, 0)):
        Image.fromarray(np.ascontiguousarray(layer[:, ::-1].T)).save(folder / f"ink_{i + 1:03d}.png", optimize=True)
    middle = [0.5 * (s.start + min(s.stop, n) - n) for s, n in zip(box, SHAPE)]
    print("the box's middle, from that of all cells, in cells:", middle, "and its size:", levels[box].shape)


if __name__ == "__main__":
    main()
