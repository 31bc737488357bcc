"""Shader nodes as glTF materials, whose optics `phasetree import` knows."""

import copy
import math
from dataclasses import dataclass, field

from . import layers, mixes, sockets, textures, volumes
from .sockets import constant

# Inputs of the Principled BSDF that are ignored, and whose effect vanishes at 0.
IGNORED_WEIGHTS = ("Subsurface", "Diffuse Roughness")

GREY = (0.8, 0.8, 0.8)


@dataclass
class Surface:
    """A material, described by the parameters of glTF's material model."""

    color: tuple = GREY
    alpha: float = 1.0
    metallic: float = 0.0
    roughness: float = 1.0
    ior: float = 1.5
    emission: tuple = (0.0, 0.0, 0.0)
    is_clear: bool = False
    absorption: tuple = None  # attenuation colour and distance
    scattering: dict = field(default_factory=dict)  # parameters of the scene file's clear material
    color_image: textures.Texture = None
    uses_image_alpha: bool = False
    roughness_image: textures.Channel = None  # multiplied by the number
    metallic_image: textures.Channel = None
    normal_image: textures.Texture = None
    normal_strength: float = 1.0
    is_bump_on_coat: bool = False  # whether the coat has these normals, too
    extensions: dict = field(default_factory=dict)  # layers, by glTF's names
    grain_axis: str = None  # the axis that anisotropy turns around; None: as the UV map
    uv_maps: set = field(default_factory=set)  # names; "" is the active one
    mixture: tuple = None  # two surfaces, and the share of the second: a number or a textures.Channel

    @property
    def is_matt(self):
        """Whether it only reflects diffusely, or is black."""
        return self.ior == MATT and self.metallic == 0 and not (self.is_clear or self.metallic_image or self.roughness_image)


# Diffuse reflection alone: with the smallest index that glTF's reader accepts, the coat reflects 0.002 %.
MATT = 1.01


def surface_of(material, notes):
    """The surface that a material describes. A missing material is Blender's default grey."""
    if material is None:
        return Surface(ior=MATT)
    if not material.use_nodes or material.node_tree is None:
        return Surface(color=tuple(material.diffuse_color[:3]), metallic=material.metallic, roughness=material.roughness,
                       ior=ior_of_specular(material.specular_intensity))  # fmt: skip
    output = material.node_tree.get_output_node("ALL")
    shader = sockets.source(output.inputs["Surface"]) if output else None
    if output and sockets.source(output.inputs["Displacement"]):
        notes.unsupported("displacement is ignored; use a Displace modifier")
    if shader is None:
        surface = Surface(color=(0, 0, 0), ior=MATT)
        if output and sockets.source(output.inputs["Volume"]):
            notes.unsupported("a volume without a surface; it is rendered as black")
        return surface
    surface = shader_surface(material, shader.node, notes)
    volume = sockets.source(output.inputs["Volume"])
    if volume is not None:
        read_volume(volume.node, surface, notes)
    return surface


def shader_surface(material, node, notes):
    """The surface of a shader node."""
    if node.bl_idname in mixes.SHADERS:
        return mixes.SHADERS[node.bl_idname](node, notes, lambda part, notes: shader_surface(material, part, notes))
    make = SHADERS.get(node.bl_idname)
    return fallback(material, node, notes) if make is None else make(node, notes)


def fallback(material, node, notes):
    notes.unsupported(
        f"the shader {node.name} ({node.bl_label}); rendered as matt, in the colour of the material's viewport display"
    )
    return Surface(color=tuple(material.diffuse_color[:3]), ior=MATT)


def ior_of_reflectance(f0):
    root = math.sqrt(min(max(f0, 0.0), 0.3))
    return (1 + root) / (1 - root)


def ior_of_specular(specular):
    return max(ior_of_reflectance(0.08 * specular), MATT)


def coat_ior(node, notes):
    """The index of the coat over the diffuse base: in Blender 3 from "Specular", later from "IOR" and its level."""
    specular = constant(node, "Specular", 0.5, notes)
    if node.inputs.get("Specular") is not None:
        return ior_of_specular(specular)
    ior = constant(node, "IOR", 1.5, notes)
    return max(ior_of_reflectance(2 * specular * ((ior - 1) / (ior + 1)) ** 2), MATT)


