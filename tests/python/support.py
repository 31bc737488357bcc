"""What several tests of the Python package share."""

import json
import os
import pathlib
import re
import subprocess

import phasetree as pt

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = ROOT / "scenes"
COMMAND = os.environ.get("PHASETREE_COMMAND", str(ROOT / "build/release/tracer/phasetree"))


def run(*arguments, given=""):
    """The command's output."""
    done = subprocess.run([COMMAND, *map(str, arguments)], input=given, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f"{arguments} exits with {done.returncode}: {done.stderr}")
    return done.stdout


def without_comments(text):
    """JSON with comments as Python's own reader takes it; strings of the scenes here have no slashes in pairs."""
    return json.loads(re.sub(r'("(?:[^"\\]|\\.)*")|//[^\n]*|/\*.*?\*/', lambda m: m[1] or "", text, flags=re.S))


def gallery():
    """The scene files of the gallery."""
    return sorted(SCENES.glob("*.json"), key=lambda p: p.name)


def gallery_scenes():
    return [p for p in gallery() if p.name != "scene.schema.json"]


def gallery_scenes_for_the_command():
    """The scenes for tests that start the command: one in four in the short form, because starting it takes 0.25 s."""
    return gallery_scenes() if os.environ.get("PHASETREE_LONG_TESTS") else gallery_scenes()[1::4]


def calls(node, shapes, phases, folder):
    """A node of a file, {"name": parameters}, made by the package's functions: each with its arguments by name.

    Shapes are replaced by what is made of them, so that each is made once."""
    if isinstance(node, str):
        if not isinstance(shapes[node], (pt.Field, pt.Object)):
            shapes[node] = calls(shapes[node], shapes, phases, folder)
        return shapes[node]
    ((name, said),) = node.items()
    function = getattr(pt, name)
    kind = function.kind
    if isinstance(said, list):
        said = {next(p.name for p in kind.parameters if not p.optional): said}
    unnamed, named = [], {}
    for p in kind.parameters:
        if p.name not in said:
            continue
        value = said[p.name]
        if p.type in ("field", "object"):
            value = calls(value, shapes, phases, folder)
        elif p.type in ("list of fields", "list of objects"):
            value = [calls(one, shapes, phases, folder) for one in value]
        elif p.type == "phase" or p.type.endswith("of phases"):
            value = phases[value] if isinstance(value, str) else [phases[one] for one in value]
        elif p.type == "name of a file":
            value = folder / value
        if p is kind.many:
            unnamed = [*(named.pop(q.python_name) for q in kind.parameters[: kind.parameters.index(p)]), *value]
        else:
            named[p.python_name] = value
    return function(*unnamed, **named)


def object_of(path):
    """The object of a scene file, made by calls alone, and with the phases in the file's order."""
    scene = without_comments(path.read_text(encoding="utf-8"))
    phases = {name: pt.phase(name) for name in scene["phases"]}
    phases["vacuum"] = pt.vacuum
    made = calls(scene["tree"], scene.get("shapes", {}), phases, path.parent)
    return made.with_phases(*(p for p in phases.values()))
