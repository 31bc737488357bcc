"""Mix Shader and Add Shader of surfaces, as far as one surface or the scene file's `mix` can express them."""

import copy

import numpy as np

from . import sockets, textures
from .sockets import constant

WHITE = (1.0, 1.0, 1.0)
HALF = 0.5


class Transparent:
    """A Transparent BSDF: not a surface, but a hole."""


def mix(node, notes, surface_at):
    """The surface of a Mix Shader. `surface_at(node, notes)` is that of a shader node."""
    first, second = (operand(socket, notes, surface_at) for socket in node.inputs[1:3])
    if is_fresnel(node, first, second):
        return gloss_over(node, first, second, notes)
    amount = amount_of(node, notes)
    if amount in (0.0, 1.0):
        return opaque_or(first if amount == 0 else second, node, notes)
    if isinstance(first, Transparent) or isinstance(second, Transparent):
        return with_holes(node, first, second, amount, notes)
    if isinstance(amount, float) and is_linear(first) and is_linear(second):
        return weighted(((1 - amount, first), (amount, second)))
    if first.is_clear or second.is_clear:
        return larger(node, first, second, amount, "a mix with a clear material", notes)
    if first.mixture or second.mixture:
        return larger(node, first, second, amount, "a mix of mixes", notes)
    return mixture(node, first, second, amount, notes)


def add(node, notes, surface_at):
    """The surface of an Add Shader: light is added to any opaque surface, and matt colours are added."""
    first, second = (operand(socket, notes, surface_at) for socket in node.inputs[0:2])
    if isinstance(first, Transparent) or isinstance(second, Transparent):
        notes.unsupported(f"Transparent BSDF at {node.name} is ignored, because what is added to it cannot be seen through")
        return opaque_or(second if isinstance(first, Transparent) else first, node, notes)
    if is_linear(first) and is_linear(second):
        total = weighted(((1, first), (1, second)))
        if max(total.color) > 1:
            notes.approximate(f"{node.name} reflects more light than arrives; its colour is clamped to 1")
            total.color = tuple(min(c, 1.0) for c in total.color)
        return total
    for surface, other in ((first, second), (second, first)):
        if is_light(other) and not surface.is_clear and not surface.mixture:
            return glowing(surface, other.emission)
    notes.unsupported(f"of the sum at {node.name}, only the first shader is rendered")
    return first


def operand(socket, notes, surface_at):
    origin = sockets.source(socket)
    if origin is None:
        return black()
    if origin.node.bl_idname == "ShaderNodeBsdfTransparent":
        if constant(origin.node, "Color", WHITE, notes) != WHITE:
            notes.unsupported(f"the colour of {origin.node.name} is ignored")
        return Transparent()
    return surface_at(origin.node, notes)


def black():
    from .materials import MATT, Surface

    return Surface(color=(0.0, 0.0, 0.0), ior=MATT)


def opaque_or(surface, node, notes):
    if isinstance(surface, Transparent):
        notes.unsupported(f"{node.name} is wholly transparent; it is rendered as black")
        return black()
    return surface


def amount_of(node, notes):
    """The share of the second shader: a number, or a channel of an image."""
    socket = node.inputs[0]
    channel = textures.channel_at(socket, notes)
    if channel is not None:
        return channel
    origin = sockets.source(socket)
    if origin is not None and origin.node.bl_idname == "ShaderNodeLightPath":
        value = 1.0 if origin.name == "Is Camera Ray" else 0.0
        notes.approximate(f'"{origin.name}" at {node.name} counts as {value:.0f} for all rays')
        return value
    return min(max(constant(node, socket.name, HALF, notes), 0.0), 1.0)


def is_linear(surface):
    """Whether the light that leaves a surface is linear in its colour and emission: matt, without images."""
    return (
        surface.is_matt
        and not surface.extensions
        and surface.alpha == 1
        and not (surface.color_image or surface.normal_image or surface.uses_image_alpha or surface.mixture)
    )


