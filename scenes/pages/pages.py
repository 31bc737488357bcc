#!/usr/bin/env python3
"""Makes the pages of the gallery, and looks at them in headless Chromium.

    pages.py COMMAND FOLDER [SCENE…]            writes FOLDER/SCENE.html for these scenes, or for all
    pages.py COMMAND FOLDER --open [SCENE…]     also opens each: FOLDER/SCENE.png and a line of a table
    pages.py COMMAND FOLDER --check [SCENE…]    also checks that each reacts to what people do with it

COMMAND is the built phasetree. The exit code is 77 where there is no Chromium, and 1 if a page is not as it should be.
"""
import argparse
import base64
import fcntl
import json
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import zlib

SCENES = pathlib.Path(__file__).resolve().parent.parent
NO_CHROMIUM = 77
LARGEST = 500_000


class Browser:
    """Headless Chromium with software WebGL, by its DevTools protocol over a pipe."""

    def __init__(self, executable, width, height):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        to_browser, self.sender = os.pipe()
        self.receiver, from_browser = os.pipe()

        # Far from 3 and 4, which they become: what is there already must not be closed.
        to_browser, from_browser = (fcntl.fcntl(f, fcntl.F_DUPFD, 64) for f in (to_browser, from_browser))

        def pipes():
            os.dup2(to_browser, 3)
            os.dup2(from_browser, 4)

        self.process = subprocess.Popen(
            [executable, "--headless=new", "--no-sandbox", "--remote-debugging-pipe", "--use-gl=angle",
             "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist", "--no-first-run",
             f"--user-data-dir={self.profile.name}", f"--window-size={width},{height}", "about:blank"],
            preexec_fn=pipes, pass_fds=(3, 4, to_browser, from_browser), stderr=subprocess.DEVNULL)
        os.close(to_browser)
        os.close(from_browser)
        self.buffer, self.count, self.session = b"", 0, None
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)

    def call(self, method, **parameters):
        self.count += 1
        message = {"id": self.count, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.sender, json.dumps(message).encode() + b"\0")
        while True:
            while b"\0" not in self.buffer:
                more = os.read(self.receiver, 1 << 20)
                if not more:
                    raise RuntimeError("Chromium has gone")
                self.buffer += more
            text, self.buffer = self.buffer.split(b"\0", 1)
            answer = json.loads(text)
            if answer.get("id") == self.count:
                if "error" in answer:
                    raise RuntimeError(answer["error"]["message"])
                return answer["result"]

    def value(self, expression):
        result = self.call("Runtime.evaluate", expression=expression, returnByValue=True)
        return result["result"].get("value")

    def wait(self, condition, seconds=60):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if self.value(condition):
                return True
            time.sleep(0.05)
        return False

    def screenshot(self):
        return base64.b64decode(self.call("Page.captureScreenshot", format="png")["data"])

    def close(self):
        self.process.terminate()
        self.process.wait()
        os.close(self.sender)
        os.close(self.receiver)
        self.profile.cleanup()


