#!/usr/bin/env python3
"""Prints the table of tracer/src/spectrum/primaries.cpp: three spectra, one for each primary colour of Rec.709.

They are smooth, by the sum of squared differences between neighbours, that add up to 1 at every wavelength,
are nowhere below 0, and whose colours under D65 are exactly red, green and blue. The idea is that of Mallett & Yuksel,
Spectral Primary Decomposition for Rendering with sRGB Reflectance, EGSR 2019; the numbers are our own, by the colour
matching functions in colour_matching.cpp. Spectra that would be below 0 are held at 0 there, and the rest is solved
again, until none is.
"""
import re
from pathlib import Path

SPECTRUM = Path(__file__).resolve().parent.parent / "src" / "spectrum"
FIRST, LAST, STEP = 380, 780, 10
NODES = (LAST - FIRST) // STEP + 1
RGB = [[3.2404542, -1.5371385, -0.4985314], [-0.9692660, 1.8760108, 0.0415560], [0.0556434, -0.2040259, 1.0572252]]


def numbers(file):
    """Those of the table in a file of C++."""
    text = re.sub(r"//.*", "", (SPECTRUM / file).read_text())
    table = re.search(r"array<[^>]*> \w+\{(.*?)\};", text, re.S).group(1)
    return [float(n) for n in re.findall(r"[0-9]+(?:\.[0-9]+)?", table)]


D65 = numbers("daylight.cpp")
OBSERVER = numbers("colour_matching.cpp")
assert len(D65) == NODES and len(OBSERVER) == 3 * ((LAST - FIRST) // 5 + 1)


def matching(x):
    """CIE's three functions at a wavelength, linear between steps of 5 nm."""
    node, part = divmod((x - FIRST) / 5, 1)
    below, above = (OBSERVER[3 * int(n):3 * int(n) + 3] for n in (node, node + 1))
    return [(1 - part) * a + part * b for a, b in zip(below, above)]


def colours_of_nodes():
    """How much each node adds to red, green and blue, of spectra that are linear between the nodes."""
    colours = [[0.0] * NODES for _ in range(3)]
    for cell in range(FIRST, FIRST + STEP * (NODES - 1)):
        x = cell + 0.5
        node, part = divmod(x - FIRST, STEP)
        node, part = int(node), part / STEP
        light = (1 - part) * D65[node] + part * D65[node + 1]
        for colour, row in zip(colours, RGB):
            weight = light * sum(a * b for a, b in zip(row, matching(x)))
            colour[node] += (1 - part) * weight
            colour[node + 1] += part * weight
    return [[value / sum(colour) for value in colour] for colour in colours]


def solved(rows):
    """The solution of linear equations, whose right-hand sides are the last column, by elimination."""
    n = len(rows)
    for i in range(n):
        pivot = max(range(i, n), key=lambda j: abs(rows[j][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for j in range(i + 1, n):
            if rows[j][i]:
                factor = rows[j][i] / rows[i][i]
                rows[j] = [a - factor * b for a, b in zip(rows[j], rows[i])]
    x = [0.0] * n
    for i in reversed(range(n)):
        x[i] = (rows[i][n] - sum(rows[i][j] * x[j] for j in range(i + 1, n))) / rows[i][i]
    return x


def smoothest(colours, held):
    """The spectra one behind the other, of which the `held` values are 0: from the equations of Lagrange."""
    values = 3 * NODES
    conditions = [({s * NODES + i: 1.0 for s in range(3)}, 1.0) for i in range(NODES)]
    conditions += [({s * NODES + i: colours[c][i] for i in range(NODES)}, float(s == c))
                   for s in range(2) for c in range(3)]
    conditions += [({i: 1.0}, 0.0) for i in held]
    size = values + len(conditions)
    rows = [[0.0] * (size + 1) for _ in range(size)]
    for s in range(3):
        for i in range(s * NODES, (s + 1) * NODES - 1):
            for a, b, sign in ((i, i, 1), (i, i + 1, -1), (i + 1, i, -1), (i + 1, i + 1, 1)):
                rows[a][b] += 2.0 * sign
    for k, (condition, right) in enumerate(conditions):
        for i, factor in condition.items():
            rows[values + k][i] = rows[i][values + k] = factor
        rows[values + k][size] = right
    return solved(rows)[:values]


colours, held = colours_of_nodes(), set()
while True:
    spectra = smoothest(colours, sorted(held))
    below = {i for i, value in enumerate(spectra) if value < -1e-9}
    if not below:
        break
    held |= below
for i in range(NODES):
    row = [max(spectra[s * NODES + i], 0.0) for s in range(3)]
    print("    {%.7f, %.7f, %.7f},  // %d nm" % (*row, FIRST + STEP * i))
