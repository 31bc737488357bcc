"""Evaluated objects as arrays of triangles."""

from dataclasses import dataclass

import numpy as np

# Objects that Blender can convert to meshes.
WITH_MESHES = ("MESH", "CURVE", "SURFACE", "FONT", "META")
# Types of visible objects that are not supported.
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


@dataclass
class Shape:
    """What of an evaluated object is needed when Blender no longer has it."""

    name: str
    triangles: Triangles
    slots: list  # a material or None for each number of a material
    role: str
    priority: float

    @property
    def is_opaque(self):
        return self.role == "OPAQUE"

    def used_slots(self):
        """Numbers of the slots that triangles have."""
        return np.unique(self.slot_numbers())

    def slot_numbers(self):
        return np.minimum(self.triangles.materials, len(self.slots) - 1)

    def is_closed(self):
        """Whether each edge joins two triangles that run along it in opposite directions."""
        corners = self.triangles.of_corners[self.triangles.corners].astype(np.int64)
        a, b = corners.reshape(-1), np.roll(corners, -1, axis=1).reshape(-1)
        count = len(self.triangles.positions)
        return np.array_equal(np.sort(a * count + b), np.sort(b * count + a)) and len(np.unique(a * count + b)) == len(a)


def shape_of(item, notes):
    """The shape of an evaluated object, or None if it has no faces."""
    mesh = item.to_mesh()
    if mesh is None:
        return None
    try:
        if len(mesh.polygons) == 0:
            return None
        triangles = triangles_of(mesh)
    finally:
        item.to_mesh_clear()
    if not np.isfinite(triangles.positions).all():
        notes.error("has vertices whose coordinates are not finite; it is left out")
        return None
    settings = item.original.phasetree
    slots = [slot.material for slot in item.material_slots] or [None]
    return Shape(item.name, triangles, slots, settings.role, settings.priority)
