"""Scenes: objects, meshes, lights and a camera. Reads and writes scene files, and renders pictures."""

from __future__ import annotations

import json
import math
import os
import sys
import warnings

import numpy as np

from phasetree import _parts, _phasetree, _placed, _reference
from phasetree._errors import Error
from phasetree._parts import Part
from phasetree._paths import path_text
from phasetree._phases import Phase, vacuum
from phasetree._trees import Object, _material, node_of
from phasetree._values import Value


def _part(value, chapter, what):
    if not (isinstance(value, Part) and value.chapter == chapter):
        raise Error(f"{what} cannot be {value!r}")
    return value


def _several(values, chapter, what):
    if isinstance(values, Part):
        values = (values,)
    return tuple(_part(v, chapter, what) for v in values)


class Image:
    """A picture: linear Rec.709 radiance, and optional planes.

    pixels: float32 (height, width, 3), the top row first. planes: float32 (height, width) each, by the names of their
    channels in EXR files, such as "depth.Z" or "normal.X". crop: (x0, y0, width, height): the position of this
    picture's first pixel in the uncropped picture, and the size of the uncropped picture; None if not cropped. (This is
    not the form that Scene.render takes.) attributes: further EXR attributes, such as the
    names in a Cryptomatte.
    """

    def __init__(
        self, pixels, planes=None, exposure=0.0, view=None, samples=0, seconds=0.0, scene="", seed=0, crop=None,
        attributes=None,
    ):  # fmt: skip
        self.pixels = np.ascontiguousarray(pixels, dtype=np.float32)
        self.planes = dict(planes or {})
        self.exposure, self.view = exposure, view
        self.samples, self.seconds, self.scene, self.seed = samples, seconds, scene, seed
        self.crop, self.attributes = crop, dict(attributes or {})

    def __array__(self, dtype=None, copy=None):
        return np.array(self.pixels, dtype=dtype) if copy else np.asarray(self.pixels, dtype=dtype)

    def png(self, exposure=None, view=None):
        """The bytes of a PNG file of the picture, after the display transform. exposure: in stops."""
        return _phasetree.png(self.pixels, self.exposure if exposure is None else exposure, view or self.view)

    def save(self, path, exposure=None, view=None):
        """Writes .exr (linear, with all planes), .png, .jpg or .tif; one file per plane if an .exr name has "{plane}"."""
        exposure = self.exposure if exposure is None else exposure
        _phasetree.save_image(
            path_text(path), self.pixels, self.planes, list(self.attributes.items()), self.crop, exposure,
            view or self.view, self.scene, self.samples, self.seed,
        )  # fmt: skip

    def _repr_png_(self):
        return self.png()

    def __eq__(self, other):
        """Whether everything except the render time is equal."""
        if not isinstance(other, Image) or self.planes.keys() != other.planes.keys():
            return False
        described = ("exposure", "view", "samples", "scene", "seed", "crop", "attributes")
        return (
            all(getattr(self, name) == getattr(other, name) for name in described)
            and np.array_equal(self.pixels, other.pixels, equal_nan=True)
            and all(np.array_equal(plane, other.planes[name], equal_nan=True) for name, plane in self.planes.items())
        )

    __hash__ = None

    def __repr__(self):
        height, width, _ = self.pixels.shape
        return f"<Image {width}x{height}, {self.samples} samples per pixel>"


