"""Renders a scene in Blender's Cycles from the meshes that compare.py writes: run by Blender, not by hand.

    blender --background --factory-startup --python in_blender.py -- FOLDER WIDTH HEIGHT SAMPLES THREADS CPU SEED…

FOLDER holds scene.json, and interfaces.npz or drink.blend; a picture of each seed is written there, and times.json with the seconds of each,
scene and hierarchy ready: processor time if CPU is 1, wall-clock time if it is 0.
"""
import json
import math
import os
import sys
import time

import bpy
import numpy as np
from mathutils import Vector

# Normal reflectance of the metals of the scenes, as tracer/src/shading/metals.cpp has them.
METALS = {"brass": (0.887, 0.789, 0.434), "copper": (0.935, 0.624, 0.538)}


class Nodes:
    """The nodes of one material, made by calls that give their first output."""

    def __init__(self, tree):
        self.tree = tree
        tree.nodes.clear()

    def __call__(self, kind, output=0, operation=None, **inputs):
        node = self.tree.nodes.new("ShaderNode" + kind)
        if operation:
            node.operation = operation
        for name, value in inputs.items():
            socket = node.inputs[int(name[1:])] if name[0] == "_" else node.inputs[name.replace("_", " ")]
            if isinstance(value, bpy.types.NodeSocket):
                self.tree.links.new(value, socket)
            else:
                socket.default_value = value
        return node.outputs[output]

    def finish(self, kind, socket):
        node = self.tree.nodes.new(kind)
        self.tree.links.new(socket, node.inputs["Surface"])


def is_clear(material):
    return material is None or "clear" in material


def ior(material):
    return material["clear"].get("ior", 1.5) if material else 1.0


def absorption(material):
    """Per unit of length, for red, green and blue."""
    clear = (material or {}).get("clear", {})
    return [-math.log(c) / clear.get("color_distance", 1.0) for c in clear.get("color", (1, 1, 1))]


def transmitted(nodes, outer, inner):
    """The colour that is left of light along the ray that met the surface, in the medium which that ray is in."""
    length, back = nodes("LightPath", "Ray Length"), nodes("NewGeometry", "Backfacing")
    parts = []
    for of_outer, of_inner in zip(absorption(outer), absorption(inner) if is_clear(inner) else absorption(None)):
        coefficient = nodes("Math", operation="MULTIPLY_ADD", _0=back, _1=of_inner - of_outer, _2=of_outer)
        exponent = nodes("Math", operation="MULTIPLY", _0=nodes("Math", operation="MULTIPLY", _0=coefficient, _1=length), _1=-1.0)
        parts.append(nodes("Math", operation="EXPONENT", _0=exponent))
    return nodes("CombineRGB", R=parts[0], G=parts[1], B=parts[2])


def tinted(nodes, color, left):
    return nodes("VectorMath", operation="MULTIPLY", _0=color, _1=left)


def material_of(name, outer, inner):
    """The surface between the two, seen from both sides where the inner is clear."""
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    nodes = Nodes(made.node_tree)
    left = transmitted(nodes, outer, inner)
    if is_clear(inner):
        surface = nodes("BsdfGlass", Color=left, Roughness=0.0, IOR=ior(inner) / ior(outer))
    elif "diffuse" in inner:
        surface = nodes("BsdfDiffuse", Color=tinted(nodes, inner["diffuse"]["color"], left))
    elif "conductor" in inner:
        metal = inner["conductor"]
        surface = nodes("BsdfGlossy", Color=tinted(nodes, METALS[metal["metal"]], left), Roughness=math.sqrt(metal.get("roughness", 0.0)))
    else:  # A coat above a diffuse base: Fresnel's reflectance chooses between them.
        coated = inner["coated"]
        index = coated.get("ior", 1.5) / ior(outer)
        coat = nodes("BsdfGlossy", Color=left, Roughness=math.sqrt(coated.get("roughness", 0.0)))
        base = nodes("BsdfDiffuse", Color=tinted(nodes, coated["color"], left))
        surface = nodes("MixShader", Fac=nodes("Fresnel", IOR=index), _1=base, _2=coat)
    nodes.finish("ShaderNodeOutputMaterial", surface)
    return made


