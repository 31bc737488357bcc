#!/usr/bin/env python3
"""Fits a small SIREN (sinusoidal network, Sitzmann et al. 2020) to the signed distance of the Stanford bunny.

    python3 train_bunny_siren.py stanford-bunny.obj -o bunny.siren.json [--preview bunny.png]

The network is f(p) = W_n h_{n-1} + b_n with h_i = sin(W_i h_{i-1} + b_i) and h_0 = p; the usual factor omega is folded
into W and b. f < 0 inside. What a renderer needs of it, besides the shape:

  * a small Lipschitz bound. The bound of the paper's appendix 9.4 is lambda = product of the spectral norms of all W_i,
    because |cos| <= 1. It holds everywhere but is far above the true largest slope, and sphere tracing walks in steps
    of f / lambda. So log lambda is a term of the loss, and the network starts with low frequencies;
  * |grad f| = 1 near the surface, and nowhere much above: distances *and* their exact gradients are learned, and slopes
    above one are penalised throughout the ball;
  * one connected solid: no second zero set anywhere in the ball of radius R; outside, the network means nothing.

The scan is not part of this repository; get it from the Stanford 3D Scanning Repository (any OBJ with y up will do). It
has holes in its base. Each is closed with a fan of triangles about the mean of its rim, so that the unsigned distance
vanishes where the sign changes; the sign is that of the generalised winding number (Jacobson et al. 2013).

Needs numpy, scipy and torch, and takes a few minutes on one core if they use an optimised BLAS (OpenBLAS, MKL); the
reference BLAS is many times slower. Same seed, same machine, same versions: same weights.
"""

import argparse
import json
import math
import struct
import time
import zlib

import numpy as np
import torch
from scipy import ndimage
from scipy.spatial import cKDTree

SOURCE = ("Fitted to the Stanford bunny, scanned by Greg Turk and Marc Levoy (1994), courtesy of the Stanford Computer "
          "Graphics Laboratory, Stanford 3D Scanning Repository, https://graphics.stanford.edu/data/3Dscanrep/. "
          "A network trained by train_bunny_siren.py; the scan itself is not included.")

RADIUS = 1.0  # the learned area: a ball about the origin
FIT = 0.95    # radius of the smallest ball around the normalised mesh


# ----------------------------------------------------------------------------------------------------------------------
# The mesh


def read_obj(path):
    """Vertices and triangles of an OBJ; polygons are fanned, everything else is ignored."""
    vertices, triangles = [], []
    with open(path, encoding="ascii", errors="replace") as file:
        for line in file:
            words = line.split()
            if not words:
                continue
            if words[0] == "v":
                vertices.append([float(word) for word in words[1:4]])
            elif words[0] == "f":
                corners = [int(word.split("/")[0]) - 1 for word in words[1:]]
                triangles += [[corners[0], corners[i], corners[i + 1]] for i in range(1, len(corners) - 1)]
    return np.array(vertices), np.array(triangles)


def fill_holes(vertices, triangles):
    """Closes every hole with a fan about the mean of its rim."""
    directed = {(int(a), int(b)) for t in triangles for a, b in ((t[0], t[1]), (t[1], t[2]), (t[2], t[0]))}
    # A rim runs against the triangles along it.
    following = {b: a for a, b in directed if (b, a) not in directed}
    vertices, triangles, holes = list(vertices), list(triangles), 0
    while following:
        start = min(following)
        loop, at = [start], following.pop(start)
        while at != start:
            loop.append(at)
            at = following.pop(at)
        centre = len(vertices)
        vertices.append(np.mean([vertices[i] for i in loop], axis=0))
        triangles += [[loop[i], loop[(i + 1) % len(loop)], centre] for i in range(len(loop))]
        holes += 1
    return np.array(vertices), np.array(triangles), holes


def enclosing_centre(points, steps=20000):
    """The centre of the smallest enclosing ball (Badoiu and Clarkson 2003), to about 1/steps."""
    centre = points.mean(axis=0)
    for i in range(1, steps + 1):
        farthest = points[np.argmax(((points - centre) ** 2).sum(axis=1))]
        centre = centre + (farthest - centre) / (i + 1)
    return centre


