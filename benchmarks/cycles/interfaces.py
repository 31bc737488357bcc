"""The interfaces between the phases of an object as meshes, one for each pair of phases, for renderers that know no phases.

The way is that of surface nets, for several labels at once (Gibson: Constrained Elastic Surface Nets, MICCAI 1998): each cube
of a grid whose corners are of several phases has a vertex, and each edge of the grid whose ends are of two phases has a quad,
which belongs to this pair of phases. Meshes of different pairs share their vertices where three phases meet, so there are
neither gaps nor overlaps between them.
"""
import numpy as np

CORNERS = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)])
# A vertex is split where its quads' normals differ by more, so that edges stay sharp.
SHARP = np.cos(np.radians(30))


def keys_of(points):
    """A whole number for each point of the grid, (N, 3) numbers below 2²⁰."""
    return points[:, 0] << 40 | points[:, 1] << 20 | points[:, 2]


def points_of(keys):
    return np.stack([keys >> 40, keys >> 20 & 0xFFFFF, keys & 0xFFFFF], axis=1)


def cubes_near_interfaces(thing, low, counts, spacing):
    """The cubes of the grid that an interface may cross. Larger cubes are divided while the next phase is within reach of their
    centre, which a distance of slope 1 tells; the thinnest layer between two centres is never left out."""
    size = 64
    cubes = np.stack(np.meshgrid(*[np.arange(0, n, size) for n in counts], indexing="ij"), axis=-1).reshape(-1, 3)
    while True:
        centres = low + (cubes + 0.5 * size) * spacing
        free = np.abs(thing.phi(centres.astype(np.float32))).min(axis=1)
        cubes = cubes[free <= 0.5 * np.sqrt(3) * size * spacing * 1.001]
        if size == 1:
            return cubes
        size //= 2
        cubes = (cubes[:, None] + size * CORNERS[None]).reshape(-1, 3)


def crossings(thing, a, b, labels):
    """Where the label changes between points a and b, of which a is of the phase of `labels`."""
    for _ in range(14):
        middle = 0.5 * (a + b)
        same = (thing.label(middle.astype(np.float32)) == labels)[:, None]
        a, b = np.where(same, middle, a), np.where(same, b, middle)
    return 0.5 * (a + b)


def moved_to_interface(thing, vertices, phases, cells, spacing):
    """Vertices in cubes of two phases, a step of Newton's at a time, where that does not leave the cube by far."""
    for _ in range(3):
        points = vertices.astype(np.float32)
        phi = np.take_along_axis(thing.phi(points), phases[:, None], axis=1)
        slope = np.zeros_like(points)
        for phase in np.unique(phases):
            of = phases == phase
            slope[of] = thing.gradient(points[of], phase=thing.phases[phase])
        moved = vertices - phi * slope / np.maximum((slope * slope).sum(axis=1, keepdims=True), 0.25)
        within = (np.abs(moved - cells - 0.5 * spacing) <= 0.6 * spacing).all(axis=1, keepdims=True)
        vertices = np.where(within, moved, vertices)
    return vertices


