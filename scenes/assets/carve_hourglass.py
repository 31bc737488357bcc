#!/usr/bin/env python3
"""Writes scenes/carving.json: the hourglass of scenes/hourglass.json, its twisted rods alone and its glass with the sand
alone, each within the convex bounds that `phasetree info --carve` reports, drawn as wires and as a tint in the air.

    python3 scenes/assets/carve_hourglass.py build/release/tracer/phasetree
"""

import json
import pathlib
import re
import subprocess
import sys

SCENES = pathlib.Path(__file__).parent.parent
HEADER = """// Sphere Carving (Figure 23): the hourglass, its rods, and its glass with the sand, each within convex bounds that
// certainly contain it. The bounds are what `phasetree info --carve` reports of scenes/hourglass.json; this file is
// written by assets/carve_hourglass.py.
"""
PLANES = 32


def carved(phasetree, scene):
    out = subprocess.run([phasetree, "info", "--carve", "--planes", str(PLANES), "--json", "-"], check=True,
                         input=json.dumps(scene), capture_output=True, text=True)
    return json.loads(out.stdout)["carved"][0]


def trails(faces):
    """The edges as few chains of corners, so that each chain is one wire."""
    left = {}
    for face in faces:
        for a, b in zip(face, face[1:] + face[:1]):
            left.setdefault(a, set()).add(b)
            left.setdefault(b, set()).add(a)
    chains = []
    while any(left.values()):
        # Where an odd number of edges meet a chain must begin or end.
        start = next((v for v in sorted(left) if len(left[v]) % 2), next(v for v in sorted(left) if left[v]))
        chain = [start]
        while left[chain[-1]]:
            here = chain[-1]
            there = min(left[here])
            left[here].discard(there)
            left[there].discard(here)
            chain.append(there)
        chains.append(chain)
    return chains


def rounded(v):
    return [round(x, 5) for x in v]


def bounded(name, tree, bounds):
    wires = [{"polyline": {"points": [rounded(bounds["corners"][i]) for i in chain], "radius": 0.011}} for chain in trails(bounds["faces"])]
    return {
        f"{name}_bounds": {"polyhedron": {"normals": [rounded(p["normal"]) for p in bounds["planes"]],
                                          "offsets": [round(p["offset"] + 2e-5, 5) for p in bounds["planes"]]}},
        f"{name}_wires": {"union": wires},
        name: tree,
        f"{name}_in_bounds": {"under": [{"set": {"phase": "air", "of": f"{name}_bounds"}}, name,
                                        {"set": {"phase": "wire", "of": f"{name}_wires"}}]},
    }


def main():
    if len(sys.argv) != 2:
        sys.exit("usage: carve_hourglass.py PHASETREE")
    text = re.sub(r"//[^\n]*", "", (SCENES / "hourglass.json").read_text(encoding="utf-8"))
    hourglass = json.loads(text)
    whole = hourglass["tree"]
    parts = {"hourglass": whole, "rods": {"remove": {"of": whole, "phases": ["glass", "sand", "wood"]}},
             "bulb_and_sand": {"remove": {"of": whole, "phases": ["wood", "brass"]}}}
    shapes = dict(hourglass["shapes"])
    places = {"hourglass": [-2.05, 0, 0], "rods": [0, 0, 0], "bulb_and_sand": [1.75, 0, 0]}
    for name, tree in parts.items():
        bounds = carved(sys.argv[1], {**hourglass, "tree": tree})
        shapes |= bounded(name, tree, bounds)
    scene = {
        "version": 1,
        "phases": {**hourglass["phases"],
                   # Air with a tint, which bends no ray.
                   "air": {"clear": {"ior": 1, "color": [0.72, 0.85, 0.97], "color_distance": 2.2}},
                   "wire": {"coated": {"color": [0.93, 0.42, 0.08], "ior": 1.5, "roughness": 0.25}}},
        "shapes": shapes,
        "tree": {"under": [{"translate": {"by": places[name], "of": f"{name}_in_bounds"}} for name in parts]},
        "meshes": [{"backdrop": {"height": -1.2799, "distance": 7, "radius": 5, "width": 60, "material": {"diffuse": {"color": [0.44, 0.42, 0.40]}}}}],
        "lights": [
            {"rectangle": {"centre": [-5.2, -3.4, 4.0], "target": [0, 0, 0], "width": 3.4, "height": 4.2, "radiance": [1.0, 0.95, 0.88], "intensity": 6.5, "visible_to_camera": False}},
            {"rectangle": {"centre": [6.0, 0.6, 2.0], "target": [0, 0, 0], "width": 1.8, "height": 4.5, "radiance": [0.88, 0.94, 1.0], "intensity": 3.6, "visible_to_camera": False}},
            {"gradient": {"zenith": [0.62, 0.64, 0.68], "horizon": [0.30, 0.30, 0.31], "ground": [0.12, 0.115, 0.11]}}],
        "camera": {"position": [0.2, -10.2, 2.0], "look_at": [-0.13, 0, 0.0], "fov": 18.5},
        "render": {"width": 720, "height": 400, "samples": 64},
    }
    lines = [f"  {json.dumps(key)}: " + ("{\n" + ",\n".join(f"    {json.dumps(k)}: {json.dumps(v)}" for k, v in value.items()) + "\n  }"
                                          if isinstance(value, dict) and key in ("phases", "shapes") else json.dumps(value))
             for key, value in scene.items()]
    (SCENES / "carving.json").write_text(HEADER + "{\n" + ",\n\n".join(lines) + "\n}\n", encoding="utf-8")


if __name__ == "__main__":
    main()
