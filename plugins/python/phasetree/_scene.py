"""Whole scenes: an object, what is beside it, a camera; their files and their pictures."""

from __future__ import annotations

import json
import os
import sys

import numpy as np

from phasetree import _parts, _phasetree
from phasetree._errors import Error
from phasetree._parts import Part
from phasetree._phases import Phase, vacuum
from phasetree._trees import Object, _material, node_of


def _part(value, chapter, what):
    if not (isinstance(value, Part) and value.chapter == chapter):
        raise Error(f"{what} cannot be {value!r}")
    return value


def _several(values, chapter, what):
    if isinstance(values, Part):
        values = (values,)
    return tuple(_part(v, chapter, what) for v in values)


class Image:
    """A picture: linear Rec.709 radiance, and further planes beside it.

    pixels: float32 (height, width, 3), the top row first. planes: float32 (height, width) by their names in EXR files.
    """

    def __init__(self, pixels, planes=None, exposure=0.0, view=None, samples=0, seconds=0.0, scene="", seed=0):
        self.pixels = np.ascontiguousarray(pixels, dtype=np.float32)
        self.planes = dict(planes or {})
        self.exposure, self.view = exposure, view
        self.samples, self.seconds, self.scene, self.seed = samples, seconds, scene, seed

    def __array__(self, dtype=None, copy=None):
        return np.array(self.pixels, dtype=dtype) if copy else np.asarray(self.pixels, dtype=dtype)

    def png(self, exposure=None, view=None):
        """The picture as a PNG file's bytes, through the display transform; exposure in stops."""
        return _phasetree.png(self.pixels, self.exposure if exposure is None else exposure, view or self.view)

    def save(self, path, exposure=None, view=None):
        """Writes .exr (linear, with all planes), .png, .jpg or .tif."""
        exposure = self.exposure if exposure is None else exposure
        _phasetree.save_image(
            os.fspath(path), self.pixels, self.planes, exposure, view or self.view, self.scene, self.samples, self.seed
        )

    def _repr_png_(self):
        return self.png()

    def __repr__(self):
        height, width, _ = self.pixels.shape
        return f"<Image {width}x{height}, {self.samples} samples a pixel>"


