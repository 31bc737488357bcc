#!/usr/bin/env python3
"""The time from an input in the studio's page to the first picture of it, for every scene of the gallery.

    python3 benchmarks/drag_latency.py [--command build/release/tracer/phasetree] [--steps 15] [--markdown] [SCENE …]

A number of the tree is changed as by a drag: in headless Chromium, in small steps, each as soon as the picture of the one
before is on the canvas. The time of a step is that from the input to the moment when the page has drawn the first picture of
it. `check` is the part that the server needs to accept the step (it reads the scene, because a step that makes it invalid is
refused), and `picture` the part from the step's acceptance by the session to its picture, as the server says. A material's
colour is dragged in the same way. `least` is the quickest step: the one that other programs disturbed least. Scenes are
copied, because the page saves them.

With --processor-time, steps are sent over HTTP as the page sends them, without Chromium, and what is measured is the
processor time of the server, of all its threads, until the first picture arrives. It does not depend on what else the machine
does, except that the server may go on working before the clock is read. Each step begins when the picture before it is
finished, or after four seconds. On an idle machine, less time passes, because the picture is rendered by several threads.
"""

import argparse
import json
import os
import pathlib
import re
import statistics
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]

# Notes when the first picture of each step is drawn: a first picture has a new time to it.
WATCH = """(() => {
    window.pictures = [];
    const read = Response.prototype.arrayBuffer, put = CanvasRenderingContext2D.prototype.putImageData, draw = CanvasRenderingContext2D.prototype.drawImage;
    Response.prototype.arrayBuffer = async function () {
      const buffer = await read.call(this), bytes = new Uint8Array(buffer), end = bytes.indexOf(10);
      if (this.url.includes("/picture?") && end > 0 && bytes.length > end + 1) window.state = JSON.parse(new TextDecoder().decode(bytes.subarray(0, end)));
      return buffer;
    };
    const note = (context) => {
      if (context.canvas.id !== "picture" || !window.state) return;
      const {seconds_to_picture: seconds} = window.state;
      if (window.pictures.at(-1)?.seconds !== seconds) window.pictures.push({at: performance.now(), seconds});
    };
    CanvasRenderingContext2D.prototype.putImageData = function (...rest) { put.apply(this, rest); note(this); };
    CanvasRenderingContext2D.prototype.drawImage = function (...rest) { draw.apply(this, rest); note(this); };
})()"""

# Drags a number: its steps, each {all, check, picture} in milliseconds; null if the scene rejects one.
DRAG = """async (pointer, text, steps) => {
    const value = JSON.parse(text), pause = () => new Promise((done) => setTimeout(done, 1)), times = [];
    const scaled = (x, k) => (Array.isArray(x) ? x.map((y) => Number((y * k).toPrecision(6))) : Number((x * k).toPrecision(6)));
    for (let i = 0; i < steps + 2; ++i) {
      const seen = window.pictures.length, begun = performance.now();
      try {
        await studio.scene.perform({label: "Drag", operations: [{set: pointer, to: JSON.stringify(scaled(value, 1 - 0.002 * (i % 7 + 1)))}], merge: "drag"});
      } catch {
        return null;
      }
      const checked = performance.now();
      while (window.pictures.length === seen && performance.now() - begun < 20000) await pause();
      const picture = window.pictures[seen];
      if (!picture) return null;
      if (i >= 2) times.push({all: picture.at - begun, check: checked - begun, picture: 1000 * picture.seconds});
    }
    return times;
}"""

NUMBERS = """studio.scene.entries.filter((e) => !e.isSection && /^\\/(tree|shapes|objects)/.test(e.pointer)).flatMap((e) => Object.values(e.parameters))
    .filter((p) => p.text && /^-?[0-9.]+$/.test(p.text) && Number(p.text) !== 0).map((p) => [p.pointer, p.text])"""
COLOURS = """studio.scene.entries.filter((e) => !e.isSection && e.pointer.startsWith("/phases")).flatMap((e) => Object.values(e.parameters))
    .filter((p) => p.text && /^\\[[0-9., ]+\\]$/.test(p.text) && JSON.parse(p.text).length === 3).map((p) => [p.pointer, p.text])"""


def processor_milliseconds(process):
    tasks = pathlib.Path(f"/proc/{process.pid}/task")
    return sum(int((task / "schedstat").read_text(encoding="ascii").split()[0]) for task in tasks.iterdir()) / 1e6


def entries_of(outline):
    for entry in outline:
        yield entry
        yield from entries_of(entry["children"])


