#!/usr/bin/env python3
"""Draws the figures of README.md as SVG files beside this script, from what phasetree-bench has written.

    build/release/benchmarks/phasetree-bench table1 --json benchmarks/results/table1.json     # and so on
    python3 benchmarks/figures/draw.py

A figure is drawn if its numbers are there: table1, phases, scaling, march and resolution, in benchmarks/results. Colours
follow the reader's light or dark mode. Nothing but Python's standard library is needed.
"""

import json
import math
import pathlib

HERE = pathlib.Path(__file__).parent
RESULTS = HERE.parent / "results"

# Table 1 of the paper (Galin et al., "The PhaseTree: Multiphase Signed Distance Fields"): object, figure, nodes and
# milliseconds of the monolithic field, nodes and milliseconds of the multiphase one; measured on a GPU by sphere tracing.
PAPER_TABLE_1 = [
    ("bunny", 26, 6, 5458, 6, 5414),
    ("cables", 17, 34, 7361, 27, 9121),
    ("hourglass", 18, 40, 488, 43, 604),
    ("geology", 27, 51, 555, 58, 585),
    ("cake", 13, 73, 1158, 81, 1054),
    ("blob", 26, 21, 1687, 21, 1880),
    ("ice cup", 4, 52, 1041, 47, 816),
]

STYLE = """<style>
.card{fill:#fcfcfa;stroke:#d8d8d2}.axis{stroke:#2b2f36;fill:none}.grid{stroke:#e2e2dc;fill:none}
text{font:12.5px sans-serif;fill:#2b2f36}.small{font-size:11.5px;fill:#565c66}.title{font-size:14px;font-weight:bold}
.c0{stroke:#1f66ad;fill:#1f66ad}.c1{stroke:#c2620a;fill:#c2620a}.c2{stroke:#2f7d4a;fill:#2f7d4a}.c3{stroke:#8a8f98;fill:#8a8f98}
.p0{fill:#1f66ad;fill-opacity:.18}.p1{fill:#c2620a;fill-opacity:.2}.p2{fill:#2f7d4a;fill-opacity:.2}.p3{fill:#8a8f98;fill-opacity:.2}
.line{fill:none;stroke-width:2}.bar{stroke:none}
@media (prefers-color-scheme:dark){
.card{fill:#191c21;stroke:#3a3f47}.axis{stroke:#e3e6ea}.grid{stroke:#30353d}text{fill:#e3e6ea}.small{fill:#a9b0ba}
.c0{stroke:#6cb2f7;fill:#6cb2f7}.c1{stroke:#f5a14b;fill:#f5a14b}.c2{stroke:#6fcf8f;fill:#6fcf8f}.c3{stroke:#868d97;fill:#868d97}
.p0{fill:#6cb2f7;fill-opacity:.22}.p1{fill:#f5a14b;fill-opacity:.22}.p2{fill:#6fcf8f;fill-opacity:.22}.p3{fill:#868d97;fill-opacity:.22}
.line{fill:none}.bar{stroke:none}}
</style>"""


def escaped(text):
    return text.replace("&", "&amp;").replace("<", "&lt;")


def middle(value):
    """The value, or its median if it was measured several times."""
    return value["median"] if isinstance(value, dict) else value


def number(value):
    """A tick's label."""
    if value == 0:
        return "0"
    if abs(value) >= 10000:
        return f"{value:,.0f}"
    if abs(value) < 1e-3:
        return "10" + f"{math.log10(value):.0f}".translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"{value:g}"


