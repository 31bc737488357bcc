#!/usr/bin/env python3
"""How long phasetree and Blender's Cycles take to the same error on the same picture.

    PYTHONPATH=build/release/plugins/python python3 benchmarks/cycles/compare.py build/release/tracer/phasetree
        [--scenes hourglass,drinks,drink] [--size WIDTHxHEIGHT] [--samples OURS,CYCLES] [--rounds N] [--threads N] [--cpu] [--keep FOLDER]

README.md, beside this file, says what is compared and how. Needs Debian's `blender`, `python3-openimageio`, `python3-numpy`.
"""
import argparse
import json
import math
import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile

import numpy as np
import OpenImageIO as oiio
import phasetree as pt
from interfaces import interfaces

HERE = os.path.dirname(os.path.abspath(__file__))
# The grid's spacing for each scene, in its unit: a quarter of what its thinnest wall measures, or less.
SPACINGS = {"hourglass": 0.006, "drinks": 0.004}
# The drink of drink.py: its surroundings, in metres. The backdrop reaches slightly into the glass.
AROUND_DRINK = {
    "meshes": [{"backdrop": {"height": 0.0002, "distance": 0.35, "radius": 0.25, "width": 4, "front": 1, "wall": 2,
                             "material": {"diffuse": {"color": [0.62, 0.60, 0.57]}}}}],
    "lights": [{"rectangle": {"centre": [-0.45, -0.25, 0.55], "target": [0, 0, 0.06], "width": 0.35, "height": 0.45,
                              "radiance": [1, 0.96, 0.9], "intensity": 12}},
               {"gradient": {"zenith": [0.9, 0.95, 1], "horizon": [0.5, 0.5, 0.52], "ground": [0.2, 0.19, 0.18],
                             "intensity": 0.9}}],
    "camera": {"position": [0.10, -0.48, 0.20], "look_at": [0.004, 0, 0.071], "fov": 19.5, "filter": "box"},
}
# The mean colours of the textures, which would be another picture in Cycles.
MIXED = {"speckle": ("color", "other"), "wood": ("light", "dark")}


def plain(value):
    """A scene without textures: each is the mean of its two colours."""
    if isinstance(value, dict):
        (kind, part), *more = value.items() or [(None, None)]
        if kind in MIXED and not more and isinstance(part, dict):
            return [0.5 * (a + b) for a, b in zip(*(part[name] for name in MIXED[kind]))]
        return {name: plain(part) for name, part in value.items()}
    return [plain(part) for part in value] if isinstance(value, list) else value


def picture(path):
    # Not by an ImageBuf, which remembers files by name and second.
    file = oiio.ImageInput.open(path)
    if file is None:
        sys.exit(f"{path}: {oiio.geterror()}")
    return file.read_image(oiio.FLOAT)[:, :, :3].astype(np.float64) @ (0.2126, 0.7152, 0.0722)


def errors(a, b, mean):
    """The relative squared error of each pixel of one picture, from two of different seeds (of what `light` measures, too)."""
    return 0.5 * (a - b) ** 2 / (mean**2 + 0.01 * mean.mean() ** 2)


