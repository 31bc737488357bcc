"""PNG pictures as bytes, and how much two of them differ."""
import struct
import zlib


def pixels(png):
    """The rows of an 8-bit image as bytes, and the bytes of a pixel (PNG, ISO/IEC 15948)."""
    at, data, size = 8, b"", None
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at:at + 8])
        body = png[at + 8:at + 8 + length]
        if kind == b"IHDR":
            size = struct.unpack(">IIBBBBB", body)
        elif kind == b"IDAT":
            data += body
        at += 12 + length
    width, height, channels = size[0], size[1], {2: 3, 6: 4}[size[3]]
    raw, rows, last, stride = zlib.decompress(data), [], bytearray(width * channels), width * channels
    for y in range(height):
        mode, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            left = row[i - channels] if i >= channels else 0
            up, corner = last[i], last[i - channels] if i >= channels else 0
            if mode == 1:
                row[i] = (row[i] + left) & 255
            elif mode == 2:
                row[i] = (row[i] + up) & 255
            elif mode == 3:
                row[i] = (row[i] + (left + up) // 2) & 255
            elif mode == 4:
                p = left + up - corner
                a, b, c = abs(p - left), abs(p - up), abs(p - corner)
                row[i] = (row[i] + (left if a <= b and a <= c else up if b <= c else corner)) & 255
        rows.append(row)
        last = row
    return rows, channels


def difference(a, b):
    """The mean difference of two pictures, from 0 to 255."""
    rows_a, n = pixels(a)
    rows_b, _ = pixels(b)
    step = 5 * n
    total = count = 0
    for ra, rb in zip(rows_a[::5], rows_b[::5]):
        for i in range(0, len(ra), step):
            total += abs(ra[i] - rb[i])
            count += 1
    return total / count