def normalise(vertices):
    """y up to z up, (x, y, z) -> (x, -z, y), then the smallest enclosing ball to radius FIT about the origin."""
    turned = np.stack([vertices[:, 0], -vertices[:, 2], vertices[:, 1]], axis=1)
    low, high = turned.min(axis=0), turned.max(axis=0)
    # Only points of the hull matter: the three foremost in each of many directions.
    extreme = np.unique(np.concatenate([np.argpartition(turned @ d, -3)[-3:] for d in sphere_points(2000)]))
    centre = enclosing_centre(turned[extreme])
    radius = math.sqrt(((turned - centre) ** 2).sum(axis=1).max())
    scale = FIT / radius
    print(f"transform: p = {scale:.6f} * ((x, -z, y) - ({centre[0]:.7f}, {centre[1]:.7f}, {centre[2]:.7f}))")
    print(f"  box of p: {np.round(scale * (low - centre), 4)} to {np.round(scale * (high - centre), 4)}")
    return (turned - centre) * scale


def sphere_points(n):
    """n well-spread unit vectors (a Fibonacci lattice)."""
    z = 1 - (2 * np.arange(n) + 1) / n
    angle = np.arange(n) * math.pi * (3 - math.sqrt(5))
    r = np.sqrt(1 - z * z)
    return np.stack([r * np.cos(angle), r * np.sin(angle), z], axis=1)


def closest_on_triangles(p, a, b, c):
    """The point of triangle abc closest to p, row by row (Ericson, Real-Time Collision Detection, 5.1.5)."""
    dot = lambda u, v: (u * v).sum(axis=-1)
    ab, ac, ap, bp, cp = b - a, c - a, p - a, p - b, p - c
    d1, d2, d3, d4, d5, d6 = dot(ab, ap), dot(ac, ap), dot(ab, bp), dot(ac, bp), dot(ab, cp), dot(ac, cp)
    va, vb, vc = d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2
    tiny = 1e-300
    div = lambda n, d: n / np.where(np.abs(d) > tiny, d, 1.0)
    along_bc = div(d4 - d3, d4 - d3 + d5 - d6)
    v, w = div(vb, va + vb + vc), div(vc, va + vb + vc)  # face
    for mask, mv, mw in (
            ((va <= 0) & (d4 >= d3) & (d5 >= d6), 1 - along_bc, along_bc),
            ((vb <= 0) & (d2 >= 0) & (d6 <= 0), 0.0, div(d2, d2 - d6)),
            ((vc <= 0) & (d1 >= 0) & (d3 <= 0), div(d1, d1 - d3), 0.0),
            ((d6 >= 0) & (d5 <= d6), 0.0, 1.0), ((d3 >= 0) & (d4 <= d3), 1.0, 0.0), ((d1 <= 0) & (d2 <= 0), 0.0, 0.0)):
        v, w = np.where(mask, mv, v), np.where(mask, mw, w)
    return a + v[..., None] * ab + w[..., None] * ac


