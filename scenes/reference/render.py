#!/usr/bin/env python3
"""Render the pictures of the scene reference, except those of nodes, which scenes/nodes/render.sh makes.

    scenes/reference/render.py build/release/tracer/phasetree                     # all of them
    scenes/reference/render.py build/release/tracer/phasetree materials/clear …   # these

An example, such as materials/clear.json, has some members of a scene. A studio supplies the others: meshes/studio.json
for an example with meshes but no tree, else studio.json in the example's folder, else studio.json in this one. Members of both are
combined as follows:

  phases, shapes, render   the studio's entries, replaced and extended by those of the example
  meshes                   the studio's list, followed by that of the example
  tree                     removed if the example has "objects"
  others                   those of the example replace those of the studio

The names of files are relative to the folder scenes. PHASETREE_RENDER_OPTIONS, such as "--spp 8", are given to the
command.
"""

import json
import os
import pathlib
import re
import subprocess
import sys

FOLDER = pathlib.Path(__file__).resolve().parent


def read(path: pathlib.Path) -> dict:
    """Read JSON that may have comments."""
    text = path.read_text(encoding="utf-8")
    return json.loads(re.sub(r'("(?:\\.|[^"\\])*")|//[^\n]*', lambda m: m.group(1) or "", text))


def examples() -> list[pathlib.Path]:
    return sorted(path for path in FOLDER.glob("*/*.json") if path.name != "studio.json")


def scene_of(example: pathlib.Path) -> dict:
    """The whole scene of an example."""
    members = read(example)
    folder = FOLDER / "meshes" if "meshes" in members and "tree" not in members else example.parent
    scene = read((folder if (folder / "studio.json").exists() else FOLDER) / "studio.json")
    for key, value in members.items():
        if key in ("phases", "shapes", "render"):
            scene[key] = {**scene.get(key, {}), **value}
        elif key == "meshes":
            scene[key] = scene.get(key, []) + value
        else:
            scene[key] = value
    if "objects" in members:
        scene.pop("tree", None)
    return scene


def main() -> None:
    if len(sys.argv) < 2:
        sys.exit("usage: render.py PHASETREE [CHAPTER/NAME]…")
    command = os.path.abspath(sys.argv[1])
    chosen = [FOLDER / f"{name}.json" for name in sys.argv[2:]] or examples()
    options = os.environ.get("PHASETREE_RENDER_OPTIONS", "").split()
    for example in chosen:
        subprocess.run([command, "render", "-", "-o", example.with_suffix(".jpg"), "--quiet", "--denoise", *options],
                       input=json.dumps(scene_of(example)), text=True, check=True, cwd=FOLDER.parent)


if __name__ == "__main__":
    main()
