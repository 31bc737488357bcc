"""Objects of the scene file that stand beside its tree, and where they are."""

import os
import struct

import numpy as np

from . import scene_materials

FEW = 16  # at most this many places are written into the scene file; more go to a file beside it


def columns_of(matrices):
    """(n, 12): the images of the unit vectors and of the origin, for each matrix."""
    return np.asarray(matrices, dtype=float)[:, :3, :].transpose(0, 2, 1).reshape(-1, 12)


def affine(matrix):
    x, y, z, by = columns_of([matrix]).reshape(4, 3).tolist()
    return {"affine": {"x": x, "y": y, "z": z, "by": by}}


def moving(times, matrices):
    """A transform with keys."""
    return {"keys": [[time, affine(matrix)] for time, matrix in zip(times, matrices)]}


def is_flat(matrix):
    """Whether a place maps space to a plane, which the scene file rejects."""
    return abs(np.linalg.det(np.array(matrix, dtype=float)[:3, :3])) < 1e-30


class SceneObjects:
    """Collects "phases", "objects" and "instances" of the scene file, and writes the files that they name."""

    def __init__(self, folder, stem, times):
        self.folder, self.stem, self._times = folder, stem, times
        self.materials = scene_materials.MaterialFiles(folder, stem)
        self._objects, self._still, self._moving = {}, {}, {}
        self.phases, self._by_solid = {}, {}

    def __len__(self):
        return len(self._objects)

    def add(self, wanted, parameters):
        """Adds an object. Returns its name, which begins with the wanted one."""
        name, same = wanted, 2
        while name in self._objects or name == "tree":
            name, same = f"{wanted} {same}", same + 1
        self._objects[name] = parameters
        return name

    def place(self, name, matrix, matrices=None):
        """Places an object; `matrices`: its places at the times of the motion."""
        if matrices is None:
            self._still.setdefault(name, []).append(np.array(matrix, dtype=float))
        else:
            self._moving.setdefault(name, []).append(matrices)

    def add_solid(self, shape, surface, notes):
        """Adds a closed opaque shape as a solid of one phase. Returns its name, which is also that of the phase."""
        if id(shape) not in self._by_solid:
            file = f"{self.stem}.solid{len(self.phases) + 1}.ply"
            with open(os.path.join(self.folder, file), "wb") as out:
                out.write(ply_of(shape.triangles))
            name = self.add(shape.name, {})
            self._objects[name]["tree"] = {"set": {"phase": name, "of": {"mesh": {"file": file}}}}
            self.phases[name] = scene_materials.material_of(surface, self.materials, notes)
            self._by_solid[id(shape)] = name
        return self._by_solid[id(shape)]

    def parts(self):
        """Members of the scene file."""
        objects, instances = [], []
        for name, parameters in self._objects.items():
            still, moved = self._still.get(name, []), self._moving.get(name, [])
            transforms = [affine(place) for place in still] + [moving(self._times, places) for places in moved]
            if len(transforms) == 1:
                objects.append({"name": name, **parameters, "transform": transforms[0]})
                continue
            objects.append({"name": name, **parameters})
            instances += [{"of": name, "transform": transform} for transform in transforms[len(still) :]]
            if len(still) > FEW:
                instances.append({"of": name, "file": self._places_file(still)})
            elif still:
                instances.append({"of": name, "transforms": columns_of(still).tolist()})
        made = {"phases": self.phases, "objects": objects, "instances": instances}
        return {key: value for key, value in made.items() if value}

    def _places_file(self, matrices):
        file = f"{self.stem}.{len(os.listdir(self.folder))}.places"
        with open(os.path.join(self.folder, file), "wb") as out:
            out.write(b"PTPLACES" + struct.pack("<Q", len(matrices)) + columns_of(matrices).astype("<f4").tobytes())
        return file


def ply_of(triangles):
    """A PLY file of a shape."""
    corners = triangles.of_corners[triangles.corners]
    used, indices = np.unique(corners, return_inverse=True)
    faces = np.empty(len(corners), dtype=[("n", "u1"), ("v", "<i4", 3)])
    faces["n"], faces["v"] = 3, indices.reshape(-1, 3)
    head = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(used)}\nproperty float x\nproperty float y\n"
        f"property float z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    return head.encode() + triangles.positions[used].astype("<f4").tobytes() + faces.tobytes()