class Scene(Value):
    """One or several objects, with everything that a picture of them needs. Immutable; `with_` replaces parts.

    object: an Object; to render it, give its phases materials. A scene has either this object, or `objects`, or only
    meshes. objects: {name: object}, or {name: (object, map)}, where the map is a position or a 3x4 or 4x4 matrix.
    Objects may touch, but must not overlap. instances: one or several pt.instances_of(name, transforms), which place
    objects and groups. An object with instances appears only where they place it, not at its own map as well. groups:
    {name: instances}.

    unit: the unit of lengths, "mm", "cm", "m" or "in"; it does not affect rendering. expect: statements, as in "expect"
    of a scene file, which `phasetree check --prove` proves or refutes.

    camera: pt.camera(…), or one of pt.cameras. lights, meshes: one or several. background: the colour that the camera
    sees instead of the lights at infinity. image: pt.image(…).
    """

    def __init__(
        self, object=None, camera=None, lights=(), meshes=(), background=None, image=None, name="scene", *,
        objects=None, groups=None, instances=(), unit=None, expect=(),
    ):  # fmt: skip
        if (object is None) == (objects is None) and (object is not None or not meshes):
            raise Error("a scene needs one of these: an object, named objects, or only meshes")
        if object is not None and not isinstance(object, Object):
            raise Error(f"a scene needs an object of phases, such as field.set(phase), not {object!r}")
        self.object = object
        self.objects = _placed.named_objects(objects or {})
        self.groups = {
            name: _placed.instance_lists(listed, f'the group "{name}"') for name, listed in dict(groups or {}).items()
        }
        self.instances = _placed.instance_lists(instances, "instances")
        if objects is None and (self.groups or self.instances):
            raise Error("groups and instances place named objects: use Scene(objects={…}, instances=…)")
        self.phases = object.phases if object is not None else _placed.phases_of(self.objects)
        self.camera = None if camera is None else _part(camera, "Cameras", "a camera")
        self.lights = _several(lights, "Lights", "a light")
        self.meshes = _several(meshes, "Meshes", "a mesh")
        self.background = background
        if isinstance(background, dict):  # an animated background, {"keys": …}
            self.background = _reference.written(background, "the background")
        elif background is not None and not isinstance(background, str):
            self.background = tuple(float(c) for c in background)
        if background is not None:
            _phasetree.check_part("lights", json.dumps({"background": self.background}))
        self.image = None if image is None else _part(image, "Render settings", "the image's settings")
        self.name = name
        if unit not in (None, "mm", "cm", "m", "in"):
            raise Error(f'the unit must be "mm", "cm", "m" or "in", but is {unit!r}')
        self.unit = unit
        self.expect = [expect] if isinstance(expect, dict) else list(expect)

    def _arguments(self):
        """The arguments with which Scene makes an equal scene."""
        shown = ("objects", "groups", "instances") if self.objects else ("object",)
        own = ("camera", "lights", "meshes", "background", "image", "name", "unit", "expect")
        return {name: getattr(self, name) for name in (*shown, *own)}

    def _pickled(self):
        return (self._arguments(),)

    @classmethod
    def _unpickled(cls, arguments):
        return cls(**arguments)

    def with_(self, **parts):
        """The same scene with some parts replaced: scene.with_(camera=…)."""
        own = self._arguments()
        if parts.keys() & {"object", "objects"}:
            own = {name: value for name, value in own.items() if name not in ("object", "objects", "groups", "instances")}
        return Scene(**{**own, **parts})

    def _shown(self):
        """The part of the file's text that describes the objects, without the last bracket."""
        if self.object is not None:
            materials = [_material(p) for p in self.phases[1:]]
            return self.object._handle.text(self.object._materials, materials).rstrip()[:-1].rstrip()
        if not self.objects:
            return '{"version": 1'
        shapes, objects = _placed.written(self.objects)
        parts = {"version": 1, "phases": {p.name: json.loads(_material(p)) for p in self.phases[1:]}}
        if shapes:
            parts["shapes"] = shapes
        parts["objects"] = objects
        if self.groups:
            parts["groups"] = {name: [one.written() for one in listed] for name, listed in self.groups.items()}
        if self.instances:
            parts["instances"] = [one.written() for one in self.instances]
        return json.dumps(parts, ensure_ascii=False, separators=(",", ": "))[:-1].rstrip()

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
        if self.unit is not None:
            rest["unit"] = self.unit
        if self.expect:
            rest["expect"] = self.expect
        return rest

    def to_json(self, **image):
        """The scene as the text of a scene file. image: settings that replace the scene's own."""
        text = self._shown()
        rest = self._rest(image)
        if not rest:
            return text + "\n}\n"
        more = json.dumps(rest, indent=2, ensure_ascii=False)
        return text + "," + more[1:] + "\n"

    def save(self, path):
        """Writes a scene file, from which load() makes an equal scene.

        Files within the folder of the scene file are named relative to it.
        """
        path = path_text(path)
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

    def render(
        self, *, progress=None, threads=0, crop=None, quality="medium", max_bytes=0, planes=(), denoise=False,
        time_limit=None, at=0.0, **image,
    ):  # fmt: skip
        """Path-traces the scene. Returns an Image, which does not depend on the number of threads. Ctrl-C ends it.

        image: settings that replace the scene's own, such as samples=16, width=400. crop: (x0, y0, x1, y1) in pixels.
        progress: True for a line on standard error, or a function of the stage and the fraction done, in [0, 1].

        planes: the names of the planes to record in Image.planes, such as ["depth", "normal"], or "all", as for
        --planes of the command. denoise: True for the best method available, "oidn", or "regression", whose result does
        not depend on the version of Open Image Denoise. Image.planes then has the picture before denoising as
        "noisy.R", "noisy.G" and "noisy.B".

        time_limit: in seconds; rendering stops with the last pass that fits. Unless samples is also given, only the
        time ends the render. at: the time in seconds at which animated values are evaluated.
        """
        if self.camera is None:
            raise Error("the scene has no camera: Scene(…, camera=pt.camera(position, look_at))")
        for p in self.phases[1:]:
            if p.material is None:
                raise Error(f'the phase "{p.name}" has no material: pt.phase("{p.name}", pt.clear(ior=1.5))')
        settings = _parts.image(**{**(self.image.parameters() if self.image else {}), **image}).parameters()
        request = _render_request(quality, denoise, time_limit, [planes] if isinstance(planes, str) else planes)
        request.crop, request.threads, request.max_bytes = crop, threads, max_bytes
        request.samples = None if image.get("samples") is None else int(image["samples"])
        request.seconds_at = _moment(at)
        tell = _line if progress is True else progress or None
        try:
            made = _phasetree.render(self.to_json(**image), self.name, request, tell)
        finally:
            if progress is True:
                print(file=sys.stderr)
        if made["is_noisy_because"]:
            warnings.warn(f"the image is not denoised: {made['is_noisy_because']}", stacklevel=2)
        parts = {name: made[name] for name in ("pixels", "planes", "attributes", "crop", "samples", "seconds")}
        exposure, view, seed = settings.get("exposure", 0.0), settings.get("view"), settings.get("seed", 0)
        return Image(**parts, exposure=exposure, view=view, scene=self.name, seed=seed)

    def _repr_png_(self):
        """A small picture that renders quickly, for notebooks."""
        if self.camera is None or any(p.material is None for p in self.phases[1:]):
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
        count = len(self.objects)
        shown = repr(self.object) if self.object is not None else f"{count} objects" if count else "no object"
        return f"<Scene of {shown}, {len(self.lights)} lights, {len(self.meshes)} meshes>"


