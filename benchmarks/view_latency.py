"""How long it is from a change to the first picture of it, as a page gets it: for scenes of the gallery, after its file is
saved, after a phase is hidden, and after the camera is turned. The median of some times each, in seconds.

    PHASETREE_COMMAND=build/release/tracer/phasetree python3 benchmarks/view_latency.py scenes/*.json
"""

import json
import pathlib
import shutil
import statistics
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tests/view"))

from support import View, is_ready  # noqa: E402

TIMES = 5


class Gallery(View):
    """The view of a copy of a scene, beside whatever it names."""

    def __init__(self, scene):
        self.scene = scene
        super().__init__(scene.read_text(encoding="utf-8"), "--spp", "4")

    def prepare(self):
        assets = self.scene.parent / "assets"
        if assets.is_dir():
            shutil.copytree(assets, self.file.parent / "assets")


def first_picture_after(view, change):
    """Seconds until the page has a picture that was taken after the change."""
    state = view.get("picture").state
    version, picture = state["version"], state["picture"]["number"]
    start = time.monotonic()
    change()
    while True:
        state = view.get(f"picture?after={version}&picture={picture}").state
        version = state["version"]
        if state["picture"]["number"] != picture:
            return time.monotonic() - start


def measure(scene):
    with Gallery(scene) as view:
        camera = json.loads(view.wait_for(is_ready, within=300).state["camera"])
        phases = [p["name"] for p in view.get("picture").state["phases"]]
        text = view.file.read_text(encoding="utf-8")
        members = camera.get("orthographic", camera)

        def turn(i):
            members["position"][0] += 0.01 * (i + 1)
            view.post("change", {"camera": camera})

        changes = {
            "saved": lambda i: view.file.write_text(text + " " * (i + 1), encoding="utf-8"),
            "hidden": lambda i: view.post("change", {"hidden": phases[-1:] if i % 2 == 0 else []}),
            "turned": turn,
        }
        result = {}
        for name, change in changes.items():
            seconds = []
            for i in range(TIMES):
                view.wait_for(is_ready, within=300)
                seconds.append(first_picture_after(view, lambda i=i, change=change: change(i)))
            result[name] = statistics.median(seconds)
        return result


def main():
    scenes = [pathlib.Path(name) for name in sys.argv[1:] if not name.endswith("scene.schema.json")]
    print(f"{'scene':24} {'saved':>8} {'hidden':>8} {'turned':>8}")
    results = []
    for scene in scenes:
        results.append(measure(scene))
        print(f"{scene.stem:24}" + "".join(f" {s:8.3f}" for s in results[-1].values()), flush=True)
    for name, of in (("median", statistics.median), ("worst", max)):
        print(f"{name:24}" + "".join(f" {of([r[kind] for r in results]):8.3f}" for kind in results[0]))


if __name__ == "__main__":
    main()
