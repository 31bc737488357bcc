"""Surfaces are dragged in the picture, in Chromium: by mouse with Alt, with the tool, by keyboard and by finger.

PHASETREE_SCREENSHOTS names a folder for pictures of it."""

import json
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from studio_case import StudioCase  # noqa: E402
from studio_user import ALT  # noqa: E402

# A ball on the left that may be moved, and a box on the right that may not.
SCENE = """{
  "version": 1,
  "phases": {"glass": {"diffuse": {"color": [0.3, 0.5, 0.8]}}, "wood": {"diffuse": {"color": [0.6, 0.3, 0.1]}}},
  "tree": {"over": [
    {"set": {"phase": "glass", "of": {"translate": {"by": [-0.8, 0, 0], "of": {"sphere": {"radius": 0.5}}}}}},  // a ball
    {"set": {"phase": "wood", "of": {"intersection": [{"slab": {"thickness": 0.8}}, {"cylinder": {"radius": 0.3, "height": 4}}]}}}
  ]},
  "lights": [{"constant": {"radiance": [1, 1, 1]}}],
  "camera": {"position": [0, -5, 0], "look_at": [0, 0, 0], "fov": 30},
  "render": {"width": 240, "height": 160, "samples": 1}
}
"""
HEIGHT = 2 * 5 * 0.2679491924  # of the picture, in the plane y = 0: 2 · 5 · tan 15°
REST = "!studio.grab.isBusy && !studio.scene.isBusy"


