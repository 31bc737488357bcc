"""Volume shaders as coefficients of a medium, per unit of length."""

from dataclasses import dataclass, field

import numpy as np

from . import sockets
from .sockets import constant

GREY = (0.8, 0.8, 0.8)


@dataclass
class Medium:
    absorption: np.ndarray = field(default_factory=lambda: np.zeros(3))
    scattering: np.ndarray = field(default_factory=lambda: np.zeros(3))
    anisotropy: float = 0.0  # mean cosine of Henyey and Greenstein's phase function

    def scaled(self, factor):
        return Medium(factor * self.absorption, factor * self.scattering, self.anisotropy)


def medium_of(node, notes):
    """What a volume shader absorbs and scatters."""
    make = SHADERS.get(node.bl_idname)
    if make is None:
        notes.unsupported(f"the volume {node.name} ({node.bl_label}) is ignored; use absorption, scatter or Principled Volume")
        return Medium()
    return make(node, notes)


def color_and_density(node, notes):
    color = np.clip(np.array(constant(node, "Color", GREY, notes)), 0, 1)
    return color, max(constant(node, "Density", 1.0, notes), 0.0)


def absorption(node, notes):
    color, density = color_and_density(node, notes)
    return Medium(absorption=density * (1 - color))


def scatter(node, notes):
    if getattr(node, "phase", "HENYEY_GREENSTEIN") != "HENYEY_GREENSTEIN":  # from Blender 4.3
        notes.approximate(f"the phase function of {node.name} is Henyey and Greenstein's")
    color, density = color_and_density(node, notes)
    return Medium(scattering=density * color, anisotropy=anisotropy_of(node, notes))


def principled(node, notes):
    """The absorption is density · (1 − color) · (1 − √absorption color), as in Cycles."""
    color, density = color_and_density(node, notes)
    kept = np.sqrt(np.maximum(np.array(constant(node, "Absorption Color", (0.0, 0.0, 0.0), notes)), 0))
    for name in ("Emission Strength", "Blackbody Intensity"):
        if constant(node, name, 0.0, notes) != 0:
            notes.unsupported(f'"{name}" of {node.name} is ignored')
    return Medium(density * (1 - color) * np.maximum(1 - kept, 0), density * color, anisotropy_of(node, notes))


def anisotropy_of(node, notes):
    g = constant(node, "Anisotropy", 0.0, notes)
    if abs(g) > 0.99:
        notes.approximate(f"the anisotropy {g:.3g} of {node.name} is clamped to 0.99")
    return min(max(g, -0.99), 0.99)


def add(node, notes):
    return sum_of([linked(node.inputs[i], notes) for i in (0, 1)], node, notes)


def mix(node, notes):
    share = min(max(constant(node, "Fac", 0.5, notes), 0.0), 1.0)
    first, second = linked(node.inputs[1], notes), linked(node.inputs[2], notes)
    return sum_of([first.scaled(1 - share), second.scaled(share)], node, notes)


def linked(socket, notes):
    origin = sockets.source(socket)
    return medium_of(origin.node, notes) if origin else Medium()


def sum_of(media, node, notes):
    weights = [medium.scattering.sum() for medium in media]
    total = sum(weights)
    mean = sum(w * medium.anisotropy for w, medium in zip(weights, media)) / total if total > 0 else 0.0
    if any(w > 0 and medium.anisotropy != mean for w, medium in zip(weights, media)):
        notes.approximate(f"the media at {node.name} scatter with their mean anisotropy, {mean:.2g}")
    return Medium(sum(m.absorption for m in media), sum(m.scattering for m in media), mean)


SHADERS = {
    "ShaderNodeVolumeAbsorption": absorption,
    "ShaderNodeVolumeScatter": scatter,
    "ShaderNodeVolumePrincipled": principled,
    "ShaderNodeAddShader": add,
    "ShaderNodeMixShader": mix,
}
