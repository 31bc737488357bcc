"""A Blender scene as a scene file of phasetree."""

import hashlib
import json
import os
from dataclasses import dataclass

import bpy
import numpy as np

from .. import command as commands
from ..notes import TranslationError
from ..passes import planes_of
from . import camera, lights, materials, meshes, motion, shapes, trees, world
from .glb import Glb
from .material_names import MaterialNames
from .placing import Placing, group_paths
from .scene_objects import SceneObjects


@dataclass
class Translation:
    """A scene whose objects are in a glTF file, and whose other parts are below. It no longer needs Blender."""

    path: str  # of the scene file that will be written
    glb: str  # path of the glTF file
    parts: dict  # of the scene file: camera, lights, background
    settings: dict  # "render" of the scene file
    media: dict  # material: what the scene file says of the phase, and glTF cannot
    has_meshes: bool  # whether the glTF file has anything
    groups: list  # clear objects that are imported by themselves
    closes_gaps: bool
    meanings: dict  # name of a material or phase: names of the object and of the material in Blender
    digest: str  # equal digests: equal scenes


@dataclass
class Written:
    document: dict  # what is in the scene file
    report: str  # the order of the phases, overlaps and gaps, as `phasetree import` prints them
    meanings: dict  # that of the translation


def size_of(render):
    """The size of the picture in pixels."""
    share = render.resolution_percentage / 100
    return max(1, int(render.resolution_x * share)), max(1, int(render.resolution_y * share))


def region_of(render):
    """The pixels (x0, y0, x1, y1) to render, counted from the top left, without x1 and y1."""
    width, height = size_of(render)
    if not render.use_border:
        return 0, 0, width, height
    x0, x1 = (round(width * x) for x in (render.border_min_x, render.border_max_x))
    y0, y1 = (round(height * (1 - y)) for y in (render.border_max_y, render.border_min_y))
    return x0, y0, max(x1, x0 + 1), max(y1, y0 + 1)


def write_scene(depsgraph, path, command, notes, active_camera=None, cancelled=lambda: False, set_time=None, evaluated=None):
    """Writes a scene file and, into its folder, the files that it names. Adds to the notes. Raises TranslationError.

    `set_time(frame, subframe)` moves the scene in time, for motion blur; then `evaluated()` is its dependency graph, by
    default the given one.
    """
    scene, (width, height) = depsgraph.scene, size_of(depsgraph.scene.render)

    def camera_at(evaluated, notes):
        return camera.camera_of(active_camera or scene.camera, evaluated, width, height, notes)

    moved = motion.sampled(scene, evaluated or (lambda: depsgraph), set_time, camera_at) if set_time else motion.Motion()
    depsgraph = evaluated() if evaluated else depsgraph
    seen = camera_at(depsgraph, notes)
    translation = translate(depsgraph, path, command, notes, moved)
    translation.parts["camera"] = moved.camera(seen, notes)
    return complete(translation, command, notes, cancelled)


def translate(depsgraph, path, command, notes, moved=None):
    """Writes the objects to glTF files, and trees to scene files. Returns the scene without a camera."""
    scene, folder, glb, moved = depsgraph.scene, os.path.dirname(path), Glb(), moved or motion.Motion()
    millimetres = round(1000 * scene.unit_settings.scale_length, 4)
    names = MaterialNames(depsgraph.view_layer.use_pass_cryptomatte_object)
    writer = meshes.MeshWriter(glb, millimetres, notes, names)
    objects = SceneObjects(folder, os.path.splitext(os.path.basename(path))[0], moved.times)
    planted, placing = trees.TreeWriter(objects, command, notes, names), Placing(writer, objects, millimetres, notes, names)
    lamps = write_objects(depsgraph, placing, planted, moved, notes)
    placing.write()
    if writer.is_empty and not objects:
        raise TranslationError("the scene has nothing to render: no visible object has faces")
    parts = {"lights": [world.world_light(depsgraph.scene_eval.world, folder, notes), *lamps]}
    if scene.render.film_transparent:
        parts["background"] = [0, 0, 0]
    note_render_settings(scene, notes)
    stem = os.path.splitext(path)[0]
    file, content, settings = stem + ".glb", glb.content(), render_settings(scene)
    write_bytes(file, content)
    for group in placing.groups:
        write_bytes(group_paths(folder, group)[0], group.glb.content())
    parts["added"], parts["mixed"] = objects.parts(), []
    for number, (name, mixed, material) in enumerate(writer.mixed_meshes(objects.materials), 1):
        file_of_mix = f"{stem}.mix{number}.glb"
        write_bytes(file_of_mix, mixed)
        content += mixed
        parts["mixed"].append((name, {"gltf": {"file": os.path.basename(file_of_mix), "material": material}}))
    rest = json.dumps([parts, settings, writer.media, scene.phasetree.closes_gaps, planted.digests])
    digest = hashlib.sha256(content + rest.encode()).hexdigest()
    closes_gaps, has_meshes = scene.phasetree.closes_gaps, glb.has_nodes
    if moved.times:
        settings["shutter"] = moved.shutter()
    return Translation(path, file, parts, settings, writer.media, has_meshes, placing.groups, closes_gaps, names.meanings, digest)