def add_mesh(name, vertices, faces, material, smooth=True):
    """Faces (M, corners) all have as many corners."""
    count, corners = faces.shape
    mesh = bpy.data.meshes.new(name)
    mesh.vertices.add(len(vertices))
    mesh.vertices.foreach_set("co", np.ascontiguousarray(vertices, dtype=np.float32).ravel())
    mesh.loops.add(count * corners)
    mesh.loops.foreach_set("vertex_index", np.ascontiguousarray(faces, dtype=np.int32).ravel())
    mesh.polygons.add(count)
    mesh.polygons.foreach_set("loop_start", np.arange(0, count * corners, corners, dtype=np.int32))
    mesh.polygons.foreach_set("loop_total", np.full(count, corners, dtype=np.int32))
    mesh.polygons.foreach_set("use_smooth", np.full(count, smooth))
    mesh.update(calc_edges=True)
    mesh.materials.append(material)
    bpy.context.collection.objects.link(bpy.data.objects.new(name, mesh))


def add_ground(name, mesh):
    """A floor, or a backdrop of 64 steps that curves up, as tracer/src/scene/floor_and_backdrop.cpp makes them."""
    (kind, p), = mesh.items()
    z = p.get("height", 0.0)
    if kind == "floor":
        half = 0.5 * p.get("size", 100.0)
        profile, half_width = [(-half, z), (half, z)], half
    else:
        radius, distance, half_width = p.get("radius", 3.0), p.get("distance", 6.0), 0.5 * p.get("width", 40.0)
        turn = [0.5 * math.pi * i / 64 for i in range(65)]
        profile = [(-p.get("front", 20.0), z)]
        profile += [(distance - radius + radius * math.sin(a), z + radius - radius * math.cos(a)) for a in turn]
        profile.append((distance, z + radius + p.get("wall", 20.0)))
    vertices = [(x, y, h) for y, h in profile for x in (-half_width, half_width)]
    quads = [(2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2) for i in range(len(profile) - 1)]
    add_mesh(name, np.array(vertices), np.array(quads), material_of(name, None, p["material"]), kind != "floor")


def turned_to(thing, position, target):
    thing.location = position
    thing.rotation_euler = (Vector(target) - Vector(position)).to_track_quat("-Z", "Y").to_euler()


def add_light(light):
    (kind, p), = light.items()
    if kind == "rectangle":
        lamp = bpy.data.lights.new(kind, "AREA")
        lamp.shape, lamp.size, lamp.size_y = "RECTANGLE", p["width"], p["height"]
        lamp.color = [c * p.get("intensity", 1.0) for c in p.get("radiance", (1, 1, 1))]
        lamp.energy = math.pi * p["width"] * p["height"]  # in watts: π A L
        placed = bpy.data.objects.new(kind, lamp)
        turned_to(placed, p["centre"], p["target"])
        placed.visible_camera = p.get("visible_to_camera", True)
        lamp.cycles.use_multiple_importance_sampling = True
        bpy.context.collection.objects.link(placed)
    elif kind == "gradient":
        height = 1024
        sine = np.sin(np.pi * ((np.arange(height) + 0.5) / height - 0.5))
        t = np.minimum(np.abs(sine) / p.get("softness", 1.0), 1)
        t = (t * t * (3 - 2 * t))[:, None]
        end = np.where(sine[:, None] > 0, np.array(p["zenith"]), np.array(p["ground"]))
        rows = p.get("intensity", 1.0) * ((1 - t) * np.array(p["horizon"]) + t * end)
        pixels = np.ones((height, 2, 4), dtype=np.float32)
        pixels[:, :, :3] = rows[:, None]
        image = bpy.data.images.new("sky", 2, height, float_buffer=True)
        image.colorspace_settings.name = "Linear"
        image.pixels.foreach_set(pixels.ravel())
        image.pack()
        world = bpy.context.scene.world
        world.use_nodes = True
        nodes = Nodes(world.node_tree)
        sky = world.node_tree.nodes.new("ShaderNodeTexEnvironment")
        sky.image = image
        nodes.finish("ShaderNodeOutputWorld", nodes("Background", Color=sky.outputs[0]))
        world.cycles.sampling_method = "MANUAL"
        world.cycles.sample_map_resolution = 1024
    else:
        sys.exit(f"a light of the kind {kind} is not known here")


