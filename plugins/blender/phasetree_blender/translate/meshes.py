"""Evaluated objects as arrays of triangles, and as meshes of a glTF file."""

from dataclasses import dataclass

import numpy as np

from . import materials, scene_materials
from .glb import Glb
from .texture_files import TextureFiles

# Objects that Blender can convert to meshes.
WITH_MESHES = ("MESH", "CURVE", "SURFACE", "FONT", "META")
# Objects with something to see that is lost.
UNSUPPORTED = {
    "VOLUME": "volumes", "POINTCLOUD": "point clouds", "CURVES": "hair curves", "GPENCIL": "grease pencil strokes",
    "GREASEPENCIL": "grease pencil strokes",
}  # fmt: skip


@dataclass
class Triangles:
    positions: np.ndarray  # of vertices
    of_corners: np.ndarray  # the vertex of each corner of a face
    normals: np.ndarray  # of corners
    corners: np.ndarray  # (n, 3): those of each triangle
    materials: np.ndarray  # the material slot of each triangle
    coordinates: dict  # name: of corners; "" is the active UV map
    generated: np.ndarray  # of vertices: places in the mesh's texture space, whose centre is 0


def read(collection, attribute, columns, dtype):
    values = np.empty(len(collection) * columns, dtype=dtype)
    collection.foreach_get(attribute, values)
    return values.reshape(-1, columns) if columns > 1 else values


def triangles_of(mesh):
    mesh.calc_loop_triangles()
    if hasattr(mesh, "corner_normals"):  # from Blender 4.1
        normals = read(mesh.corner_normals, "vector", 3, np.float32)
    else:
        mesh.calc_normals_split()
        normals = read(mesh.loops, "normal", 3, np.float32)
    coordinates = {}
    for layer in mesh.uv_layers:
        coordinates[layer.name] = read(layer.data, "uv", 2, np.float32)
        if layer.active_render:
            coordinates[""] = coordinates[layer.name]
    return Triangles(
        read(mesh.vertices, "co", 3, np.float32), read(mesh.loops, "vertex_index", 1, np.int32), normals,
        read(mesh.loop_triangles, "loops", 3, np.int32), read(mesh.loop_triangles, "material_index", 1, np.int32), coordinates,
        generated_of(mesh),
    )  # fmt: skip


def generated_of(mesh):
    size = np.array(mesh.texspace_size)
    return (read(mesh.vertices, "co", 3, np.float32) - np.array(mesh.texspace_location)) / np.where(size > 0, size, 1)


def tangents_around(axis, places, normals):
    """Tangents of glTF that turn around an axis of the texture space, as anisotropy does without a UV map."""
    x, y, z = places.T
    zero = np.zeros_like(x)
    around = np.column_stack({"X": (zero, -z, y), "Y": (-z, zero, x), "Z": (-y, x, zero)}[axis])
    around = around - normals * np.sum(normals * around, axis=1, keepdims=True)
    length = np.linalg.norm(around, axis=1, keepdims=True)
    return np.column_stack([around / np.where(length > 0, length, 1), np.ones_like(x)])


def greatest_facet_angle(triangles, corners):
    """The largest angle in degrees between a triangle and the normal that smooth shading gives one of its corners."""
    p = triangles.positions[triangles.of_corners[corners]].astype(float)
    flat = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    length = np.linalg.norm(flat, axis=1)
    flat, smooth = flat[length > 0] / length[length > 0, None], triangles.normals[corners][length > 0]
    cosines = np.einsum("ij,ikj->ik", flat, smooth)
    return float(np.degrees(np.arccos(np.clip(cosines, -1, 1).min()))) if cosines.size else 0.0


