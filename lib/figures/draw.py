#!/usr/bin/env python3
"""Draws the figures of lib/README.md as SVG files beside this script. The curves are computed, not sketched.

    python3 lib/figures/draw.py

Colours follow the reader's light or dark mode; each figure also has a background of its own, so that it can be read
where the page's mode is not the reader's.
"""

import math
import pathlib

STYLE = """<style>
.card{fill:#fcfcfa;stroke:#d8d8d2}.ink{stroke:#2b2f36;fill:none}.thin{stroke:#8a8f98;fill:none}
text{font:13px sans-serif;fill:#2b2f36}.small{font-size:11.5px;fill:#565c66}.it{font-style:italic}
.a{stroke:#1f66ad;fill:none}.b{stroke:#c2620a;fill:none}.fa{fill:#1f66ad}.fb{fill:#c2620a}.fi{fill:#2b2f36}
.ta{fill:#1f66ad}.tb{fill:#b25605}.wa{fill:#1f66ad;fill-opacity:.16}.wb{fill:#c2620a;fill-opacity:.18}
.gone{stroke:#a9adb4;fill:none}.tgone{fill:#9298a1}
@media (prefers-color-scheme:dark){
.card{fill:#191c21;stroke:#3a3f47}.ink{stroke:#e3e6ea}.thin{stroke:#868d97}text{fill:#e3e6ea}.small{fill:#a9b0ba}
.a{stroke:#6cb2f7}.b{stroke:#f5a14b}.fa{fill:#6cb2f7}.fb{fill:#f5a14b}.fi{fill:#e3e6ea}
.ta{fill:#6cb2f7}.tb{fill:#f5a14b}.wa{fill:#6cb2f7;fill-opacity:.2}.wb{fill:#f5a14b;fill-opacity:.2}
.gone{stroke:#5d646e}.tgone{fill:#747c87}}
</style>"""