def add_camera(p):
    lens = bpy.data.cameras.new("camera")
    placed = bpy.data.objects.new("camera", lens)
    turned_to(placed, p["position"], p["look_at"])
    lens.sensor_fit, lens.angle = "VERTICAL", math.radians(p.get("fov", 40.0))
    if p.get("lens_radius"):
        lens.dof.use_dof = True
        lens.dof.aperture_fstop = 0.001 * lens.lens / (2 * p["lens_radius"])
        forward = (Vector(p["look_at"]) - Vector(p["position"])).normalized()
        focus = p.get("focus_distance")
        lens.dof.focus_distance = focus or (Vector(p["focus_at"]) - Vector(p["position"])).dot(forward)
    bpy.context.collection.objects.link(placed)
    bpy.context.scene.camera = placed


def settings(scene, width, height, samples, threads):
    """A path tracer without any of the biases that Cycles has by default."""
    scene.render.engine = "CYCLES"
    scene.render.use_persistent_data = True  # the second picture does not build the hierarchy again
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = width, height, 100
    scene.render.threads_mode, scene.render.threads = "FIXED", threads
    scene.render.film_transparent = False
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = samples
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.blur_glossy = cycles.light_sampling_threshold = 0.0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = 64
    cycles.transparent_max_bounces = 64
    cycles.use_auto_tile = False
    cycles.pixel_filter_type = "BOX"


def add_interfaces(folder, phases):
    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    meshes = np.load(os.path.join(folder, "interfaces.npz"))
    for pair in sorted({name.split("/")[0] for name in meshes.files}):
        outer, inner = (phases.get(name) for name in pair.split("|"))
        vertices, triangles = meshes[f"{pair}/vertices"], meshes[f"{pair}/triangles"]
        if not is_clear(outer):
            if not is_clear(inner):
                continue  # No light comes there.
            outer, inner, triangles = inner, outer, triangles[:, ::-1]
        add_mesh(pair, vertices, triangles, material_of(pair, outer, inner))


def main():
    folder, *numbers = sys.argv[sys.argv.index("--") + 1:]
    width, height, samples, threads, is_processor_time, *seeds = (int(n) for n in numbers)
    clock = time.process_time if is_processor_time else time.monotonic
    with open(os.path.join(folder, "scene.json"), encoding="utf-8") as file:
        description = json.load(file)
    drink = os.path.join(folder, "drink.blend")
    if os.path.exists(drink):
        bpy.ops.wm.open_mainfile(filepath=drink)  # drink.py has made its meshes and materials
    else:
        add_interfaces(folder, description["phases"])
    for number, mesh in enumerate(description.get("meshes", [])):
        if "gltf" not in mesh:
            add_ground(f"ground {number}", mesh)
    for light in description["lights"]:
        add_light(light)
    add_camera(description["camera"])

    scene = bpy.context.scene
    settings(scene, width, height, samples, threads)
    seconds = []
    for turn, seed in enumerate([seeds[0], *seeds]):
        scene.cycles.seed = seed
        scene.cycles.samples = samples if turn else 1  # The first picture is for the hierarchy and the caches.
        scene.render.filepath = os.path.join(folder, f"cycles.{seed}.exr")
        start = clock()
        bpy.ops.render.render(write_still=True)
        seconds.append(clock() - start)
    with open(os.path.join(folder, "times.json"), "w", encoding="utf-8") as file:
        json.dump(seconds[1:], file)


main()