class Scene:
    """An object, and what a picture of it needs. Immutable; `with_` makes another one with some parts replaced.

    object: its phases need materials to be rendered. camera: pt.camera(…) or one of pt.cameras. lights, meshes: one or
    several. background: the colour that the camera sees in place of the lights at infinity. image: pt.image(…).
    """

    def __init__(self, object, camera=None, lights=(), meshes=(), background=None, image=None, name="scene"):
        if not isinstance(object, Object):
            raise Error(f"a scene shows an object of phases, but this is {object!r}")
        self.object = object
        self.camera = None if camera is None else _part(camera, "Cameras", "a camera")
        self.lights = _several(lights, "Lights", "a light")
        self.meshes = _several(meshes, "Meshes", "a mesh")
        self.background = None if background is None else background
        if background is not None and not isinstance(background, str):
            self.background = tuple(float(c) for c in background)
        if background is not None:
            _phasetree.check_part("lights", json.dumps({"background": self.background}))
        self.image = None if image is None else _part(image, "Image", "the image's settings")
        self.name = name

    def with_(self, **parts):
        """The same scene with some parts replaced: scene.with_(camera=…)."""
        own = ("object", "camera", "lights", "meshes", "background", "image", "name")
        return Scene(**{**{name: getattr(self, name) for name in own}, **parts})

    def _rest(self, image=None):
        rest = {}
        if self.meshes:
            rest["meshes"] = [m.written() for m in self.meshes]
        if self.lights:
            rest["lights"] = [light.written() for light in self.lights]
        if self.background is not None:
            rest["background"] = self.background
        if self.camera is not None:
            rest["camera"] = self.camera.written()
        settings = {**(self.image.parameters() if self.image else {}), **(image or {})}
        if settings:
            rest["render"] = settings
        return rest

    def to_json(self, **image):
        """The scene as a file says it; image: settings that are replaced."""
        materials = [_material(p) for p in self.object.phases[1:]]
        text = self.object._handle.text(self.object._materials, materials).rstrip()
        rest = self._rest(image)
        if not rest:
            return text + "\n"
        more = json.dumps(rest, indent=2, ensure_ascii=False)
        return text[:-1].rstrip() + "," + more[1:] + "\n"

    def save(self, path):
        """Writes a scene file, from which load() makes an equal scene. Files beside it are named relative to it."""
        path = os.fspath(path)
        folder = os.path.dirname(os.path.abspath(path))

        def named(file):
            inside = file.startswith(os.path.join(folder, ""))
            return os.path.relpath(file, folder) if inside else file

        text = _phasetree.with_files(self.to_json(), self.name, named)
        temporary = f"{path}.{os.getpid()}.part"
        try:
            with open(temporary, "x", encoding="utf-8") as file:
                file.write(text)
            os.replace(temporary, path)
        except BaseException:
            if os.path.exists(temporary):
                os.remove(temporary)
            raise

    def render(self, *, progress=None, threads=0, crop=None, quality="medium", most_bytes=0, **image):
        """Path-traces the scene: an Image. The same scene gives the same image, whatever the number of threads.

        image: settings in place of the scene's own, such as samples=16, width=400. crop: (x0, y0, x1, y1) in pixels.
        progress: True for a line on standard error, or a function of a stage and a share in [0, 1]. Ctrl-C ends it.
        """
        if self.camera is None:
            raise Error("the scene has no camera: Scene(…, camera=pt.camera(position, look_at))")
        for p in self.object.phases[1:]:
            if p.material is None:
                raise Error(f'the phase "{p.name}" has no material: pt.phase("{p.name}", pt.clear(ior=1.5))')
        if quality not in ("low", "medium"):
            raise Error(f'the quality must be "low" or "medium", but is {quality!r}')
        settings = _parts.image(**{**(self.image.parameters() if self.image else {}), **image}).parameters()
        text = self.to_json(**image)
        tell = _line if progress is True else progress or None
        try:
            made = _phasetree.render(text, self.name, crop, threads, quality == "low", most_bytes, tell)
        finally:
            if progress is True:
                print(file=sys.stderr)
        return Image(
            made["pixels"],
            made["planes"],
            exposure=settings.get("exposure", 0.0),
            view=settings.get("view"),
            samples=made["samples"],
            seconds=made["seconds"],
            scene=self.name,
            seed=settings.get("seed", 0),
        )

    def _repr_png_(self):
        """A small and quick picture, for notebooks."""
        if self.camera is None or any(p.material is None for p in self.object.phases[1:]):
            return None
        own = self.image.parameters() if self.image else {}
        width, height = own.get("width", 1024), own.get("height", 768)
        scale = min(1.0, 320 / max(width, height))
        size = {"width": max(1, round(width * scale)), "height": max(1, round(height * scale))}
        return self.render(quality="low", samples=min(16, own.get("samples", 64)), **size).png()

    def __eq__(self, other):
        return isinstance(other, Scene) and self.to_json() == other.to_json()

    __hash__ = None

    def __repr__(self):
        return f"<Scene of {self.object!r}, {len(self.lights)} lights, {len(self.meshes)} meshes>"


def _line(stage, share):
    print(f"\r{stage} {share:4.0%}", end="", file=sys.stderr, flush=True)


def _with_nodes(parts, phases):
    """The same with the nodes of handles in their place."""
    if isinstance(parts, _phasetree.FieldHandle):
        return node_of(parts, phases or ["phase"])
    if isinstance(parts, dict):
        return {key: _with_nodes(value, phases) for key, value in parts.items()}
    return [_with_nodes(value, phases) for value in parts] if isinstance(parts, list) else parts


def load(path):
    """Reads a scene file. Raises SceneError with file, line and column. Comments and names of shapes are not kept."""
    path = os.fspath(path)
    handle, parts = _phasetree.read_file(path)
    folder = os.path.dirname(os.path.abspath(path))
    text = _phasetree.text_of_file(path)
    absolute = _phasetree.with_files(text, path, lambda file: os.path.join(folder, file))
    if absolute != text:
        handle, parts = _phasetree.read_text(absolute, path)
    parts = _with_nodes(parts, list(parts["phases"]))
    phases = [vacuum]
    for name, material in parts["phases"].items():
        is_material = isinstance(material, dict) and len(material) == 1
        phases.append(Phase(name, _parts.part_of("Materials", material) if is_material else None))
    camera, render = parts.get("camera"), parts.get("render")
    return Scene(
        Object(handle, tuple(phases)),
        camera=None if camera is None else _parts.part_of("Cameras", camera),
        lights=[_parts.part_of("Lights", light) for light in parts.get("lights", ())],
        meshes=[_parts.part_of("Meshes", mesh) for mesh in parts.get("meshes", ())],
        background=parts.get("background"),
        image=None if render is None else _parts.part_of("Image", render),
        name=path,
    )