class Figure:
    def __init__(self, width, height, title):
        self.size = (width, height)
        self.parts = []
        self.title = title

    def add(self, text):
        self.parts.append(text)

    def line(self, x0, y0, x1, y1, kind="ink", width=1.5, dash=""):
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.add(f'<line x1="{x0:.1f}" y1="{y0:.1f}" x2="{x1:.1f}" y2="{y1:.1f}" class="{kind}" stroke-width="{width}"{dashes}/>')

    def curve(self, points, kind="ink", width=2, dash="", closed=False):
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        path = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points) + ("Z" if closed else "")
        self.add(f'<path d="{path}" class="{kind}" stroke-width="{width}"{dashes}/>')

    def rect(self, x, y, w, h, kind="ink", width=1.5, dash="", round_=0):
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.add(f'<rect x="{x:.1f}" y="{y:.1f}" width="{w:.1f}" height="{h:.1f}" rx="{round_}" class="{kind}" stroke-width="{width}"{dashes}/>')

    def dot(self, x, y, kind="fi", r=4):
        self.add(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{r}" class="{kind}"/>')

    def ring(self, x, y, r, kind="ink", width=2, dash=""):
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.add(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{r:.1f}" class="{kind}" stroke-width="{width}"{dashes}/>')

    def text(self, x, y, text, kind="", anchor="start"):
        self.add(f'<text x="{x:.1f}" y="{y:.1f}" class="{kind}" text-anchor="{anchor}">{text}</text>')

    def arrow(self, x0, y0, x1, y1, kind="ink", fill="fi", width=1.5):
        self.line(x0, y0, x1, y1, kind, width)
        a = math.atan2(y1 - y0, x1 - x0)
        p = [(x1 + 2 * math.cos(a), y1 + 2 * math.sin(a))]
        p += [(x1 - 9 * math.cos(a + s), y1 - 9 * math.sin(a + s)) for s in (0.38, -0.38)]
        self.add('<path d="M' + "L".join(f"{x:.1f} {y:.1f}" for x, y in p) + f'Z" class="{fill}"/>')

    def write(self, name):
        w, h = self.size
        svg = (f'<svg xmlns="http://www.w3.org/2000/svg" width="{w}" height="{h}" viewBox="0 0 {w} {h}" role="img">'
               f"<title>{self.title}</title>{STYLE}"
               f'<rect x=".5" y=".5" width="{w - 1}" height="{h - 1}" rx="8" class="card"/>' + "\n".join(self.parts) + "</svg>\n")
        (pathlib.Path(__file__).parent / name).write_text(svg, encoding="utf-8")


def box():
    """A box, the plane that the field keeps to, the slab of its slack, and two rays."""
    f = Figure(720, 330, "A box, the plane that its field keeps to within a slack, and two rays")
    x0, y0, w, h = 60, 40, 330, 250
    surface = lambda x: 185 - 0.22 * (x - x0) + 20 * math.sin((x - x0) / 62)
    xs = [x0 + i * w / 120 for i in range(121)]
    # The middle of the smallest slab of the plane's direction that holds the curve, and half of its height.
    slope = -0.22
    off = [surface(x) - slope * (x - x0) for x in xs]
    middle, slack = (max(off) + min(off)) / 2, (max(off) - min(off)) / 2 + 2
    plane = lambda x: middle + slope * (x - x0)
    f.curve([(x0, plane(x0) - slack), (x0 + w, plane(x0 + w) - slack), (x0 + w, plane(x0 + w) + slack), (x0, plane(x0) + slack)], "wa", 0, closed=True)
    f.rect(x0, y0, w, h)
    top, bottom = plane(x0 + w) - slack, plane(x0) + slack
    f.rect(x0, top, w, bottom - top, "a", 1.5, "3 3")
    f.line(x0, plane(x0), x0 + w, plane(x0 + w), "a", 1.5, "8 5")
    f.curve([(x, surface(x)) for x in xs], "b", 2.5)
    f.text(x0 + w - 10, y0 + h - 10, "f &lt; 0: one phase", "small", "end")
    f.text(x0 + 10, y0 + 20, "f &gt; 0: the other phase", "small")
    # A ray that enters the cell and misses the slab, and one that crosses it.
    f.arrow(20, 124, 432, 20, "thin", "fi", 1.5)
    a, b = (95, 318), (262, 14)
    at = lambda t: (a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]))
    f.arrow(*a, *b, "thin", "fi", 1.5)
    height = lambda t: at(t)[1] - plane(at(t)[0])
    ts = [i / 2000 for i in range(2001)]
    inside = [t for t in ts if abs(height(t)) <= slack]
    f.line(*at(inside[0]), *at(inside[-1]), "ink", 4)
    hit = min(ts, key=lambda t: abs(at(t)[1] - surface(at(t)[0])))
    f.dot(*at(hit), "fb", 5)
    x = 440
    f.rect(x, 42, 26, 14, "ink")
    f.text(x + 38, 54, "the box")
    f.line(x, 81, x + 26, 81, "b", 2.5)
    f.text(x + 38, 86, "the interface, f = 0")
    f.line(x, 113, x + 26, 113, "a", 1.5, "8 5")
    f.text(x + 38, 118, "the plane, n·p + c = 0")
    f.rect(x, 137, 26, 16, "wa", 0)
    f.text(x + 38, 150, "the slab where f can vanish:")
    f.text(x + 38, 167, "|n·p + c| ≤ slack", "it")
    f.rect(x, 185, 26, 14, "a", 1.5, "3 3")
    f.text(x + 38, 197, "the cell: the box, cut to the slab")
    f.line(x, 224, x + 26, 224, "ink", 4)
    f.text(x + 38, 229, "all that is searched of the lower ray")
    f.line(x, 256, x + 26, 256, "thin", 1.5)
    f.text(x + 38, 261, "The upper ray misses the slab,")
    f.text(x + 38, 278, "and costs no evaluation of f.")
    f.write("box.svg")