def principled(node, notes):
    surface, transmission = Surface(), constant(node, "Transmission", 0.0, notes)
    read_metallic_and_roughness(node, surface, transmission, notes)
    read_color(node, "Base Color", surface, notes)
    if surface.is_clear:
        surface.ior = constant(node, "IOR", 1.45, notes)
        if transmission < 1 or surface.metallic > 0:
            notes.approximate(f"transmission {transmission:.3g} and metallic {surface.metallic:.3g} count as 1 and 0: clear")
        if constant(node, "Transmission Roughness", 0.0, notes) > 0:
            notes.unsupported('"Transmission Roughness" is ignored; "Roughness" is used')
    else:
        surface.ior = coat_ior(node, notes)
        if transmission > 0:
            notes.approximate(f"transmission {transmission:.3g} counts as 0: opaque")
    for name in IGNORED_WEIGHTS:
        if sockets.socket(node, name) is not None and constant(node, name, 0.0, notes) != 0:
            notes.unsupported(f'"{sockets.socket(node, name).name}" is ignored')
    strength = constant(node, "Emission Strength", 1.0, notes)
    if strength > 0:
        surface.emission = tuple(strength * c for c in constant(node, "Emission", (0.0, 0.0, 0.0), notes))
    read_alpha(node, surface, notes)
    read_normals(node, surface, notes)
    layers.read_layers(node, surface, notes)
    return surface


def read_metallic_and_roughness(node, surface, transmission, notes):
    """Numbers or, of opaque surfaces, channels of images. Decides whether the surface is clear."""
    metallic = textures.channel_at(sockets.socket(node, "Metallic"), notes)
    surface.metallic = constant(node, "Metallic", 0.0, notes) if metallic is None else 1.0
    surface.is_clear = transmission >= 0.5 and surface.metallic < 0.5
    roughness = None if surface.is_clear else textures.channel_at(sockets.socket(node, "Roughness"), notes)
    surface.roughness = constant(node, "Roughness", 0.5, notes) if roughness is None else 1.0
    if roughness and metallic and not roughness.texture.has_same_mapping(metallic.texture):
        notes.unsupported('the image of "Metallic" is ignored, because its mapping differs from that of "Roughness"')
        metallic, surface.metallic = None, sockets.plain(sockets.socket(node, "Metallic").default_value)
    surface.roughness_image, surface.metallic_image = roughness, metallic
    surface.uv_maps.update(channel.texture.uv_map for channel in (roughness, metallic) if channel)


def read_color(node, name, surface, notes):
    """A colour, or an image by the UV map."""
    image = textures.texture_at(node.inputs.get(name), notes)
    if image is not None:
        surface.uv_maps.add(image.uv_map)
        surface.color, surface.color_image = (1.0, 1.0, 1.0), image
    else:
        surface.color = constant(node, name, GREY, notes)
    low, high = min(surface.color), max(surface.color)
    if low < 0 or high > 1:
        notes.approximate(f'"{name}" is clamped to the range from 0 to 1')
        surface.color = tuple(min(max(c, 0.0), 1.0) for c in surface.color)


def read_alpha(node, surface, notes):
    alpha = node.inputs.get("Alpha")
    origin = sockets.source(alpha)
    if origin is not None and origin.node.bl_idname == "ShaderNodeTexImage" and origin.name == "Alpha":
        if surface.color_image is not None and textures.texture_of(origin.node, notes) == surface.color_image:
            surface.uses_image_alpha = True
            return
        notes.unsupported('"Alpha" is an image other than that of "Base Color" and is ignored')
        return
    surface.alpha = min(max(constant(node, "Alpha", 1.0, notes), 0.0), 1.0)
    if surface.is_clear and surface.alpha < 1:
        notes.unsupported('"Alpha" of a clear material is ignored')


def read_normals(node, surface, notes):
    origin = sockets.source(node.inputs.get("Normal"))
    if origin is None:
        return
    maps = origin.node
    image = None
    if maps.bl_idname == "ShaderNodeNormalMap" and maps.space == "TANGENT" and not surface.is_clear:
        image = textures.texture_at(maps.inputs["Color"], notes)
    if image is None:
        notes.unsupported(f"{maps.name} at \"Normal\" is ignored")
        return
    surface.uv_maps.add(image.uv_map)
    if not image.transform.keeps_directions():
        notes.approximate("rotating the Mapping of a normal map also rotates its normals")
    surface.normal_image, surface.normal_strength = image, constant(maps, "Strength", 1.0, notes)


def glass(node, notes):
    surface = Surface(is_clear=True, roughness=constant(node, "Roughness", 0.0, notes), ior=constant(node, "IOR", 1.45, notes))
    read_color(node, "Color", surface, notes)
    read_normals(node, surface, notes)
    return surface


def refraction(node, notes):
    notes.approximate("Refraction BSDF is rendered as glass, which also reflects")
    return glass(node, notes)


def diffuse(node, notes):
    surface = Surface(ior=MATT)
    read_color(node, "Color", surface, notes)
    if constant(node, "Roughness", 0.0, notes) != 0:
        notes.unsupported('"Roughness" of a Diffuse BSDF is ignored')
    read_normals(node, surface, notes)
    return surface