class MeshWriter:
    """Adds objects to a glTF file. Instances of one object share a mesh."""

    def __init__(self, glb, millimetres, notes):
        """`millimetres`: the length of Blender's unit."""
        self._glb, self._millimetres, self._notes = glb, millimetres, notes
        self._meshes, self._materials, self._surfaces, self._files = {}, {}, {}, TextureFiles(glb)
        self.has_clear, self.is_empty = False, True
        self.mixed = {}  # material: a glTF file of the surfaces that are a mix, and the mix
        self.media = {}  # material: parameters of the scene file's clear material that glTF lacks

    def add(self, instance_object, matrix):
        """Adds an evaluated object at a place, a 4×4 matrix."""
        settings = instance_object.original.phasetree
        key = (instance_object.original.as_pointer(), instance_object.data.as_pointer() if instance_object.data else 0)
        if key not in self._meshes:
            self._meshes[key] = self._mesh_of(instance_object, settings.role == "OPAQUE")
        made = self._meshes[key]
        extras = {"phasetree_matter": settings.role.lower()} if settings.role in ("SOLID", "LIQUID", "GAS") else {}
        if settings.priority:
            extras["phasetree_priority"] = settings.priority
        for glb, mesh in made:
            glb.node(instance_object.name, mesh, np.array(matrix, dtype=float), extras)
            self.is_empty = False

    def _mesh_of(self, item, is_opaque):
        """The object's meshes, each with the glTF file that has it."""
        notes = self._notes.about(f'object "{item.name}"')
        mesh = item.to_mesh()
        if mesh is None:
            return []
        try:
            if len(mesh.polygons) == 0:
                return []
            triangles = triangles_of(mesh)
        finally:
            item.to_mesh_clear()
        if not np.isfinite(triangles.positions).all():
            notes.error("has vertices whose coordinates are not finite; it is left out")
            return []
        slots = [slot.material for slot in item.material_slots] or [None]
        numbers = np.minimum(triangles.materials, len(slots) - 1)
        primitives = {}  # by the glTF file
        for slot in np.unique(numbers):
            surface = self._surface_of(slots[slot])
            glb = self._mixed_glb(slots[slot], surface) if surface.mixture else self._glb
            made = self._primitive(glb, triangles, triangles.corners[numbers == slot], slots[slot], is_opaque, notes)
            primitives.setdefault(glb, []).append(made)
        return [(glb, glb.mesh(item.name, parts)) for glb, parts in primitives.items()]

    def _mixed_glb(self, material, surface):
        if material.name not in self.mixed:
            glb = Glb()
            glb.material({"name": material.name})
            self.mixed[material.name] = (glb, surface)
        return self.mixed[material.name][0]

    def mixed_meshes(self, files):
        """[(content of a glTF file, material of the scene file)] of the surfaces that are a mix."""
        return [
            (glb.content(), scene_materials.material_of(surface, files, self._notes.about(f'material "{name}"')))
            for name, (glb, surface) in self.mixed.items()
        ]

    def _primitive(self, glb, triangles, corners, material, is_opaque, notes):
        surface = self._surface_of(material)
        number = 0 if surface.mixture else self._material_of(material, surface, is_opaque)
        if surface.is_clear and not is_opaque:
            self.has_clear = True
            angle = greatest_facet_angle(triangles, corners)
            if angle > 3:
                notes.approximate(
                    f"clear objects are shaded flat, so facets of up to {angle:.0f}° are visible; add a Subdivision Surface "
                    "modifier"
                )
            vertices, indices = np.unique(triangles.of_corners[corners], return_inverse=True)
            return glb.primitive(triangles.positions[vertices], None, indices.reshape(-1, 3), None, number)
        used, indices = np.unique(corners, return_inverse=True)
        coordinates = self._coordinates(triangles, surface, notes)
        coordinates = None if coordinates is None else coordinates[used]
        positions = triangles.positions[triangles.of_corners[used]]
        normals, tangents = triangles.normals[used], None
        if surface.grain_axis:
            tangents = tangents_around(surface.grain_axis, triangles.generated[triangles.of_corners[used]], normals)
            if coordinates is None:  # the reader drops tangents of meshes without coordinates
                coordinates = np.zeros((len(used), 2))
        return glb.primitive(positions, normals, indices.reshape(-1, 3), coordinates, number, tangents)

    def _coordinates(self, triangles, surface, notes):
        """The texture coordinates of corners as in glTF, where v points down; None without images."""
        if not surface.uv_maps:
            return None
        name = sorted(surface.uv_maps)[0]
        if len(surface.uv_maps) > 1:
            notes.unsupported("has a material with several UV maps; one is used")
        if name not in triangles.coordinates:
            if name or not triangles.coordinates:
                notes.unsupported(f'has no UV map{f" {name!r}" if name else ""} for its images')
            name = ""
        found = triangles.coordinates.get(name)
        return None if found is None else np.column_stack([found[:, 0], 1 - found[:, 1]])

    def _about(self, material):
        return self._notes.about(f'material "{material.name}"' if material else "")

    def _surface_of(self, material):
        key = material.original.as_pointer() if material else None
        if key not in self._surfaces:
            self._surfaces[key] = materials.surface_of(material, self._about(material))
        return self._surfaces[key]

    def _material_of(self, material, surface, is_opaque):
        key = (material.original.as_pointer() if material else None, is_opaque and surface.is_clear)
        if key not in self._materials:
            notes = self._about(material)
            if key[1]:
                notes.information("is clear, but opaque on objects whose role is Opaque")
            name = material.name if material else "Default"
            made = materials.gltf_of(surface, name, self._files, notes, is_opaque)
            if surface.is_clear and not is_opaque:
                medium = materials.medium_of(surface, material, self._millimetres, notes)
                if medium:
                    self.media[name] = medium
            self._materials[key] = self._glb.material(made)
        return self._materials[key]
