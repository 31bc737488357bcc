"""Computes how a fluid that hardly changes its volume, such as water or air, flows in a closed box: for ink.py.

Pressures make velocities free of divergence at the faces of the cells (Harlow & Welch 1965), by cosine transforms, since
walls are all around. Everything else is computed at the centres, so each step averages velocities there and back, which
damps small eddies; a force strengthens these (Fedkiw, Stam & Jensen 2001). What the fluid carries, and its velocities,
are advected by MacCormack's scheme (Selle et al. 2008). Lengths are in cells, and times in a unit of their own.
"""

import numpy as np
from PIL import Image
from scipy.fft import dctn, idctn
from scipy.ndimage import map_coordinates

AXES = range(3)


def part(axis, which):
    """The index of a part of an array along an axis: all but the last there, all but the first, or the last."""
    index = [slice(None)] * 3
    index[axis] = {"low": slice(None, -1), "high": slice(1, None), "last": -1}[which]
    return tuple(index)


def at_centres(faces):
    """Velocities at the cells' centres."""
    centres = [f.copy() for f in faces]
    for axis in AXES:
        centres[axis][part(axis, "high")] += faces[axis][part(axis, "low")]
        centres[axis] *= 0.5
    return centres


def at_faces(centres):
    """Velocities at the faces between cells: number i of an axis is between the cells i and i + 1. The last one, in the
    wall, is left wrong; Box.without_divergence() sets it to 0."""
    faces = [f.astype(np.float32) for f in centres]
    for axis in AXES:
        faces[axis][part(axis, "low")] = 0.5 * (centres[axis][part(axis, "low")] + centres[axis][part(axis, "high")])
    return faces


class Box:
    """A box of cells, `shape` of them along x, y and z, and the time of a step."""

    def __init__(self, shape, time_step):
        self.shape, self.time_step = shape, time_step
        self.cells = np.meshgrid(*(np.arange(n, dtype=np.float32) for n in shape), indexing="ij")
        # The eigenvalues of the discrete Laplace operator, whose eigenvectors are cosines.
        self.eigenvalues = sum(
            (2 * np.cos(np.pi * np.arange(n) / n) - 2).reshape([-1 if i == axis else 1 for i in AXES])
            for axis, n in enumerate(shape)
        )
        self.eigenvalues[0, 0, 0] = 1  # of the mean of the pressure, which is set to 0

    def zeros(self):
        return np.zeros(self.shape, np.float32)

    def smooth_noise(self, seed, scale):
        """Random numbers at each `scale` cells, with linear interpolation between them."""
        sizes = [max(2, int(n / scale)) for n in self.shape]
        coarse = np.random.default_rng(seed).standard_normal(sizes).astype(np.float32)
        places = [p * ((m - 1) / (n - 1)) for p, m, n in zip(self.cells, coarse.shape, self.shape)]
        return map_coordinates(coarse, places, order=1)

    def without_divergence(self, faces):
        """Takes the gradient of a pressure from the velocities, so that as much flows into each cell as out of it."""
        divergence = self.zeros()
        for axis in AXES:
            faces[axis][part(axis, "last")] = 0  # the wall
            divergence += faces[axis]
            divergence[part(axis, "high")] -= faces[axis][part(axis, "low")]
        pressure = dctn(divergence, type=2) / self.eigenvalues
        pressure[0, 0, 0] = 0
        pressure = idctn(pressure, type=2).astype(np.float32)
        for axis in AXES:
            faces[axis][part(axis, "low")] -= pressure[part(axis, "high")] - pressure[part(axis, "low")]
        return faces

    def advected(self, values, velocity):
        """Values after a step, by MacCormack's scheme; where that leaves the range of the eight values around, by simple
        interpolation."""

        def sampled(at_cells, places):
            return map_coordinates(at_cells, places, order=1, mode="nearest")

        origin = [p - self.time_step * v for p, v in zip(self.cells, velocity)]
        simple = sampled(values, origin)
        returned = sampled(simple, [p + self.time_step * v for p, v in zip(self.cells, velocity)])
        better = simple + 0.5 * (values - returned)
        low_corner = [np.clip(np.floor(o).astype(np.int32), 0, n - 2) for o, n in zip(origin, self.shape)]
        corners = (
            values[low_corner[0] + (i & 1), low_corner[1] + (i >> 1 & 1), low_corner[2] + (i >> 2)] for i in range(8)
        )
        least = most = None
        for corner in corners:
            least = corner if least is None else np.minimum(least, corner)
            most = corner if most is None else np.maximum(most, corner)
        return np.where((better < least) | (better > most), simple, better)


def confinement(velocity, strength):
    """The force that spins up eddies."""
    slopes = [np.gradient(f) for f in velocity]
    curl = [slopes[2][1] - slopes[1][2], slopes[0][2] - slopes[2][0], slopes[1][0] - slopes[0][1]]
    towards = np.gradient(np.sqrt(sum(c * c for c in curl)))
    length = np.sqrt(sum(t * t for t in towards)) + 1e-6
    n = [t / length for t in towards]
    return [
        strength * (n[1] * curl[2] - n[2] * curl[1]),
        strength * (n[2] * curl[0] - n[0] * curl[2]),
        strength * (n[0] * curl[1] - n[1] * curl[0]),
    ]


def box_around(levels, least):
    """The part of an array with all of its numbers that are greater than `least`, and a margin of two cells."""
    return tuple(slice(max(i.min() - 2, 0), i.max() + 3) for i in np.nonzero(levels > least))


def write_layers(levels, folder, name):
    """Writes images of grey levels from 0 to 255, one for each layer from below: NAME_001.png and so on."""
    folder.mkdir(exist_ok=True)
    for old in folder.glob(f"{name}_*.png"):
        old.unlink()
    for i, layer in enumerate(np.moveaxis(levels, 2, 0)):
        Image.fromarray(np.ascontiguousarray(layer[:, ::-1].T)).save(folder / f"{name}_{i + 1:03d}.png", optimize=True)