def _render_request(quality, denoise, time_limit, planes):
    """The arguments of render() as a RenderRequest of the extension module."""
    if quality not in ("low", "medium"):
        raise Error(f'the quality must be "low" or "medium", but is {quality!r}')
    if not isinstance(denoise, (bool, str)) and denoise is not None:
        raise Error(f'denoise must be True, "regression" or "oidn", but is {denoise!r}')
    if time_limit is not None and not 0 < time_limit <= 366 * 24 * 3600:
        raise Error(f"time_limit must be seconds, more than 0 and no more than a year, but is {time_limit!r}")
    request = _phasetree.RenderRequest()
    request.is_quick = quality == "low"
    request.denoise = "best" if denoise is True else denoise or None
    request.time_seconds = time_limit or 0
    request.planes = list(planes or ())
    return request


def _moment(at):
    """The time in seconds at which a scene is read. Raises Error unless it is a finite number."""
    try:
        seconds = math.nan if isinstance(at, str) else float(at)
    except (OverflowError, TypeError, ValueError):
        seconds = math.nan
    if not math.isfinite(seconds):
        raise Error(f"at must be a finite number of seconds, but is {at!r}")
    return seconds


def _line(stage, share):
    print(f"\r{stage} {share:4.0%}", end="", file=sys.stderr, flush=True)


def _with_nodes(parts, phases):
    """The same parts, with handles replaced by the JSON of their nodes."""
    if isinstance(parts, _phasetree.FieldHandle):
        return node_of(parts, phases or ["phase"])
    if isinstance(parts, dict):
        return {key: _with_nodes(value, phases) for key, value in parts.items()}
    return [_with_nodes(value, phases) for value in parts] if isinstance(parts, list) else parts


def _phases_of(parts):
    phases = [vacuum]
    for name, entry in parts.get("phases", {}).items():
        phases.append(Phase(name, *_material_and_density(entry)))
    return tuple(phases)


def _material_and_density(entry):
    """The material and the density in an entry of "phases"; None for each that is missing."""
    if not isinstance(entry, dict):
        return None, None
    material = {key: value for key, value in entry.items() if key != "density"}
    return _parts.part_of("Materials", material) if len(material) == 1 else None, entry.get("density")