class Mesh:
    """A closed triangle mesh that answers signed distances."""

    def __init__(self, vertices, triangles, rng):
        self.corners = vertices[triangles]
        a, b, c = self.corners[:, 0], self.corners[:, 1], self.corners[:, 2]
        cross = np.cross(b - a, c - a)
        self.area = np.linalg.norm(cross, axis=1) / 2
        self.face_normal = cross / np.maximum(np.linalg.norm(cross, axis=1, keepdims=True), 1e-30)
        normal = np.zeros_like(vertices)
        for corner in range(3):
            np.add.at(normal, triangles[:, corner], cross)
        self.corner_normal = (normal / np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-30))[triangles]
        # Samples for the search of close triangles: some inside each triangle, more in the big ones.
        count = 1 + (self.area * 2e4).astype(int)
        owner = np.repeat(np.arange(len(triangles)), count)
        self.sample_owner = owner
        self.samples = cKDTree(self._inside(owner, rng)[0])
        self._build_clusters()

    def _inside(self, owner, rng):
        """A random point of each triangle named, and its barycentric coordinates."""
        u, v = rng.random(len(owner)), rng.random(len(owner))
        u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
        t = self.corners[owner]
        return t[:, 0] + u[:, None] * (t[:, 1] - t[:, 0]) + v[:, None] * (t[:, 2] - t[:, 0]), u, v

    def surface(self, n, rng):
        """n points uniform on the surface, and smooth normals there."""
        owner = rng.choice(len(self.area), n, p=self.area / self.area.sum())
        points, u, v = self._inside(owner, rng)
        k = self.corner_normal[owner]
        normal = k[:, 0] * (1 - u - v)[:, None] + k[:, 1] * u[:, None] + k[:, 2] * v[:, None]
        return points, normal / np.linalg.norm(normal, axis=1, keepdims=True)

    def closest(self, points, candidates=16, chunk=20000):
        """Closest points: exact on the triangles that own the `candidates` nearest samples. Far from the surface the
        right triangle may not be among them; compared with all triangles, distances were at most 0.0004 too large."""
        result = np.empty_like(points)
        for i in range(0, len(points), chunk):
            p = points[i:i + chunk]
            near = self.sample_owner[self.samples.query(p, candidates)[1]]
            t = self.corners[near]
            q = closest_on_triangles(p[:, None], t[:, :, 0], t[:, :, 1], t[:, :, 2])
            best = np.argmin(((q - p[:, None]) ** 2).sum(axis=-1), axis=1)
            result[i:i + chunk] = q[np.arange(len(p)), best]
        return result

    def _build_clusters(self, size=24):
        """Leaves of triangles with their dipoles, for the winding number."""
        centre = self.corners.mean(axis=1)
        self.leaves = split(centre, np.arange(len(centre)), size)
        middle = np.array([np.average(centre[leaf], axis=0, weights=self.area[leaf] + 1e-12) for leaf in self.leaves])
        self.reach = np.array(
            [np.linalg.norm(self.corners[leaf] - m, axis=-1).max() for leaf, m in zip(self.leaves, middle)])
        area_vector = self.face_normal * self.area[:, None]
        self.dipole = np.array([area_vector[leaf].sum(axis=0) for leaf in self.leaves])
        self.middle = middle

    def winding(self, points):
        """The generalised winding number: triangles near a query by their solid angle (van Oosterom and Strackee 1983),
        far clusters by their dipole (Barill et al. 2018). Queries are grouped in space, so that a group shares its list
        of near clusters; within a group everything is a product of matrices, since the query can be taken out of dot
        products and determinants: (a - q).(b - q) = a.b - q.(a + b) + q.q."""
        result = np.empty(len(points))
        dot = lambda u, v: (u * v).sum(axis=-1)
        for group in split(points, np.arange(len(points)), 128):
            centre = points[group].mean(axis=0)
            q = points[group] - centre
            qq = dot(q, q)[:, None]
            near = np.linalg.norm(self.middle - centre, axis=1) < np.sqrt(qq.max()) + 2.0 * self.reach
            m, d = self.middle[~near] - centre, self.dipole[~near]
            distance2 = dot(m, m) - 2 * (q @ m.T) + qq
            w = ((dot(m, d) - q @ d.T) / (distance2 * np.sqrt(distance2))).sum(axis=1)
            if near.any():
                t = self.corners[np.concatenate([self.leaves[i] for i in np.flatnonzero(near)])] - centre
                a, b, c = t[:, 0], t[:, 1], t[:, 2]
                la, lb, lc = (np.sqrt(np.maximum(dot(x, x) - 2 * (q @ x.T) + qq, 0)) for x in (a, b, c))
                det = dot(a, np.cross(b, c)) - q @ (np.cross(a, b) + np.cross(b, c) + np.cross(c, a)).T
                pair = lambda x, y: dot(x, y) - q @ (x + y).T + qq
                den = la * lb * lc + pair(a, b) * lc + pair(b, c) * la + pair(c, a) * lb
                w += 2 * torch.atan2(torch.from_numpy(det), torch.from_numpy(den)).sum(1).numpy()
            result[group] = w / (4 * math.pi)
        return result

    def distance(self, points):
        """Signed distances and their gradients."""
        away = points - self.closest(points)
        unsigned = np.linalg.norm(away, axis=1)
        sign = np.where(self.winding(points) > 0.5, -1.0, 1.0)
        return sign * unsigned, (sign / np.maximum(unsigned, 1e-12))[:, None] * away