class Side:
    """What was measured of one of the two renderers."""

    def __init__(self):
        self.means, self.costs, self.least = [], [], []

    def add(self, pictures, seconds):
        a, b = pictures
        mean = 0.5 * (a + b)
        of_pixels = np.sort(errors(a, b, mean).ravel())
        self.means.append(mean)
        self.costs.append(of_pixels.mean() * statistics.mean(seconds))
        # Without the thousandth of the pixels that are the worst: what rare bright paths do not decide.
        self.least.append(of_pixels[: -(len(of_pixels) // 1000) or None].mean() * statistics.mean(seconds))


def ours(command, folder, options, samples, seeds):
    def render(seed, spp):
        output, stats = os.path.join(folder, f"ours.{seed}.exr"), os.path.join(folder, "stats.json")
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        subprocess.run([command, "render", os.path.join(folder, "scene.json"), "--quiet", "--size", "{}x{}".format(*options.size),
                        "--spp", str(spp), "--seed", str(seed), "--threads", str(options.threads), "-o", output,
                        "--stats", stats], check=True)
        if options.cpu:
            return resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        with open(stats, encoding="utf-8") as file:
            return json.load(file)["render_seconds"]

    # Processor time includes the preparation, so that of a picture with one sample is subtracted.
    preparation = render(seeds[0], 1) if options.cpu else 0
    pictures, seconds = [], []
    for seed in seeds:
        taken = render(seed, samples) - preparation
        seconds.append(taken * samples / (samples - 1) if options.cpu else taken)
        pictures.append(picture(os.path.join(folder, f"ours.{seed}.exr")))
    return pictures, seconds


def in_blender(script, *arguments):
    run = subprocess.run(["blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python",
                          os.path.join(HERE, script), "--", *arguments],
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if run.returncode != 0:
        sys.exit(f"Blender failed:\n{run.stdout[-3000:]}")


def cycles(folder, options, samples, seeds):
    in_blender("in_blender.py", folder, *(str(n) for n in (*options.size, samples, options.threads, int(options.cpu), *seeds)))
    with open(os.path.join(folder, "times.json"), encoding="utf-8") as file:
        seconds = json.load(file)
    return [picture(os.path.join(folder, f"cycles.{seed}.exr")) for seed in seeds], seconds


def prepare_drink(command, folder):
    """Blender writes the drink as glTF, and `phasetree import` makes a scene of it. Cycles renders Blender's file."""
    in_blender("drink.py", folder)
    report = subprocess.run([command, "import", "drink.glb", "-o", "scene.json", "--force"], check=True, cwd=folder,
                            capture_output=True, text=True).stdout
    print(report, file=sys.stderr)
    with open(os.path.join(folder, "scene.json"), encoding="utf-8") as file:
        scene = json.load(file)
    scene |= AROUND_DRINK | {"meshes": scene["meshes"] + AROUND_DRINK["meshes"]}
    scene["render"] = {"exposure": 0}
    # Blender's exporter copies the colour of a Volume Absorption, which absorbs (1 − colour) × density in Cycles.
    tea = scene["phases"]["Tea"]["clear"]
    tea["color"] = [math.exp(c - 1) for c in tea["color"]]
    with open(os.path.join(folder, "scene.json"), "w", encoding="utf-8") as file:
        json.dump(scene, file)
    return triangles_of_glb(os.path.join(folder, "drink.glb"))


def triangles_of_glb(path):
    with open(path, "rb") as file:
        data = file.read()
    gltf = json.loads(data[20:20 + int.from_bytes(data[12:16], "little")])
    return sum(gltf["accessors"][part["indices"]]["count"] // 3
               for node in gltf["nodes"] if "mesh" in node for part in gltf["meshes"][node["mesh"]]["primitives"])


def prepare(command, name, folder):
    if name == "drink":
        return prepare_drink(command, folder)
    scene = os.path.join(HERE, "..", "..", "scenes", f"{name}.json")
    loaded = pt.load(scene)
    description = plain(json.loads(loaded.to_json()))
    description["camera"] = description["camera"]["thin_lens"] | {"filter": "box"}  # so that pixels are independent
    with open(os.path.join(folder, "scene.json"), "w", encoding="utf-8") as file:
        json.dump(description, file)
    names = [phase.name for phase in loaded.object.phases]
    arrays = {}
    for (outer, inner), (vertices, triangles) in interfaces(loaded.object, SPACINGS[name]).items():
        pair = f"{names[outer]}|{names[inner]}"
        arrays[f"{pair}/vertices"], arrays[f"{pair}/triangles"] = vertices.astype(np.float32), triangles.astype(np.int32)
    np.savez(os.path.join(folder, "interfaces.npz"), **arrays)
    return sum(len(array) for name, array in arrays.items() if name.endswith("/triangles"))


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("command")
    parser.add_argument("--scenes", default="hourglass,drinks,drink", type=lambda text: text.split(","))
    parser.add_argument("--size", default=(300, 300), type=lambda text: tuple(int(n) for n in text.split("x")))
    parser.add_argument("--samples", default=(64, 64), type=lambda text: tuple(int(n) for n in text.split(",")))
    parser.add_argument("--rounds", default=3, type=int)
    parser.add_argument("--threads", default=2, type=int)
    parser.add_argument("--cpu", action="store_true", help="measure processor time: for busy machines")
    parser.add_argument("--keep", help="a folder for the meshes and pictures, which are thrown away otherwise")
    options = parser.parse_args()
    command = os.path.abspath(options.command)
    if not shutil.which("blender"):
        sys.exit("there is no blender; Debian has it as a package of this name")
    print("| picture | triangles | brightness, ours of Cycles' | error × seconds: ours | Cycles | faster | without the worst 0.1 % of pixels |")
    print("|---|---|---|---|---|---|---|")
    for name in options.scenes:
        with tempfile.TemporaryDirectory() as temporary:
            folder = os.path.join(options.keep, name) if options.keep else temporary
            os.makedirs(folder, exist_ok=True)
            triangles = prepare(command, name, folder)
            here, there = Side(), Side()
            for turn in range(options.rounds):
                seeds = (2 * turn + 1, 2 * turn + 2)
                here.add(*ours(command, folder, options, options.samples[0], seeds))
                there.add(*cycles(folder, options, options.samples[1], seeds))
            ratios = [b / a for a, b in zip(here.costs, there.costs)]
            least = [b / a for a, b in zip(here.least, there.least)]
            brightness = np.mean(here.means) / np.mean(there.means)
            print(f"| {name} | {triangles:,} | {brightness:.3f} | {statistics.median(here.costs):.3g} | "
                  f"{statistics.median(there.costs):.3g} | {statistics.median(ratios):.2f} × ({min(ratios):.2f} to {max(ratios):.2f}) | "
                  f"{statistics.median(least):.2f} × |", flush=True)


main()
