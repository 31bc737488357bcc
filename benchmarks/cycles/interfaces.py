"""The interfaces between the phases of an object as meshes, one for each pair of phases, for renderers that know no phases.

They are parts of one mesh, so they share their vertices where three phases meet, and there are neither gaps nor overlaps.
"""
import numpy as np

# A vertex is there once more for triangles whose normal differs by more from the mean, so that edges stay sharp.
SHARP = np.cos(np.radians(30))


def split_at_edges(vertices, triangles):
    """The same triangles, with a vertex twice where the surface has an edge: renderers smooth normals over what shares one."""
    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    flat = np.cross(b - a, c - a)
    unit = flat / np.maximum(np.linalg.norm(flat, axis=1, keepdims=True), 1e-30)
    mean = np.zeros((len(vertices), 3))
    for corner in range(3):
        np.add.at(mean, triangles[:, corner], flat)
    mean /= np.maximum(np.linalg.norm(mean, axis=1, keepdims=True), 1e-30)
    # What differs from the mean goes to one copy for each main direction of its normal.
    axis = np.argmax(np.abs(unit), axis=1)
    direction = axis * 2 + (np.take_along_axis(unit, axis[:, None], 1)[:, 0] > 0)
    wanted = triangles.astype(np.int64) * 7
    for corner in range(3):
        sharp = (unit * mean[triangles[:, corner]]).sum(axis=1) < SHARP
        wanted[:, corner] += np.where(sharp, direction + 1, 0)
    used, renumbered = np.unique(wanted, return_inverse=True)
    return vertices[used // 7], renumbered.reshape(-1, 3)


def interfaces(thing, spacing):
    """{(outer, inner): (vertices (N, 3), triangles (M, 3))} by the phases' indices. Normals point from the inner to the outer
    phase, which is the one of the lower index."""
    mesh = thing.mesh(spacing)
    pairs = np.stack([mesh.front, mesh.behind], axis=1)
    result = {}
    for outer, inner in np.unique(pairs, axis=0):
        of = mesh.triangles[(pairs == (outer, inner)).all(axis=1)]
        used, renumbered = np.unique(of, return_inverse=True)
        vertices = mesh.vertices[used].astype(np.float64)
        result[int(outer), int(inner)] = split_at_edges(vertices, renumbered.reshape(-1, 3))
    return result