def measure_processor_time(view_type, scene, steps):
    """The processor time of steps that change a number of the tree, and of steps that change a colour."""
    with tempfile.NamedTemporaryFile(dir=scene.parent, prefix=scene.stem + "-", suffix=".json") as copy, \
            view_type(pathlib.Path(copy.name), scene.read_bytes(), "--spp", "1") as view:
        def finished():
            end = time.monotonic() + 4
            return view.wait_for(lambda state: "picture" in state and (state["doing"] == "Ready" or time.monotonic() > end), 120)

        def step(pointer, value, k):
            base = json.loads(view.get("document?after=0&text=1000000").body)["version"]
            shown = finished().state["picture"]["number"]
            scaled = [float(f"{k * x:.6g}") for x in value] if isinstance(value, list) else float(f"{k * value:.6g}")
            begun, answered = processor_milliseconds(view.process), None
            status = view.post("document", {"base": base, "label": "Drag", "merge": "drag", "strict": True, "operations": [{"set": pointer, "to": json.dumps(scaled)}]}).status
            answered = processor_milliseconds(view.process)
            if status != 200:
                return None
            version = 0
            while (state := view.get(f"picture?after={version}&picture={shown}").state)["picture"]["number"] == shown:
                version = state["version"]
            return {"all": processor_milliseconds(view.process) - begun, "check": answered - begun}

        finished()
        entries = list(entries_of(json.loads(view.get("document").body)["outline"]))
        parameters = [(p["pointer"], p["text"]) for e in entries for p in e["parameters"].values() if p["text"]]
        numbers = [(p, float(t)) for p, t in parameters if p.startswith(("/tree", "/shapes", "/objects")) and re.fullmatch(r"-?[0-9.]+", t) and float(t) != 0]
        colours = [(p, json.loads(t)) for p, t in parameters if p.startswith("/phases") and re.fullmatch(r"\[[0-9., ]+\]", t) and len(json.loads(t)) == 3]
        result = {"nodes": sum(e["type"] in ("field", "object") for e in entries)}
        for what, found in (("tree", numbers), ("colour", colours)):
            for pointer, value in found[:: max(1, len(found) // 4)][:4]:
                times = [step(pointer, value, 1 - 0.002 * (i % 7 + 1)) for i in range(steps + 1)]
                if None not in times:
                    result[what] = times[1:]
                    break
        return result


def measure(view_type, browser, user, scene, steps):
    """Medians of a number of the tree and of a colour, and the quickest and the slowest step of the number."""
    with tempfile.NamedTemporaryFile(dir=scene.parent, prefix=scene.stem + "-", suffix=".json") as copy, view_type(pathlib.Path(copy.name), scene.read_bytes()) as view:
        user.open(view.url)
        user.until("document.getElementById('picture').width > 1", 120)
        browser.run(WATCH)
        result = {"nodes": browser.run("studio.scene.entries.filter((e) => e.type === 'field' || e.type === 'object').length")}
        for what, candidates in (("tree", NUMBERS), ("colour", COLOURS)):
            found = browser.run(candidates)
            for pointer, text in found[:: max(1, len(found) // 4)][:4]:
                times = browser.run(f"({DRAG})({json.dumps(pointer)}, {json.dumps(text)}, {steps})")
                if times:
                    result[what] = {part: statistics.median(t[part] for t in times) for part in ("all", "check", "picture")}
                    result[what]["least"] = min(t["all"] for t in times)
                    result[what]["worst"] = max(t["all"] for t in times)
                    break
        browser.open("about:blank")
        return result


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--command", default=str(ROOT / "build/release/tracer/phasetree"))
    parser.add_argument("--steps", type=int, default=15, help="of each drag")
    parser.add_argument("--processor-time", action="store_true", help="of the server, without Chromium")
    parser.add_argument("--markdown", action="store_true", help="print a table for a document")
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    options = parser.parse_args()
    os.environ["PHASETREE_COMMAND"] = options.command
    sys.path.insert(0, str(ROOT / "tests/view"))
    import browser
    import studio_user
    import support

    class CopiedView(support.View):
        """A view of a file that is there already, with what it needs beside it."""

        def __init__(self, file, content, *more):
            self.copied = file
            file.write_bytes(content)
            super().__init__("", *more)

        def prepare(self):
            self.file = self.copied

    def print_row(cells):
        print("| " + " | ".join(cells) + " |" if options.markdown else f"{cells[0]:28}" + "".join(f"{cell:>9}" for cell in cells[1:]), flush=True)

    def print_head(cells):
        print_row(cells)
        if options.markdown:
            print("|---" * len(cells) + "|")

    scenes = options.scenes or sorted(p for p in (ROOT / "scenes").glob("*.json") if p.name != "scene.schema.json")
    load = [os.getloadavg()[0]]
    if options.processor_time:
        print_head(["scene", "nodes", "least", "median", "check", "colour"])
        for scene in scenes:
            try:
                told = measure_processor_time(CopiedView, scene, options.steps)
            except AssertionError as error:
                print(scene.stem, "failed:", str(error)[:100], flush=True)
                continue
            tree, colour = told.get("tree"), told.get("colour")
            shown = [f"{choice(t[part] for t in tree):.0f}" for choice, part in ((min, "all"), (statistics.median, "all"), (min, "check"))] if tree else ["–"] * 3
            print_row([scene.stem, str(told["nodes"]), *shown, f"{min(t['all'] for t in colour):.0f}" if colour else "–"])
        print(f"load before and at the end: {load[0]:.1f}, {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")
        return
    print_head(["scene", "nodes", "least", "median", "worst", "check", "picture", "colour"])
    medians, colours = [], []
    with browser.Browser(1280, 720) as chromium:
        user = studio_user.User(chromium)
        for scene in scenes:
            try:
                told = measure(CopiedView, chromium, user, scene, options.steps)
            except AssertionError as error:
                print(scene.stem, "failed:", str(error)[:100], flush=True)
                continue
            tree, colour = told.get("tree"), told.get("colour")
            shown = [f"{tree[part]:.0f}" for part in ("least", "all", "worst", "check", "picture")] if tree else ["–"] * 5
            medians += [tree["all"]] if tree else []
            colours += [colour["all"]] if colour else []
            print_row([scene.stem, str(told["nodes"]), *shown, f"{colour['all']:.0f}" if colour else "–"])
    load.append(os.getloadavg()[0])
    print(f"load before and at the end: {load[0]:.1f}, {load[1]:.1f} on {os.cpu_count()} cores")
    print(f"median of the scenes: {statistics.median(medians):.0f} ms for a number of the tree, {statistics.median(colours):.0f} ms for a colour")


if __name__ == "__main__":
    main()
