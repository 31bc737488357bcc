#!/usr/bin/env python3
"""What "spectral" costs: pictures of scenes with it and without, in turn.

    benchmarks/spectral_cost.py PHASETREE [--samples N] [--size WxH] [SCENE…]

For each scene: by how much the picture's mean red, green and blue change; the variance of a sample with wavelengths over that
with colours, of single channels and of brightness, each the median over the pixels of the variance over the square of the mean,
from two seeds; and the processor time likewise. Needs Debian's python3-numpy and python3-openimageio.
"""
import argparse
import json
import os
import re
import resource
import subprocess
import tempfile

import numpy as np
import OpenImageIO as oiio

SCENES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "scenes")
LUMINANCE = (0.2126, 0.7152, 0.0722)


def with_wavelengths(scene):
    """The text of the scene with "spectral" in its settings, which must be there."""
    text, count = re.subn(r'"render":\s*\{', '"render": {"spectral": true, ', open(scene, encoding="utf-8").read(), count=1)
    if count != 1:
        raise SystemExit(f'{scene} has no "render" of its own')
    return text


def rendered(options, scene, seed, folder, name):
    """The pixels and the processor seconds of one picture."""
    output = os.path.join(folder, f"{name}.{seed}.exr")
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    subprocess.run([options.phasetree, "render", scene, "--quiet", "--size", options.size, "--spp", str(options.samples),
                    "--seed", str(seed), "-o", output], check=True)
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    return oiio.ImageInput.open(output).read_image(oiio.FLOAT)[:, :, :3].astype(np.float64), seconds


def summary(first, second):
    """The mean colour, the variances of channels and of brightness, and the seconds, of two pictures of the same."""
    def variance(a, b):
        return np.median((a - b) ** 2 / 2 / ((a + b) / 2 + 0.01) ** 2)
    (a, seconds), (b, more) = first, second
    return (a + b).mean(axis=(0, 1)) / 2, variance(a, b), variance(a @ LUMINANCE, b @ LUMINANCE), seconds + more


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("phasetree", type=os.path.abspath)
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--size", default="160x120")
    parser.add_argument("scenes", nargs="*")
    options = parser.parse_intermixed_args()
    for scene in options.scenes or [os.path.join(SCENES, "hourglass.json")]:
        # Beside the scene, because that names files beside itself.
        with tempfile.TemporaryDirectory() as folder, tempfile.NamedTemporaryFile(
                "w", suffix=".json", dir=os.path.dirname(os.path.abspath(scene)), encoding="utf-8") as spectral:
            spectral.write(with_wavelengths(scene))
            spectral.flush()
            pictures = {"colours": [], "wavelengths": []}
            for seed in (1, 2):
                for name, file in (("colours", scene), ("wavelengths", spectral.name)):
                    pictures[name].append(rendered(options, file, seed, folder, name))
            colours, wavelengths = (summary(*pictures[name]) for name in ("colours", "wavelengths"))
            print(json.dumps({"scene": os.path.basename(scene),
                              "colour": [round(float(x), 4) for x in wavelengths[0] / colours[0]],
                              "variance of channels": round(float(wavelengths[1] / colours[1]), 2),
                              "variance of brightness": round(float(wavelengths[2] / colours[2]), 2),
                              "time": round(wavelengths[3] / colours[3], 3)}), flush=True)


if __name__ == "__main__":
    main()
