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

Points in walls thinner than 1.2 spacings may have other labels (tracer/manual/how-to/export.md); they are counted
separately. A row per scene and spacing is printed, as it is finished. The exit status is 1 if anything is wrong.

Needs Debian's admesh, libcgal-dev, g++ and python3-numpy. Compiling self_intersections.cpp takes minutes; --crossings
names the program if it is already compiled.
"""
import argparse
import glob
import os
import re
import subprocess
import sys
import tempfile
import time

import numpy as np
import phasetree as pt

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
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


def wrong_labels(scene_object, name, path, surface, spacing, count):
    """How many points were compared; how many of them have a wrong label; how many of these are in thin walls."""
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
    # Thin: the label differs from the one expected somewhere nearby, in 26 directions at 1.2 spacings.
    thin = 0
    if len(wrong):
        steps = np.array([(x, y, z) for x in (-1, 0, 1) for y in (-1, 0, 1) for z in (-1, 0, 1)], dtype=np.float32)
        nearby = wrong[:, None, :] + 1.2 * spacing * steps[None]
        labels = scene_object.label(nearby.astype(np.float32)) == index
        thin = int(np.sum(labels.any(axis=1) & ~labels.all(axis=1)))
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
    print("| scene | longest side / spacing | triangles | points | wrong labels, all in thin walls | s | faults |")
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
