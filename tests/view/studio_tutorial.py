"""Makes the pictures of the tutorial about the studio and a recording: the page in Chromium, in which a glass of water is
built.

    PHASETREE_COMMAND=build/release/tracer/phasetree python3 tests/view/studio_tutorial.py tracer/manual/images

Each picture is taken when the page's own picture is finished, and the recording shows few samples in between, so neither
shows how long that takes. PHASETREE_SAMPLES sets the samples per pixel of the pictures. The recording needs Pillow (package python3-pil)."""

import base64
import io
import os
import pathlib
import sys
import time

from PIL import Image, ImageDraw

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from browser import Browser  # noqa: E402
from studio_user import EMPTY, User, build_glass_of_water  # noqa: E402
from support import View  # noqa: E402

SAMPLES = os.environ.get("PHASETREE_SAMPLES", "64")  # of the pictures
SAMPLES_OF_FRAMES = 2  # of the recording
MOST_BYTES = 2_000_000
FRAME, LAST_FRAME = 900, 4000  # milliseconds

SETTLED = """(() => {
    const status = document.getElementById('status').textContent, samples = /^(\\d+) of/.exec(status);
    const isSeen = [...document.images].every((image) => image.complete);
    return isSeen && (status.startsWith('Ready') || (samples && Number(samples[1]) >= %d) || !document.getElementById('empty').hidden);
})()"""


class GlassView(View):
    name = "glass.json"


class Recorder(User):
    """A user whose steps are recorded, each with the pointer where it was."""

    def __init__(self, browser):
        super().__init__(browser)
        self.frames, self.pointer = [], None

    def settle(self, samples, within=300):
        time.sleep(0.7)  # the picture of the last change has begun
        self.until(SETTLED % samples, within)

    def record(self):
        data = base64.b64decode(self.browser.call("Page.captureScreenshot", format="png")["data"])
        frame = Image.open(io.BytesIO(data)).convert("RGB")
        if self.pointer:
            x, y = self.pointer
            arrow = [(x, y), (x, y + 20), (x + 5, y + 15), (x + 9, y + 23), (x + 12, y + 21), (x + 8, y + 14), (x + 15, y + 14)]
            ImageDraw.Draw(frame).polygon(arrow, fill="black", outline="white")
        self.frames.append(frame.resize((960, 540), Image.Resampling.LANCZOS))

    def click(self, element, modifiers=0, button="left"):
        self.pointer = self.place(element)
        super().click(element, modifiers, button)
        if self.browser.run("document.querySelector('.menu:popover-open, dialog[open]') !== null"):
            self.record()

    def step(self, action):
        super().step(action)
        self.settle(SAMPLES_OF_FRAMES)
        self.record()


def save_recording(frames, file):
    durations = [FRAME] * (len(frames) - 1) + [LAST_FRAME]
    for quality in (72, 60, 48, 36):
        frames[0].save(file, save_all=True, append_images=frames[1:], duration=durations, loop=0, quality=quality, method=6)
        if file.stat().st_size < MOST_BYTES:
            return
    raise SystemExit(f"{file} is larger than {MOST_BYTES} bytes")


def main():
    folder = pathlib.Path(sys.argv[1])
    with GlassView(EMPTY, "--spp", SAMPLES) as view, Browser(1280, 720) as browser:
        user = Recorder(browser)
        user.open(view.url)

        def take(name):
            user.settle(1 << 30, 900)
            data = browser.call("Page.captureScreenshot", format="jpeg", quality=80)["data"]
            (folder / f"studio-{name}.jpg").write_bytes(base64.b64decode(data))
            user.record()

        build_glass_of_water(user, take)
        save_recording(user.frames, folder / "studio.webp")
        print(view.file.read_text(encoding="utf-8"))
        print(len(user.frames), "frames", (folder / "studio.webp").stat().st_size, "bytes")


if __name__ == "__main__":
    main()
