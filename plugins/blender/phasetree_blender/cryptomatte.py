"""Cryptomatte: its IDs by the names that Blender's node knows.

phasetree names the materials of glTF meshes "gltf NAME", and phases of files after their objects. Here, their IDs are
replaced by those of Blender's names. The command's layer of objects does not tell apart what is in one glTF file, so the
layer of objects is made of that of materials: with it, each object has materials of its own.

Reference: Friedman & Jones, Fully Automatic ID Mattes with Support for Motion Blur and Transparency, 2015, and the
Cryptomatte specification 1.2.0.
"""

import json

import numpy as np

OF_MESHES = "gltf "
# Layers in Blender, the layers of the command that have their coverages, and the planes.
MATERIAL, OBJECT, PHASE = "CryptoMaterial", "CryptoObject", "CryptoAsset"  # Blender's node knows only these
SOURCES = {MATERIAL: "CryptoMaterial", OBJECT: "CryptoMaterial", PHASE: "CryptoPhase"}
PLANES = {MATERIAL: "crypto_material", OBJECT: "crypto_material", PHASE: "crypto_phase"}


def layers_of(view_layer):
    """The layers that a view layer asks for."""
    wanted = {MATERIAL: view_layer.use_pass_cryptomatte_material, OBJECT: view_layer.use_pass_cryptomatte_object,
              PHASE: view_layer.use_pass_cryptomatte_asset}  # fmt: skip
    return [layer for layer, is_wanted in wanted.items() if is_wanted]


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


def manifest_in(attributes, layer):
    """{name: ID} of a layer, by the attributes of an EXR file. Empty without such a layer."""
    for name, value in attributes.items():
        if name.startswith("cryptomatte/") and name.endswith("/name") and value.decode() == layer:
            return {k: int(v, 16) for k, v in json.loads(attributes[name.removesuffix("name") + "manifest"]).items()}
    return {}


def name_in(layer, name, meanings):
    """The name in Blender of what the command calls by a name. `meanings`: names of objects and of materials."""
    if name.strip() in meanings:
        own = name.strip()
    else:
        own = name.removeprefix(OF_MESHES)
    found_object, found_material = meanings.get(own, (own, own))
    return found_object if layer == OBJECT else found_material


def renamed(layer, channels, attributes, meanings):
    """The channels of a layer with IDs by Blender's names, and {name: ID}. The file's channels are kept."""
    source, made, ids = SOURCES[layer], {}, {}
    manifest = manifest_in(attributes, source)
    news = {old: name_in(layer, name, meanings) for name, old in manifest.items()}
    for channel, pixels in channels.items():
        if not channel.startswith(source):
            continue
        new = pixels.copy()
        if channel[-1] in "RB":  # G and A are coverages
            for old, name in news.items():
                new.view(np.uint32)[pixels.view(np.uint32) == old] = id_of(name)
        made[layer + channel.removeprefix(source)] = new
    ids.update({name: id_of(name) for name in news.values()})
    return made, ids


def metadata(view_layer, layer, ids):
    """The fields of a render result by which Blender's Cryptomatte node finds names: {field: value}."""
    layer = f"{view_layer}.{layer}"
    prefix = f"cryptomatte/{murmur3(layer.encode()):08x}"[: len("cryptomatte/") + 7]
    manifest = json.dumps({name: f"{value:08x}" for name, value in ids.items()}, ensure_ascii=False)
    return {f"{prefix}/name": layer, f"{prefix}/hash": "MurmurHash3_32", f"{prefix}/conversion": "uint32_to_float32",
            f"{prefix}/manifest": manifest}  # fmt: skip