def is_light(surface):
    return is_linear(surface) and not any(surface.color) and any(surface.emission)


def weighted(parts):
    """The sum of linear surfaces, each with a factor."""
    made = copy.copy(parts[0][1])
    for name in ("color", "emission"):
        setattr(made, name, tuple(float(sum(w * getattr(s, name)[i] for w, s in parts)) for i in range(3)))
    return made


def glowing(surface, emission):
    """A surface with more light."""
    from .layers import make_layered

    surface.emission = tuple(a + b for a, b in zip(surface.emission, emission))
    if not surface.is_matt:
        make_layered(surface)
    return surface


def with_holes(node, first, second, amount, notes):
    """A surface that light passes through in part."""
    if isinstance(first, Transparent) and isinstance(second, Transparent):
        return opaque_or(first, node, notes)
    is_first = isinstance(second, Transparent)
    surface = first if is_first else second
    if surface.is_clear:
        notes.unsupported(f"Transparent BSDF at {node.name} is ignored beside a clear material")
        return surface
    if surface.mixture:
        notes.unsupported(f"Transparent BSDF at {node.name} is ignored beside a mix")
        return surface
    if not isinstance(amount, float):
        notes.unsupported(f"the image at the factor of {node.name} is ignored; {HALF} is used")
    surface.alpha *= 1 - number_of(amount) if is_first else number_of(amount)
    return surface


def number_of(amount):
    return amount if isinstance(amount, float) else HALF


def larger(node, first, second, amount, what, notes):
    is_first = number_of(amount) < HALF
    notes.unsupported(f"{what} at {node.name}; only the {'first' if is_first else 'second'} shader is rendered")
    return first if is_first else second


def mixture(node, first, second, amount, notes):
    """A surface that the scene file's `mix` makes of two."""
    for surface in (first, second):
        if any(surface.emission):
            notes.unsupported(f"emission within the mix at {node.name} is ignored")
            surface.emission = (0.0, 0.0, 0.0)
        if surface.alpha < 1 or surface.uses_image_alpha:
            notes.unsupported(f"alpha within the mix at {node.name} is ignored")
    made = copy.copy(first)
    made.mixture = (first, second, amount)
    made.alpha, made.uses_image_alpha, made.emission = 1.0, False, (0.0, 0.0, 0.0)
    made.uv_maps = set(first.uv_maps) | set(second.uv_maps)
    if not isinstance(amount, float):
        made.uv_maps.add(amount.texture.uv_map)
    made.grain_axis = None
    made.color = tuple(float(c) for c in (np.array(first.color) + np.array(second.color)) / 2)
    return made


def is_fresnel(node, first, second):
    """Whether a node is the usual gloss over a matt shader, mixed by Fresnel's equations."""
    origin = sockets.source(node.inputs[0])
    if origin is None or origin.node.bl_idname not in ("ShaderNodeFresnel", "ShaderNodeLayerWeight"):
        return False
    if isinstance(first, Transparent) or isinstance(second, Transparent) or origin.name == "Facing":
        return False
    return is_linear(first) and second.metallic == 1 and not second.is_clear and not second.mixture


def gloss_over(node, first, second, notes):
    """A matt shader below a glossy one, by the index of Fresnel's equations."""
    fresnel = sockets.source(node.inputs[0]).node
    if fresnel.bl_idname == "ShaderNodeFresnel":
        ior = constant(fresnel, "IOR", 1.45, notes)
    else:
        ior = 1 / max(1 - constant(fresnel, "Blend", HALF, notes), 1e-5)
    if min(second.color) < 0.99:
        notes.unsupported(f"the colour of the gloss at {node.name} is ignored")
    notes.approximate(f"{node.name} is rendered as a gloss of the index {ior:.3g} over the first shader")
    first.ior, first.roughness = min(max(ior, 1.02), 4.0), second.roughness
    return first


SHADERS = {"ShaderNodeMixShader": mix, "ShaderNodeAddShader": add}
