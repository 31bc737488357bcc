#!/usr/bin/env python3
"""Writes the table of tracer/src/spectrum/upsampling.cpp: three spectra, one for each primary colour of Rec.709.

They are smooth, by the sum of squared differences between neighbours, that add up to 1 at every wavelength,
are nowhere below 0, and whose colours under D65 are exactly red, green and blue. The idea is that of Mallett & Yuksel,
Spectral Primary Decomposition for Rendering with sRGB Reflectance, EGSR 2019; the numbers are our own, by our colour
matching functions. Spectra that would be below 0 are held at 0 there, and the rest is solved anew, until none is.
"""
from math import exp

D65 = [49.9755, 54.6482, 82.7549, 91.486, 93.4318, 86.6823, 104.865, 117.008, 117.812, 114.861, 115.923, 108.811,
       109.354, 107.802, 104.79, 107.689, 104.405, 104.046, 100, 96.3342, 95.788, 88.6856, 90.0062, 89.5991, 87.6987,
       83.2886, 83.6992, 80.0268, 80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.349, 61.604, 69.8856, 75.087,
       63.5927, 46.4182, 66.8054, 63.3828]
FIRST, STEP, NODES = 380, 10, len(D65)
RGB = [[3.2404542, -1.5371385, -0.4985314], [-0.9692660, 1.8760108, 0.0415560], [0.0556434, -0.2040259, 1.0572252]]


def lobe(x, middle, below, above):
    return exp(-0.5 * ((x - middle) / (below if x < middle else above)) ** 2)


def matching(x):
    return [1.056 * lobe(x, 599.8, 37.9, 31.0) + 0.362 * lobe(x, 442.0, 16.0, 26.7) - 0.065 * lobe(x, 501.1, 20.4, 26.2),
            0.821 * lobe(x, 568.8, 46.9, 40.5) + 0.286 * lobe(x, 530.9, 16.3, 31.1),
            1.217 * lobe(x, 437.0, 11.8, 36.0) + 0.681 * lobe(x, 459.0, 26.0, 13.8)]


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
    """Of linear equations whose right sides are the last column, by elimination."""
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
    print("    {%.7ff, %.7ff, %.7ff},  // %d nm" % (*row, FIRST + STEP * i))
