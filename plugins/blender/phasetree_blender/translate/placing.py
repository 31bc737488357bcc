"""Decides for each shape whether it is part of the main glTF file, a group that moves, or an object with instances."""

import os
from dataclasses import dataclass

import numpy as np

from .glb import Glb
from .meshes import MeshWriter
from .scene_objects import is_flat
from .shapes import greatest_facet_angle

MANY_COPIES = 64  # more copies of a clear shape are instances of one object
MANY_TRIANGLES = 15_000_000  # of opaque meshes, copies counted; the reader of glTF files accepts 20 million


@dataclass
class Group:
    """Clear shapes that are imported by themselves, as an object of the scene."""

    writer: MeshWriter
    glb: Glb
    name: str
    file: str  # of the scene, without its folder


class Placing:
    """Collects shapes and their places, and then writes them."""

    def __init__(self, writer, objects, millimetres, notes, names):
        self._writer, self._objects, self._millimetres, self._notes, self._names = writer, objects, millimetres, notes, names
        self._places = []  # (shape, matrix, matrices)
        self.groups = []

    def add(self, shape, matrix, matrices):
        self._places.append((shape, matrix, matrices))

    def write(self):
        apart = self._apart()
        moving = {}
        for shape, matrix, matrices in self._places:
            kind = apart.get(id(shape))
            if kind is not None and not is_flat(matrix):
                self._objects.place(kind, matrix, matrices)
            elif matrices is None or not self._write_moving(shape, matrix, matrices, moving):
                self._writer.add(shape, matrix)
        for group in self.groups:
            self._names.add_group(group.name)

    def _apart(self):
        """{id of a shape: name of its object} of those with too many copies."""
        copies, shapes = {}, {}
        for shape, _, _ in self._places:
            copies[id(shape)] = copies.get(id(shape), 0) + 1
            shapes[id(shape)] = shape
        total = sum(len(shapes[key].triangles.corners) * count for key, count in copies.items())
        apart = {}
        for key, count in sorted(copies.items(), key=lambda entry: -entry[1] * len(shapes[entry[0]].triangles.corners)):
            shape = shapes[key]
            notes = self._notes.about(f'object "{shape.name}"')
            if self._writer.is_clear(shape) and count > MANY_COPIES:
                notes.information(f"its {count} copies are instances of one object, which may not overlap other clear objects")
                group = self._new_group(shape.name)
                group.writer.add(shape, np.identity(4))
                apart[key] = group.name
            elif self._writer.is_clear(shape) is False and count > MANY_COPIES and total > MANY_TRIANGLES:
                if self._note_solid(shape, f"has {count} copies, but", notes):
                    total -= count * len(shape.triangles.corners)
                    apart[key] = self._add_solid(shape, notes)
        return apart

    def _surface(self, shape):
        return self._writer.surface_of(shape.slots[shape.used_slots()[0]])

    def _add_solid(self, shape, notes):
        name = self._objects.add_solid(shape, self._surface(shape), notes)
        material = shape.slots[shape.used_slots()[0]]
        self._names.add(name, shape.name, material.name if material else "Default")
        return name

    def _new_group(self, wanted):
        number = len(self.groups) + 1
        glb, file = Glb(), f"{self._objects.stem}.group{number}.json"
        name = self._objects.add(wanted, {"file": file})
        self.groups.append(Group(MeshWriter(glb, self._millimetres, self._notes, self._names), glb, name, file))
        return self.groups[-1]

    def _write_moving(self, shape, matrix, matrices, moving):
        """Adds a moving shape to the objects of the scene. Returns whether that is possible."""
        notes = self._notes.about(f'object "{shape.name}"')
        if is_flat(matrix) or any(is_flat(place) for place in matrices):
            return False
        is_clear = self._writer.is_clear(shape)
        if is_clear is None:
            notes.unsupported("its motion is not blurred, because only some of its materials are clear")
            return False
        if not is_clear:
            if not self._note_solid(shape, "its motion is not blurred, because", notes):
                return False
            self._objects.place(self._add_solid(shape, notes), matrix, matrices)
            return True
        # Shapes with the same motion stay in one tree, so that glass and liquid touch exactly.
        motion = [place @ np.linalg.inv(np.array(matrix, dtype=float)) for place in matrices]
        for other, group in moving.values():
            if all(np.allclose(a, b, rtol=1e-4, atol=1e-5) for a, b in zip(motion, other)):
                group.writer.add(shape, matrix)
                return True
        group = self._new_group(shape.name)
        moving[shape.name, len(moving)] = (motion, group)
        self._objects.place(group.name, np.identity(4), motion)
        group.writer.add(shape, matrix)
        return True

    def _note_solid(self, shape, what, notes):
        """Whether an opaque shape can be a solid of one phase. Notes what is unsupported."""
        slots = shape.used_slots()
        surface = self._surface(shape)
        why = (
            "it has several materials" if len(slots) > 1
            else "its material has images" if surface.uv_maps
            else "its material is transparent in part" if surface.alpha < 1 or surface.uses_image_alpha
            else "" if shape.is_closed() else "it is not closed"
        )  # fmt: skip
        if why:
            notes.unsupported(f"{what} {why}")
            return False
        if greatest_facet_angle(shape.triangles, shape.triangles.corners) > 3:
            notes.approximate("is shaded flat, because it is rendered as a solid: opaque meshes cannot move or have instances")
        if surface.grain_axis:
            notes.unsupported("the grain of its material is ignored, because it is rendered as a solid")
        return True


def group_paths(folder, group):
    """The files of a group: glTF and scene."""
    scene = os.path.join(folder, group.file)
    return os.path.splitext(scene)[0] + ".glb", scene
