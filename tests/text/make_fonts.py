#!/usr/bin/env python3
"""Makes the fonts of these tests: letters.ttf of quadratic curves and letters.otf of cubic ones.

The em is 1000 units. Both fonts have the same letters, whose shapes are known:

    I   a bar 100 wide and 700 high, from x = 50; it advances by 200
    O   a ring about (300, 350) of radii 300 and 200; it advances by 600
    X   two bars that cross, 100 thick and 700 long, one contour each; it advances by 700
    B   a square of 400 with a hole of 200 in it and a square of 100 in the hole; it advances by 500

and a space of 300. Between I and O the font takes away 100. Needs Debian's python3-fonttools.
"""
import math
from pathlib import Path

from fontTools.feaLib.builder import addOpenTypeFeaturesFromString
from fontTools.fontBuilder import FontBuilder
from fontTools.pens.t2CharStringPen import T2CharStringPen
from fontTools.pens.ttGlyphPen import TTGlyphPen

ADVANCE = {".notdef": 500, "space": 300, "I": 200, "O": 600, "X": 700, "B": 500}
LEFT = {".notdef": 0, "space": 0, "I": 50, "O": 0, "X": 0, "B": 50}  # where the outlines begin
FEATURES = "languagesystem DFLT dflt; feature kern { pos I O -100; } kern;"


def rectangle(pen, x0, y0, x1, y1, clockwise):
    corners = [(x0, y0), (x0, y1), (x1, y1), (x1, y0)]
    polygon(pen, corners if clockwise else corners[::-1])


def polygon(pen, corners):
    pen.moveTo(corners[0])
    for corner in corners[1:]:
        pen.lineTo(corner)
    pen.closePath()


def circle(pen, x, y, r, clockwise, cubic):
    """Of eight quadratic arcs or four cubic ones."""
    count = 4 if cubic else 8
    step = (-1 if clockwise else 1) * 2 * math.pi / count
    at = lambda angle, away=1.0: (round(x + r * away * math.cos(angle)), round(y + r * away * math.sin(angle)))
    pen.moveTo(at(0))
    for i in range(count):
        a, b = i * step, (i + 1) * step
        if cubic:
            k = 4 / 3 * math.tan(step / 4)
            pen.curveTo((round(x + r * (math.cos(a) - k * math.sin(a))), round(y + r * (math.sin(a) + k * math.cos(a)))),
                        (round(x + r * (math.cos(b) + k * math.sin(b))), round(y + r * (math.sin(b) - k * math.cos(b)))),
                        at(b))
        else:
            pen.qCurveTo(at((a + b) / 2, 1 / math.cos(step / 2)), at(b))
    pen.closePath()


def draw(pen, name, cubic):
    # The outer contours of TrueType run clockwise, those of PostScript counter-clockwise.
    outer = not cubic
    if name == "I":
        rectangle(pen, 50, 0, 150, 700, outer)
    elif name == "O":
        circle(pen, 300, 350, 300, outer, cubic)
        circle(pen, 300, 350, 200, not outer, cubic)
    elif name == "X":
        rectangle(pen, 300, 0, 400, 700, outer)
        rectangle(pen, 0, 300, 700, 400, outer)
    elif name == "B":
        rectangle(pen, 50, 0, 450, 400, outer)
        rectangle(pen, 150, 100, 350, 300, not outer)
        rectangle(pen, 200, 150, 300, 250, outer)


def make(path, cubic):
    names = list(ADVANCE)
    font = FontBuilder(1000, isTTF=not cubic)
    font.setupGlyphOrder(names)
    font.setupCharacterMap({ord(n): n for n in names if len(n) == 1} | {32: "space"})
    glyphs = {}
    for name in names:
        pen = T2CharStringPen(ADVANCE[name], None) if cubic else TTGlyphPen(None)
        draw(pen, name, cubic)
        glyphs[name] = pen.getCharString() if cubic else pen.glyph()
    if cubic:
        font.setupCFF("PhasetreeLetters", {}, glyphs, {})
    else:
        font.setupGlyf(glyphs)
    font.setupHorizontalMetrics({n: (a, LEFT[n]) for n, a in ADVANCE.items()})
    font.setupHorizontalHeader(ascent=800, descent=-200)
    font.setupNameTable({"familyName": "Phasetree Letters", "styleName": "Regular"})
    font.setupOS2()
    font.setupPost()
    addOpenTypeFeaturesFromString(font.font, FEATURES)
    font.font.recalcTimestamp = False
    font.font["head"].created = font.font["head"].modified = 0
    font.save(path)


if __name__ == "__main__":
    folder = Path(__file__).parent
    make(folder / "letters.ttf", cubic=False)
    make(folder / "letters.otf", cubic=True)
