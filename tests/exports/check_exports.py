#!/usr/bin/env python3
"""Checks exported triangles with programs that share no code with phasetree, and reads them back as phases.

    PYTHONPATH=build/release/plugins/python /usr/bin/python3 tests/exports/check_exports.py build/release/tracer/phasetree
        [--scenes NAME…] [--divisions N,N,N] [--points N] [--crossings PROGRAM]

Every scene of the gallery is exported at spacings of 1/N of the longest side of its bounds, with a file per phase. For
each phase,

* admesh must find a closed surface with consistent triangles, without degenerate ones, that needs no repair;
* CGAL must find that it is manifold, and that no two triangles cross or touch, except at common edges and vertices;
* the phase that the file bounds must have the labels of the scene, at random points farther from the phase's surface
  than the spacing. Half of the points are uniform in the bounds, half are near the surface.

Near parts thinner than 1.2 spacings, points may have wrong labels (tracer/manual/how-to/export.md). So for each wrong
label, the thickness there is measured: the shortest chord within the region of one label, through the point itself or
through points on its way to the phase. Wrong labels with chords of at least 1.2 spacings are faults. The script prints
a row as soon as it finishes a scene and spacing. The exit status is 1 if anything is wrong.

Needs Debian's admesh, libcgal-dev, g++ and python3-numpy. Compiling self_intersections.cpp takes minutes; --crossings
names the program if it is already compiled.
"""
import argparse
import glob
import math
import os
import re
import subprocess
import sys
import tempfile
import time

import numpy as np
import phasetree as pt

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
THIN = 1.2  # spacings; thinner parts may be pierced, missing or too thick
FACET = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def read_stl(path):
    """Vertices, each once, and triangles of a binary STL file."""
    with open(path, "rb") as file:
        data = file.read()
    facets = np.frombuffer(data, FACET, np.frombuffer(data, "<u4", 1, 80)[0], 84)
    vertices, triangles = np.unique(facets["corners"].reshape(-1, 3) + 0.0, axis=0, return_inverse=True)
    return vertices, triangles.reshape(-1, 3)


def admesh_faults(path):
    """The statistics of admesh's report that show a fault."""
    report = subprocess.run(["admesh", path], capture_output=True, text=True, check=False, env={"LC_ALL": "C"}).stdout
    faults = []
    for line in report.splitlines():
        match = re.match(r"(Total disconnected facets|Degenerate facets|Edges fixed|Facets removed|Facets added|"
                         r"Facets reversed|Backwards edges|Normals fixed)\s*:\s*(-?\d+)", line)
        if match and int(match[2]) != 0:
            faults.append(f"{match[1].lower()}: {match[2]}")
    return faults if "Number of parts" in report else ["admesh failed"]


def crossing_faults(program, vertices, triangles, folder):
    """What CGAL finds of triangles that cross. Floats are written exactly."""
    path = os.path.join(folder, "surface.off")
    with open(path, "w", encoding="ascii") as file:
        file.write(f"OFF\n{len(vertices)} {len(triangles)} 0\n")
        np.savetxt(file, vertices.astype(float), "%.17g")
        np.savetxt(file, np.insert(triangles, 0, 3, axis=1), "%d")
    run = subprocess.run([program, path], capture_output=True, text=True, check=False)
    if run.returncode != 0:
        return [f"CGAL failed: {run.stderr.strip()[-200:] or run.returncode}"]
    pairs, read = (int(word) for word in run.stdout.split())
    if pairs < 0 or read != len(triangles):
        return ["CGAL: not manifold"]
    return [f"CGAL: {pairs} crossing pairs"] if pairs else []


def compiled(folder):
    """The program that calls CGAL."""
    program = os.path.join(folder, "self_intersections")
    source = os.path.join(os.path.dirname(os.path.abspath(__file__)), "self_intersections.cpp")
    subprocess.run(["g++", "-O2", "-o", program, source, "-lgmp", "-lmpfr"], check=True)
    return program


