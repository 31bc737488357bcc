"""Makes the recording of the live view that the manual shows: the page in Chromium, turned, asked, edited and cut.

    PHASETREE_COMMAND=build/release/tracer/phasetree python3 tests/view/recording.py scenes/film/live_view.webp

It needs Chromium and Debian's package webp. Each picture of it is taken when the page says that it is ready, so the
recording does not show how long that takes; benchmarks/view_latency.py tells."""

import os
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from browser import Browser  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENE = "scenes/hourglass.json"
READY = "document.getElementById('status')?.textContent.startsWith('Ready')"
WIDTH, HEIGHT, PICTURE = 1040, 640, 330


class Recorder:
    def __init__(self, browser, folder):
        self.browser, self.folder, self.frames = browser, pathlib.Path(folder), []
        self.seen = ""
        box = browser.run("(() => { const b = document.getElementById('picture').getBoundingClientRect(); return [b.x, b.y, b.width, b.height]; })()")
        self.box = box

    def at(self, x, y):
        return self.box[0] + x * self.box[2], self.box[1] + y * self.box[3]

    def take(self, milliseconds=120):
        """One picture of the recording, once the page is ready."""
        self.browser.wait_for(READY)
        path = self.folder / f"{len(self.frames):03}.png"
        self.browser.screenshot(path)
        self.frames.append((path, milliseconds))

    def changed(self, milliseconds=120):
        """The same, once the picture is another one."""
        picture = "document.getElementById('picture').toDataURL()"
        self.browser.wait_for(f"{READY} && {picture} !== {self.seen!r}")
        self.seen = self.browser.run(picture)
        self.take(milliseconds)

    def set(self, selector, value, event="input"):
        self.browser.run(f"(() => {{ const e = document.querySelector({selector!r}); e.value = {value!r};"
                         f" e.dispatchEvent(new Event({event!r}, {{bubbles: true}})); }})()")

    def write(self, out):
        arguments = ["-loop", "0", "-lossy", "-q", "62", "-m", "6"]
        for path, milliseconds in self.frames:
            arguments += ["-d", str(milliseconds), str(path)]
        subprocess.run(["img2webp", *arguments, "-o", str(out)], check=True)


def record(r):
    r.changed(1200)
    for _ in range(8):  # turned by the mouse
        r.browser.drag(r.at(0.5, 0.5), r.at(0.56, 0.5))
        r.changed()
    r.browser.click(*r.at(0.5, 0.62))  # asked what is there
    r.browser.wait_for("document.querySelectorAll('#point li').length > 1")
    r.browser.run("document.getElementById('point').scrollIntoView({block: 'nearest'})")
    r.take(2500)
    r.set("#number-filter", "glass ior")
    r.browser.run("document.getElementById('numbers').scrollIntoView({block: 'start'}); window.scrollTo(0, 0);")
    r.set("#cut-direction", "0 -1 0", "change")  # cut open
    for offset in (0.6, 0.45, 0.3, 0.15, 0.0):
        r.set("#cut-offset", str(offset))
        r.changed(250)
    r.take(1500)
    r.set("#layer", "normal", "change")
    r.changed(1200)
    r.set("#layer", "phase_entered", "change")
    r.changed(1200)
    r.set("#layer", "", "change")
    r.set("#cut-direction", "", "change")
    r.changed(800)


def main():
    out = pathlib.Path(sys.argv[1])
    view = subprocess.Popen([os.path.abspath(os.environ["PHASETREE_COMMAND"]), "view", SCENE, "--width", str(PICTURE), "--spp", "32"],
                            stdout=subprocess.PIPE, text=True, cwd=ROOT)
    try:
        url = view.stdout.readline().strip()
        with Browser(WIDTH, HEIGHT) as browser, tempfile.TemporaryDirectory() as folder:
            browser.open(url)
            browser.wait_for(READY)
            recorder = Recorder(browser, folder)
            record(recorder)
            recorder.write(out)
    finally:
        view.terminate()
        view.wait()


if __name__ == "__main__":
    main()
