#!/usr/bin/env python3
"""Makes the pages of the gallery, and looks at them in headless Chromium.

    pages.py COMMAND FOLDER [SCENE…]            writes FOLDER/SCENE.html for these scenes, or for all
    pages.py COMMAND FOLDER --open [SCENE…]     also opens each: FOLDER/SCENE.png and a line of a table
    pages.py COMMAND FOLDER --check [SCENE…]    also checks that each reacts to what people do with it, and says what is
                                                wrong where it cannot work
    pages.py COMMAND FOLDER --sheet [SCENE…]    also puts each beside the path-traced picture: FOLDER/sheet.jpg
                                                (ImageMagick's convert and montage)

COMMAND is the built phasetree. The exit code is 77 where there is no Chromium, and 1 if a page is not as it should be.
"""
import argparse
import pathlib
import subprocess
import sys
import time

from chromium import Browser, executable
from pictures import difference

SCENES = pathlib.Path(__file__).resolve().parent.parent
NO_CHROMIUM = 77
LARGEST = 500_000  # bytes
SHEET_HEIGHT = 180


def gallery():
    return sorted(p.stem for p in SCENES.glob("*.json") if not p.stem.startswith("scene."))


def opened(browser, page):
    """What is wrong, or None."""
    browser.call("Page.navigate", url=page.resolve().as_uri())
    if not browser.wait("!!window.phasetree && (phasetree.ready || phasetree.error !== null)"):
        return "it is not ready after a minute"
    return browser.value("phasetree.error")


def at_rest(browser, seconds=120):
    """A picture with at least one finished pass, or what there is after this many seconds."""
    browser.wait("phasetree.passes >= 1", seconds)
    return browser.screenshot()


def touch(browser, kind, *points):
    browser.call("Input.dispatchTouchEvent", type=kind,
                 touchPoints=[{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)])


def reactions(browser, width, height):
    """What a page does not do that it should."""
    wrong = []
    view = "document.getElementById('view')"
    key = view + ".dispatchEvent(new KeyboardEvent('keydown', {key: '%s'}))"

    def reset():
        browser.value(key % "0")

    browser.value("phasetree.most_passes = 1")
    reset()
    browser.wait("phasetree.passes === 0", 2)
    finished = at_rest(browser)

    def expect(what, action, after=reset):
        action() if callable(action) else browser.value(action)
        browser.wait("phasetree.passes === 0", 2)
        if difference(finished, at_rest(browser)) < 0.5:
            wrong.append(f"{what} changes nothing")
        after()

    def mouse(kind, x, y, modifiers=0):
        browser.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1, modifiers=modifiers,
                     buttons=0 if kind == "mouseReleased" else 1)

    def drag(modifiers=0):
        x, y = width // 2, height // 2
        mouse("mousePressed", x, y, modifiers)
        mouse("mouseMoved", x + 40, y + 15, modifiers)
        mouse("mouseReleased", x + 40, y + 15, modifiers)

    x, y = width // 2, height // 2

    def one_finger():
        touch(browser, "touchStart", (x, y))
        touch(browser, "touchMove", (x + 40, y))
        touch(browser, "touchEnd")

    def pinch():
        touch(browser, "touchStart", (x - 20, y), (x + 20, y))
        touch(browser, "touchMove", (x - 40, y), (x + 20, y))
        touch(browser, "touchMove", (x - 40, y), (x + 40, y))
        touch(browser, "touchEnd")

    def two_fingers():
        touch(browser, "touchStart", (x - 20, y), (x + 20, y))
        touch(browser, "touchMove", (x - 20, y + 40), (x + 20, y))
        touch(browser, "touchMove", (x - 20, y + 40), (x + 20, y + 40))
        touch(browser, "touchEnd")

    expect("an arrow", ";".join([key % "ArrowLeft"] * 4))
    expect("+", ";".join([key % "+"] * 4))
    expect("the wheel", view + ".dispatchEvent(new WheelEvent('wheel', {deltaY: 400}))")
    expect("dragging", drag)
    expect("dragging with shift", lambda: drag(modifiers=8))
    browser.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=2)
    expect("a finger", one_finger)
    away = browser.value("phasetree.view.away")
    expect("two fingers that spread", pinch, after=lambda: None)
    if not browser.value("phasetree.view.away") < 0.8 * away:
        wrong.append("two fingers that spread do not zoom in")
    reset()
    expect("two fingers that move", two_fingers)
    box = "document.querySelectorAll('#phases input').forEach(b => b.click())"
    expect("hiding all phases", box, after=lambda: browser.value(box))
    cut = "(() => { const a = document.getElementById('axis'); a.value = '%s'; a.dispatchEvent(new Event('input')); })()"
    expect("a cut", cut % "0", after=lambda: browser.value(cut % ""))
    browser.wait("phasetree.passes === 0", 2)
    if difference(finished, at_rest(browser)) > 0:
        wrong.append("what was changed and changed back leaves another picture")
    return wrong


# What is done to a page before it opens, and words of what it must then say.
TROUBLES = {
    "no WebGL 2": ("HTMLCanvasElement.prototype.getContext = () => null", "needs WebGL 2"),
    "an old browser": ("delete window.DecompressionStream", "too old"),
    "a shader that does not compile":
        ("const f = WebGL2RenderingContext.prototype.shaderSource;"
         "WebGL2RenderingContext.prototype.shaderSource = function(s, t) { f.call(this, s, t + 'nonsense'); }",
         "does not compile"),
    "data that are cut off":
        ("const f = window.atob; window.atob = t => f(t).slice(0, 100)", "cannot be opened"),
}


