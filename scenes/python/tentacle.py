"""The tentacle of scenes/tentacle.json, which has the same labels: python3 tentacle.py [IMAGE [SAMPLES]]

The places of links, suckers and bumps, some thousand numbers that a script has once computed, are read from there.
"""

import json
import pathlib
import re
import sys

import phasetree as pt

FILE = pathlib.Path(__file__).resolve().parents[1] / "tentacle.json"
shapes = json.loads(re.sub(r"//.*", "", FILE.read_text(encoding="utf-8")))["shapes"]

flesh = pt.phase("flesh", pt.coated(
    pt.textures.marble(color=(0.66, 0.16, 0.12), vein=(0.86, 0.50, 0.42), scale=0.22, seed=3), ior=1.4, roughness=0.22))
fat = pt.phase("fat", pt.coated(
    pt.textures.speckle((0.88, 0.66, 0.36), (0.93, 0.80, 0.56), grain=0.025, contrast=0.15), ior=1.4, roughness=0.2))
skin = pt.phase("skin", pt.coated(
    pt.textures.speckle((0.16, 0.022, 0.055), (0.36, 0.065, 0.085), grain=0.05, contrast=0.3), ior=1.5, roughness=0.12))
bumps = pt.phase("bumps", pt.coated((0.82, 0.40, 0.30), ior=1.45, roughness=0.12))

# The arm is a chain of cones, in layers: each embeds what is within and touches it exactly.
links = (list(link.values())[0] for link in shapes["core"]["union"])
core = pt.union([pt.round_cone(k["from"], k["radius_from"], k["to"], k["radius_to"]) for k in links])
arm = flesh(core).layered_sequence([fat, skin], [0.085, 0.04])

# A sucker is a cup with a thick rim; they stand in two rows.
cup = pt.capped_cone(0.44, 0.36, 0.5).translate((0, 0, 0.1)).smooth(0.3) | pt.torus(0.4, 0.11).translate((0, 0, 0.36))
sucker = cup.smooth(0.16) - pt.sphere(0.37).translate((0, 0, 0.56))
frames = (turned["affine"] for turned in shapes["suckers"]["union"])
suckers = pt.union([sucker.affine(x=f["x"], y=f["y"], z=f["z"], by=f["by"]) for f in frames])
spiral = shapes["bumps"]["instances"]
balls = pt.sphere(1).instances(spiral["positions"], scales=spiral["scales"])
tentacle = bumps(balls, suckers).under(arm)

# Each phase is cut by a shape of its own, the skin highest, so that one sees every layer from outside and in section.
for phases, y, height, angle in (((skin, bumps), -0.86, 4.7, -18), (fat, -0.98, 3.5, -14), (flesh, -1.10, 2.1, -10)):
    knife = pt.rounded_box((4, 2, height), 0.03).rotate(angle, axis=(0, 1, 0)).translate((-0.2, y, 0))
    tentacle = tentacle.subtract_shape(knife, phases=phases)
tentacle = tentacle.with_phases(flesh, fat, skin, bumps)

if __name__ == "__main__":
    studio = pt.load(FILE)
    scene = studio.with_(object=tentacle)
    samples = int(sys.argv[2]) if len(sys.argv) > 2 else 16
    scene.render(samples=samples, progress=True).save(sys.argv[1] if len(sys.argv) > 1 else "tentacle.png")
