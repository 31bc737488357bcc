"""Writes the images of materials into a glTF file, each once."""

import numpy as np

from . import images
from .textures import Transform


class TextureFiles:
    def __init__(self, glb):
        self._glb, self._written = glb, {}

    def texture(self, texture, notes):
        """A material's reference to a texture, or None if its image cannot be read."""
        image = texture.image
        written = self._write(image.original.as_pointer(), lambda: images.png_or_jpeg(image), image, notes)
        return self._with_mapping(texture, written)

    def metallic_and_roughness(self, surface, notes):
        """A reference to a texture whose green is the roughness and whose blue is how metallic the surface is."""
        channels = surface.roughness_image, surface.metallic_image
        texture = next(channel for channel in channels if channel).texture
        if has_gltf_layout(surface) and (found := self.texture(texture, notes)):
            return found
        key = tuple(channel and (channel.texture.image.original.as_pointer(), channel.number, channel.fallback)
                    for channel in channels)  # fmt: skip

        def content():
            return images.png_of_numbers(None, *(numbers_of(channel, notes) for channel in channels)), "image/png"

        return self._with_mapping(texture, self._write(key, content, texture.image, notes))

    def _write(self, key, content, image, notes):
        if key not in self._written:
            made = content()
            self._written[key] = self._glb.texture(*made) if made else None
            if made is None:
                note_unreadable(image, notes)
        return self._written[key]

    @staticmethod
    def _with_mapping(texture, written):
        if written is None or texture.transform == Transform():
            return written
        t = texture.transform
        placed = {"offset": list(t.offset), "rotation": t.rotation, "scale": list(t.scale)}
        return {**written, "extensions": {"KHR_texture_transform": placed}}


def numbers_of(channel, notes):
    """The numbers of a channel, which may be None."""
    if channel is None:
        return None
    values = images.values_of(channel)
    if values is None:
        note_unreadable(channel.texture.image, notes)
        return np.full((1, 1), channel.fallback)
    return values


def note_unreadable(image, notes):
    notes.unsupported(f'the image "{image.name}" cannot be read and is ignored')


def has_gltf_layout(surface):
    """Whether an image can be used as it is."""
    roughness, metallic = surface.roughness_image, surface.metallic_image
    return (
        roughness is not None
        and roughness.number == 1
        and roughness.texture.image.colorspace_settings.is_data
        and (surface.metallic == 0 if metallic is None else metallic.number == 2 and metallic.texture == roughness.texture)
    )