class Grabbing(StudioCase):
    def open(self, text=SCENE):
        super().open(text)
        self.expected = "Failed to load resource: the server responded with a status of 409"
        self.until("document.querySelector('#picture').width === 240 && studio.view.camera() !== null")

    def spot(self, x, z):
        """Where a point of the plane y = 0 is on the page."""
        box = self.browser.run("(({left, top, width, height}) => [left, top, width, height])(document.querySelector('#picture').getBoundingClientRect())")
        unit = box[3] / HEIGHT
        return box[0] + box[2] / 2 + unit * x, box[1] + box[3] / 2 - unit * z

    def number(self, pointer):
        return json.loads(self.browser.run(f"(() => {{ let at = JSON.parse(studio.scene.text.replace(/\\/\\/[^\\n]*/g, '')); "
                                           f"for (const key of {json.dumps(pointer.split('/')[1:])}) at = at[key]; return JSON.stringify(at); }})()"))

    BALL = "/tree/over/0/set/of/translate"

    def test_alt_and_dragging_moves_a_ball_in_one_step_that_can_be_undone(self):
        self.open()
        self.browser.drag(self.spot(-0.8, 0.1), self.spot(-0.5, 0.3), modifiers=ALT)
        self.until(f"{REST} && studio.grab.point?.follows && !document.querySelector('#grab-panel').hidden")
        x, _, z = self.number(f"{self.BALL}/by")
        # The grabbed point is in front of the plane, where a pixel is less wide.
        self.assertAlmostEqual(x, -0.8 + 0.3 * 0.9, delta=0.03)
        self.assertAlmostEqual(z, 0.2 * 0.9, delta=0.03)
        self.assertIn("// a ball", self.view.file.read_text(encoding="utf-8"))
        self.shoot("grab")
        self.browser.run("studio.scene.goBack()")
        self.until(f"{REST}")
        self.assertEqual(self.view.file.read_text(encoding="utf-8"), SCENE)
        self.assertEqual(self.browser.run("studio.scene.undo"), None)

    def test_the_panel_chooses_what_may_change(self):
        self.open()
        self.browser.drag(self.spot(-0.8, 0.42), self.spot(-0.8, 0.6), modifiers=ALT)
        self.until(f"{REST} && studio.grab.point")
        rows = self.browser.run("[...document.querySelectorAll('#grab-panel .row')].map((row) => row.innerText.replace(/\\s+/g, ' '))")
        self.assertTrue(any(row.startswith("Radius") for row in rows), rows)
        self.assertTrue(any(row.startswith("z") for row in rows), rows)
        radius = self.number(f"{self.BALL}/of/sphere/radius")
        self.assertGreater(radius, 0.5)
        # With the radius alone, the ball stays where it was.
        self.browser.run("[...document.querySelectorAll('#grab-panel .row')].find((row) => row.innerText.startsWith('Radius')).querySelector('button').click()")
        self.until(f"{REST} && studio.grab.point.values['{self.BALL}/by/2'] === 0")
        self.assertEqual(self.number(f"{self.BALL}/by"), [-0.8, 0, 0])
        self.assertGreater(self.number(f"{self.BALL}/of/sphere/radius"), radius + 0.02)
        # Locked, it stays as it was, and the ball moves.
        self.browser.run("document.querySelector('#grab-panel header .link').click()")
        self.until(REST)
        self.browser.run("[...document.querySelectorAll('#grab-panel .row')].find((row) => row.innerText.startsWith('Radius')).querySelector('input').click()")
        self.until(f"{REST} && studio.grab.point.values['{self.BALL}/of/sphere/radius'] === 0.5")
        self.assertGreater(self.number(f"{self.BALL}/by")[2], 0.1)
        # All of it is one step.
        self.browser.run("studio.scene.goBack()")
        self.until(REST)
        self.assertEqual(self.view.file.read_text(encoding="utf-8"), SCENE)

    def test_the_tool_works_with_the_mouse_and_the_keyboard(self):
        self.open()
        camera = self.browser.run("JSON.stringify(studio.view.camera())")
        self.browser.press("g", "KeyG", "g")
        self.until("document.querySelector('#grab').getAttribute('aria-pressed') === 'true'")
        # The top of the cut cylinder: the slab is thicker.
        self.browser.drag(self.spot(0, 0.35), self.spot(0.1, 0.35))
        self.until(f"{REST} && studio.grab.point")
        self.assertEqual(self.browser.run("studio.grab.point.inside"), "wood")
        self.assertNotEqual(self.number("/tree/over/1/set/of/intersection/1/cylinder/radius"), 0.3)
        self.browser.run("studio.scene.goBack()")
        # The point is let go, because its numbers are out of date.
        self.until(f"{REST} && studio.grab.point === null")
        # From the middle of the picture, by keys.
        self.browser.press("Enter")
        self.until(f"{REST} && studio.grab.point")
        for _ in range(3):
            self.browser.press("ArrowRight")
        self.until(f"{REST} && studio.scene.undo !== null")
        self.assertEqual(self.browser.run("studio.scene.undo"), "Drag wood")
        self.assertEqual(self.browser.run("JSON.stringify(studio.view.camera())"), camera)
        self.browser.press("Escape")
        self.browser.press("Escape")
        self.until("document.querySelector('#grab').getAttribute('aria-pressed') === 'false'")
        # Then a drag turns the camera again.
        self.browser.drag(self.spot(-0.8, 0), self.spot(-0.5, 0))
        self.until(f"JSON.stringify(studio.view.camera()) !== {json.dumps(camera)}")

    def test_a_finger_drags_with_the_tool(self):
        self.open()
        self.browser.run("document.querySelector('#grab').click()")
        self.browser.touch([self.spot(-0.8, 0)], [self.spot(-0.75, 0)], [self.spot(-0.7, 0.1)], [self.spot(-0.6, 0.2)])
        self.until(f"{REST} && studio.grab.point?.follows && studio.scene.undo !== null")
        self.assertAlmostEqual(self.number(f"{self.BALL}/by")[2], 0.2 * 0.9, delta=0.03)

    def test_where_nothing_can_be_dragged_the_page_says_why(self):
        self.open()
        self.browser.drag(self.spot(1.5, 0.9), self.spot(1.4, 0.9), modifiers=ALT)
        self.until(f"{REST} && document.querySelector('#toasts').textContent.includes('there is no surface at this point')")
        self.assertTrue(self.browser.run("document.querySelector('#grab-panel').hidden && studio.scene.undo === null"))
        # A click with Alt still inspects the point.
        x, y = self.spot(-0.8, 0)
        self.browser.mouse("mousePressed", x, y, button="left", clickCount=1, modifiers=ALT)
        self.browser.mouse("mouseReleased", x, y, button="left", clickCount=1, modifiers=ALT)
        self.until("document.querySelector('#point').textContent.includes('glass')")


if __name__ == "__main__":
    unittest.main(verbosity=2)
