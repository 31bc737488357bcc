"""Scenes of many objects: named objects, and their transforms as arrays of affine maps."""

from __future__ import annotations

import numpy as np

from phasetree import _phasetree, _reference
from phasetree._errors import Error
from phasetree._phases import vacuum
from phasetree._trees import Object

_IDENTITY = np.hstack([np.eye(3), np.zeros((3, 1))]).astype(np.float32)


def _maps(transforms, what):
    """Converts transforms of any shape that `instances_of` accepts to a float32 array of shape (N, 3, 4)."""
    _reference.check_still(transforms, what)
    array = np.asarray(transforms, dtype=np.float32)
    if array.shape[-1:] == (3,) and array.ndim <= 2:
        positions = array.reshape(-1, 3)
        array = np.tile(_IDENTITY, (len(positions), 1, 1))
        array[:, :, 3] = positions
    elif array.shape[-2:] == (4, 4) and array.ndim <= 3:
        array = array.reshape(-1, 4, 4)
        if not np.array_equal(array[:, 3], np.tile([0, 0, 0, 1], (len(array), 1))):
            raise Error(f"{what}: the last row of a 4x4 matrix must be 0 0 0 1")
        array = array[:, :3]
    elif array.shape[-2:] == (3, 4) and array.ndim <= 3:
        array = array.reshape(-1, 3, 4)
    else:
        raise Error(
            f"{what} must be positions of shape (3,) or (N, 3), or affine matrices of shape (3, 4), (4, 4), (N, 3, 4) "
            f"or (N, 4, 4); the shape is {array.shape}"
        )
    if len(array) == 0 or not np.all(np.isfinite(array)):
        raise Error(f"{what} must contain at least one transform, and only finite numbers")
    return np.ascontiguousarray(array)


class Instances:
    """The instances of an object or a group in a scene.

    of: its name. transforms: float32 (N, 3, 4), one matrix [M v] per instance, for the affine map from p to M p + v.
    """

    __slots__ = ("of", "transforms")

    def __init__(self, of, transforms):
        self.of, self.transforms = of, transforms

    def written(self):
        """The JSON value. Each transform is twelve numbers: the images of the three axes, then of the origin."""
        columns = self.transforms.transpose(0, 2, 1).reshape(-1, 12)
        return {"of": self.of, "transforms": _numbers(columns)}

    def __len__(self):
        return len(self.transforms)

    def __eq__(self, other):
        return isinstance(other, Instances) and self.of == other.of and np.array_equal(self.transforms, other.transforms)

    __hash__ = None

    def __repr__(self):
        return f"<{len(self)} instances of {self.of!r}>"


def instances_of(of, transforms):
    """Instances of an object or a group, for the `instances` or `groups` of a Scene. Returns Instances.

    of: the name of the object or group. transforms: positions of shape (3,) or (N, 3), or matrices of
    affine maps, of shape (3, 4), (4, 4), (N, 3, 4) or (N, 4, 4).
    """
    if not isinstance(of, str) or not of:
        raise Error(f"instances need the name of an object or a group, not {of!r}")
    return Instances(of, _maps(transforms, "transforms"))


def named_objects(objects):
    """Converts a scene's `objects` to {name: (object, its own map)}."""
    result = {}
    for name, value in dict(objects).items():
        placed, transform = value if isinstance(value, tuple) and len(value) == 2 else (value, _IDENTITY)
        if not isinstance(placed, Object):
            raise Error(f'the object "{name}" must be an object of phases, or a pair of one and its map, but is {value!r}')
        maps = _maps(transform, f'the map of "{name}"')
        if len(maps) != 1:
            raise Error(f'the object "{name}" has {len(maps)} maps of its own; use instances_of(…)')
        result[name] = (placed, maps[0])
    return result


def instance_lists(value, what):
    """Converts one Instances or several to a tuple."""
    lists = (value,) if isinstance(value, Instances) else tuple(value)
    for one in lists:
        if not isinstance(one, Instances):
            raise Error(f"{what} must be pt.instances_of(…), but {one!r} is among them")
    return lists


def phases_of(objects):
    """All phases of the objects, the vacuum first. Phases with the same name must have the same material."""
    known = {}
    for placed, _ in objects.values():
        for p in placed.phases[1:]:
            if known.setdefault(p.name, p) != p:
                raise Error(f'two objects have different materials for the phase "{p.name}"; rename it in one of them')
    return (vacuum, *known.values())


def _numbers(array):
    """Nested lists of numbers, each with the fewest digits that identify the float32."""
    if array.ndim > 1:
        return [_numbers(row) for row in array]
    return [float(str(value)) for value in array]


def _written_map(matrix):
    x, y, z, by = (_numbers(matrix[:, i]) for i in range(4))
    return {"affine": {"x": x, "y": y, "z": z, "by": by}}


def written(objects):
    """The "shapes" and "objects" of a scene file. Shapes that a tree uses repeatedly are named after the object."""
    shapes, placed = {}, []
    for name, (one, matrix) in objects.items():
        # A phase's name may equal a name that the writer gives a shape. So phases have temporary names until the shapes
        # are renamed.
        phases = {f"{name}: phase {i}": p.name for i, p in enumerate(one.phases[1:], 1)}
        scene = _phasetree.value_of(one._handle.text(list(phases), ["null"] * len(phases)))
        renamed = phases | {shape: f"{name}: {shape}" for shape in scene.get("shapes", {})}

        def with_names(value, renamed=renamed):
            if isinstance(value, str):
                return renamed.get(value, value)
            if isinstance(value, dict):
                return {key: with_names(v) for key, v in value.items()}
            return [with_names(v) for v in value] if isinstance(value, list) else value

        shapes.update({renamed[shape]: with_names(node) for shape, node in scene.get("shapes", {}).items()})
        entry = {"name": name, "tree": with_names(scene["tree"])}
        if not np.array_equal(matrix, _IDENTITY):
            entry["transform"] = _written_map(matrix)
        placed.append(entry)
    return shapes, placed


def without_implicit_instances(objects, groups, instances):
    """Removes the instances that the reader adds for objects that no instance or group names."""
    named = [one.of for listed in (*groups.values(), instances) for one in listed]
    return [
        one
        for one in instances
        if not (one.of in objects and named.count(one.of) == 1 and np.array_equal(one.transforms, _IDENTITY[None]))
    ]
