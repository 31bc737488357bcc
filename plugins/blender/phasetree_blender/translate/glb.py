"""Writes a .glb file: meshes, materials and images."""

import json
import struct

import numpy as np

FLOAT, UNSIGNED = 5126, 5125


class Glb:
    def __init__(self):
        self._chunks, self._size = [], 0
        self._json = {"asset": {"version": "2.0", "generator": "phasetree for Blender"}, "scene": 0, "scenes": [{"nodes": []}]}
        self._extensions = set()

    def _add(self, name, element):
        self._json.setdefault(name, []).append(element)
        return len(self._json[name]) - 1

    def _view(self, data):
        view = self._add("bufferViews", {"buffer": 0, "byteOffset": self._size, "byteLength": len(data)})
        padded = data + b"\0" * (-len(data) % 4)
        self._chunks.append(padded)
        self._size += len(padded)
        return view

    def _accessor(self, array, kind, component, **more):
        dtype = np.float32 if component == FLOAT else np.uint32
        data = np.ascontiguousarray(array, dtype=dtype)
        element = {"bufferView": self._view(data.tobytes()), "componentType": component, "count": len(data), "type": kind}
        return self._add("accessors", {**element, **more})

    def primitive(self, positions, normals, triangles, coordinates, material, tangents=None):
        """A primitive for mesh(). Arrays have a row per vertex or triangle; those of normals, coordinates and tangents may be
        None."""
        low, high = positions.min(axis=0).tolist(), positions.max(axis=0).tolist()
        attributes = {"POSITION": self._accessor(positions, "VEC3", FLOAT, min=low, max=high)}
        if normals is not None:
            attributes["NORMAL"] = self._accessor(normals, "VEC3", FLOAT)
        if coordinates is not None:
            attributes["TEXCOORD_0"] = self._accessor(coordinates, "VEC2", FLOAT)
        if tangents is not None:
            attributes["TANGENT"] = self._accessor(tangents, "VEC4", FLOAT)
        return {"attributes": attributes, "indices": self._accessor(triangles.reshape(-1), "SCALAR", UNSIGNED),
                "material": material}  # fmt: skip

    @property
    def has_nodes(self):
        return bool(self._json["scenes"][0]["nodes"])

    def mesh(self, name, primitives):
        return self._add("meshes", {"name": name, "primitives": primitives})

    def material(self, material):
        self._extensions.update(extensions_in(material))
        return self._add("materials", material)

    def texture(self, content, mime):
        """An image as a texture of a material."""
        image = self._add("images", {"bufferView": self._view(content), "mimeType": mime})
        return {"index": self._add("textures", {"source": image})}

    def node(self, name, mesh, matrix, extras):
        """Places a mesh. `matrix`: 4×4, to the space of the scene, where z is up; glTF's y is up."""
        y_up = np.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]], dtype=float)
        node = {"name": name, "mesh": mesh, "matrix": (y_up @ matrix).T.reshape(-1).tolist()}
        if extras:
            node["extras"] = extras
        self._json["scenes"][0]["nodes"].append(self._add("nodes", node))

    def content(self):
        self._json["buffers"] = [{"byteLength": self._size}]
        if self._extensions:
            self._json["extensionsUsed"] = sorted(self._extensions)
        text = json.dumps(self._json).encode()
        text += b" " * (-len(text) % 4)
        binary = b"".join(self._chunks)
        size = 12 + 8 + len(text) + 8 + len(binary)
        return b"".join([b"glTF", struct.pack("<II", 2, size), struct.pack("<I4s", len(text), b"JSON"), text,
                         struct.pack("<I4s", len(binary), b"BIN\0"), binary])  # fmt: skip


def extensions_in(value):
    """The names of the extensions that a value of the file uses."""
    if not isinstance(value, dict):
        return set()
    return set(value.get("extensions", ())).union(*map(extensions_in, value.values()))
