"""Parts of a scene other than objects: materials, textures, number textures, normal maps, phase functions, voxels,
lights, meshes, cameras and image settings."""

from __future__ import annotations

import json
import types

from phasetree import _phasetree, _reference
from phasetree._values import Value

_CHECKED_AS = {
    "Materials": ("material", lambda text: text),
    "Textures": ("material", lambda text: {"diffuse": {"color": text}}),
    "Number textures": ("material", lambda text: {"clear": {"ior": 1, "film_thickness": text}}),
    "Normal maps": ("material", lambda text: {"diffuse": {"color": [1, 1, 1], "normal_map": text}}),
    "Phase functions": (
        "material",
        lambda text: {"clear": {"ior": 1, "scattering": [1, 1, 1], "phase_function": text}},
    ),
    "Voxel grids": ("material", lambda text: {"clear": {"ior": 1, "scattering": [1, 1, 1], "density_grid": text}}),
    "Lights": ("lights", lambda text: {"lights": [text]}),
    "Meshes": ("meshes", lambda text: [text]),
    "Cameras": ("camera", lambda text: text),
    "Render settings": ("render", lambda text: text["render"]),
}


class Part(Value):
    """A material, texture, number texture, normal map, phase function, voxel grid, light, mesh or camera, or the image
    settings.

    Consists of a kind and its parameters, which have been checked.
    """

    __slots__ = ("_text", "chapter", "kind")

    def __init__(self, chapter, kind, value):
        object.__setattr__(self, "chapter", chapter)
        object.__setattr__(self, "kind", kind)
        object.__setattr__(self, "_text", json.dumps(value, ensure_ascii=False))

    def __setattr__(self, name, value):
        raise AttributeError(f"a {self.kind} is immutable; create another one")

    def _pickled(self):
        return self.chapter, self.kind, json.loads(self._text)

    def written(self):
        """The JSON value: {kind: parameters}, or only the parameters if there is a single kind."""
        return self.parameters() if self.chapter in ("Normal maps", "Voxel grids") else json.loads(self._text)

    def parameters(self):
        """The parameters that were passed."""
        return json.loads(self._text)[self.kind]

    def __eq__(self, other):
        return isinstance(other, Part) and (self.chapter, self._text) == (other.chapter, other._text)

    def __hash__(self):
        return hash(self._text)

    def __repr__(self):
        said = ", ".join(f"{_reference.python_name(k)}={v!r}" for k, v in self.parameters().items())
        return f"{self.kind}({said})"


def _function(kind):
    signature = kind.signature()

    def make(*arguments, **named):
        values = {}
        for p, value in kind.bound(signature, arguments, named).items():
            is_file = p.type == "name of a file"
            what = f'{kind.name}: "{p.name}"'
            values[p.name] = _reference.file_name(value) if is_file else _reference.written(value, what)
        part = Part(kind.chapter, kind.name, {kind.name: values})
        checked_as, around = _CHECKED_AS[kind.chapter]
        _phasetree.check_part(checked_as, json.dumps(around(part.written()), ensure_ascii=False))
        return part

    make.__name__ = make.__qualname__ = kind.name
    make.__doc__ = kind.doc
    make.__signature__ = signature
    make.__module__ = "phasetree"
    return make


def _module(name, doc, kinds):
    module = types.SimpleNamespace()
    for kind in kinds:
        function = _function(kind)
        function.__qualname__ = f"{name}.{kind.name}"  # pickle looks the function up by this name
        setattr(module, kind.name, function)
    module.__doc__ = doc
    return module


_chapters = {title: kinds for title, kinds in _reference.chapters() if title in _CHECKED_AS}
kinds = _chapters


def module_name(chapter):
    """The name of the module with the functions for a chapter of the scene reference."""
    return {"Number textures": "numbers"}.get(chapter, chapter.lower().replace(" ", "_"))


materials = _module("materials", "Materials: what phases and meshes are made of.", _chapters["Materials"])
textures = _module("textures", "Textures: colours that differ from place to place.", _chapters["Textures"])
numbers = _module("numbers", "Numbers that differ from place to place.", _chapters["Number textures"])
phase_functions = _module(
    "phase_functions", "Phase functions: into which directions media scatter light.", _chapters["Phase functions"]
)
lights = _module("lights", "Lights.", _chapters["Lights"])
meshes = _module("meshes", "Meshes in the scene in addition to the object.", _chapters["Meshes"])
cameras = _module("cameras", "Cameras.", _chapters["Cameras"])
image = _function(_chapters["Render settings"][0])
image.__name__ = image.__qualname__ = "image"
normal_map = _function(_chapters["Normal maps"][0])
voxels = _function(_chapters["Voxel grids"][0])


def part_of(chapter, value):
    """Makes a part from the JSON of a scene file, which has been checked already.

    A camera without a kind is a thin lens.
    """
    names = [kind.name for kind in _chapters[chapter]]
    if chapter == "Render settings":
        value = {"render": value}
    if chapter == "Cameras" and not (len(value) == 1 and next(iter(value)) in names):
        value = {names[0]: value}
    return Part(chapter, next(iter(value)), value)
