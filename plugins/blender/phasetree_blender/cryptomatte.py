"""Cryptomatte: its IDs by the names that Blender's node knows.

phasetree names the materials of glTF meshes "gltf NAME". Here, their IDs are replaced by those of NAME.

Reference: Friedman & Jones, Fully Automatic ID Mattes with Support for Motion Blur and Transparency, 2015, and the
Cryptomatte specification 1.2.0.
"""

import json

import numpy as np

LAYER = "CryptoMaterial"
OF_MESHES = "gltf "


def murmur3(data):
    """MurmurHash3_x86_32 with the seed 0."""
    bits, result = 0xFFFFFFFF, 0
    rest = len(data) % 4

    def mixed(block):
        block = block * 0xCC9E2D51 & bits
        return ((block << 15 | block >> 17) & bits) * 0x1B873593 & bits

    for i in range(0, len(data) - rest, 4):
        result ^= mixed(int.from_bytes(data[i : i + 4], "little"))
        result = ((result << 13 | result >> 19) & bits) * 5 + 0xE6546B64 & bits
    if rest:
        result ^= mixed(int.from_bytes(data[-rest:], "little"))
    result ^= len(data)
    result = (result ^ result >> 16) * 0x85EBCA6B & bits
    result = (result ^ result >> 13) * 0xC2B2AE35 & bits
    return result ^ result >> 16


def id_of(name):
    """The bits of the float by which a pixel names a material. Infinite, NaN and subnormal floats are avoided."""
    bits = murmur3(name.encode())
    return bits ^ (1 << 23) if bits >> 23 & 255 in (0, 255) else bits


def manifest_in(attributes):
    """{name: ID} of the layer, by the attributes of an EXR file. Empty without such a layer."""
    for name, value in attributes.items():
        if name.startswith("cryptomatte/") and name.endswith("/name") and value.decode() == LAYER:
            return {k: int(v, 16) for k, v in json.loads(attributes[name.removesuffix("name") + "manifest"]).items()}
    return {}


def renamed(channels, attributes):
    """Replaces IDs in the layer's channels. Returns {name: ID} by Blender's names."""
    manifest = manifest_in(attributes)
    names = {name.removeprefix(OF_MESHES): old for name, old in manifest.items()}
    for channel, pixels in channels.items():
        if not channel.startswith(LAYER) or channel[-1] not in "RB":  # G and A are coverages
            continue
        bits, new = pixels.view(np.uint32), pixels.copy()
        for name, old in names.items():
            new.view(np.uint32)[bits == old] = id_of(name)
        channels[channel] = new
    return {name: id_of(name) for name in names}


def metadata(view_layer, ids):
    """The fields of a render result by which Blender's Cryptomatte node finds names: {field: value}."""
    layer = f"{view_layer}.{LAYER}"
    prefix = f"cryptomatte/{murmur3(layer.encode()):08x}"[: len("cryptomatte/") + 7]
    manifest = json.dumps({name: f"{value:08x}" for name, value in ids.items()}, ensure_ascii=False)
    return {f"{prefix}/name": layer, f"{prefix}/hash": "MurmurHash3_32", f"{prefix}/conversion": "uint32_to_float32",
            f"{prefix}/manifest": manifest}  # fmt: skip
