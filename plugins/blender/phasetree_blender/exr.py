"""Reads the OpenEXR files that phasetree writes: single-part scan-line files of floats, uncompressed or
with ZIP compression."""

import struct
import zlib

import numpy as np

LINES_PER_BLOCK = {0: 1, 2: 1, 3: 16}  # by compression: none, ZIPS, ZIP


def text_at(data, at):
    end = data.index(b"\0", at)
    return data[at:end].decode(), end + 1


def header_of(data):
    if data[:4] != b"\x76\x2f\x31\x01":
        raise ValueError("not an OpenEXR file")
    at, attributes = 8, {}
    while data[at]:
        name, at = text_at(data, at)
        _, at = text_at(data, at)
        (size,) = struct.unpack_from("<i", data, at)
        attributes[name] = data[at + 4 : at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def channels_of(data):
    at, names = 0, []
    while data[at]:
        name, at = text_at(data, at)
        if struct.unpack_from("<i", data, at)[0] != 2:
            raise ValueError(f"the channel {name} does not consist of 32-bit floats")
        names.append(name)
        at += 16
    return names


def unzipped(data, size):
    if len(data) == size:  # did not get smaller
        return data
    decoded = np.frombuffer(zlib.decompress(data), dtype=np.uint8)
    sums = np.cumsum(decoded.astype(np.int64) - 128) + 128  # the first byte is stored as it is
    halves = np.empty(size, dtype=np.uint8)
    middle = (size + 1) // 2
    halves[0::2], halves[1::2] = sums[:middle] & 255, sums[middle:] & 255
    return halves.tobytes()


def read(path):
    """{channel: float32 (height, width)}, the top row first."""
    return read_with_attributes(path)[0]


def read_with_attributes(path):
    """The channels, and the header's attributes as {name: bytes}."""
    with open(path, "rb") as file:
        data = file.read()
    attributes, at = header_of(data)
    compression = attributes["compression"][0]
    if compression not in LINES_PER_BLOCK:
        raise ValueError(f"the compression {compression} is not supported")
    x0, y0, x1, y1 = struct.unpack("<4i", attributes["dataWindow"])
    width, height, lines = x1 - x0 + 1, y1 - y0 + 1, LINES_PER_BLOCK[compression]
    names = channels_of(attributes["channels"])
    pixels = np.empty((height, len(names), width), dtype=np.float32)
    for offset in struct.unpack_from(f"<{-(-height // lines)}Q", data, at):
        y, size = struct.unpack_from("<ii", data, offset)
        first = y - y0
        count = min(lines, height - first)
        whole = 4 * width * len(names) * count
        block = data[offset + 8 : offset + 8 + size]
        block = unzipped(block, whole) if compression else block
        pixels[first : first + count] = np.frombuffer(block, dtype="<f4").reshape(count, len(names), width)
    return {name: pixels[:, i] for i, name in enumerate(names)}, attributes
