"""What people know from other tools, in Chromium: labels, undo in fields, Escape, handles under the pointer, clicks that
select the whole first, and parameters that bring and remove others."""

import json
import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from studio_case import GLASSES, StudioCase  # noqa: E402
from studio_user import CONTROL  # noqa: E402

COLOURED = GLASSES.replace('{"clear": {"ior": 1.50}, "density": 2500}', '{"clear": {"ior": 1.50, "color": [0.8, 0.9, 1], "anisotropy": 0.5, "scattering": [1, 1, 1]}, "density": 2500}')
# A ball that is used by a part, beside a part of its own.
NESTED = GLASSES.replace('"shapes": {"ball": {"sphere": {"radius": 0.5}}}', '"shapes": {"ball": {"union": [{"sphere": {"radius": 0.5}}, {"box": {"size": [0.2, 0.2, 0.2]}}]}}')


class Habits(StudioCase):
    def select(self, pointer):
        self.browser.run(f"studio.selection.set([{json.dumps(pointer)}])")

    def undo(self):
        self.step(lambda: self.browser.run("studio.actions.undo()"))

    # ---- parameters that require and exclude others

    def test_a_measured_medium_takes_its_scale_and_removes_the_colour(self):
        self.open(COLOURED)
        self.select("/phases/glass")
        self.until("document.querySelector('[data-parameter=medium]')")
        self.browser.run("document.querySelector('#inspector details.rest').open = true")
        self.click("[data-parameter=medium] .choice")
        self.until("document.querySelector('.menu:popover-open')")
        self.step(lambda: self.click(self.named(".menu .item", "whole milk")))
        clear = self.scene()["phases"]["glass"]["clear"]
        self.assertEqual(self.scene()["phases"]["glass"]["density"], 2500)
        self.assertEqual(clear, {"ior": 1.5, "anisotropy": 0.5, "medium": "whole_milk", "scale": 25})
        self.shoot("habits-medium")
        self.undo()
        self.assertEqual(self.file(), COLOURED)
        # And back: a colour needs no medium, so that its scale is not left over.
        self.step(lambda: self.browser.run("studio.actions.redo()"))
        self.browser.run("document.querySelector('#inspector details.rest').open = true")
        self.step(lambda: self.click("[data-parameter=medium] .reset"))
        self.assertEqual(self.scene()["phases"]["glass"]["clear"], {"ior": 1.5})
        self.step(lambda: self.browser.run("studio.inspector.context.set(studio.scene.entry('/phases/glass'), 'glass', '\"bk7\"', null, {spec: {}, fail() {}})"))
        self.assertEqual(self.scene()["phases"]["glass"]["clear"], {"glass": "bk7"})

    # ---- undo in a field

    def test_ctrl_z_in_a_field_undoes_the_scene(self):
        self.open(GLASSES)
        self.select("/tree/over/1/set/of")
        self.click("[data-parameter=size] .number")
        self.browser.run("document.activeElement.select()")
        self.type("0.7")
        self.step(lambda: self.browser.press("Enter", "Enter", "\r"))
        self.assertEqual(self.tree()["over"][1]["set"]["of"]["box"]["size"], [0.7, 0.5, 0.5])
        self.step(lambda: self.key("z", CONTROL))
        self.assertEqual(self.file(), GLASSES)
        self.until("document.activeElement.value === '0.5'")
        self.step(lambda: self.browser.press("ArrowUp"))
        self.step(lambda: self.key("z", CONTROL))
        self.assertEqual(self.file(), GLASSES)
        # What is being typed is not part of the scene yet.
        self.type("3")
        self.key("z", CONTROL)
        self.browser.run("new Promise((done) => setTimeout(done, 300))")
        self.assertEqual(self.browser.run("studio.scene.redo !== null"), True)
        self.browser.press("Escape")

    # ---- errors

    def test_an_error_goes_when_another_page_changes_the_scene(self):
        self.open(GLASSES)
        self.expected = "Failed to load resource"
        self.select("/tree/over/2/set/of/translate/of")
        self.click("[data-parameter=radius] .number")
        self.browser.run("document.activeElement.select()")
        self.type("-3")
        self.browser.press("Enter", "Enter", "\r")
        self.until("document.querySelector('[data-parameter=radius].wrong')")
        self.browser.run("document.activeElement.blur()")
        self.assertEqual(self.file(), GLASSES)
        answer = self.view.post("document", {"label": "elsewhere", "base": self.browser.run("studio.scene.version"), "operations": [
            {"set": "/tree/over/1/set/of/box/size", "to": "[0.6, 0.5, 0.5]"}]})
        self.assertEqual(answer.status, 200)
        self.until("!document.querySelector('.parameter.wrong') && document.querySelector('[data-parameter=radius] input').value === '0.3'", 10)

    # ---- labels

    def test_a_label_focuses_its_control(self):
        self.open(GLASSES)
        self.select("/tree/over/0/set/of")
        self.click("[data-parameter=by] .label")
        self.until("document.activeElement.getAttribute('aria-label')?.startsWith('By')")
        self.assertTrue(self.browser.run("document.querySelector('[data-parameter=by] .help').hidden"))
        self.click("[data-parameter=by] .about-it")
        self.until("!document.querySelector('[data-parameter=by] .help').hidden")
        self.shoot("habits-help")

    def test_coefficients_are_red_green_and_blue(self):
        self.open(COLOURED)
        self.select("/phases/glass")
        self.until("document.querySelector('[data-parameter=scattering] .tag')")
        self.assertEqual(self.browser.run("[...document.querySelectorAll('[data-parameter=scattering] .tag')].map((e) => e.textContent)"), ["R", "G", "B"])

    # ---- lights

    def test_a_new_light_fits_the_scene_and_its_copy_lies_beside_it(self):
        self.open(GLASSES)
        radius = self.browser.run("studio.view.radius()")
        self.step(lambda: self.browser.run("studio.actions.addKind(studio.actions.catalogue.named('rectangle', 'light'))"))
        light = self.scene()["lights"][1]["rectangle"]
        k = float(f"{radius:.1g}")
        self.assertEqual(light["centre"], [-2 * k, -2 * k, 3 * k])
        self.assertEqual(light["width"], k)
        # The irradiance at the centre is that of a bright sky, π.
        distance = math.dist(light["centre"], [0, 0, 0])
        irradiance = light["intensity"] * light["radiance"][0] * light["width"] * light["height"] / distance ** 2
        self.assertGreater(irradiance, 2.5)
        self.assertLess(irradiance, 5)
        self.select("/lights/1")
        self.step(lambda: self.browser.run("studio.actions.duplicate()"))
        copy = self.scene()["lights"][2]["rectangle"]
        self.assertGreater(copy["centre"][0], light["centre"][0])
        self.assertEqual({**copy, "centre": light["centre"]}, light)

    # ---- handles under the pointer, and Escape

    def grip(self, name):
        part = f"[...document.querySelectorAll('[data-handle={json.dumps(name)}] :is(circle, rect)')].at(-1)"
        box = self.browser.run(f"({part}).getBoundingClientRect().toJSON()")
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def test_handles_follow_the_pointer_before_the_server_answers(self):
        self.open(GLASSES)
        self.select("/tree/over/2")
        for name, by in (("move x", (40, 0)), ("move", (30, 20)), ("radius", (25, 0)), ("scale", (20, -20))):
            with self.subTest(name):
                self.until("!studio.scene.isBusy && document.querySelector('#handles .handle')")
                self.browser.run(f"for (const e of document.querySelectorAll('#handles .handle')) e.style.display = e.dataset.handle === {json.dumps(name)} ? '' : 'none'")
                x, y = self.grip(name)
                # No step arrives until the handle has been looked at.
                self.browser.run("window.perform = studio.scene.perform; studio.scene.perform = (step) => new Promise((done) => { window.late = () => window.perform.call(studio.scene, step).then(done); })")
                self.browser.mouse("mouseMoved", x, y)
                self.browser.mouse("mousePressed", x, y, button="left", clickCount=1)
                for k in (0.5, 1):
                    self.browser.mouse("mouseMoved", x + k * by[0], y + k * by[1], button="left", buttons=1)
                now = self.grip(name)
                self.assertAlmostEqual(now[0], x + by[0], delta=2)
                self.assertAlmostEqual(now[1], y + by[1], delta=2)
                # Nor does it jump back when it is released.
                self.browser.mouse("mouseReleased", x + by[0], y + by[1], button="left", clickCount=1)
                self.assertEqual(self.grip(name), now)
                self.browser.run("studio.scene.perform = window.perform")
                self.step(lambda: self.browser.run("window.late()"))
                self.until("!document.querySelector('#handles .dragged')")
                self.undo()
        self.assertEqual(self.file(), GLASSES)

    def test_escape_takes_a_drag_back(self):
        self.open(GLASSES)
        self.step(lambda: self.browser.run("studio.scene.perform({label: 'first', operations: [{set: '/tree/over/2/set/of/translate/by', to: '[-0.8, 0, 0.1]'}]})"))
        before = self.file()
        self.select("/tree/over/2")
        self.browser.run("document.getElementById('inspector').scrollTop = 0")
        number = self.place("[data-parameter=by] .number")
        for name, start in (("move x", None), ("scale", None), ("a number", number)):
            with self.subTest(name):
                self.until("!studio.scene.isBusy && document.querySelector('#handles .handle') && !document.querySelector('#handles .dragged')")
                x, y = start or self.grip(name)
                self.browser.mouse("mouseMoved", x, y)
                self.browser.mouse("mousePressed", x, y, button="left", clickCount=1)

                def move():
                    for k in (10, 20, 30):
                        self.browser.mouse("mouseMoved", x + k, y - k / 3, button="left", buttons=1)
                self.step(move)
                self.assertNotEqual(self.file(), before)
                self.step(lambda: self.browser.press("Escape"))
                self.browser.mouse("mouseMoved", x + 50, y, button="left", buttons=1)
                self.browser.mouse("mouseReleased", x + 50, y, button="left", clickCount=1)
                self.until(f"!studio.scene.isBusy && studio.scene.text === {json.dumps(before)}")
                self.assertEqual(self.file(), before)
                self.assertEqual(self.browser.run("[studio.scene.undo, studio.scene.redo]"), ["first", None])

    # ---- clicks in the picture

    def test_a_click_selects_the_whole_and_another_a_part(self):
        self.open(NESTED)
        self.until("studio.view.canvas.width > 1")
        box = self.browser.run("document.getElementById('picture').getBoundingClientRect().toJSON()")
        # The wooden ball on the right, beside the handles.
        at = box["x"] + box["width"] / 2 + 0.85 / (2 * 5 * 0.268) * box["height"], box["y"] + box["height"] / 2 + 0.25 / (2 * 5 * 0.268) * box["height"]
        self.browser.run("document.activeElement.blur()")
        for pointer in ("/tree/over/0", "/tree/over/0/set/of", "/tree/over/0/set/of/translate/of", "/shapes/ball", "/shapes/ball/union/0", "/tree/over/0"):
            self.browser.click(*at)
            self.until(f"studio.selection.active === {json.dumps(pointer)}", 5)
        # Another object is again selected as a whole.
        self.browser.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2 + 8)
        self.until("studio.selection.active === '/tree/over/1'", 5)

    # ---- the outline in the picture

    def test_the_outline_comes_although_the_server_was_busy(self):
        self.open(GLASSES)
        self.until("studio.view.canvas.width > 1")
        self.browser.run("""window.fetch = ((real) => (address, ...more) => {
            if (!String(address).includes("selected") || window.refused >= 2) return real(address, ...more);
            window.refused = (window.refused ?? 0) + 1;
            return Promise.resolve(new Response("finding the selection in the picture takes too long", {status: 409}));
        })(window.fetch)""")
        for pointer in ("/tree/over/0/set/of", "/shapes/ball"):
            self.browser.run("window.refused = 0")
            self.select(pointer)
            self.until("window.refused === 2", 10)
            self.until("document.querySelector('#selected-outline .line') && document.getElementById('selected-said').textContent.includes('outlined')", 10)


if __name__ == "__main__":
    unittest.main()
