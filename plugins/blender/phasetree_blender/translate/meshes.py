"""Shapes as meshes of a glTF file."""

import numpy as np

from . import materials, scene_materials
from .glb import Glb
from .shapes import greatest_facet_angle, tangents_around
from .texture_files import TextureFiles


class MeshWriter:
    """Adds shapes to a glTF file. Instances of one shape share a mesh."""

    def __init__(self, glb, millimetres, notes, names):
        """`millimetres`: the length of Blender's unit. `names`: of the materials that are written."""
        self._names = names
        self._glb, self._millimetres, self._notes = glb, millimetres, notes
        self._meshes, self._materials, self._surfaces, self._files = {}, {}, {}, TextureFiles(glb)
        self.has_clear, self.is_empty = False, True
        self.mixed = {}  # material: a glTF file of the surfaces that are a mix, and the mix
        self.media = {}  # material: parameters of the scene file's clear material that glTF lacks

    def add(self, shape, matrix):
        """Adds a shape at a place, a 4×4 matrix."""
        key = id(shape)
        if key not in self._meshes:
            self._meshes[key] = self._meshes_of(shape)
        extras = {"phasetree_matter": shape.role.lower()} if shape.role in ("SOLID", "LIQUID", "GAS") else {}
        if shape.priority:
            extras["phasetree_priority"] = shape.priority
        for glb, mesh in self._meshes[key]:
            glb.node(shape.name, mesh, np.array(matrix, dtype=float), extras)
            self.is_empty = False

    def is_clear(self, shape):
        """Whether a shape is clear: True or False, or None if only some of its surfaces are."""
        clear = {not shape.is_opaque and self.surface_of(shape.slots[slot]).is_clear for slot in shape.used_slots()}
        return clear.pop() if len(clear) == 1 else None

    def _meshes_of(self, shape):
        """The shape's meshes, each with the glTF file that has it."""
        notes = self._notes.about(f'object "{shape.name}"')
        triangles, numbers, primitives = shape.triangles, shape.slot_numbers(), {}  # by the glTF file
        for slot in shape.used_slots():
            material = shape.slots[slot]
            surface = self.surface_of(material)
            glb = self._mixed_glb(material, surface, shape) if surface.mixture else self._glb
            made = self._primitive(glb, triangles, triangles.corners[numbers == slot], material, shape, notes)
            primitives.setdefault(glb, []).append(made)
        return [(glb, glb.mesh(shape.name, parts)) for glb, parts in primitives.items()]

    def _mixed_glb(self, material, surface, shape):
        name = self._names.of(shape.name, material)
        if name not in self.mixed:
            glb = Glb()
            glb.material({"name": name})
            self.mixed[name] = (glb, surface)
        return self.mixed[name][0]

    def mixed_meshes(self, files):
        """[(name, content of a glTF file, material of the scene file)] of the surfaces that are a mix."""
        return [
            (name, glb.content(), scene_materials.material_of(surface, files, self._about_name(name)))
            for name, (glb, surface) in self.mixed.items()
        ]

    def _primitive(self, glb, triangles, corners, material, shape, notes):
        surface = self.surface_of(material)
        number = 0 if surface.mixture else self._material_of(material, surface, shape)
        if surface.is_clear and not shape.is_opaque:
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
        if coordinates is not None:
            coordinates = coordinates[used]
        elif surface.mixture and surface.uv_maps:  # the scene file's images need some
            coordinates = np.zeros((len(used), 2))
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

    def _about_name(self, name):
        return self._notes.about(f'material "{self._names.meanings[name][1]}"')

    def _about(self, material):
        return self._notes.about(f'material "{material.name}"' if material else "")

    def surface_of(self, material):
        key = material.original.as_pointer() if material else None
        if key not in self._surfaces:
            self._surfaces[key] = materials.surface_of(material, self._about(material))
        return self._surfaces[key]

    def _material_of(self, material, surface, shape):
        is_opaque, name = shape.is_opaque, self._names.of(shape.name, material)
        key = (name, material.original.as_pointer() if material else None, is_opaque and surface.is_clear)
        if key not in self._materials:
            notes = self._about(material)
            if key[-1]:
                notes.information("is clear, but opaque on objects whose role is Opaque")
            made = materials.gltf_of(surface, name, self._files, notes, is_opaque)
            if surface.is_clear and not is_opaque:
                medium = materials.medium_of(surface, material, self._millimetres, notes)
                if medium:
                    self.media[name] = medium
            self._materials[key] = self._glb.material(made)
        return self._materials[key]
