"""Computes the ink of ink.json: a stream of it that sinks in still water, as a stack of images, ink/ink_###.png.

    python3 scenes/assets/ink.py        # needs numpy, scipy and Pillow; about a quarter of an hour on one core

The water is an incompressible fluid under Boussinesq's approximation: ink is a little heavier, and has no other part in how
it flows. Pressures make velocities free of divergence at the faces of the cells (Harlow & Welch 1965), by cosine
transforms, since walls are all around. Everything else is computed at the centres, so each step averages velocities
there and back, which damps small eddies; a force strengthens these (Fedkiw, Stam & Jensen 2001). Ink and velocities
are advected by MacCormack's scheme (Selle et al. 2008). Lengths are in cells, and times in a unit of their own.
"""

import pathlib

import numpy as np
from PIL import Image
from scipy.fft import dctn, idctn
from scipy.ndimage import map_coordinates

SHAPE = (128, 128, 224)
SCALE = 1.6  # The numbers below were found with a grid of fewer cells. One of its lengths is so many here.
TIME_STEP = 0.6
STEPS = 190
STREAM_ENDS = 62.0  # when no more ink is poured
# The acceleration by which ink of density 1 sinks, and how strongly eddies are spun up.
HEAVINESS, CONFINEMENT = 0.05, 0.10
# Levels of grey below the first are empty. The box that is written holds all that are above the second.
LEAST_LEVEL, LEAST_LEVEL_IN_BOX = 3, 5

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
    """Velocities at the faces between cells, each that to the higher side of its cell. Those in walls are left wrong."""
    faces = [f.astype(np.float32) for f in centres]
    for axis in AXES:
        faces[axis][part(axis, "low")] = 0.5 * (centres[axis][part(axis, "low")] + centres[axis][part(axis, "high")])
    return faces


# Of the discrete Laplace operator, whose eigenvectors are cosines.
EIGENVALUES = sum(
    (2 * np.cos(np.pi * np.arange(n) / n) - 2).reshape([-1 if i == axis else 1 for i in AXES])
    for axis, n in enumerate(SHAPE)
)
EIGENVALUES[0, 0, 0] = 1  # of the mean of the pressure, which is set to 0 below


def without_divergence(faces):
    """Takes the gradient of a pressure from the velocities, so that as much flows into each cell as out of it."""
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


def sampled(values, places):
    """Values between the cells' centres, by linear interpolation."""
    return map_coordinates(values, places, order=1, mode="nearest")


def advected(values, velocity):
    """Values after a step, by MacCormack's scheme; where that leaves the range of the eight values around, by simple
    interpolation."""
    origin = [p - TIME_STEP * v for p, v in zip((X, Y, Z), velocity)]
    simple = sampled(values, origin)
    returned = sampled(simple, [p + TIME_STEP * v for p, v in zip((X, Y, Z), velocity)])
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
    """Sets ink and velocities at the stream's end below the surface: a ball that wanders, pulses, and pushes down. The
    velocities have divergence until the step's end."""
    middle = SHAPE[0] * (0.5 + 0.035 * np.sin(0.22 * time)), SHAPE[1] * (0.49 + 0.035 * np.cos(0.18 * time + 1))
    radius = (5.0 + 1.2 * np.sin(0.31 * time)) * SCALE
    distance = np.sqrt((X - middle[0]) ** 2 + (Y - middle[1]) ** 2 + (0.7 * (Z - 0.93 * SHAPE[2])) ** 2) / radius
    there = np.clip((1.1 - distance - 0.08 * np.roll(noise, int(2 * time), axis=2)) / 0.25, 0, 1)
    np.maximum(ink, there * (0.75 + 0.25 * np.sin(0.47 * time)), out=ink)
    faces[2] = faces[2] * (1 - there) - 1.1 * SCALE * there


def computed():
    noise = smooth_noise(1, 6 * SCALE) + 0.6 * smooth_noise(2, 3 * SCALE)
    ink = np.zeros(SHAPE, np.float32)
    faces = [np.zeros(SHAPE, np.float32) for _ in AXES]
    for step in range(STEPS):
        time = step * TIME_STEP
        if time < STREAM_ENDS:
            pour(ink, faces, time, noise)
        velocity = at_centres(faces)
        forces = confinement(velocity)
        forces[2] = forces[2] - HEAVINESS * SCALE * ink
        ink, velocity = advected(ink, velocity), [advected(v, velocity) for v in velocity]
        faces = without_divergence(at_faces([v + TIME_STEP * f for v, f in zip(velocity, forces)]))
        if step % 10 == 9:
            print(f"step {step + 1} of {STEPS}", flush=True)
    return ink


def main():
    ink = computed()
    levels = np.round(255 * np.clip(ink, 0, 1)).astype(np.uint8)
    levels[levels < LEAST_LEVEL] = 0
    box = tuple(slice(max(i.min() - 2, 0), i.max() + 3) for i in np.nonzero(levels > LEAST_LEVEL_IN_BOX))
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