class Picture:
    def __init__(self, width, height, title):
        self.size = (width, height)
        self.title = title
        self.parts = []

    def add(self, text):
        self.parts.append(text)

    def text(self, x, y, text, kind="", anchor="start", turn=None):
        turned = f' transform="rotate({turn} {x:.1f} {y:.1f})"' if turn is not None else ""
        self.add(f'<text x="{x:.1f}" y="{y:.1f}" class="{kind}" text-anchor="{anchor}"{turned}>{escaped(text)}</text>')

    def line(self, x0, y0, x1, y1, kind, width=1.0, dash=""):
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.add(f'<line x1="{x0:.1f}" y1="{y0:.1f}" x2="{x1:.1f}" y2="{y1:.1f}" class="{kind}" stroke-width="{width}"{dashes}/>')

    def curve(self, points, kind, dash="", width=2.0):
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        path = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
        self.add(f'<path d="{path}" class="{kind} line" style="fill:none" stroke-width="{width}"{dashes}/>')

    def dot(self, x, y, kind, r=3.4):
        self.add(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{r}" class="{kind}"/>')

    def rect(self, x, y, w, h, kind):
        self.add(f'<rect x="{x:.1f}" y="{y:.1f}" width="{w:.1f}" height="{h:.1f}" class="{kind}"/>')

    def write(self, name):
        w, h = self.size
        (HERE / name).write_text(
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{w}" height="{h}" viewBox="0 0 {w} {h}" role="img">'
            f"<title>{escaped(self.title)}</title>{STYLE}"
            f'<rect x=".5" y=".5" width="{w - 1}" height="{h - 1}" rx="8" class="card"/>' + "\n".join(self.parts) + "</svg>\n",
            encoding="utf-8")


class Axes:
    """A plot's frame: from values to places in the picture, with ticks and labels."""

    def __init__(self, picture, box, x, y, title, x_label, y_label, log_x=False, log_y=False, x_ticks=None, y_ticks=None):
        self.picture, self.box, self.x, self.y, self.log_x, self.log_y = picture, box, x, y, log_x, log_y
        left, top, width, height = box
        picture.text(left, top - 12, title, "title")
        for value in y_ticks or self.ticks(*y, log_y):
            at = self.at(x[0], value)[1]
            picture.line(left, at, left + width, at, "grid")
            picture.text(left - 7, at + 4, number(value), "small", "end")
        for value in x_ticks or self.ticks(*x, log_x):
            at = self.at(value, y[0])[0]
            picture.line(at, top + height, at, top + height + 5, "axis")
            picture.text(at, top + height + 18, number(value), "small", "middle")
        picture.line(left, top + height, left + width, top + height, "axis")
        picture.line(left, top, left, top + height, "axis")
        picture.text(left + width / 2, top + height + 36, x_label, "", "middle")
        picture.text(left - 46, top + height / 2, y_label, "", "middle", -90)

    @staticmethod
    def ticks(low, high, is_log):
        if is_log:
            return [10.0 ** k for k in range(math.ceil(math.log10(low) - 1e-9), math.floor(math.log10(high) + 1e-9) + 1)]
        step = 10 ** math.floor(math.log10((high - low) / 4))
        step *= next(f for f in (1, 2, 5, 10) if (high - low) / (step * f) <= 6)
        return [step * k for k in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]

    def share(self, value, limits, is_log):
        low, high = limits
        if is_log:
            value, low, high = math.log10(value), math.log10(low), math.log10(high)
        return (value - low) / (high - low)

    def at(self, x, y):
        left, top, width, height = self.box
        return (left + width * self.share(x, self.x, self.log_x), top + height * (1 - self.share(y, self.y, self.log_y)))

    def plot(self, points, kind, dash="", dots=True):
        places = [self.at(x, y) for x, y in points]
        self.picture.curve(places, kind, dash)
        for place in places if dots else []:
            self.picture.dot(*place, kind)

    def level(self, y, kind="c3", dash="6 4"):
        self.picture.curve([self.at(self.x[0], y), self.at(self.x[1], y)], kind, dash, 1.5)


def legend(picture, x, y, entries, step=19):
    for i, (text, kind, dash) in enumerate(entries):
        picture.curve([(x, y + i * step - 4), (x + 24, y + i * step - 4)], kind, dash)
        picture.text(x + 31, y + i * step, text)


def decades(values):
    """Limits of a logarithmic axis around values."""
    low, high = math.log10(min(values)), math.log10(max(values))
    return 10 ** math.floor(low - 0.05), 10 ** math.ceil(high + 0.05)


def draw_table1(data):
    """Table 1 and its objects (Figure 19): the overhead of phases."""
    rows = {row["object"]: row for row in data["objects"]}
    f = Picture(860, 420, "Table 1: what phases cost, the paper's numbers and ours")
    a = Axes(f, (84, 62, 740, 262), (0, len(PAPER_TABLE_1)), (-30, 30), "What phases cost: Table 1, on the objects of Figure 19",
             "", "overhead of phases, %", x_ticks=[-1])
    f.parts = [p for p in f.parts if ">-1<" not in p]
    a.level(0, "c3", "")
    for i, (name, _, mono_nodes, mono, multi_nodes, multi) in enumerate(PAPER_TABLE_1):
        row = rows[name]
        bars = [(100 * (multi / mono - 1), "c3"), (100 * middle(row["primary_overhead"]), "c0"), (100 * middle(row["bounce_overhead"]), "c1")]
        for k, (value, kind) in enumerate(bars):
            x0, y0 = a.at(i + 0.16 + 0.23 * k, max(value, 0))
            x1, y1 = a.at(i + 0.16 + 0.23 * (k + 1), min(value, 0))
            f.rect(x0, y0, x1 - x0 - 2, max(y1 - y0, 1), kind + " bar")
            f.text((x0 + x1) / 2 - 1, (y0 if value >= 0 else y1 + 15) - 4, f"{value:+.0f}", "small", "middle")
        at = a.at(i + 0.5, -30)[0]
        f.text(at, 344, name, "", "middle")
        f.text(at, 361, f"{mono_nodes}, {multi_nodes}", "small", "middle")
        f.text(at, 377, f"{row['monophase_nodes']:.0f}, {row['multiphase_nodes']:.0f}", "small", "middle")
    f.text(76, 361, "#N, paper", "small", "end")
    f.text(76, 377, "#N, ours", "small", "end")
    for k, (kind, text) in enumerate([("c3", "paper (GPU, sphere tracing)"), ("c0", "ours, one ray per pixel"), ("c1", "ours, ground and a bounce")]):
        f.rect(84 + 225 * k, 394, 14, 11, kind + " bar")
        f.text(104 + 225 * k, 404, text)
    f.write("table1.svg")


def draw_phases(data):
    """Figure 20: the growth with phases."""
    rows = data["counts"]
    n = [row["phases"] for row in rows]
    f = Picture(860, 400, "Figure 20: the time of an image by the number of phases")
    a = Axes(f, (84, 48, 520, 290), (1, 32), (0.5, 32), "The same surface in more and more phases: Figure 20",
             "phases", "time relative to one phase", log_y=True, x_ticks=[1, 4, 8, 12, 16, 20, 24, 32], y_ticks=[0.5, 1, 2, 4, 8, 16, 32])
    a.plot([(1, 1), (32, 32)], "c3", "6 4", False)
    a.plot([(k, middle(row["naive_ratio"])) for k, row in zip(n, rows)], "c1")
    a.plot([(k, middle(row["ratio"])) for k, row in zip(n, rows)], "c0")
    legend(f, 622, 90, [("proportional to phases:", "c3", "6 4"), ("walking the tree with arrays", "c1", ""), ("interface cells", "c0", "")], 44)
    f.text(653, 107, "“almost” so in the paper (GPU)", "small")
    f.text(653, 151, "of phases, on one thread", "small")
    f.text(653, 195, "a ray runs only what it needs", "small")
    f.write("phases.svg")


def draw_scaling(data):
    """The growth with the size of the tree."""
    rows = data["counts"]
    n = [row["bumps"] for row in rows]
    x = decades(n)
    f = Picture(860, 340, "The growth with the size of the tree")
    for k, (title, label, series) in enumerate([
            ("Rays", "million rays per second", [("primary_rays_per_second", 1e-6, "c0", "camera rays"), ("random_rays_per_second", 1e-6, "c1", "random, from inside")]),
            ("Building", "seconds, one thread", [("build_seconds", 1, "c0", "all phases"), ("opaque_build_seconds", 1, "c1", "opaque")]),
            ("Memory", "MB", [("cell_bytes", 1e-6, "c0", "cells"), ("embree_bytes", 1e-6, "c1", "Embree's BVH")])]):
        values = [middle(row[key]) * scale for key, scale, _, _ in series for row in rows]
        a = Axes(f, (76 + 278 * k, 48, 195, 190), x, decades(values), title, "bumps", label, True, True)
        for i, (key, scale, kind, name) in enumerate(series):
            a.plot([(row["bumps"], middle(row[key]) * scale) for row in rows], kind)
            f.rect(76 + 278 * k, 294 + 19 * i, 14, 11, kind + " bar")
            f.text(96 + 278 * k, 304 + 19 * i, name)
    f.write("scaling.svg")


def draw_march(data):
    """Figure 21: steps along a ray."""
    profile, steps = data["profile"], data["steps"]
    until = profile[-1]["t"]
    ways = {row["way"]: row for row in data["ways"]}
    most = 1.05 * max(max(row["least"], row["interface"]) for row in profile)
    f = Picture(860, 470, "Figure 21: steps along a ray from phase to phase")
    a = Axes(f, (84, 48, 740, 230), (0, until), (0, most), "Safe step sizes: a ray through the hourglass, Figure 21",
             "", "safe distance, dm", x_ticks=[-1])
    f.parts = [p for p in f.parts if ">-1<" not in p]
    bands, start = [], 0
    for i in range(1, len(profile) + 1):
        if i == len(profile) or profile[i]["phase"] != profile[start]["phase"]:
            bands.append((profile[start]["t"], profile[min(i, len(profile) - 1)]["t"], int(profile[start]["phase"])))
            start = i
    tints = {1: "p0", 2: "p1", 3: "p2", 4: "p3"}
    for low, high, phase in bands:
        if phase:
            x0, x1 = a.at(low, 0)[0], a.at(high, 0)[0]
            f.rect(x0, 48, max(x1 - x0, 1), 230 + 96, tints.get(phase, "p3"))
    a.plot([(row["t"], row["interface"]) for row in profile], "c0", "", False)
    a.plot([(row["t"], row["least"]) for row in profile], "c1", "5 3", False)
    rows = [("least", "c1", "least |φᵢ|"), ("interface", "c0", "interface distance")]
    for k, (way, kind, name) in enumerate(rows):
        y = 312 + 40 * k
        for step in steps:
            if step["way"] == way and step["t"] <= until:
                x = a.at(step["t"], 0)[0]
                f.line(x, y - 11, x, y + 11, kind, 1.1)
    f.text(84, 404, "t along the ray →", "small")
    names = ["least |φᵢ|, the paper's step", "interface distance s, the second smallest φ including the vacuum's", "interface cells"]
    for k, (key, kind) in enumerate([("least |φᵢ|", "c1"), ("interface distance", "c0"), ("cells, batches of eight", "c2")]):
        f.rect(84, 414 + 18 * k, 14, 11, kind + " bar")
        unit = "batches of eight points" if kind == "c2" else "evaluations"
        f.text(104, 424 + 18 * k, f"{names[k]}: {ways[key]['evaluations']:.0f} {unit} for {ways[key]['crossings']:.0f} crossings")
    met = [(tints[p], name) for p, name in enumerate(["glass", "sand", "wood", "brass"], 1) if p in {phase for _, _, phase in bands}]
    for k, (tint, name) in enumerate(met):
        f.rect(640 + 80 * k, 394, 14, 11, tint)
        f.text(659 + 80 * k, 404, name, "small")
    f.write("march.svg")


def draw_resolution(data):
    """Rays compared with triangles, by the mesh's resolution."""
    f = Picture(860, 640, "A field compared with its triangles, by the mesh's resolution")
    meshes, fields = data["meshes"], {row["scene"]: row for row in data["fields"]}
    scenes = list(fields)
    kinds = dict(zip(scenes, ["c0", "c1"]))
    grids = sorted({row["cubes"] for row in meshes})
    x = (grids[0] / 1.2, grids[-1] * 1.2)
    panels = [("Rays: field relative to triangles", "rate of the field, ×", None, (0.2, 2.5)),
              ("Error of the mesh", "mean, relative to the diagonal", "error", None),
              ("Memory", "MB", "bytes", None), ("Building", "seconds, one thread", "build_seconds", None)]
    for k, (title, label, key, limits) in enumerate(panels):
        left, top = 84 + 420 * (k % 2), 48 + 290 * (k // 2)
        scale = 1e-6 if key == "bytes" else 1
        if limits is None:
            values = [row[key] * scale for row in meshes] + [fields[s]["resolution" if key == "error" else key] * scale for s in scenes]
            limits = decades(values)
        a = Axes(f, (left, top, 320, 190), x, limits, title, "cubes along the longest side", label, True, True, grids,
                 [0.2, 0.5, 1, 2] if key is None else None)
        if key is None:
            a.level(1)
        for scene in scenes:
            rows = [row for row in meshes if row["scene"] == scene]
            if key is None:
                a.plot([(row["cubes"], middle(row["primary_ratio"])) for row in rows], kinds[scene])
                a.plot([(row["cubes"], middle(row["random_ratio"])) for row in rows], kinds[scene], "2 4")
            else:
                a.plot([(row["cubes"], row[key] * scale) for row in rows], kinds[scene])
                a.level(fields[scene]["resolution" if key == "error" else key] * scale, kinds[scene], "7 5")
    legend(f, 84, 604, [(f"{scenes[0]}: triangles; in “Rays” camera rays", "c0", ""), (f"{scenes[1]}", "c1", "")])
    legend(f, 420, 604, [("in “Rays”: random rays from the surface", "c3", "2 4"), ("the field, which has no grid; its error is its bracket", "c3", "7 5")])
    f.write("resolution.svg")


def main():
    drawn = []
    for name, draw in [("table1", draw_table1), ("phases", draw_phases), ("scaling", draw_scaling), ("march", draw_march), ("resolution", draw_resolution)]:
        file = RESULTS / f"{name}.json"
        if file.exists():
            draw(json.loads(file.read_text(encoding="utf-8"))[name])
            drawn.append(f"{name}.svg")
    print("drawn:", ", ".join(drawn) or "nothing: there are no results")


if __name__ == "__main__":
    main()