def split(points, indices, size):
    """Halves the points at the median of their longest side until no part has more than `size`."""
    todo, done = [indices], []
    while todo:
        part = todo.pop()
        if len(part) <= size:
            done.append(part)
            continue
        x = points[part]
        order = part[np.argsort(x[:, np.argmax(x.max(axis=0) - x.min(axis=0))], kind="stable")]
        todo += [order[:len(order) // 2], order[len(order) // 2:]]
    return done


def uniform_in_ball(n, rng):
    v = rng.standard_normal((n, 3))
    return v / np.linalg.norm(v, axis=1, keepdims=True) * (RADIUS * rng.random(n) ** (1 / 3))[:, None]


def training_set(mesh, n, rng):
    """Points, distances, gradients: on the surface, near it at several scales, and anywhere in the ball."""
    on, normal = mesh.surface(n // 4, rng)
    loose = [uniform_in_ball(n // 4, rng)]
    for sigma, share in ((0.01, 8), (0.03, 6), (0.08, 6)):
        p = mesh.surface(n // share, rng)[0]
        loose.append(p + sigma * rng.standard_normal(p.shape))
    loose = np.concatenate(loose)
    loose = loose[np.linalg.norm(loose, axis=1) < RADIUS]
    d, gradient = mesh.distance(loose)
    return np.concatenate([on, loose]), np.concatenate([np.zeros(len(on)), d]), np.concatenate([normal, gradient])


# ----------------------------------------------------------------------------------------------------------------------
# The network


class Siren:
    """Weights, biases, and the value together with the gradient (carried forward: one backward pass is enough)."""

    def __init__(self, width, hidden, omega, generator):
        uniform = lambda bound, *shape: (torch.rand(*shape, generator=generator) * 2 - 1) * bound
        sizes = [3] + [width] * hidden + [1]
        self.weights, self.biases = [], []
        for i, (m, n) in enumerate(zip(sizes, sizes[1:])):
            # Sitzmann et al., 3.2: omega / inputs for the first layer, sqrt(6 / inputs) for others; less for the last.
            self.weights.append(uniform(omega / m if i == 0 else math.sqrt(6 / m) * (1 if i < hidden else 0.25), n, m))
            self.biases.append(uniform(math.pi if i < hidden else 0.0, n))
        for x in self.parameters():
            x.requires_grad_(True)
        self.vectors = [torch.randn(w.shape[1], generator=generator) for w in self.weights]

    def parameters(self):
        return self.weights + self.biases

    def value_and_gradient(self, p):
        """Values (n) and gradients (3, n)."""
        h = p
        j = None
        last = len(self.weights) - 1
        for i, (w, b) in enumerate(zip(self.weights, self.biases)):
            z = h @ w.T + b
            dz = w.T[:, None, :].expand(3, len(p), -1) if j is None else j @ w.T
            if i == last:
                return z[:, 0], dz[:, :, 0]
            h = torch.sin(z)
            j = torch.cos(z) * dz

    def log_lipschitz(self, iterations=2):
        """log of the product of the spectral norms, by power iteration that goes on from the step before."""
        total = 0.0
        for i, w in enumerate(self.weights):
            with torch.no_grad():
                v = self.vectors[i]
                for _ in range(iterations):
                    u = w @ v
                    u = u / u.norm()
                    v = w.T @ u
                    v = v / v.norm()
                self.vectors[i] = v
            total = total + torch.log(u @ w @ v)
        return total


def train(siren, data, args):
    points, distance, gradient = (torch.tensor(x, dtype=torch.float32) for x in data)
    generator = torch.Generator().manual_seed(args.seed + 1)
    optimiser = torch.optim.Adam(siren.parameters(), lr=args.rate, betas=(0.9, 0.99))
    started = time.process_time()
    for step in range(args.steps):
        done = step / args.steps
        for group in optimiser.param_groups:
            group["lr"] = args.rate * min(1.0, (step + 1) / 200) * (0.003 + 0.4985 * (1 + math.cos(math.pi * done)))
        pick = torch.randint(len(points), (args.batch,), generator=generator)
        d, n = distance[pick], gradient[pick].T
        f, g = siren.value_and_gradient(points[pick])
        # Errors count relative to the distance: what matters is where the surface is.
        scale = 1 / (0.04 + d.abs())
        residual = (f - d) * scale
        fit = torch.sqrt(residual ** 2 + 1e-4).mean()
        # Exact gradients (so |grad f| = 1 too), fading away from the surface, where the medial axis kinks them.
        slope = (((g - n) ** 2).sum(0) * (0.04 * scale)).mean()
        steep = (torch.relu(g.norm(dim=0) - 1.0) ** 2).mean()
        log_lambda = siren.log_lipschitz()
        loss = fit + args.slope * slope + args.steep * steep + args.lipschitz * log_lambda
        optimiser.zero_grad()
        loss.backward()
        optimiser.step()
        if step % 1000 == 0 or step == args.steps - 1:
            near = d.abs() < 0.02
            print(f"step {step:6d}  fit {fit.item():.4f}  slope {slope.item():.4f}  steep {steep.item():.5f}  "
                  f"lambda {math.exp(log_lambda.item()):8.3f}  "
                  f"mean error near the surface {(f - d)[near].abs().mean().item():.5f}  "
                  f"{time.process_time() - started:.0f} s", flush=True)


# ----------------------------------------------------------------------------------------------------------------------
# What was learned: written, read back, measured, drawn


def write(path, siren):
    """The weights as float32 printed with six significant digits, one row a line."""
    number = lambda x: format(float(x), ".6g")
    row = lambda xs: "[" + ",".join(number(x) for x in xs) + "]"
    layers = ",\n".join(
        ' {"weights":[\n  ' + ",\n  ".join(row(r) for r in w.tolist()) + '],\n  "bias":' + row(b.tolist()) + "}"
        for w, b in zip(siren.weights, siren.biases))
    with open(path, "w", encoding="ascii") as file:
        file.write(f'{{"source":{json.dumps(SOURCE)},\n"radius":{RADIUS:g},\n"layers":[\n{layers}]}}\n')


def read(path):
    with open(path, encoding="ascii") as file:
        layers = json.load(file)["layers"]
    siren = Siren.__new__(Siren)
    siren.weights = [torch.tensor(layer["weights"]) for layer in layers]
    siren.biases = [torch.tensor(layer["bias"]) for layer in layers]
    return siren


def evaluate(siren, points, chunk=8192):
    """Values (n) and gradients (n, 3), in numpy."""
    values, slopes = [], []
    with torch.no_grad():
        for i in range(0, len(points), chunk):
            f, g = siren.value_and_gradient(torch.tensor(points[i:i + chunk], dtype=torch.float32))
            values.append(f.numpy())
            slopes.append(g.numpy().T)
    return np.concatenate(values), np.concatenate(slopes)


def steepest(siren, rng):
    """The largest slope found: many samples, then uphill from the best."""
    p = uniform_in_ball(400000, rng)
    g = np.linalg.norm(evaluate(siren, p)[1], axis=1)
    best = p[np.argsort(g)[-256:]]
    largest, step = np.sort(g)[-256:], 0.01
    for _ in range(60):
        trial = best + step * rng.standard_normal(best.shape)
        trial /= np.maximum(np.linalg.norm(trial, axis=1, keepdims=True) / RADIUS, 1.0)
        t = np.linalg.norm(evaluate(siren, trial)[1], axis=1)
        better = t > largest
        best[better], largest[better], step = trial[better], t[better], step * 0.93
    at = best[np.argmax(largest)]
    return largest.max(), at, np.percentile(g, [1, 50, 99, 99.9])


def report(siren, mesh, rng, resolution):
    norms = [float(np.linalg.norm(w.double().numpy(), 2)) for w in siren.weights]
    print("spectral norms:", " ".join(f"{x:.4f}" for x in norms), f" lambda = {math.prod(norms):.4f}")
    largest, at, percentiles = steepest(siren, rng)
    print(f"largest sampled |grad f| in the ball: {largest:.4f} at {np.round(at, 3)} (|p| = {np.linalg.norm(at):.3f}); "
          f"1, 50, 99, 99.9 %: {np.round(percentiles, 3)}")

    # The zero set on a grid: pieces, and points on it (crossings of grid edges, polished along the gradient).
    axis = np.linspace(-RADIUS, RADIUS, resolution)
    grid = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), axis=-1)
    inside_ball = np.linalg.norm(grid, axis=-1) <= RADIUS
    f = np.full(inside_ball.shape, np.float32(1))
    f[inside_ball] = evaluate(siren, grid[inside_ball])[0]
    outer = f[inside_ball & (np.linalg.norm(grid, axis=-1) > RADIUS - 0.03)]
    print(f"pieces inside: {ndimage.label(f < 0)[1]}, outside: {ndimage.label(f >= 0)[1]}; "
          f"smallest value near the rim of the ball: {outer.min():.4f}")
    crossings = []
    for k in range(3):
        low, high = np.take(f, range(resolution - 1), k), np.take(f, range(1, resolution), k)
        cut = (low < 0) != (high < 0)
        p = np.take(grid, range(resolution - 1), k)[cut]
        p[:, k] += (low[cut] / (low[cut] - high[cut])) * (axis[1] - axis[0])
        crossings.append(p)
    zero = np.concatenate(crossings)
    for _ in range(3):
        v, g = evaluate(siren, zero)
        zero = zero - (v / np.maximum((g * g).sum(axis=1), 0.01))[:, None] * g
    to_mesh = np.linalg.norm(zero - mesh.closest(zero), axis=1)
    slopes = np.linalg.norm(evaluate(siren, zero)[1], axis=1)
    scan = mesh.surface(100000, rng)[0]
    from_mesh = cKDTree(zero).query(scan)[0]
    print(f"zero set to mesh: mean {to_mesh.mean():.5f}, 99 % {np.percentile(to_mesh, 99):.5f}, "
          f"max {to_mesh.max():.5f}; |grad f| on it {slopes.min():.3f} to {slopes.max():.3f}, mean {slopes.mean():.3f}")
    print(f"mesh to zero set: mean {from_mesh.mean():.5f}, max {from_mesh.max():.5f} "
          f"(against points {axis[1] - axis[0]:.4f} apart); "
          f"mean |f| on the mesh {np.abs(evaluate(siren, scan)[0]).mean():.5f}")

    for name, p in (("uniform in the ball", uniform_in_ball(100000, rng)),
                    ("within about 0.03 of the surface", scan + 0.03 * rng.standard_normal(scan.shape))):
        d = mesh.distance(p)[0]
        v = evaluate(siren, p)[0]
        wrong = (d < 0) != (v < 0)
        print(f"{name}: sign agrees at {100 * (1 - wrong.mean()):.3f} %, "
              f"farthest wrong sign {np.abs(d[wrong]).max(initial=0):.4f} from the mesh; "
              f"mean |f - d| {np.abs(v - d).mean():.5f}, max {np.abs(v - d).max():.5f}, "
              f"largest overestimate |f| - |d| {(np.abs(v) - np.abs(d)).max():.5f}")


def draw(siren, path, size=512):
    """A picture from four sides, sphere traced, so that ripples and floaters show: lit from above the camera's left."""
    largest = 1.4
    tiles = []
    for azimuth, height in ((-90, 12), (-30, 20), (90, 12), (200, 35)):
        a, e = math.radians(azimuth), math.radians(height)
        towards = np.array([math.cos(a) * math.cos(e), math.sin(a) * math.cos(e), math.sin(e)])  # the camera
        right = np.array([-math.sin(a), math.cos(a), 0.0])
        up = np.cross(towards, right)
        s = (np.arange(size) + 0.5) / size * 2 - 1
        x, y = np.meshgrid(s, -s)
        disc = x * x + y * y < 1
        start = x[disc][:, None] * right + y[disc][:, None] * up
        half = np.sqrt(1 - (start ** 2).sum(axis=1))
        t, hit, alive = -half.copy(), np.zeros(len(half), bool), np.arange(len(half))
        for _ in range(400):
            v = evaluate(siren, start[alive] - t[alive, None] * towards)[0]
            hit[alive[v < 5e-4]] = True
            t[alive] += np.maximum(v, 0) / largest
            alive = alive[(v >= 5e-4) & (t[alive] < half[alive])]
            if not len(alive):
                break
        n = evaluate(siren, start - t[:, None] * towards)[1]
        n /= np.linalg.norm(n, axis=1, keepdims=True)
        light = towards + 0.6 * up - 0.7 * right
        light /= np.linalg.norm(light)
        shade = 0.12 + 0.8 * np.maximum(n @ light, 0) + 0.25 * np.maximum(n @ light, 0) ** 40
        tile = np.full((size, size), 0.55)
        tile[disc] = np.where(hit, shade, 0.65)
        tiles.append(tile)
    picture = np.vstack([np.hstack(tiles[:2]), np.hstack(tiles[2:])])
    write_png(path, (255 * np.clip(picture, 0, 1) ** (1 / 2.2)).astype(np.uint8))


def write_png(path, grey):
    chunk = lambda kind, body: struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
    rows = b"".join(b"\0" + row.tobytes() for row in grey)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        file.write(chunk(b"IHDR", struct.pack(">IIBBBBB", grey.shape[1], grey.shape[0], 8, 0, 0, 0, 0)))
        file.write(chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


# ----------------------------------------------------------------------------------------------------------------------


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("mesh", help="the scan, as an OBJ with y up")
    parser.add_argument("-o", "--output", default="bunny.siren.json")
    parser.add_argument("--preview", help="also draw the result, to a PNG")
    parser.add_argument("--check", action="store_true", help="only measure the output file, do not train")
    parser.add_argument("--width", type=int, default=48)
    parser.add_argument("--hidden", type=int, default=3, help="sine layers")
    parser.add_argument("--omega", type=float, default=8.0, help="three times the largest first weight")
    parser.add_argument("--points", type=int, default=300000)
    parser.add_argument("--batch", type=int, default=2048)
    parser.add_argument("--steps", type=int, default=12000)
    parser.add_argument("--rate", type=float, default=4e-3)
    parser.add_argument("--slope", type=float, default=0.2, help="weight of the gradient's error")
    parser.add_argument("--steep", type=float, default=10.0, help="weight of slopes above one")
    parser.add_argument("--lipschitz", type=float, default=0.03, help="weight of log lambda")
    parser.add_argument("--resolution", type=int, default=128, help="of the grid that checks the result")
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--seed", type=int, default=1)
    args = parser.parse_args()

    torch.set_num_threads(args.threads)
    torch.use_deterministic_algorithms(True)
    rng = np.random.default_rng(args.seed)

    vertices, triangles, holes = fill_holes(*read_obj(args.mesh))
    print(f"{len(vertices)} vertices, {len(triangles)} triangles, {holes} holes filled")
    mesh = Mesh(normalise(vertices), triangles, rng)

    if not args.check:
        started = time.process_time()
        data = training_set(mesh, args.points, rng)
        print(f"{len(data[0])} training points, {time.process_time() - started:.0f} s", flush=True)
        siren = Siren(args.width, args.hidden, args.omega, torch.Generator().manual_seed(args.seed))
        train(siren, data, args)
        write(args.output, siren)

    # From here on with the rounded weights, as they were written.
    siren = read(args.output)
    report(siren, mesh, np.random.default_rng(args.seed + 2), args.resolution)
    if args.preview:
        draw(siren, args.preview)


if __name__ == "__main__":
    main()
