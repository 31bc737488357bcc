"""Passes of a view layer: their names in Blender, and the planes and channels of phasetree that fill them."""

import re
from dataclasses import dataclass

from . import cryptomatte

CRYPTOMATTE_RANKS = 6


@dataclass(frozen=True)
class Pass:
    name: str
    channels: tuple  # of the EXR file
    ids: str  # a letter for each channel, as Blender calls them
    kind: str  # VALUE, VECTOR or COLOR
    plane: str = ""  # of the command's option --planes
    missing: float = 0.0  # the value of channels that the file lacks


def passes_of(view_layer):
    """The passes of a view layer, the picture first. Depth, normal and albedo are those of the first surface."""
    found = [Pass("Combined", ("R", "G", "B", "A"), "RGBA", "COLOR", missing=1.0)]
    if view_layer.use_pass_z:
        found.append(Pass("Depth", ("depth.Z",), "Z", "VALUE", "depth"))
    if view_layer.use_pass_normal:
        found.append(Pass("Normal", ("normal.X", "normal.Y", "normal.Z"), "XYZ", "VECTOR", "normal"))
    if view_layer.phasetree.use_pass_albedo:
        found.append(Pass("Albedo", tuple(f"albedo.{c}" for c in "RGB"), "RGB", "COLOR", "albedo"))
    for group in view_layer.lightgroups:
        channels = tuple(f"light_{group_name(group.name)}.{c}" for c in "RGB")
        found.append(Pass(f"Combined_{group.name}", channels, "RGB", "COLOR", "lights"))
    for layer in cryptomatte.layers_of(view_layer):
        for i in range(min(view_layer.pass_cryptomatte_depth, CRYPTOMATTE_RANKS) // 2):
            name = f"{layer}{i:02}"
            found.append(Pass(name, tuple(f"{name}.{c}" for c in "RGBA"), "RGBA", "COLOR", cryptomatte.PLANES[layer]))
    return found


def planes_of(view_layer):
    """Names of planes for the command, each once."""
    return list(dict.fromkeys(p.plane for p in passes_of(view_layer) if p.plane))


def group_name(name):
    """A light group's name in scene files: letters, digits, - and _. Different names stay different."""
    return re.sub(r"[^A-Za-z0-9-]", lambda found: f"_{ord(found[0]):x}_", name)
