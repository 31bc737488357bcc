"""Opaque surfaces as materials of the scene file, for mixes, which glTF does not have."""

import os

from . import images, textures

COAT_IOR = 1.5
CHANNELS = ("red", "green", "blue")


class MaterialFiles:
    """Writes images of the scene file's materials into its folder, each once."""

    def __init__(self, folder, stem):
        self._folder, self._stem, self._written = folder, stem, {}

    def color(self, texture, notes):
        """A `mesh_image` of colours, or None."""
        found = self._file(texture.image.original.as_pointer(), lambda: images.png_or_jpeg(texture.image))
        return self._with_mapping(found, texture, notes)

    def number(self, channel, notes, low=0.0, high=1.0):
        """A `mesh_image` of numbers, or None."""

        def content():
            values = images.values_of(channel)
            return None if values is None else (images.png_of_numbers(values, values, values), "image/png")

        key = (channel.texture.image.original.as_pointer(), channel.number)
        made = self._with_mapping(self._file(key, content), channel.texture, notes)
        if made and (low, high) != (0.0, 1.0):
            made["mesh_image"]["range"] = [low, high]
        return made

    def _file(self, key, make):
        if key not in self._written:
            content = make()
            self._written[key] = None
            if content:
                extension = ".jpg" if content[1] == "image/jpeg" else ".png"
                name = f"{self._stem}.image{len(self._written)}{extension}"
                with open(os.path.join(self._folder, name), "wb") as file:
                    file.write(content[0])
                self._written[key] = name
        return self._written[key]

    @staticmethod
    def _with_mapping(file, texture, notes):
        if file is None:
            notes.unsupported(f'the image "{texture.image.name}" cannot be read and is ignored')
            return None
        t, made = texture.transform, {"file": file}
        if t != textures.Transform():
            if t.rotation or any(t.offset) or min(t.scale) <= 0:
                notes.unsupported("in a mix, images are neither moved nor rotated")
            made["repeat"] = [abs(s) or 1 for s in t.scale]
        return {"mesh_image": made}


def material_of(surface, files, notes):
    """The material of the scene file for an opaque surface."""
    if surface.mixture:
        first, second, amount = surface.mixture
        if not isinstance(amount, float):
            amount = files.number(amount, notes) or amount.fallback
        return {"mix": {"first": material_of(first, files, notes), "second": material_of(second, files, notes), "amount": amount}}
    color = surface.color_image and files.color(surface.color_image, notes) or list(surface.color)
    bumps = {}
    if surface.normal_image is not None and (found := files.color(surface.normal_image, notes)):
        bumps = {"normal_map": {**found["mesh_image"], "strength": surface.normal_strength}}
    radiance = max(surface.emission)
    light = [c / radiance for c in surface.emission] if radiance > 0 else None
    if surface.is_matt and not surface.extensions:
        if light:
            return {"glowing": {"light": light, "radiance": radiance, "color": color}}
        return {"diffuse": {"color": color, **bumps}}
    # Roughness is squared: α of GGX is interpolated by its image, which differs little.
    alpha = surface.roughness**2
    if surface.metallic == 1 and not surface.metallic_image and not surface.extensions and not light:
        if surface.roughness_image:
            alpha = files.number(surface.roughness_image, notes) or surface.roughness_image.fallback ** 2
        return {"conductor": {"reflectance": color, "roughness": alpha, **bumps}}
    roughness, metallic = surface.roughness, surface.metallic
    if surface.roughness_image:
        roughness = files.number(surface.roughness_image, notes) or surface.roughness_image.fallback
    if surface.metallic_image:
        metallic = files.number(surface.metallic_image, notes) or surface.metallic_image.fallback
    layers = layers_of(surface, notes)
    if light:
        layers.update(emission_radiance=radiance, emission_color=light)
    return {"principled": {"base_color": color, "base_metalness": metallic, "specular_roughness": roughness,
                           "specular_ior": min(max(surface.ior, 1.0), 4.0), **layers, **bumps}}  # fmt: skip


def layers_of(surface, notes):
    made = {}
    for name, values in surface.extensions.items():
        if name == "KHR_materials_clearcoat":
            made.update(coat_weight=values["clearcoatFactor"], coat_roughness=values["clearcoatRoughnessFactor"],
                        coat_ior=COAT_IOR)  # fmt: skip
        elif name == "KHR_materials_sheen":
            color = values["sheenColorFactor"]
            if max(color) > 1e-3:
                made.update(fuzz_weight=max(color), fuzz_color=[c / max(color) for c in color],
                            fuzz_roughness=values["sheenRoughnessFactor"])  # fmt: skip
        elif name == "KHR_materials_specular":
            made["specular_color"] = [min(c, 1.0) for c in values["specularColorFactor"]]
        else:
            notes.unsupported(f"{WORDS.get(name, name)} within a mix is ignored")
    return made


WORDS = {"KHR_materials_anisotropy": "anisotropy", "KHR_materials_iridescence": "a thin film"}
