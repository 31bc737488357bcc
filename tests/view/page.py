"""The live view's page in Chromium: turned, clicked, hidden from, edited, by mouse, touch and keyboard.

PHASETREE_SCREENSHOTS names a folder for pictures of it."""

import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

import browser  # noqa: E402
from support import COMMAND, SCENE, View, skip  # noqa: E402

LARGER = SCENE.replace('"width": 96, "height": 64', '"width": 240, "height": 160')
READY = "document.getElementById('status')?.textContent.startsWith('Ready')"
SEEN = "document.getElementById('picture').toDataURL()"
CAMERA = "document.getElementById('camera').value"
SHIFT, CONTROL = 8, 2
ORIGIN = [0, 0, 0]


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not browser.program():
            skip("Chromium is not installed (package chromium)")
        cls.view = View(LARGER).__enter__()
        cls.browser = browser.Browser().__enter__()

    @classmethod
    def tearDownClass(cls):
        if hasattr(cls, "browser"):
            cls.browser.__exit__()
            cls.view.__exit__()

    def setUp(self):
        self.expected = ()  # what the browser may say on its console
        self.view.file.write_text(LARGER, encoding="utf-8")
        self.view.post("change", {"camera": None, "hidden": [], "looks": {}, "cut": None, "numbers": {}, "layer": "", "exposure": 0, "time": 0})
        self.browser.events.clear()
        self.browser.open(self.view.url)
        self.browser.wait_for(READY)
        self.before = self.browser.run(SEEN)
        box = self.browser.run("JSON.stringify(document.getElementById('picture').getBoundingClientRect())")
        self.box = json.loads(box)

    def tearDown(self):
        self.assertEqual([c for c in self.browser.complaints() if not c.startswith(self.expected)], [])

    def at(self, x, y):
        """Where a place of the picture, by shares of its sides, is in the window."""
        return self.box["x"] + x * self.box["width"], self.box["y"] + y * self.box["height"]

    def open_tab(self, name):
        self.browser.run(f"document.querySelector('[role=tab][data-tab={name}]').click()")

    def text(self, name):
        return self.browser.run(f"document.getElementById('{name}').textContent")

    def shoot(self, name):
        if folder := os.environ.get("PHASETREE_SCREENSHOTS"):
            self.browser.screenshot(pathlib.Path(folder) / f"{name}.png")

    def camera(self):
        """The camera, once all that was done to it has been sent and shown: when it has been the same for a while."""
        last, since = None, time.monotonic()
        while time.monotonic() - since < 0.4:
            now = self.browser.wait_for(f"{READY} && {CAMERA}")
            if now != last:
                last, since = now, time.monotonic()
            time.sleep(0.05)
        return json.loads("{" + last + "}")["camera"]

    def reset(self):
        self.browser.run("document.getElementById('reset').click()")
        self.browser.wait_for(f"{READY} && {SEEN} === {json.dumps(self.before)}")

    def said_in_terminal(self):
        """What `check` says of the scene's file."""
        checked = subprocess.run([COMMAND, "check", str(self.view.file)], capture_output=True, text=True, check=False, timeout=60)
        return checked.stderr.removesuffix("\n")

    def wait_for_error(self, text=""):
        self.browser.wait_for(f"document.getElementById('error').textContent.includes({json.dumps(text)})"
                              " && !document.getElementById('error').hidden")
        return self.text("error")

    def wait_for_no_error(self):
        self.browser.wait_for("document.getElementById('error').hidden && document.getElementById('error').textContent === ''")

    def wait_for_another(self, than, where=SEEN):
        self.browser.wait_for(f"{READY} && {where} !== {json.dumps(than)}")
        return self.browser.run(where)

    def test_it_shows_the_scene_and_loads_nothing_from_elsewhere(self):
        self.assertIn("scene.json", self.text("scene"))
        self.assertEqual(self.browser.run("document.getElementById('picture').width"), 240)
        self.assertGreater(len(self.browser.addresses()), 5)
        for address in self.browser.addresses():
            self.assertTrue(address.startswith((self.view.url, "data:")), address)
        self.shoot("light")
        self.browser.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": "dark"}])
        self.assertEqual(self.browser.run("getComputedStyle(document.body).backgroundColor"), "rgb(27, 28, 30)")
        self.shoot("dark")
        self.browser.call("Emulation.setEmulatedMedia", features=[])

    def test_dragging_turns_moves_and_the_wheel_zooms(self):
        camera = self.camera()
        self.browser.drag(self.at(0.5, 0.5), self.at(0.7, 0.4))
        self.wait_for_another(self.before)
        turned = self.camera()
        # Around the object's centre: as far away as before.
        self.assertNotEqual(turned["position"], camera["position"])
        self.assertAlmostEqual(sum(x * x for x in turned["position"]), 25, places=2)
        self.browser.drag(self.at(0.5, 0.5), self.at(0.6, 0.5), SHIFT)
        moved = json.loads("{" + self.wait_for_another('"camera": ' + json.dumps(turned), CAMERA) + "}")["camera"]
        self.assertNotEqual(moved["look_at"], turned["look_at"])
        self.browser.mouse("mouseWheel", *self.at(0.5, 0.5), deltaX=0, deltaY=-200)
        text = self.browser.wait_for(f"{CAMERA} !== {json.dumps('x')} && {READY} && {CAMERA}")
        self.reset()
        self.assertIn("position", text)

    def test_what_is_under_the_pointer_stays_there_when_the_picture_is_moved(self):
        # The ball of wood is 0.6 to the right; the picture is 2.68 high and 4.02 wide where the balls are.
        self.browser.drag(self.at(0.65, 0.5), self.at(0.5, 0.2), SHIFT)
        self.wait_for_another(self.before)
        self.camera()
        self.browser.click(*self.at(0.5, 0.2))
        self.browser.wait_for("document.getElementById('point').textContent.includes('wood at')")

    def with_fingers(self):
        self.browser.call("Emulation.setTouchEmulationEnabled", enabled=True, maxTouchPoints=3)
        self.addCleanup(self.browser.call, "Emulation.setTouchEmulationEnabled", enabled=False)

    def test_a_finger_turns_as_the_mouse_does(self):
        self.browser.drag(self.at(0.5, 0.5), self.at(0.7, 0.4))
        seen = self.wait_for_another(self.before)
        by_mouse = self.camera()
        self.reset()
        self.with_fingers()
        self.browser.touch(*([self.at(0.5 + 0.04 * i, 0.5 - 0.02 * i)] for i in range(6)))
        self.browser.wait_for(f"{READY} && {SEEN} !== {json.dumps(self.before)}")
        for by_finger, there in zip(self.camera()["position"], by_mouse["position"]):
            self.assertAlmostEqual(by_finger, there, places=3)
        self.assertNotEqual(seen, self.before)
        self.assertEqual(self.browser.run("[scrollX, scrollY, visualViewport.scale]"), [0, 0, 1])

    def test_two_fingers_zoom(self):
        self.with_fingers()
        x, y = self.at(0.5, 0.5)
        self.browser.touch(*([(x - spread, y), (x + spread, y)] for spread in (20, 30, 40)))
        self.wait_for_another(self.before)
        # Twice as far apart: half as far away.
        self.assertAlmostEqual(math.dist(self.camera()["position"], ORIGIN), 2.5, delta=0.01)
        self.assertEqual(self.camera()["look_at"], ORIGIN)
        self.assertEqual(self.browser.run("visualViewport.scale"), 1)

    def test_two_fingers_move_what_is_between_them(self):
        self.with_fingers()
        # The ball of wood is 0.6 to the right, and is moved into the middle.
        self.browser.touch(*([self.at(x - 0.1, y - 0.1), self.at(x + 0.1, y + 0.1)] for x, y in ((0.65, 0.5), (0.6, 0.6), (0.55, 0.7), (0.5, 0.8))))
        self.wait_for_another(self.before)
        camera = self.camera()
        self.assertAlmostEqual(camera["position"][0], camera["look_at"][0], places=3)
        self.assertAlmostEqual(math.dist(camera["position"], camera["look_at"]), 5, places=3)
        self.browser.touch([self.at(0.5, 0.8)])
        self.browser.wait_for("document.getElementById('point').textContent.includes('wood at')")

    def test_a_tap_asks_and_what_more_fingers_do_is_no_tap(self):
        self.with_fingers()
        told = self.text("point")
        a, b, c = self.at(0.65, 0.5), self.at(0.5, 0.5), self.at(0.6, 0.6)
        for fingers in ([a], [a, b]), ([a], [a, b], [a, b, c]):
            self.browser.touch(*fingers)
        # A third finger turns nothing.
        self.browser.touch([a], [a, b], [a, b, c], [a, b, self.at(0.9, 0.9)])
        time.sleep(0.3)
        self.assertEqual(self.text("point"), told)
        self.assertEqual(self.browser.run(SEEN), self.before)
        self.browser.touch([a])
        self.browser.wait_for("document.getElementById('point').textContent.includes('wood at')")

    def test_a_click_tells_what_is_there(self):
        self.open_tab("point")
        self.browser.click(*self.at(0.65, 0.5))
        self.browser.wait_for("document.getElementById('point').textContent.includes('wood at')")
        rows = self.browser.run("[...document.querySelectorAll('#point table:last-child tbody tr')].map((r) => r.innerText)")
        self.assertEqual([row.split("\t")[1:] for row in rows], [["vacuum", "wood"], ["wood", "vacuum"]])
        self.shoot("point")
        self.browser.click(*self.at(0.02, 0.02))
        self.browser.wait_for("document.getElementById('point').textContent.includes('There is nothing')")

    def test_the_keyboard_does_it_all(self):
        self.browser.run("document.getElementById('picture').focus()")
        self.browser.press("ArrowRight")
        turned = self.wait_for_another(self.before)
        self.browser.press("+", "Equal", "+")
        self.wait_for_another(turned)
        self.browser.press("0", "Digit0", "0")
        self.browser.wait_for(f"{READY} && {SEEN} === {json.dumps(self.before)}")
        self.browser.press("Enter")
        self.browser.wait_for("document.getElementById('point').textContent.includes('There is nothing')")
        # From the tabs, arrows lead to the view's settings. A blank ticks the first phase.
        self.browser.run("document.querySelector('[role=tab][data-tab=edit]').focus()")
        self.browser.press("ArrowRight")
        self.assertEqual(self.browser.run("document.activeElement.dataset.tab"), "view")
        for _ in range(40):
            if self.browser.run("document.activeElement.value") == "glass":
                break
            self.browser.press("Tab")
        self.assertEqual(self.browser.run("document.activeElement.value"), "glass")
        self.browser.press(" ", "Space", " ")
        hidden = self.wait_for_another(self.before)
        self.assertEqual(self.browser.run("document.activeElement.value"), "glass")
        self.assertFalse(self.browser.run("document.activeElement.checked"))
        self.shoot("hidden")
        self.browser.press(" ", "Space", " ")
        self.wait_for_another(hidden)

    def test_a_screen_reader_is_told_names(self):
        self.open_tab("view")
        self.browser.run("document.querySelectorAll('details').forEach((d) => { d.open = true; })")
        nodes = self.browser.call("Accessibility.getFullAXTree")["nodes"]
        told = {(n["role"]["value"], n["name"]["value"]) for n in nodes if n.get("name", {}).get("value")}
        for role, name in (("checkbox", "glass"), ("checkbox", "wood"), ("group", "Phases"), ("button", "Rotate left"),
                           ("application", "Picture of the scene"), ("button", "Save picture"),
                           ("textbox", "Text of the camera"), ("button", "Reset material of glass"), ("button", "Save as EXR"),
                           ("group", "Cut"), ("combobox", "Cut away the side towards"), ("spinbutton", "x of the normal")):
            self.assertIn((role, name), told)
        for slider in ("Exposure", "Position", "Index", "Roughness"):
            self.assertTrue(any(role == "slider" and name.startswith(slider) for role, name in told), slider)

    def test_the_file_is_followed_and_its_errors_are_shown(self):
        # At once, so that nobody reads a file that is still empty.
        written = self.view.file.with_suffix(".new")
        written.write_text(LARGER.replace('"radius": 0.5', '"raduis": 0.5'), encoding="utf-8")
        written.replace(self.view.file)
        self.browser.wait_for("!document.getElementById('error').hidden")
        error = self.text("error")
        self.assertIn("scene.json:3:", error)
        self.assertIn('did you mean "radius"?', error)
        self.assertEqual(error, self.said_in_terminal())
        self.assertEqual(self.browser.run("getComputedStyle(document.getElementById('error')).whiteSpaceCollapse"), "preserve")
        self.assertEqual(self.browser.run(SEEN), self.before)
        self.shoot("error")
        self.view.file.write_text(LARGER.replace('"radius": 0.5', '"radius": 0.4'), encoding="utf-8")
        self.browser.wait_for("document.getElementById('error').hidden")
        self.wait_for_another(self.before)

    def test_a_file_that_vanishes_is_told_and_waited_for(self):
        self.view.file.unlink()
        error = self.wait_for_error("scene.json")
        self.assertEqual(error, self.said_in_terminal())
        self.assertEqual(self.browser.run(SEEN), self.before)
        # A file that cannot be written is reported once.
        self.expected = "Failed to load resource"
        self.browser.run("document.getElementById('write').click()")
        time.sleep(0.3)
        self.assertEqual(self.text("error"), error)
        self.assertEqual(self.text("copied"), "")
        self.view.file.write_text(LARGER, encoding="utf-8")
        self.browser.wait_for(READY)
        # What was rejected stays until something else is tried.
        self.assertEqual(self.text("error"), error)
        self.browser.run("document.getElementById('write').click()")
        self.wait_for_no_error()
        self.assertEqual(self.text("copied"), "Written.")

    def select(self, name):
        """Selects the last entry of the outline with a name: the shape, not the places where it is used."""
        row = f"[...document.querySelectorAll('#outline [role=treeitem]')].findLast((r) => r.querySelector('.name').textContent === {json.dumps(name)})"
        self.browser.wait_for(f"Boolean({row})")
        self.browser.run(f"{row}.click()")

    def set_number(self, parameter, text):
        """Types a number into the inspector."""
        field = f"document.querySelector('[data-parameter={parameter}] input')"
        self.browser.wait_for(f"Boolean({field})")
        self.browser.run(f"(() => {{ const e = {field}; e.focus(); e.select(); }})()")
        for key in text:
            self.browser.press(key, "", key)
        self.browser.press("Enter")

    def test_a_number_that_is_refused_is_told_where_it_stands(self):
        self.select("ball")
        self.expected = "Failed to load resource"
        self.set_number("radius", "-1")
        problem = "document.querySelector('[data-parameter=radius] .problem')"
        self.browser.wait_for(f"!{problem}.hidden")
        self.assertIn("-1", self.browser.run(f"{problem}.textContent"))
        self.assertEqual(self.browser.run(SEEN), self.before)
        self.shoot("refused")
        # It is not written; the next number that is accepted takes the message away.
        self.assertEqual(self.view.file.read_text(encoding="utf-8"), LARGER)
        self.set_number("radius", "0.4")
        self.browser.wait_for(f"{problem}.hidden")
        self.wait_for_another(self.before)
        self.assertEqual(self.view.file.read_text(encoding="utf-8"), LARGER.replace('"radius": 0.5', '"radius": 0.4'))

    def test_the_picture_is_saved_by_its_buttons(self):
        with tempfile.TemporaryDirectory() as folder:
            self.browser.call("Page.setDownloadBehavior", behavior="allow", downloadPath=folder)
            for button, name in (("save", "scene.png"), ("save-exr", "scene.exr")):
                self.browser.run(f"document.getElementById('{button}').click()")
                saved = pathlib.Path(folder) / name
                end = time.monotonic() + 30
                while not saved.exists() and time.monotonic() < end:
                    time.sleep(0.05)
                self.assertEqual(saved.read_bytes(), self.view.get(f"picture.{name[-3:]}").body)
        self.assertTrue(self.browser.run("document.getElementById('error').hidden"))

    def test_a_server_that_is_gone_is_told(self):
        self.expected = "Failed to load resource"
        with View(LARGER) as view:
            self.browser.open(view.url)
            self.browser.wait_for(READY)
            seen = self.browser.run(SEEN)
            view.end()
            self.browser.wait_for("document.getElementById('status').textContent.includes('does not answer')")
            self.assertEqual(self.browser.run(SEEN), seen)
            for button in ("save", "write", "reset"):
                self.browser.run("document.getElementById('error').textContent = ''")
                self.browser.run(f"document.getElementById('{button}').click()")
                self.wait_for_error("The server does not answer")
            self.shoot("gone")

    def test_it_fits_small_windows_and_large_ones(self):
        self.addCleanup(self.browser.resize, 1100, 800)
        self.view.file.write_text(SCENE.replace('"width": 96, "height": 64', '"width": 900, "height": 1200'), encoding="utf-8")
        self.browser.wait_for(f"{READY} && document.getElementById('picture').width === 900")
        self.box = json.loads(self.browser.run("JSON.stringify(document.getElementById('picture').getBoundingClientRect())"))
        self.browser.click(*self.at(0.65, 0.5))
        self.browser.wait_for("document.querySelectorAll('#point li').length === 4")
        self.browser.run("document.querySelectorAll('#phases details').forEach((d) => { d.open = true; })")
        for scheme in ("light", "dark"):
            self.browser.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
            for name, width, height in (("phone", 360, 740), ("tablet", 800, 1100), ("desk", 1920, 1080)):
                self.browser.resize(width, height)
                # Nothing sticks out, so that the page need not be scrolled; its panels scroll by themselves.
                self.assertLessEqual(self.browser.run("document.documentElement.scrollWidth"), width)
                self.assertLessEqual(self.browser.run("document.documentElement.scrollHeight"), height)
                # The picture is fitted in the next frame.
                self.browser.wait_for(f"document.getElementById('picture').getBoundingClientRect().height < {0.95 * height}")
                box = json.loads(self.browser.run("JSON.stringify(document.getElementById('picture').getBoundingClientRect())"))
                self.assertGreater(box["height"], 100)
                self.shoot(f"{name}-{scheme}")
        self.browser.call("Emulation.setEmulatedMedia", features=[])

    def set_input(self, selector, value, event="input"):
        self.browser.run(f"""(() => {{ const e = document.querySelector({json.dumps(selector)}); e.value = {json.dumps(value)};
            e.dispatchEvent(new Event({json.dumps(event)}, {{bubbles: true}})); }})()""")

    def test_a_phase_is_given_another_look_and_its_own_again(self):
        self.browser.run("document.querySelectorAll('#phases details').forEach((d) => { d.open = true; })")
        wood = "#phases > div:nth-of-type(2)"
        self.open_tab("view")
        self.set_input(f"{wood} input.hex", "#2040c0", "change")
        blue = self.wait_for_another(self.before)
        # By keyboard: made clear, then rougher. A clear phase has an index, and the focus stays at the phase.
        self.browser.run(f"document.querySelector('{wood} details input[type=checkbox]').focus()")
        self.browser.press(" ", "Space", " ")
        clear = self.wait_for_another(blue)
        self.assertEqual(self.browser.run("document.activeElement.closest('#phases > div').querySelector('input').value"), "wood")
        for _ in range(3):
            self.browser.press("Tab")
        self.browser.press("ArrowRight")
        self.wait_for_another(clear)
        self.assertEqual(self.browser.run("document.activeElement.getAttribute('aria-valuetext')"), "1.51")
        self.shoot("looks")
        self.browser.run(f"document.querySelector('{wood} button[aria-label^=Reset]').click()")
        self.browser.wait_for(f"{READY} && {SEEN} === {json.dumps(self.before)}")

    def test_a_plane_cuts_and_is_dragged(self):
        self.set_input("#cut-direction", "0 0 1", "change")
        half = self.wait_for_another(self.before)
        self.assertIn("0 %", self.text("cut-said"))
        self.shoot("cut")
        # Up by a tenth of the picture's height, which is 2.68 where the balls are: 0.268 of the object's radius of 1.3.
        self.browser.drag(self.at(0.5, 0.5), self.at(0.5, 0.4), CONTROL)
        higher = self.wait_for_another(half)
        share = float(self.browser.run("document.getElementById('cut-offset').value"))
        radius = json.loads(self.view.get("picture").body.split(b"\n", 1)[0])["radius"]
        self.assertAlmostEqual(share * radius, 0.268, delta=0.02)
        self.browser.run("document.getElementById('picture').focus()")
        self.browser.press("[", "BracketLeft", "[")
        self.wait_for_another(higher)
        self.browser.run("document.getElementById('cut-facing').click()")
        self.browser.wait_for(f"{READY} && document.querySelector('[data-normal][aria-label^=y]').value === '-1'")
        self.set_input("#cut-direction", "", "change")
        self.browser.wait_for(f"{READY} && {SEEN} === {json.dumps(self.before)}")

    def test_a_point_leads_to_its_numbers_and_those_to_the_file(self):
        self.browser.click(*self.at(0.65, 0.5))
        self.browser.wait_for("document.querySelectorAll('#point li').length === 4")
        self.assertIn("sphere scene.json:3:21", self.text("point"))
        self.browser.run("[...document.querySelectorAll('#point li button')].at(-1).click()")
        self.browser.wait_for("document.getElementById('inspector-head').textContent.includes('Sphere')")
        self.set_number("radius", "0.3")
        smaller = self.wait_for_another(self.before)
        self.assertEqual(self.view.file.read_text(encoding="utf-8"), LARGER.replace('"radius": 0.5', '"radius": 0.3'))
        self.shoot("numbers")
        # Undone and done again, by the keys.
        self.browser.run("document.activeElement.blur()")
        self.browser.press("z", "KeyZ", modifiers=CONTROL)
        self.browser.wait_for(f"{READY} && {SEEN} === {json.dumps(self.before)}")
        self.assertEqual(self.view.file.read_text(encoding="utf-8"), LARGER)
        self.browser.press("z", "KeyZ", modifiers=CONTROL | SHIFT)
        self.browser.wait_for(f"{READY} && {SEEN} === {json.dumps(smaller)}")

    def test_planes_of_the_film_are_shown(self):
        layers = self.browser.run("[...document.getElementById('layer').options].map((o) => o.value)")
        for layer in ("depth", "normal", "position_behind", "phase_to", "length_glass", "CryptoPhase00", "variance"):
            self.assertIn(layer, layers)
        last = self.before
        for layer in ("depth", "normal", "phase_to", "CryptoPhase00", "length_glass"):
            self.set_input("#layer", layer, "change")
            last = self.wait_for_another(last)
            self.shoot(f"layer-{layer}")
        self.set_input("#layer", "", "change")
        self.browser.wait_for(f"{READY} && {SEEN} === {json.dumps(self.before)}")

    def test_time_goes_from_the_first_key_to_the_last(self):
        self.assertTrue(self.browser.run("document.getElementById('time').hidden"))
        moving = LARGER.replace('"radius": 0.5', '"radius": {"keys": [[0, 0.2], [2, 0.5]]}')
        self.assertNotEqual(moving, LARGER)
        self.view.file.write_text(moving, encoding="utf-8")
        self.browser.wait_for("!document.getElementById('time').hidden")
        first = self.wait_for_another(self.before)
        slider = "document.getElementById('time-slider')"
        self.assertEqual(self.browser.run(f"[{slider}.min, {slider}.max, {slider}.value]"), ["0", "2", "0"])
        self.shoot("time")
        self.set_input("#time-slider", "2", "input")
        # At its end the scene is the one without keys.
        self.browser.wait_for(f"{READY} && {SEEN} === {json.dumps(self.before)}")
        self.assertEqual(self.text("time-said"), "2.00 s")
        self.set_input("#time-slider", "0", "input")
        self.browser.wait_for(f"{READY} && {SEEN} === {json.dumps(first)}")
        # Played, it ends at the end by itself, in two seconds at least.
        begun = time.monotonic()
        self.browser.run("document.getElementById('time-play').click()")
        self.browser.wait_for(f"document.getElementById('time-play').textContent === 'Stop'")
        self.browser.wait_for(f"document.getElementById('time-play').textContent === 'Play'")
        self.assertGreater(time.monotonic() - begun, 1.5)
        self.browser.wait_for(f"{READY} && {SEEN} === {json.dumps(self.before)}")

    def test_the_exposure_brightens(self):
        self.browser.run("(() => { const e = document.getElementById('exposure'); e.value = 2; e.dispatchEvent(new Event('input')); })()")
        self.wait_for_another(self.before)


if __name__ == "__main__":
    unittest.main()
