"""Image Texture nodes as textures of glTF: which image, its mapping, and which of its channels."""

import math
from dataclasses import dataclass

import numpy as np

from . import sockets
from .sockets import constant


@dataclass(frozen=True)
class Transform:
    """KHR_texture_transform: scales texture coordinates, then rotates and moves them."""

    offset: tuple = (0.0, 0.0)
    rotation: float = 0.0  # in radians
    scale: tuple = (1.0, 1.0)

    def keeps_directions(self):
        return math.sin(self.rotation / 2) == 0 and min(self.scale) > 0


@dataclass(frozen=True)
class Texture:
    """An image on a mesh."""

    image: object  # of Blender
    uv_map: str = ""  # a name; "" is the active one
    transform: Transform = Transform()

    def has_same_mapping(self, other):
        return (self.uv_map, self.transform) == (other.uv_map, other.transform)


@dataclass(frozen=True)
class Channel:
    """A channel of a texture: 0, 1 or 2, or None for the luminance."""

    texture: Texture
    number: int
    fallback: float  # the value if the image cannot be read


SEPARATED = {"Red": 0, "Green": 1, "Blue": 2, "R": 0, "G": 1, "B": 2}


def texture_at(socket, notes):
    """The texture of the Image Texture that an input is linked to, or None."""
    origin = sockets.source(socket)
    if origin is None or origin.node.bl_idname != "ShaderNodeTexImage" or origin.name != "Color":
        return None
    return texture_of(origin.node, notes)


def texture_of(node, notes):
    """The texture of an Image Texture, or None if its image cannot be used."""
    if node.image is None:
        notes.unsupported(f"{node.name} has no image; its input's own colour is used")
        return None
    if node.image.source not in ("FILE", "GENERATED"):
        notes.unsupported(f'the image "{node.image.name}" is a {node.image.source.lower()}; its input\'s own colour is used')
        return None
    if node.projection != "FLAT" or node.extension != "REPEAT":
        notes.unsupported(f"{node.name} is used as a flat projection that repeats")
    return Texture(node.image, *placement_of(node, notes))


def channel_at(socket, notes):
    """The channel of an image that an input for numbers is linked to, also through Separate Color; or None."""
    origin = sockets.source(socket)
    if origin is None:
        return None
    number, fallback = None, sockets.plain(socket.default_value)
    if origin.node.bl_idname in ("ShaderNodeSeparateColor", "ShaderNodeSeparateRGB"):
        if getattr(origin.node, "mode", "RGB") != "RGB":
            return None
        number, socket = SEPARATED[origin.name], origin.node.inputs[0]
    texture = texture_at(socket, notes)
    return None if texture is None else Channel(texture, number, fallback)


def placement_of(node, notes):
    """The UV map and the transform given by the nodes linked to the Vector input of an Image Texture."""
    origin, matrix = sockets.source(node.inputs["Vector"]), np.identity(3)
    while origin is not None and origin.node.bl_idname == "ShaderNodeMapping":
        mapping = matrix_of(origin.node, notes)
        if mapping is None:
            notes.unsupported(f"{origin.node.name} at {node.name} is ignored; it may only move, scale, and rotate about z")
        else:
            matrix = matrix @ mapping
        last, origin = origin.node, sockets.source(origin.node.inputs["Vector"])
        if origin is None:
            notes.unsupported(f"{last.name} has no input; the UV map is used")
    transform = transform_of(matrix)
    if transform is None:
        notes.unsupported(f"the Mapping at {node.name} is ignored; it shears the image or scales it to nothing")
        transform = Transform()
    if origin is None or (origin.node.bl_idname == "ShaderNodeTexCoord" and origin.name == "UV"):
        return "", transform
    if origin.node.bl_idname == "ShaderNodeUVMap":
        return origin.node.uv_map, transform
    notes.unsupported(f"{origin.node.name} at {node.name} is ignored; the UV map is used")
    return "", transform


def matrix_of(node, notes):
    """The 3×3 matrix by which a Mapping node transforms (u, v, 1), or None."""
    location = constant(node, "Location", (0.0, 0.0, 0.0), notes)
    rotation = constant(node, "Rotation", (0.0, 0.0, 0.0), notes)
    scale = constant(node, "Scale", (1.0, 1.0, 1.0), notes)
    if node.vector_type == "NORMAL" or rotation[0] != 0 or rotation[1] != 0:
        return None
    cosine, sine = math.cos(rotation[2]), math.sin(rotation[2])
    move, turn = np.identity(3), np.array([[cosine, -sine, 0], [sine, cosine, 0], [0, 0, 1]])
    move[:2, 2] = location[:2] if node.vector_type != "VECTOR" else 0
    matrix = move @ turn @ np.diag([scale[0], scale[1], 1])
    if node.vector_type != "TEXTURE":
        return matrix
    return np.linalg.inv(matrix) if scale[0] * scale[1] != 0 else None


def transform_of(matrix):
    """Converts a transform of Blender's texture coordinates to one of glTF's, in which v points down; None if glTF cannot
    express it."""
    if np.array_equal(matrix, np.identity(3)):
        return Transform()
    flip = np.array([[1, 0, 0], [0, -1, 1], [0, 0, 1]])
    m = flip @ matrix @ flip
    # The columns of a scale followed by a rotation, which glTF counts clockwise in its own coordinates.
    x, y = m[:2, 0], m[:2, 1]
    scale_x = math.hypot(*x)
    if scale_x == 0 or abs(x @ y) > 1e-5 * scale_x * math.hypot(*y):
        return None
    cosine, sine = x[0] / scale_x, -x[1] / scale_x
    scale_y = float(sine * y[0] + cosine * y[1])
    if scale_y == 0:
        return None
    return Transform((float(m[0, 2]), float(m[1, 2])), math.atan2(sine, cosine), (scale_x, scale_y))