def split_at_edges(vertices, quads):
    """The same quads, with a vertex twice where the surface has an edge: renderers smooth normals over what shares one."""
    a, b = vertices[quads[:, 2]] - vertices[quads[:, 0]], vertices[quads[:, 3]] - vertices[quads[:, 1]]
    flat = np.cross(a, b)
    unit = flat / np.maximum(np.linalg.norm(flat, axis=1, keepdims=True), 1e-30)
    mean = np.zeros((len(vertices), 3))
    for corner in range(4):
        np.add.at(mean, quads[:, corner], flat)
    mean /= np.maximum(np.linalg.norm(mean, axis=1, keepdims=True), 1e-30)
    # What differs from the mean goes to one copy for each main direction of its normal.
    direction = np.argmax(np.abs(unit), axis=1) * 2 + (np.take_along_axis(unit, np.argmax(np.abs(unit), axis=1)[:, None], 1)[:, 0] > 0)
    wanted = quads * 7
    for corner in range(4):
        sharp = (unit * mean[quads[:, corner]]).sum(axis=1) < SHARP
        wanted[:, corner] += np.where(sharp, direction + 1, 0)
    used, renumbered = np.unique(wanted, return_inverse=True)
    return vertices[used // 7], renumbered.reshape(-1, 4)


def interfaces(thing, spacing):
    """{(outer, inner): (vertices (N, 3), quads (M, 4))} by the phases' indices. Normals point from the inner to the outer phase,
    which is the one of the lower index."""
    low, high = (np.array(v, dtype=np.float64) for v in thing.bounds)
    low -= 2.37 * spacing
    counts = np.ceil((high + 2 * spacing - low) / spacing).astype(np.int64)
    if (counts >= 1 << 20).any():
        raise ValueError("the spacing is too small for the object")
    cubes = cubes_near_interfaces(thing, low, counts, spacing)
    corners = keys_of((cubes[:, None] + CORNERS[None]).reshape(-1, 3))
    points, corner = np.unique(corners, return_inverse=True)
    labels = thing.label((low + points_of(points) * spacing).astype(np.float32))
    corner = corner.reshape(-1, 8)
    of_corners = labels[corner]
    crossed = (of_corners != of_corners[:, :1]).any(axis=1)
    cubes, corner, of_corners = cubes[crossed], corner[crossed], of_corners[crossed]

    # Each edge of the grid once, with the up to four cubes about it.
    starts = [[c for c in range(8) if not c >> axis & 1] for axis in range(3)]
    edge_start, edge_axis, edge_cube, edge_place = [], [], [], []
    for axis in range(3):
        for place, c in enumerate(starts[axis]):
            differ = np.flatnonzero(of_corners[:, c] != of_corners[:, c | 1 << axis])
            edge_start.append(corner[differ, c])
            edge_axis.append(np.full(len(differ), axis))
            edge_cube.append(differ)
            edge_place.append(np.full(len(differ), place))
    start, axis, cube, place = (np.concatenate(v) for v in (edge_start, edge_axis, edge_cube, edge_place))
    edges, edge = np.unique(start * 3 + axis, return_inverse=True)
    first = points_of(points[edges // 3])
    last = first + np.eye(3, dtype=np.int64)[edges % 3]
    first_label = labels[edges // 3]
    last_label = labels[np.searchsorted(points, keys_of(last))]
    crossing = crossings(thing, low + first * spacing, low + last * spacing, first_label)

    vertices, number = np.zeros((len(cubes), 3)), np.zeros(len(cubes))
    np.add.at(vertices, cube, crossing[edge])
    np.add.at(number, cube, 1)
    vertices /= number[:, None]
    least, most = of_corners.min(axis=1), of_corners.max(axis=1)
    two = ((of_corners == least[:, None]) | (of_corners == most[:, None])).all(axis=1)
    vertices[two] = moved_to_interface(thing, vertices[two], most[two].astype(np.int64), low + cubes[two] * spacing, spacing)

    about = np.full((len(edges), 4), -1)
    about[edge, place] = cube
    whole = (about >= 0).all(axis=1)
    # The four cubes in the order 0, 1, 3, 2 go round the edge: about x and z so that the normal points along the axis, about y
    # against it, since the two other axes follow each other the other way there.
    quads = about[whole][:, [3, 2, 0, 1]]
    against = (edges[whole] % 3 == 1) ^ (first_label[whole] < last_label[whole])
    quads = np.where(against[:, None], quads[:, ::-1], quads)
    pairs = np.sort(np.stack([first_label[whole], last_label[whole]], axis=1), axis=1)
    result = {}
    for outer, inner in np.unique(pairs, axis=0):
        of = quads[(pairs == (outer, inner)).all(axis=1)]
        used, renumbered = np.unique(of, return_inverse=True)
        result[int(outer), int(inner)] = split_at_edges(vertices[used], renumbered.reshape(-1, 4))
    return result