def probes(rng, count, vertices, triangles, bounds, spacing):
    """Half of the points are uniform in the bounds, half within eight spacings of the surface."""
    low, high = np.asarray(bounds)
    anywhere = rng.uniform(low - spacing, high + spacing, (count // 2, 3))
    a, b, c = (vertices[triangles[:, k]].astype(float) for k in range(3))
    chosen = rng.choice(len(triangles), count - count // 2)
    weights = rng.dirichlet((1, 1, 1), len(chosen))
    near = sum(weights[:, k, None] * corner[chosen] for k, corner in enumerate((a, b, c)))
    direction = rng.normal(size=near.shape)
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    near += rng.uniform(1, 8, (len(near), 1)) * spacing * direction
    return np.concatenate([anywhere, near]).astype(np.float32)


def directions(count):
    """Directions distributed evenly over a hemisphere, on a Fibonacci spiral."""
    z = (np.arange(count) + 0.5) / count
    turn = np.arange(count) * math.pi * (3 - math.sqrt(5))
    r = np.sqrt(1 - z * z)
    return np.stack([r * np.cos(turn), r * np.sin(turn), z], axis=1)


def thickness_on_way(scene_object, point, index, spacing):
    """The shortest chord, in spacings, through a point with a wrong label, or through points on the shortest way from it
    to the phase, or out of the phase. A chord is a straight line within the region of one label, in one of 256
    directions. Its ends are found in steps of 1/16, then by bisection. Its length is at most 4."""
    steps = np.arange(1, 33) / 16
    there = 256

    def labels_around(at):
        ways = np.concatenate([directions(there), -directions(there)])
        around = at + spacing * steps[None, :, None] * ways[:, None, :]
        return ways, scene_object.label(around.reshape(-1, 3).astype(np.float32)).reshape(len(ways), len(steps))

    def chord(at):
        _, labels = labels_around(at)
        own = scene_object.label(at[None].astype(np.float32))[0]
        other = labels != own
        reach = np.where(other.any(axis=1), steps[np.argmax(other, axis=1)], steps[-1])
        # Bisect where the label changes.
        low, high, ways = reach - 1 / 16, reach, np.concatenate([directions(there), -directions(there)])
        for _ in range(6):
            middle = 0.5 * (low + high)
            places = (at + spacing * middle[:, None] * ways).astype(np.float32)
            is_other = scene_object.label(places) != own
            low, high = np.where(is_other, low, middle), np.where(is_other, middle, high)
        return (high[:there] + high[there:]).min()

    is_inside = scene_object.label(point[None].astype(np.float32))[0] == index
    ways, labels = labels_around(point)
    changed = (labels == index) != is_inside
    least = chord(point)
    if changed.any():
        first = np.where(changed.any(axis=1), np.argmax(changed, axis=1), len(steps))
        way = np.argmin(first)
        for k in range(0, first[way], 2):
            least = min(least, chord(point + spacing * steps[k] * ways[way]))
    return least


def wrong_labels(scene_object, name, path, surface, spacing, count):
    """The number of points compared, of those with a wrong label, and of wrong labels at thin parts."""
    read = pt.mesh(path).set(pt.phase("read"))
    rng = np.random.default_rng(7)
    points = probes(rng, count, *surface, scene_object.bounds, spacing)
    phi = scene_object.phi(points)
    index = scene_object.index(name)
    # Away from this phase's surface by more than the spacing, on either side, by the distances of the object.
    others = np.delete(phi, index, axis=1)
    distance = np.where(phi[:, index] < 0, others.min(axis=1), phi[:, index])
    far = distance > spacing
    expected, found = scene_object.label(points)[far] == index, read.label(points[far]) == 1
    wrong = points[far][expected != found]
    thin = sum(thickness_on_way(scene_object, point, index, spacing) < THIN for point in wrong)
    return int(far.sum()), len(wrong), thin


def check(command, scene, division, options, folder):
    """A row of the table, and whether all is well."""
    loaded = pt.load(scene)
    low, high = loaded.object.bounds
    spacing = float(np.max(np.asarray(high) - np.asarray(low))) / division
    start = time.time()
    export = subprocess.run([command, "export", scene, "--spacing", repr(spacing), "-o",
                             os.path.join(folder, "{phase}.stl")], capture_output=True, text=True, check=False)
    name = os.path.splitext(os.path.basename(scene))[0]
    if export.returncode != 0:
        return f"| {name} | {division} | | | | | export failed: {export.stderr.strip().splitlines()[-1]} |", False
    faults, counts, total = [], np.zeros(3, dtype=int), 0
    for path in sorted(glob.glob(os.path.join(glob.escape(folder), "*.stl"))):
        phase = os.path.splitext(os.path.basename(path))[0]
        vertices, triangles = read_stl(path)
        total += len(triangles)
        found = admesh_faults(path) + crossing_faults(options.crossings, vertices, triangles, folder)
        try:
            counts += wrong_labels(loaded.object, phase, path, (vertices, triangles), spacing, options.points)
        except pt.Error as error:
            found.append(f"reading back: {error}")
        faults += [f"{phase}: {fault}" for fault in found]
    if counts[1] > counts[2]:
        faults.append(f"{counts[1] - counts[2]} wrong labels")
    note = "; ".join(faults) or "none"
    return (f"| {name} | {division} | {total:,} | {counts[0]:,} | {counts[1]} | {time.time() - start:.0f} | {note} |",
            not faults)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("command")
    parser.add_argument("--scenes", nargs="*", help="names of scenes in the folder scenes (default: all)")
    parser.add_argument("--divisions", default="48,96,160", type=lambda text: [int(n) for n in text.split(",")])
    parser.add_argument("--points", default=20_000, type=int, help="per phase (default: 20,000)")
    parser.add_argument("--crossings", metavar="PROGRAM", help="self_intersections.cpp, compiled")
    options = parser.parse_args()
    tools = tempfile.TemporaryDirectory()
    options.crossings = options.crossings or compiled(tools.name)
    scenes = [os.path.join(ROOT, "scenes", name + ".json") for name in options.scenes or []] or sorted(
        path for path in glob.glob(os.path.join(ROOT, "scenes", "*.json")) if not path.endswith("scene.schema.json"))
    print("| scene | longest side / spacing | triangles | points | wrong labels, all at thin parts | s | faults |")
    print("|---|---|---|---|---|---|---|", flush=True)
    all_well = True
    for scene in scenes:
        for division in options.divisions:
            with tempfile.TemporaryDirectory() as folder:
                row, is_well = check(os.path.abspath(options.command), scene, division, options, folder)
            print(row, flush=True)
            all_well = all_well and is_well
    sys.exit(0 if all_well else 1)


main()
