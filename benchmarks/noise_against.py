#!/usr/bin/env python3
"""How much less noise a build makes in a second than another one, also one of years ago, over the gallery.

    benchmarks/noise_against.py BEFORE/phasetree AFTER/phasetree [--samples N] [--size WxH] [--seeds N] [SCENE…]

`phasetree-bench light --against` does the same with more care, for builds that know all of today's options. Scenes that one
of the builds refuses are left out. Variance is relative to the square of a pixel's mean (and a hundredth of the picture's),
from pictures of several seeds; seconds are those of rendering on the wall, the two in turn, their median. What a build
cannot find at all is no noise: compare with "mean", by how much brighter AFTER's pictures are. Needs Debian's
python3-numpy and python3-openimageio.
"""
import argparse
import glob
import json
import os
import subprocess
import tempfile

import numpy as np
import OpenImageIO as oiio

SCENES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "scenes")


def rendered(command, scene, options, seed, folder):
    """The luminances and the seconds of one picture; None if the scene is rejected."""
    output, stats = os.path.join(folder, "picture.exr"), os.path.join(folder, "stats.json")
    run = subprocess.run([command, "render", scene, "--quiet", "--size", options.size, "--spp", str(options.samples), "--seed",
                          str(seed), "-o", output, "--stats", stats], stderr=subprocess.DEVNULL)
    if run.returncode != 0:
        return None
    with open(stats, encoding="utf-8") as file:
        seconds = json.load(file)["render_seconds"]
    # An ImageBuf would show the picture before this one again where both were written in the same second.
    pixels = oiio.ImageInput.open(output).read_image(oiio.FLOAT)[:, :, :3].astype(np.float64)
    return pixels @ (0.2126, 0.7152, 0.0722), seconds


def summary(pictures):
    """The relative variance, the median of the seconds, and the mean."""
    values = np.array([picture for picture, _ in pictures])
    mean = values.mean(axis=0)
    variance = values.var(axis=0, ddof=1) / (mean**2 + 0.01 * mean.mean() ** 2)
    return variance.mean(), float(np.median([seconds for _, seconds in pictures])), mean.mean()


def compared(scene, options, folder):
    before, after = [], []
    for seed in range(1, options.seeds + 1):
        for command, pictures in ((options.before, before), (options.after, after)):
            picture = rendered(command, scene, options, seed, folder)
            if picture is None:
                return None
            pictures.append(picture)
    return summary(before), summary(after)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("before", type=os.path.abspath)
    parser.add_argument("after", type=os.path.abspath)
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--samples", default=8, type=int)
    parser.add_argument("--seeds", default=4, type=int)
    parser.add_argument("--size", default="200x200")
    options = parser.parse_intermixed_args()
    gains = []
    print("| scene | variance | time | variance × time | mean |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for scene in options.scenes or sorted(glob.glob(os.path.join(SCENES, "*.json"))):
            both = compared(scene, options, folder)
            if both is None:
                continue
            variance, seconds, mean = (b / a for b, a in zip(*both))
            gains.append(variance * seconds)
            name = os.path.splitext(os.path.basename(scene))[0]
            print(f"| {name} | {variance:.2f} × | {seconds:.2f} × | {gains[-1]:.2f} × | {1 / mean:.3f} |", flush=True)
    print(f"\nThe median of {len(gains)} gains is {np.median(gains):.2f}, the least {min(gains):.2f}, the most {max(gains):.2f}.")


main()
