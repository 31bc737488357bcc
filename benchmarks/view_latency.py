#!/usr/bin/env python3
"""The time from an edit to the first picture of it in the live view, for every scene of the gallery.

    python3 benchmarks/view_latency.py [--command build/release/tracer/phasetree] [--edits 7] [--operations] [SCENE …]

An edit is one of the numbers of the tree changed by a hundredth, as by a slider: the scene is read, its cells are built
and a picture is taken. The time is the one that the page shows; it is the server's, from the request to the picture.
With --operations, an edit is an operation on the text of the file, which is also saved (in a copy of the scene beside
it). Of this many edits of a scene the median counts. Numbers that may not be changed, as those on which the tree's validity
depends, are passed over.
"""

import argparse
import contextlib
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time
import urllib.request

ROOT = pathlib.Path(__file__).resolve().parents[1]


class View:
    def __init__(self, command, scene):
        self.process = subprocess.Popen([command, "view", str(scene)], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
        self.url = self.process.stdout.readline().strip()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.process.terminate()
        self.process.wait()

    def state(self, after=0):
        with urllib.request.urlopen(f"{self.url}picture?after={after}") as answer:
            return json.loads(answer.read().split(b"\n", 1)[0])

    def numbers(self):
        with urllib.request.urlopen(self.url + "numbers") as answer:
            return json.loads(answer.read())["numbers"]

    def set(self, pointer, value):
        with urllib.request.urlopen(self.url + "document") as answer:
            base = json.loads(answer.read())["version"]
        before = self.state()["version"]
        body = json.dumps({"base": base, "label": "Edit", "operations": [{"set": pointer, "to": json.dumps(value)}]}).encode()
        urllib.request.urlopen(urllib.request.Request(self.url + "document", body, {"Content-Type": "application/json"})).close()
        return before

    def change(self, numbers):
        body = json.dumps({"numbers": numbers}).encode()
        request = urllib.request.Request(self.url + "change", body, {"Content-Type": "application/json"})
        with urllib.request.urlopen(request) as answer:
            return json.loads(answer.read())["version"]

    def first_picture(self, version, number):
        """The time until a picture later than `number`; nothing where there was an error."""
        while True:
            state = self.state(version)
            if state["error"]:
                return None
            if state.get("picture", {}).get("number", 0) > number:
                return state["seconds_to_picture"]
            version = state["version"]


@contextlib.contextmanager
def copied(scene):
    """A copy that may be changed, in the same folder because of the files that the scene names."""
    with tempfile.NamedTemporaryFile(dir=scene.parent, prefix=scene.stem + "-", suffix=".json") as copy:
        copy.write(scene.read_bytes())
        copy.flush()
        yield pathlib.Path(copy.name)


def measure(command, scene, edits, is_operation):
    with copied(scene) if is_operation else contextlib.nullcontext(scene) as file, View(command, file) as view:
        state = view.state()
        while "picture" not in state:
            state = view.state(state["version"])
        numbers = [n for n in view.numbers() if n["pointer"].startswith(("/tree/", "/shapes/", "/objects/")) and n["value"] != 0]
        numbers = numbers[:: max(1, len(numbers) // (3 * edits))]
        times = []
        for n in numbers:
            if len(times) == edits:
                break
            time.sleep(0.3)
            number = view.state()["picture"]["number"]
            value = 1.01 * n["value"]
            version = view.set(n["pointer"], value) if is_operation else view.change({n["pointer"]: value})
            seconds = view.first_picture(version, number)
            if seconds is not None:
                times.append(seconds)
        return times


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--command", default=str(ROOT / "build/release/tracer/phasetree"))
    parser.add_argument("--edits", type=int, default=7)
    parser.add_argument("--operations", action="store_true", help="edit the text of a copy of the scene")
    parser.add_argument("scenes", nargs="*", type=pathlib.Path)
    options = parser.parse_args()
    scenes = options.scenes or sorted(p for p in (ROOT / "scenes").glob("*.json") if p.name != "scene.schema.json")
    medians = {}
    for scene in scenes:
        if times := measure(options.command, scene, options.edits, options.operations):
            medians[scene.stem] = statistics.median(times)
            print(f"{scene.stem:32} {medians[scene.stem]:6.2f} s  worst of {len(times)}: {max(times):.2f} s", flush=True)
        else:
            print(f"{scene.stem:32} no number could be changed", flush=True)
    if medians:
        worst = max(medians, key=medians.get)
        print(f"{'median of the scenes':32} {statistics.median(medians.values()):6.2f} s\n{'worst, ' + worst:32} {medians[worst]:6.2f} s")
    return 0


if __name__ == "__main__":
    sys.exit(main())
