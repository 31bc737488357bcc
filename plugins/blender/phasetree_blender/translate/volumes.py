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
    anisotropy: float = 0.0  # mean cosine of Henyey and Greenstein's phase function …
    phase_function: dict = None  # … or another one, as scene files have it

    def scaled(self, factor):
        return Medium(factor * self.absorption, factor * self.scattering, self.anisotropy, self.phase_function)

    def parameters(self):
        """Of a scene file's clear material: how the medium scatters."""
        how = {"phase_function": self.phase_function} if self.phase_function else {"anisotropy": self.anisotropy}
        return {"scattering": [float(s) for s in self.scattering], **how}

    def any_phase_function(self):
        return self.phase_function or {"henyey_greenstein": {"g": self.anisotropy}}


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
    color, density = color_and_density(node, notes)
    phase = getattr(node, "phase", "HENYEY_GREENSTEIN")  # a choice from Blender 4.3 on
    make = PHASE_FUNCTIONS.get(phase)
    if make:
        return Medium(scattering=density * color, phase_function=make(node, notes))
    if phase != "HENYEY_GREENSTEIN":
        notes.approximate(f"the phase function of {node.name} is Henyey and Greenstein's")
    return Medium(scattering=density * color, anisotropy=anisotropy_of(node, notes))


def clamped(node, name, default, low, high, notes):
    value = constant(node, name, default, notes)
    if not low <= value <= high:
        notes.approximate(f'"{name}" of {node.name}, {value:.3g}, is clamped to {min(max(value, low), high):.3g}')
    return min(max(value, low), high)


def rayleigh(node, notes):
    return {"rayleigh": {}}


def draine(node, notes):
    return {"draine": {"g": anisotropy_of(node, notes), "alpha": clamped(node, "Alpha", 0.5, 0, 1000, notes)}}


def droplets(node, notes):
    """Blender has the same fit, and others for smaller droplets."""
    return {"droplets": {"diameter": clamped(node, "Diameter", 20.0, 5, 50, notes)}}


PHASE_FUNCTIONS = {"RAYLEIGH": rayleigh, "DRAINE": draine, "MIE": droplets}


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
    """The sum of two media. Together they scatter by a mix of their phase functions, which is exact if their scattering
    has the same colour."""
    absorption, scattering = (sum(getattr(m, name) for m in media) for name in ("absorption", "scattering"))
    scattered = [m for m in media if m.scattering.sum() > 0]
    if not scattered:
        return Medium(absorption, scattering)
    first, second = scattered[0], scattered[-1]
    if first.any_phase_function() == second.any_phase_function():
        return Medium(absorption, scattering, first.anisotropy, first.phase_function)
    shares = second.scattering[scattering > 0] / scattering[scattering > 0]
    amount = float(second.scattering.sum() / scattering.sum())
    if np.ptp(shares) > 1e-3:
        notes.approximate(f"the media at {node.name} scatter by a mix of their phase functions that is the same for all colours")
    mix = {"first": first.any_phase_function(), "second": second.any_phase_function(), "amount": amount}
    return Medium(absorption, scattering, phase_function={"mix": mix})


SHADERS = {
    "ShaderNodeVolumeAbsorption": absorption,
    "ShaderNodeVolumeScatter": scatter,
    "ShaderNodeVolumePrincipled": principled,
    "ShaderNodeAddShader": add,
    "ShaderNodeMixShader": mix,
}