def troubles(chromium, page, width, height):
    """What a page does not say where it cannot work."""
    wrong = []

    def expect(what, browser, words):
        if not browser.wait("!!window.phasetree && phasetree.error !== null", 20):
            wrong.append(f"{what}: it says nothing")
        elif words not in browser.value("document.getElementById('message').innerText"):
            wrong.append(f"{what}: it says {browser.value('phasetree.error')!r}")

    for what, (script, words) in TROUBLES.items():
        browser = Browser(chromium, width, height)
        try:
            browser.call("Page.enable")
            browser.call("Page.addScriptToEvaluateOnNewDocument", source=script)
            browser.call("Page.navigate", url=page.resolve().as_uri())
            expect(what, browser, words)
        finally:
            browser.close()
    browser = Browser(chromium, width, height)
    try:
        opened(browser, page)
        browser.value("document.getElementById('view').getContext('webgl2').getExtension('WEBGL_lose_context').loseContext()")
        expect("a driver that gives up", browser, "stopped drawing")
    finally:
        browser.close()
    return wrong


def make(command, scene, page):
    """Writes a page. Returns None, or why the scene is too large for one."""
    made = subprocess.run([command, "export", str(SCENES / f"{scene}.json"), "-o", str(page)], check=False,
                          stderr=subprocess.PIPE, text=True)
    if made.returncode == 0:
        return None
    if ": a shader " in made.stderr:
        return made.stderr.splitlines()[0].split(": ", 1)[1]
    sys.exit(made.stderr)


def measured(browser, name, kilobytes, width, height):
    """A line of the table, once moving frames have settled to their size."""
    for _ in range(12):
        browser.value("phasetree.view.turn += 0.01; phasetree.touch()")
        time.sleep(0.1)
        browser.wait("phasetree.at_rest === phasetree.scale", 10)
    state = browser.value("({opened: phasetree.opened, compiled: phasetree.compiled, frame: phasetree.frame, scale: phasetree.scale})")
    return (f"| {name} | {kilobytes:.0f} | {state['compiled'] / 1000:.1f} s | {state['opened'] / 1000:.1f} s | "
            f"{state['frame']:.0f} ms at {width * state['scale']:.0f}×{height * state['scale']:.0f} |")


def beside_path_traced(chromium, folder, scene):
    """FOLDER/SCENE.pair.png: the path-traced picture, and the page at the same size."""
    picture = SCENES / "gallery" / f"{scene}.jpg"
    pair = folder / f"{scene}.pair.png"
    scaled = folder / f"{scene}.traced.png"
    subprocess.run(["convert", str(picture), "-resize", f"x{SHEET_HEIGHT}", str(scaled)], check=True)
    width = int(subprocess.run(["identify", "-format", "%w", str(scaled)], check=True, capture_output=True, text=True).stdout)
    browser = Browser(chromium, width, SHEET_HEIGHT)
    try:
        error = opened(browser, folder / f"{scene}.html")
        if error:
            return error
        browser.value("document.getElementById('panel').style.display = 'none'")
        browser.wait("phasetree.passes >= 3", 40)  # or as far as it has come by then
        (folder / f"{scene}.png").write_bytes(browser.screenshot())
    finally:
        browser.close()
    subprocess.run(["convert", str(scaled), str(folder / f"{scene}.png"), "+append", str(pair)], check=True)
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("command")
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("scenes", nargs="*")
    parser.add_argument("--open", action="store_true")
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--sheet", action="store_true")
    parser.add_argument("--size", default="800x600")
    parser.add_argument("--patience", type=float, default=120, help="the longest time for a picture, in seconds")
    options = parser.parse_intermixed_args()
    chromium = executable()
    looks = options.open or options.check
    if (looks or options.sheet) and not chromium:
        print("skipped: there is no Chromium (Debian: chromium)")
        return NO_CHROMIUM
    options.folder.mkdir(parents=True, exist_ok=True)
    width, height = map(int, options.size.split("x"))
    wrong, pairs = [], []
    if looks:
        print("| scene | kB | compiled in | first picture after | a moving frame |\n|---|---|---|---|---|")
    for name in options.scenes or gallery():
        page = options.folder / f"{name}.html"
        why_not = make(options.command, name, page)
        if why_not:
            print(f"{name} has no page: {why_not}")
            if options.scenes:
                wrong.append(f"{name}: {why_not}")
            continue
        size = page.stat().st_size
        if size > LARGEST:
            wrong.append(f"{name}: {size} bytes")
        if options.sheet:
            error = beside_path_traced(chromium, options.folder, name)
            if error:
                wrong.append(f"{name}: {error}")
            else:
                pairs.append(options.folder / f"{name}.pair.png")
        if not looks:
            continue
        browser = Browser(chromium, width, height)
        try:
            error = opened(browser, page)
            if error:
                wrong.append(f"{name}: {error}")
                continue
            print(measured(browser, name, size / 1000, width, height), flush=True)
            (options.folder / f"{name}.png").write_bytes(at_rest(browser, options.patience))
            if options.check:
                wrong += [f"{name}: {w}" for w in reactions(browser, width, height)]
        finally:
            browser.close()
        if options.check:
            wrong += [f"{name}: {w}" for w in troubles(chromium, page, width, height)]
    if pairs:
        subprocess.run(["montage", *map(str, pairs), "-tile", "3x", "-geometry", f"x{SHEET_HEIGHT}+6+6", "-background", "white",
                        "-quality", "88", "-strip", str(options.folder / "sheet.jpg")], check=True)
    for w in wrong:
        print("wrong:", w)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