def complete(translation, command, notes, cancelled=lambda: False):
    """Makes phases of clear objects by `phasetree import`, and writes the scene file. May run in any thread."""
    document, report = {"version": 1, "render": {}}, ""
    if translation.has_meshes:
        document, report = imported(translation.glb, translation.path, translation, translation.media, command, notes, cancelled)
    media = dict(translation.media)
    for group in translation.groups:
        glb, path = group_paths(os.path.dirname(translation.path), group)
        own, of_group = imported(glb, path, translation, group.writer.media, command, notes, cancelled)
        report += f"\n{group.name}, by itself:\n{of_group}"
        write_document(own, path)
        media.update({f"{group.name}.{name}": medium for name, medium in group.writer.media.items()})
    # For the dispersion of a phase.
    is_spectral = document["render"].get("spectral", False) or any("glass" in m for m in media.values())
    document.pop("camera", None)
    document.update(translation.parts)
    mixed, added = document.pop("mixed"), document.pop("added")
    if mixed:
        for number, (name, mesh) in enumerate(mixed, len(document.get("meshes", ())) + 1):
            # The command names a mesh with a material of the scene file by its place in the list.
            translation.meanings["gltf all" if number == 1 else f"gltf {number} all"] = translation.meanings[name]
            document.setdefault("meshes", []).append(mesh)
    for key, value in added.items():
        document[key] = {**document.get(key, {}), **value} if key == "phases" else value
    document["render"] = {**translation.settings, **({"spectral": True} if is_spectral else {})}
    write_document(document, translation.path)
    return Written(document, report, translation.meanings)


def imported(glb, path, translation, media, command, notes, cancelled):
    """The scene file of the meshes in a glTF file, and the report on its phases."""
    done = commands.import_glb(command, glb, path, translation.closes_gaps, cancelled)
    for warning in done.warnings:
        notes.approximate(warning)
    with open(path, encoding="utf-8") as file:
        document = json.load(file)
    for mesh in document.get("meshes", ()):
        mesh["gltf"]["imported"] = True  # the lights are in the scene file
    for name, medium in media.items():
        if name in document.get("phases", ()):  # only closed objects became phases; open surfaces did not
            materials.complete_phase(document["phases"][name]["clear"], medium)
    return document, done.report


def write_bytes(path, content):
    with open(path, "wb") as file:
        file.write(content)


def write_document(document, path):
    with open(path, "w", encoding="utf-8") as file:
        json.dump(document, file, indent=1, ensure_ascii=False)


def write_objects(depsgraph, placing, planted, moved, notes):
    """Adds all visible objects; returns the lights."""
    found, known = [], {}
    for instance in depsgraph.object_instances:
        item = instance.object
        about = notes.about(f'object "{item.name}"')
        if not instance.show_self:
            continue
        if trees.is_tree(item):
            note_object(item, about)
            planted.add(item, instance.matrix_world.copy(), moved.of(instance))
        elif item.type == "LIGHT":
            light = lights.light_of(item, instance.matrix_world, notes)
            found += [light] if light else []
            if light and moved.of(instance) is not None:
                notes.about(f'light "{item.name}"').unsupported("its motion is not blurred")
        elif item.type in shapes.UNSUPPORTED:
            about.unsupported(f"{shapes.UNSUPPORTED[item.type]} are left out")
        elif isinstance(item.data, bpy.types.Mesh):  # curves and the like also come as objects with meshes
            key = (item.original.as_pointer(), item.data.as_pointer())
            if key not in known:
                note_object(item, about)
                known[key] = shapes.shape_of(item, about)
            if known[key] is not None:
                if moved.deforms(instance):
                    about.unsupported("its deformation is not blurred, only its motion as a whole")
                placing.add(known[key], np.array(instance.matrix_world, dtype=float), moved.of(instance))
    return found


def note_object(item, notes):
    if any(system.settings.type == "HAIR" and system.settings.render_type == "PATH" for system in item.particle_systems):
        notes.unsupported("hair is left out")
    rays = ("camera", "diffuse", "glossy", "transmission", "shadow")
    if item.lightgroup:
        notes.unsupported("its light group is ignored: the light of glowing surfaces is in none of the groups' passes")
    hidden = [name for name in rays if not getattr(item, f"visible_{name}", True)]
    if hidden:
        notes.unsupported(f"it is visible to all rays, although ray visibility excludes {', '.join(hidden)}")
    if getattr(item, "is_holdout", False) or getattr(item, "is_shadow_catcher", False):
        notes.unsupported("holdouts and shadow catchers are rendered as ordinary objects")


def note_render_settings(scene, notes):
    render = scene.render
    if render.pixel_aspect_x != render.pixel_aspect_y:
        notes.unsupported("pixels are square, whatever the aspect ratio")
    if render.use_multiview:
        notes.unsupported("stereoscopy is ignored")
    if render.use_freestyle:
        notes.unsupported("Freestyle is ignored")


def render_settings(scene):
    own, (width, height) = scene.phasetree, size_of(scene.render)
    settings = {"width": width, "height": height, "samples": own.samples, "caustics": own.caustics, "guiding": own.guiding,
                "seed": own.seed}  # fmt: skip
    if own.max_depth:
        settings["max_depth"] = own.max_depth
    if own.spectral:
        settings["spectral"] = True
    return settings


def options_of(scene, view_layer):
    """Options for `phasetree render` that are not in the scene file."""
    planes = ["alpha"] if scene.render.film_transparent else []
    planes += planes_of(view_layer)
    options = ["--planes", ",".join(planes)] if planes else []
    region, (width, height) = region_of(scene.render), size_of(scene.render)
    if region != (0, 0, width, height):
        options += ["--crop", ",".join(map(str, region))]
    if scene.render.threads_mode == "FIXED":
        options += ["--threads", str(scene.render.threads)]
    if scene.phasetree.denoise:
        options.append("--denoise")
    return options
