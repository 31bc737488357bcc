"""Inputs of an opaque Principled BSDF that are layers on its base, as extensions of glTF's materials."""

import math

from . import sockets
from .sockets import constant

WHITE = (1.0, 1.0, 1.0)

# Coat and sheen of Blender 3 are fainter than glTF's, and its sheen has no roughness. With these numbers, smooth balls reflect
# as much of a white sky as in Cycles.
OLD_COAT, OLD_SHEEN, OLD_SHEEN_ROUGHNESS = 0.14, 0.16, 0.3

# A weight of sheen that nobody sees. It makes the reader choose its layered material, which reflects and emits light.
INVISIBLE = 1e-6

# Inputs of layers, whose effect vanishes at 0.
WEIGHTS = ("Sheen", "Clearcoat", "Anisotropic")


def read_layers(node, surface, notes):
    """Adds extensions to a surface, whose emission, metallic and roughness are known."""
    read_film(node, surface, notes)
    if surface.is_clear:
        for name in WEIGHTS:
            if sockets.socket(node, name) is not None and constant(node, name, 0.0, notes) != 0:
                notes.unsupported(f'"{sockets.socket(node, name).name}" of a clear material is ignored')
    else:
        read_coat(node, surface, notes)
        read_sheen(node, surface, notes)
        read_grain(node, surface, notes)
    # The reader makes layers of any extension but the specular one, which a metal does not have.
    if any(surface.emission) and not surface.is_clear:
        make_layered(surface)
    read_specular_tint(node, surface, notes)


def make_layered(surface):
    """Makes the reader choose its layered material."""
    if not surface.extensions:
        surface.extensions["KHR_materials_sheen"] = {"sheenColorFactor": [INVISIBLE] * 3, "sheenRoughnessFactor": 1.0}


def weight_of(node, name, notes):
    return min(max(constant(node, name, 0.0, notes), 0.0), 1.0)


def read_coat(node, surface, notes):
    weight = weight_of(node, "Clearcoat", notes)
    if weight == 0:
        return
    if node.inputs.get("Clearcoat") is not None:
        weight *= OLD_COAT
        notes.approximate('"Clearcoat" lacks the wide tails that its highlights have in Blender 3')
    if abs(constant(node, "Coat IOR", 1.5, notes) - 1.5) > 1e-6:
        notes.unsupported('"Coat IOR" is ignored; 1.5 is used instead')
    if constant(node, "Coat Tint", WHITE, notes) != WHITE:
        notes.unsupported('"Coat Tint" is ignored')
    roughness = min(max(constant(node, "Clearcoat Roughness", 0.03, notes), 0.0), 1.0)
    surface.extensions["KHR_materials_clearcoat"] = {"clearcoatFactor": weight, "clearcoatRoughnessFactor": roughness}
    own, base = (sockets.source(sockets.socket(node, name)) for name in ("Clearcoat Normal", "Normal"))
    surface.is_bump_on_coat = own is not None and own == base
    if own is not None and own != base:
        notes.unsupported(f'{own.node.name} at "{sockets.socket(node, "Clearcoat Normal").name}" is ignored')


def read_sheen(node, surface, notes):
    weight, tint = weight_of(node, "Sheen", notes), constant(node, "Sheen Tint", WHITE, notes)
    roughness = constant(node, "Sheen Roughness", OLD_SHEEN_ROUGHNESS, notes)
    if not isinstance(tint, tuple):  # Blender 3: from white to the hue of the base
        weight *= OLD_SHEEN * (1 - surface.metallic)
        red, green, blue = surface.color
        luminance = 0.2126 * red + 0.7152 * green + 0.0722 * blue
        tint = tuple(1 + tint * (c / luminance - 1) for c in surface.color) if luminance > 0 else WHITE
    color = [min(max(weight * c, 0.0), 1.0) for c in tint]
    if max(color) > 0:
        notes.approximate(f'"{sockets.socket(node, "Sheen").name}" uses a different model than Blender')
        surface.extensions["KHR_materials_sheen"] = {"sheenColorFactor": color, "sheenRoughnessFactor": roughness}


def read_film(node, surface, notes):
    """A thin film. `phasetree import` supports it on clear materials, too."""
    thickness = constant(node, "Thin Film Thickness", 0.0, notes)  # in nanometres
    if thickness <= 0:
        return
    surface.extensions["KHR_materials_iridescence"] = {
        "iridescenceFactor": 1.0, "iridescenceIor": constant(node, "Thin Film IOR", 1.33, notes),
        "iridescenceThicknessMinimum": thickness, "iridescenceThicknessMaximum": thickness,
    }  # fmt: skip


def read_grain(node, surface, notes):
    """Anisotropy. Blender stretches α along the tangent and shrinks it across; glTF only stretches it."""
    anisotropy = weight_of(node, "Anisotropic", notes)
    if anisotropy == 0:
        return
    if surface.roughness_image is not None:
        notes.unsupported('"Anisotropic" is ignored, because "Roughness" is an image')
        return
    aspect = math.sqrt(1 - 0.9 * anisotropy)
    alpha = max(surface.roughness, 0.04) ** 2
    along, across = min(alpha / aspect, 1.0), alpha * aspect
    surface.roughness = math.sqrt(across)
    surface.extensions["KHR_materials_anisotropy"] = {
        "anisotropyStrength": math.sqrt((along - across) / (1 - across)),
        "anisotropyRotation": 2 * math.pi * constant(node, "Anisotropic Rotation", 0.0, notes),
    }
    read_tangent(node, surface, notes)


def read_tangent(node, surface, notes):
    """The direction of the grain: around an axis of the mesh, or along a UV map."""
    surface.grain_axis = "Z"
    origin = sockets.source(node.inputs.get("Tangent"))
    if origin is None:
        pass
    elif origin.node.bl_idname != "ShaderNodeTangent":
        notes.unsupported(f'{origin.node.name} at "Tangent" is ignored')
    elif origin.node.direction_type == "UV_MAP":
        surface.grain_axis = None
        surface.uv_maps.add(origin.node.uv_map)
    else:
        surface.grain_axis = origin.node.axis
    if surface.grain_axis and surface.normal_image is not None:
        surface.grain_axis = None
        notes.approximate("the grain runs along the UV map, because of the normal map")


def read_specular_tint(node, surface, notes):
    tint = sockets.socket(node, "Specular Tint")
    if tint is None:
        return
    value = constant(node, "Specular Tint", plain_neutral(tint), notes)
    if not isinstance(value, tuple) or surface.is_clear:  # a number in Blender 3
        if value not in (0.0, WHITE):
            notes.unsupported('"Specular Tint" of a clear material is ignored' if surface.is_clear else
                              '"Specular Tint" is ignored')  # fmt: skip
        return
    if all(abs(v - 1) < 1e-6 for v in value):
        return
    notes.approximate('"Specular Tint" also colours reflections at grazing angles')
    if surface.metallic > 0:
        notes.unsupported('"Specular Tint" of metal is ignored')
    surface.extensions["KHR_materials_specular"] = {"specularColorFactor": [max(v, 0.0) for v in value]}


def plain_neutral(socket):
    return WHITE if isinstance(sockets.plain(socket.default_value), tuple) else 0.0