def pixels(png):
    """The rows of an 8-bit image as bytes, and the bytes of a pixel (PNG, ISO/IEC 15948)."""
    at, data, size = 8, b"", None
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at:at + 8])
        body = png[at + 8:at + 8 + length]
        if kind == b"IHDR":
            size = struct.unpack(">IIBBBBB", body)
        elif kind == b"IDAT":
            data += body
        at += 12 + length
    width, height, channels = size[0], size[1], {2: 3, 6: 4}[size[3]]
    raw, rows, last, stride = zlib.decompress(data), [], bytearray(width * channels), width * channels
    for y in range(height):
        mode, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
        for i in range(stride):
            left = row[i - channels] if i >= channels else 0
            up, corner = last[i], last[i - channels] if i >= channels else 0
            if mode == 1:
                row[i] = (row[i] + left) & 255
            elif mode == 2:
                row[i] = (row[i] + up) & 255
            elif mode == 3:
                row[i] = (row[i] + (left + up) // 2) & 255
            elif mode == 4:
                p = left + up - corner
                a, b, c = abs(p - left), abs(p - up), abs(p - corner)
                row[i] = (row[i] + (left if a <= b and a <= c else up if b <= c else corner)) & 255
        rows.append(row)
        last = row
    return rows, channels


def difference(a, b):
    """The mean difference of two pictures, from 0 to 255."""
    rows_a, n = pixels(a)
    rows_b, _ = pixels(b)
    step = 5 * n
    total = count = 0
    for ra, rb in zip(rows_a[::5], rows_b[::5]):
        for i in range(0, len(ra), step):
            total += abs(ra[i] - rb[i])
            count += 1
    return total / count


def gallery():
    return sorted(p.stem for p in SCENES.glob("*.json") if not p.stem.startswith("scene."))


def opened(browser, page):
    browser.call("Page.navigate", url=page.resolve().as_uri())
    if not browser.wait("!!window.phasetree && (phasetree.ready || phasetree.error !== null)"):
        return "it is not ready after a minute"
    return browser.value("phasetree.error")


def at_rest(browser, seconds=120):
    """A picture of at least one pass at full size."""
    browser.wait("phasetree.passes >= 1", seconds)
    return browser.screenshot()


def reactions(browser):
    """What a page does not do that it should."""
    wrong, before = [], at_rest(browser)

    def expect(what, action):
        browser.value(action)
        browser.wait("phasetree.passes === 0", 2)
        if difference(before, at_rest(browser)) < 0.5:
            wrong.append(f"{what} changes nothing")
        browser.value("document.getElementById('view').dispatchEvent(new KeyboardEvent('keydown', {key: '0'}))")

    key = "document.getElementById('view').dispatchEvent(new KeyboardEvent('keydown', {key: '%s'}))"
    expect("an arrow", ";".join([key % "ArrowLeft"] * 4))
    expect("+", ";".join([key % "+"] * 4))
    expect("the wheel", "document.getElementById('view').dispatchEvent(new WheelEvent('wheel', {deltaY: 400}))")
    view = "document.getElementById('view').dispatchEvent(new PointerEvent('%s', {pointerId: 1, clientX: %d, clientY: 200}))"
    browser.value("document.getElementById('view').setPointerCapture = () => {}")
    expect("dragging", ";".join([view % ("pointerdown", 200), view % ("pointermove", 300), view % ("pointerup", 300)]))
    box = "document.querySelectorAll('#phases input').forEach(b => b.click())"
    expect("hiding all phases", box)
    browser.value(box)
    cut = "(() => { const a = document.getElementById('axis'); a.value = '%s'; a.dispatchEvent(new Event('input')); })()"
    expect("a cut", cut % "0")
    browser.value(cut % "")
    return wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--open", action="store_true")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--size", default="800x600")
    options = parser.parse_intermixed_args()
    chromium = next((p for p in map(shutil.which, ["chromium", "chromium-browser", "google-chrome"]) if p), None)
    looks = options.open or options.check
    if looks and not chromium:
        print("skipped: there is no Chromium (Debian: chromium)")
        return NO_CHROMIUM
    options.folder.mkdir(parents=True, exist_ok=True)
    width, height = map(int, options.size.split("x"))
    wrong = []
    if looks:
        print("| scene | kB | opens in | a moving frame |\n|---|---|---|---|")
    for name in options.scenes or gallery():
        page = options.folder / f"{name}.html"
        made = subprocess.run([options.command, "export", str(SCENES / f"{name}.json"), "-o", str(page)], check=False,
                              stderr=subprocess.PIPE, text=True)
        if made.returncode != 0 and ": a shader " in made.stderr and not options.scenes:
            print(f"{name} has no page: {made.stderr.splitlines()[0].split(': ', 1)[1]}")
            continue
        if made.returncode != 0:
            sys.exit(made.stderr)
        size = page.stat().st_size
        if size > LARGEST:
            wrong.append(f"{name}: {size} bytes")
        if not looks:
            continue
        browser = Browser(chromium, width, height)
        try:
            error = opened(browser, page)
            if error:
                wrong.append(f"{name}: {error}")
                continue
            picture = at_rest(browser)
            (options.folder / f"{name}.png").write_bytes(picture)
            for _ in range(12):  # until the size of moving frames has settled
                browser.value("phasetree.view.turn += 0.01; phasetree.touch()")
                time.sleep(0.1)
            state = browser.value("({opened: phasetree.opened, frame: phasetree.frame, scale: phasetree.scale})")
            print(f"| {name} | {size / 1000:.0f} | {state['opened'] / 1000:.1f} s | {state['frame']:.0f} ms at "
                  f"{width * state['scale']:.0f}×{height * state['scale']:.0f} |", flush=True)
            if options.check:
                wrong += [f"{name}: {w}" for w in reactions(browser)]
        finally:
            browser.close()
    for w in wrong:
        print("wrong:", w)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