def ray():
    """Distances along a ray, two frames of samples, and the bracket."""
    f = Figure(720, 430, "A ray with its samples and the bracket that they lead to")
    x0, w = 60, 600
    # A component of the ray's phase, negated: how deep the ray is in it. 1-Lipschitz, zero at the interface.
    unit = 100.0
    def depth(t):
        return 0.34 + 0.5 * math.exp(-((t - 0.6) / 0.55) ** 2) - 0.30 * math.exp(-((t - 2.35) / 0.34) ** 2) + 0.34 * math.exp(-((t - 3.35) / 0.7) ** 2) - 0.62 / (1 + math.exp(-(t - 4.42) / 0.16))
    X = lambda t: x0 + t * unit
    base = 150
    Y = lambda s: base - s * unit
    ts = [i * 6 / 600 for i in range(601)]
    root = next(t for t in ts if depth(t) < 0)
    lo, hi = root - 0.02, root
    for _ in range(60):
        m = (lo + hi) / 2
        lo, hi = (m, hi) if depth(m) > 0 else (lo, m)
    root = lo
    f.arrow(x0 - 20, base, x0 + w + 25, base, "thin", "fi", 1.2)
    f.text(x0 + w + 22, base + 18, "t", "it", "end")
    f.text(x0 - 20, 26, "s, the interface distance", "small")
    f.curve([(X(t), Y(abs(depth(t)))) for t in ts if t <= root] + [(X(root), base)], "a", 2.5)
    f.curve([(X(root), base)] + [(X(t), Y(abs(depth(t)))) for t in ts if t > root], "b", 2.5)
    f.text(X(0.2), base - 92, "in the ray’s phase", "ta")
    f.text(X(5.98), base - 48, "in another phase", "tb", "end")
    first = [i * 6 / 7 for i in range(8)]
    def row(y, samples, label):
        """A frame: samples, and how far the label is certain about each."""
        f.text(x0 - 20, y - 22, label, "small")
        f.line(x0, y, x0 + w, y, "thin", 1)
        for t in samples:
            kind, fill = ("wa", "fa") if depth(t) > 0 else ("wb", "fb")
            s = abs(depth(t)) * unit
            left, right = max(X(t) - s, x0), min(X(t) + s, x0 + w)
            f.rect(left, y - 9, right - left, 18, kind, 0, round_=4)
        for t in samples:
            f.dot(X(t), y, "fa" if depth(t) > 0 else "fb", 4.5)
    for t in first:
        f.line(X(t), base, X(t), Y(abs(depth(t))), "thin", 1, "2 3")
        f.dot(X(t), Y(abs(depth(t))), "fa" if depth(t) > 0 else "fb", 3)
    row(215, first, "First frame: eight samples over the whole piece of the ray. A bar shows where the label is that of its sample.")
    # Gaps of one label that bars do not cover.
    doubt = [(a, b) for a, b in zip(first, first[1:]) if depth(a) > 0 and depth(b) > 0 and depth(a) + depth(b) < b - a]
    a, b = doubt[0]
    f.text(X((a + b) / 2), 240, "in doubt", "small", "middle")
    def within(a, b, da, db):
        low, high = min(a + da, b), max(b - db, a)
        return [min(low, high) + (max(low, high) - min(low, high)) * i / 7 for i in range(8)]
    second = within(a, b, depth(a), depth(b))
    row(285, second, "Second frame: what is in doubt is sampled again, and found free.")
    c, d = next((p, q) for p, q in zip(first, first[1:]) if depth(p) > 0 > depth(q))
    f.text(X((c + d) / 2), 240, "the label changes", "small", "middle")
    near = [root + k for k in (-0.15, -0.07, -0.02, 0.02, 0.07, 0.16, 0.3, 0.46)]
    row(355, near, "Third frame: gathered around the place where the distances on both sides predict the interface.")
    f.line(X(root), 367, X(root), 384, "ink", 1.5)
    f.text(X(root), 400, "the bracket: its ends differ in label and are", "", "middle")
    f.text(X(root), 417, "no more than the resolution apart", "", "middle")
    f.write("ray.svg")