def glossy(node, notes):
    surface = Surface(metallic=1.0, roughness=constant(node, "Roughness", 0.0, notes))
    read_color(node, "Color", surface, notes)
    read_normals(node, surface, notes)
    if constant(node, "Anisotropy", 0.0, notes) != 0:
        notes.unsupported('"Anisotropy" is ignored')
    notes.approximate("Glossy BSDF is rendered as metal, which reflects more at grazing angles")
    return surface


def emission(node, notes):
    strength = constant(node, "Strength", 1.0, notes)
    color = constant(node, "Color", (1.0, 1.0, 1.0), notes)
    return Surface(color=(0, 0, 0), ior=MATT, emission=tuple(max(strength * c, 0.0) for c in color))


SHADERS = {
    "ShaderNodeBsdfPrincipled": principled,
    "ShaderNodeBsdfGlass": glass,
    "ShaderNodeBsdfRefraction": refraction,
    "ShaderNodeBsdfDiffuse": diffuse,
    "ShaderNodeBsdfGlossy": glossy,
    "ShaderNodeBsdfAnisotropic": glossy,  # the name of Glossy BSDF from Blender 4.0
    "ShaderNodeEmission": emission,
}


def read_volume(node, surface, notes):
    """Absorption becomes glTF's, a colour after a distance. glTF cannot scatter."""
    if not surface.is_clear:
        return notes.unsupported("the volume of an opaque surface is ignored")
    medium = volumes.medium_of(node, notes)
    greatest = max(medium.absorption)
    if greatest > 0:
        surface.absorption = (tuple(math.exp(-a / greatest) for a in medium.absorption), 1 / greatest)
    if max(medium.scattering) > 0:
        surface.scattering = medium.parameters()
    return None


def medium_of(surface, material, millimetres, notes):
    """Parameters of the scene file's clear material that glTF lacks: scattering, a measured medium, a measured index.
    `millimetres`: the length of Blender's unit."""
    medium, settings = dict(surface.scattering), material.phasetree
    if settings.medium != "NODES":
        if medium or surface.absorption:
            notes.information(f"its volume shader is overridden by the measured medium {settings.medium.lower()}")
        medium = {"medium": settings.medium.lower(), "scale": millimetres}
    if settings.glass != "NODES":
        if surface.roughness > 0 or "KHR_materials_iridescence" in surface.extensions:
            notes.unsupported("the measured index is ignored: only smooth surfaces without a thin film have one")
        else:
            medium["glass"] = settings.glass.lower()
    return medium


def complete_phase(clear, medium):
    """Adds the parameters to the clear material of a phase."""
    if "glass" in medium:
        for name in ("ior", "abbe_number"):
            clear.pop(name, None)
    if "medium" in medium:
        for name in ("absorption", "color", "color_distance"):
            clear.pop(name, None)
    clear.update(medium)


def gltf_of(surface, name, files, notes, is_opaque=False):
    """A glTF material. `files` writes textures. `is_opaque`: whether a clear surface is made opaque."""
    pbr = {"baseColorFactor": [*surface.color, surface.alpha], "metallicFactor": surface.metallic,
           "roughnessFactor": surface.roughness}  # fmt: skip
    made = {"name": name, "pbrMetallicRoughness": pbr}
    extensions = {"KHR_materials_ior": {"ior": surface.ior}, **copy.deepcopy(surface.extensions)}
    if surface.color_image is not None and (found := files.texture(surface.color_image, notes)):
        pbr["baseColorTexture"] = found
    if surface.roughness_image or surface.metallic_image:
        pbr["metallicRoughnessTexture"] = files.metallic_and_roughness(surface, notes)
    if surface.normal_image is not None and (found := files.texture(surface.normal_image, notes)):
        made["normalTexture"] = {**found, "scale": surface.normal_strength}
        if surface.is_bump_on_coat:
            extensions["KHR_materials_clearcoat"]["clearcoatNormalTexture"] = made["normalTexture"]
    strength = max(surface.emission)
    if strength > 0:
        made["emissiveFactor"] = [c / strength for c in surface.emission]
        extensions["KHR_materials_emissive_strength"] = {"emissiveStrength": strength}
    if surface.is_clear and not is_opaque:
        volume = {"thicknessFactor": 1}
        if surface.absorption:
            volume["attenuationColor"], volume["attenuationDistance"] = list(surface.absorption[0]), surface.absorption[1]
        extensions.update({"KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_volume": volume})
    elif surface.alpha < 1 or surface.uses_image_alpha:
        made["alphaMode"] = "BLEND"
    made["extensions"] = extensions
    return made
