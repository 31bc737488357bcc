"""Images of Blender as bytes of files."""

import os
import struct
import zlib

import bpy
import numpy as np

LUMINANCE = (0.2126, 0.7152, 0.0722)

SIGNATURES = {b"\x89PNG\r\n\x1a\n": "image/png", b"\xff\xd8\xff": "image/jpeg"}


def stored_bytes(image):
    """The bytes of the image's file, packed or on disk; None if there is none, or if it was changed in Blender."""
    if image.is_dirty or image.source != "FILE":
        return None
    if image.packed_file is not None:
        return bytes(image.packed_file.data)
    path = bpy.path.abspath(image.filepath, library=image.library)
    if not os.path.isfile(path):
        return None
    with open(path, "rb") as file:
        return file.read()


def png_or_jpeg(image):
    """(bytes, MIME type), or None if it cannot be read. Other formats become PNG, with 8 bits per channel."""
    content = stored_bytes(image)
    for signature, mime in SIGNATURES.items():
        if content and content.startswith(signature):
            return content, mime
    pixels = pixels_of(image)
    return None if pixels is None else (png_of(image, *pixels), "image/png")


def pixels_of(image):
    """The image's numbers, the top row first: colours (height, width, 3) and alpha (height, width, 1)."""
    width, height = image.size
    if width == 0 or height == 0:
        return None
    pixels = np.empty(width * height * image.channels, dtype=np.float32)
    image.pixels.foreach_get(pixels)
    pixels = pixels.reshape(height, width, image.channels)[::-1]
    colors = pixels[..., :3] if image.channels >= 3 else np.repeat(pixels[..., :1], 3, axis=2)
    return colors, pixels[..., 3:4] if image.channels == 4 else np.ones_like(colors[..., :1])


def values_of(channel):
    """The linear numbers (height, width) of a channel of an image, the top row first; None if it cannot be read."""
    image = channel.texture.image
    pixels = pixels_of(image)
    if pixels is None:
        return None
    colors, _ = pixels
    space = image.colorspace_settings
    if not (image.is_float or space.is_data or space.name.startswith("Linear")):
        colors = linear(colors)
    return colors @ np.array(LUMINANCE, dtype=np.float32) if channel.number is None else colors[..., channel.number]


def png_of_numbers(*channels):
    """A PNG whose channels are arrays (height, width) of numbers from 0 to 1, or None for 1. Channels are resampled to the
    largest height and width among them."""
    height, width = (max(c.shape[axis] for c in channels if c is not None) for axis in (0, 1))
    rgba = np.full((height, width, 4), 255, dtype=np.uint8)
    for number, values in enumerate(channels):
        if values is not None:
            rows, columns = np.arange(height) * values.shape[0] // height, np.arange(width) * values.shape[1] // width
            rgba[..., number] = np.rint(255 * np.clip(values, 0, 1)).astype(np.uint8)[rows[:, None], columns]
    return encode_png(rgba)


def linear(colors):
    """Converts sRGB-encoded values to linear ones."""
    return np.where(colors <= 0.04045, colors / 12.92, ((colors + 0.055) / 1.055) ** 2.4)


def png_of(image, colors, alpha):
    if image.is_float and not image.colorspace_settings.is_data:  # linear
        low = np.clip(colors, 0, 1)
        colors = np.where(low <= 0.0031308, 12.92 * low, 1.055 * np.power(low, 1 / 2.4) - 0.055)
    return encode_png(np.rint(255 * np.clip(np.concatenate([colors, alpha], axis=2), 0, 1)).astype(np.uint8))


def radiance_of(image):
    """A Radiance file (.hdr) of the image, or None if it cannot be read."""
    pixels = pixels_of(image)
    if pixels is None:
        return None
    colors = np.maximum(pixels[0], 0)
    if not image.is_float:
        colors = linear(colors)
    height, width, _ = colors.shape
    largest = colors.max(axis=2)
    exponent = np.where(largest > 1e-32, np.frexp(np.maximum(largest, 1e-32))[1], -128)
    mantissa = np.minimum(colors * np.exp2(8.0 - exponent)[..., None], 255)
    rgbe = np.concatenate([mantissa, (exponent + 128)[..., None]], axis=2).astype(np.uint8)
    return f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode() + rgbe.tobytes()


def encode_png(rgba):
    height, width, _ = rgba.shape
    rows = np.zeros((height, 1 + 4 * width), dtype=np.uint8)  # each begins with its filter, 0
    rows[:, 1:] = rgba.reshape(height, 4 * width)

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows.tobytes(), 1)) + chunk(b"IEND", b"")