def bridge():
    """Two samples whose radii do not cover their gap, and whose curvature bound bridges it."""
    f = Figure(720, 330, "The curvature bound bridges a gap that the Lipschitz bound leaves in doubt")
    x0, y0, sx, sy = 80, 265, 560, 560
    a, b, K = 0.16, 0.22, 1.15  # of a gap of length 1
    X = lambda t: x0 + t * sx
    Y = lambda s: y0 - s * sy
    ts = [i / 200 for i in range(201)]
    chord = lambda t: a + (b - a) * t
    low = lambda t: chord(t) - 0.5 * K * t * (1 - t)
    assert math.sqrt(a) + math.sqrt(b) >= math.sqrt(K / 2)
    # A distance that bends upward by less than K: above the parabola, and 1-Lipschitz.
    true = lambda t: chord(t) - 0.5 * 0.72 * t * (1 - t) * (1 + 0.15 * math.sin(5 * t))
    f.arrow(x0 - 30, y0, x0 + sx + 45, y0, "thin", "fi", 1.2)
    f.text(x0 + sx + 42, y0 + 18, "t", "it", "end")
    f.curve([(X(0), Y(0)), (X(0), Y(a)), (X(a), Y(0))], "wa", 0, closed=True)
    f.curve([(X(1), Y(0)), (X(1), Y(b)), (X(1 - b), Y(0))], "wa", 0, closed=True)
    f.line(X(0), Y(a), X(a), Y(0), "a", 1.5)
    f.line(X(1), Y(b), X(1 - b), Y(0), "a", 1.5)
    f.line(X(0), Y(a), X(1), Y(b), "thin", 1.2, "6 5")
    f.curve([(X(t), Y(low(t))) for t in ts], "b", 2.5)
    f.curve([(X(t), Y(true(t))) for t in ts], "ink", 2)
    for t, s, name in ((0, a, "a"), (1, b, "b")):
        f.dot(X(t), Y(s), "fi", 5)
        f.text(X(t) + (-14 if t == 0 else 10), Y(s) - 8, name, "it", "end" if t == 0 else "start")
    f.line(X(a), y0 + 24, X(1 - b), y0 + 24, "ink", 1.2)
    f.text(X((a + 1 - b) / 2), y0 + 41, "in doubt by the Lipschitz bound alone", "", "middle")
    f.text(X(0.5), Y(chord(0.5)) - 8, "the chord", "small", "middle")
    f.text(X(0.30), Y(true(0.30)) - 12, "s along the ray", "", "start")
    f.text(X(0.5), Y(low(0.5)) + 20, "the chord less K t (h − t)/2: s is nowhere below it", "tb", "middle")
    f.text(X(0.02), Y(0) - 8, "s ≥ a − t", "ta small")
    f.text(X(1) - 8, Y(0) - 8, "s ≥ b − (h − t)", "ta small", "end")
    f.text(x0 - 30, 30, "Two samples of one label, h apart. What bends upward by no more than K stays above the parabola,")
    f.text(x0 - 30, 48, "and the parabola stays above zero if √a + √b ≥ h √(K/2). Then the gap is free.")
    f.write("bridge.svg")


def pruning():
    """A program of three solids, and what is left of it in a box."""
    f = Figure(720, 330, "What is left of a program in a box")
    f.ring(120, 150, 78, "a", 2.5)
    f.text(120, 154, "a", "it ta", "middle")
    f.ring(250, 118, 62, "gone", 2, "5 4")
    f.text(252, 112, "b", "it tgone", "middle")
    f.ring(262, 262, 48, "gone", 2, "5 4")
    f.text(262, 267, "c", "it tgone", "middle")
    f.rect(26, 158, 74, 74, "ink", 2)
    f.text(26, 250, "a box", "small")
    f.text(26, 30, "The object: min(min(a, b), c − t)")
    def node(x, y, text, gone=False, kind=""):
        f.rect(x - 44, y - 17, 88, 34, "gone" if gone else "ink", 1.5, "5 4" if gone else "", 6)
        f.text(x, y + 4, text, "tgone" if gone else kind, "middle")
    f.line(520, 67, 455, 113, "ink")
    f.line(520, 67, 590, 113, "gone", 1.5, "5 4")
    f.line(455, 147, 412, 203, "ink")
    f.line(455, 147, 520, 203, "gone", 1.5, "5 4")
    f.line(590, 147, 624, 203, "gone", 1.5, "5 4")
    node(520, 50, "min")
    node(455, 130, "min")
    node(590, 130, "c − t", True)
    node(412, 220, "a", False, "it ta")
    node(520, 220, "b", True)
    node(624, 220, "c", True)
    f.text(572, 46, "Only its sign matters:", "small")
    f.text(572, 62, "it is required at 0.", "small")
    f.text(644, 127, "c − t &gt; 0 all", "small")
    f.text(644, 143, "over the box", "small")
    f.text(466, 262, "b &gt; 0 all over the box,", "small")
    f.text(466, 278, "beyond what is required", "small")
    f.text(340, 312, "In the box, one of six instructions is left: a.", "")
    f.write("pruning.svg")


if __name__ == "__main__":
    box()
    ray()
    bridge()
    pruning()