def _object_with_names(entry, raw, path):
    """One object of a scene with "objects": its tree, with the phase names that the C++ reader gives it."""
    name = entry["name"]
    if "file" in entry:
        taken = load(os.path.join(os.path.dirname(os.path.abspath(path)), entry["file"]))
        made, prefix = taken.object, f"{name}."
    else:
        alone = {key: raw[key] for key in ("phases", "shapes") if key in raw}
        handle, parts = _phasetree.read_text(json.dumps({**alone, "tree": entry["tree"]}), path)
        made, prefix = Object(handle, _phases_of(_with_nodes(parts, list(parts["phases"])))), ""
    own = entry.get("phases", {})
    phases = [
        Phase(f"{name}.{p.name}", *_material_and_density(own[p.name])) if p.name in own
        else Phase(prefix + p.name, p.material, p.density)
        for p in made.phases[1:]
    ]  # fmt: skip
    return Object(made._handle, (vacuum, *phases))


def _fields_of_materials(value):
    """The JSON of all fields in textures and densities, which reading converts to handles."""
    if isinstance(value, dict):
        field = "of" if "ramp" in value else "density" if "density_depth" in value else None
        own = [value[field]] if field in value else []
        return own + [field for one in value.values() for field in _fields_of_materials(one)]
    return [field for one in value for field in _fields_of_materials(one)] if isinstance(value, list) else []


def _warn_of_what_stands_still(raw, path):
    shown = [raw.get(part) for part in ("tree", "shapes", "groups", "instances")]
    shown += [{**entry, "phases": None} for entry in raw.get("objects", ())]
    if _reference.moves([shown, _fields_of_materials(raw)]):
        warnings.warn(
            f"{path}: its trees or transforms change with time; they are read at time 0, and no longer move",
            stacklevel=3,
        )


def _load_objects(path):
    folder = os.path.dirname(os.path.abspath(path))
    maps, groups, listed = _phasetree.placed_in_file(path)
    text = _phasetree.with_files(_phasetree.text_of_file(path), path, lambda file: os.path.join(folder, file))
    raw = _phasetree.value_of(text)
    entries = [*raw["objects"]]
    if "tree" in raw:
        entries.insert(0, {"name": "tree", "tree": raw["tree"]})
    objects = {
        name: (_object_with_names(entry, raw, path), matrix[0]) for entry, (name, matrix) in zip(entries, maps)
    }
    groups = {name: [_placed.Instances(*one) for one in group] for name, group in groups.items()}
    instances = _placed.without_implicit_instances(objects, groups, [_placed.Instances(*one) for one in listed])
    return raw, {"objects": objects, "groups": groups, "instances": instances}


def load(path):
    """Reads a scene file. Raises SceneError with file, line and column. Comments and names of shapes are not kept.

    Objects taken from another scene file are read from there and become part of this scene. Trees and transforms are
    read at time 0, with a warning if they have keyframes ("keys"); everything else keeps its keyframes.
    """
    path = path_text(path)
    text = _phasetree.text_of_file(path)
    raw = _phasetree.value_of(text)
    if "objects" in raw:
        parts, shown = _load_objects(path)
        _warn_of_what_stands_still(raw, path)
        return _scene_of(parts, path, **shown)
    handle, parts = _phasetree.read_file(path)
    _warn_of_what_stands_still(raw, path)
    folder = os.path.dirname(os.path.abspath(path))
    absolute = _phasetree.with_files(text, path, lambda file: os.path.join(folder, file))
    if absolute != text:
        handle, parts = _phasetree.read_text(absolute, path)
    parts = _with_nodes(parts, list(parts.get("phases", ())))
    return _scene_of(parts, path, object=None if handle is None else Object(handle, _phases_of(parts)))


def _scene_of(parts, path, **shown):
    camera, render = parts.get("camera"), parts.get("render")
    return Scene(
        **shown,
        camera=None if camera is None else _parts.part_of("Cameras", camera),
        lights=[_parts.part_of("Lights", light) for light in parts.get("lights", ())],
        meshes=[_parts.part_of("Meshes", mesh) for mesh in parts.get("meshes", ())],
        background=parts.get("background"),
        image=None if render is None else _parts.part_of("Render settings", render),
        name=path,
        unit=parts.get("unit"),
        expect=parts.get("expect", ()),
    )
