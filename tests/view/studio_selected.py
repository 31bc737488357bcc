"""The studio's page in Chromium: the outline of the selection in the picture, hidden parts, files to choose from, the
unit of lengths, and whether the file is valid."""

import json
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from studio_case import GLASSES, StudioCase  # noqa: E402
from studio_user import ALT  # noqa: E402

OUTLINE = "document.querySelector('#selected-outline .line')"
WOOD = "[data-key='/tree/over/0']"  # the row of the ball
LARGER = GLASSES.replace('"width": 96, "height": 72', '"width": 480, "height": 360')


class Selected(StudioCase):
    def select(self, *pointers):
        self.browser.run(f"studio.selection.set({json.dumps(pointers)})")

    def outlined(self):
        """The box of the outline in the picture, from 0 to 1, at rest."""
        self.until(f"{OUTLINE} && !document.getElementById('selected-outline').classList.contains('old')")
        return self.browser.run(f"""(() => {{
            const box = {OUTLINE}.getBoundingClientRect(), all = document.getElementById('picture').getBoundingClientRect();
            return [(box.left - all.left) / all.width, (box.top - all.top) / all.height, (box.right - all.left) / all.width, (box.bottom - all.top) / all.height];
        }})()""")

    def hidden(self):
        return self.browser.run("fetch('picture?after=0&picture=0').then((a) => a.text()).then((text) => JSON.parse(text.split('\\n')[0]).hidden_parts)")

    def assert_near(self, found, expected, by=0.02):
        for a, b in zip(found, expected):
            self.assertAlmostEqual(a, b, delta=by, msg=(found, expected))

    # ---- the outline

    def test_the_selection_is_outlined_where_it_is_seen(self):
        self.open(LARGER)
        self.until("studio.view.canvas.width > 1")
        # Fractions of the picture's height and width per unit at a distance of 5.
        high = 1 / (2 * 5 * 0.2679492)
        wide = high * 3 / 4
        ball = [0.5 + (0.6 - 0.503) * wide, 0.5 - 0.503 * high, 0.5 + (0.6 + 0.503) * wide, 0.5 + 0.503 * high]
        self.click(WOOD)
        self.assert_near(self.outlined(), ball)
        said = lambda: self.browser.run("document.getElementById('selected-said').textContent")
        self.assertIn("outlined in the picture", said())
        self.shoot("selected-ball")
        # By the keyboard.
        self.browser.press("ArrowDown")
        self.until("studio.selection.active !== '/tree/over/0'")
        self.select("/phases/glass")
        box = self.outlined()
        self.assertLess(box[0], 0.35)
        self.shoot("selected-phase")
        # A part that has moved is outlined at its new place.
        self.select("/tree/over/0")
        self.step(lambda: self.browser.run("studio.scene.perform({label: 'Move', operations: [{set: '/tree/over/0/set/of/translate/by', to: '[0.6, 0, 0.4]'}]})"))
        self.until(f"{OUTLINE} && {OUTLINE}.getBoundingClientRect().top < document.getElementById('picture').getBoundingClientRect().top + "
                   f"{ball[1] - 0.3 * high} * document.getElementById('picture').getBoundingClientRect().height")
        self.assert_near(self.outlined(), [ball[0], ball[1] - 0.4 * high, ball[2], ball[3] - 0.4 * high])
        # So is a part after the camera has turned.
        before = self.outlined()
        self.browser.run("studio.view.tabs.show('view')")
        self.click("[data-turn='1 0']")
        self.until("document.getElementById('selected-outline').classList.contains('old')", 10)
        self.assertNotEqual(self.outlined(), before)

    def test_it_is_switched_off_and_follows_the_size_of_the_picture(self):
        self.open(LARGER)
        self.select("/tree/over/0")
        before = self.outlined()
        self.browser.run("document.activeElement.blur()")
        self.key("o")
        self.until(f"!{OUTLINE}")
        self.assertEqual(self.browser.run("document.getElementById('outline-selection').getAttribute('aria-pressed')"), "false")
        self.key("o")
        self.assert_near(self.outlined(), before, 1e-6)
        for width, height in ((390, 844), (1920, 1080)):
            self.browser.resize(width, height)
            self.until(f"Math.abs(document.getElementById('selected-outline').getBoundingClientRect().width - document.getElementById('picture').getBoundingClientRect().width) < 1")
            self.assert_near(self.outlined(), before, 0.01)
        self.browser.resize(1280, 720)
        # Settings have no outline, and neither does an empty selection.
        for pointers in (["/camera"], []):
            self.select("/tree/over/0")
            self.outlined()
            self.select(*pointers)
            self.until(f"!{OUTLINE}")

    # ---- hidden parts

    def test_parts_are_hidden_and_the_file_stays(self):
        self.open(GLASSES)
        self.until("studio.view.canvas.width > 1")
        row = f"document.querySelector({json.dumps(WOOD)})"
        self.browser.run(f"{row}.querySelector('.eye').click()")
        self.until(f"{row}.classList.contains('is-hidden')")
        self.assertEqual(self.hidden(), ["/tree/over/0"])
        self.assertEqual(self.browser.run(f"{row}.querySelector('.eye').getAttribute('aria-label').slice(0, 4)"), "Show")
        self.assertEqual(self.file(), GLASSES)
        self.shoot("hidden-ball")
        # The part stays hidden while the scene is edited.
        self.step(lambda: self.browser.run("studio.scene.perform({label: 'Move', operations: [{move: '/tree/over/0', to: '/tree/over/2'}]})"))
        self.until("document.querySelector('[data-key=\"/tree/over/2\"]').classList.contains('is-hidden')")
        self.assertFalse(self.browser.run("document.querySelector('[data-key=\"/tree/over/0\"]').classList.contains('is-hidden')"))
        self.step(lambda: self.browser.run("studio.actions.undo()"))
        self.until(f"{row}.classList.contains('is-hidden')")
        # Keys hide all selected parts, and show everything again.
        self.select("/tree/over/0", "/tree/over/1", "/lights/0")
        self.browser.run("document.activeElement.blur()")
        self.key("h")
        self.until("document.querySelectorAll('[data-key=\"/tree/over/1\"].is-hidden, [data-key=\"/lights/0\"].is-hidden').length === 2")
        self.key("h")
        self.until("document.querySelectorAll('#outline .is-hidden').length === 0")
        self.key("h")
        self.until("document.querySelectorAll('#outline .is-hidden').length > 0")
        self.key("h", ALT)
        self.until("document.querySelectorAll('#outline .is-hidden').length === 0")
        self.assertEqual(self.hidden(), [])
        self.assertEqual(self.file(), GLASSES)

    # ---- files

    def test_a_file_is_chosen_from_the_folder(self):
        self.open(GLASSES.replace('{"box": {"size": [0.5, 0.5, 0.5]}}', '{"mesh": {"file": "first.obj"}}'))
        cube = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1)) + "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n"
        for name in ("first.obj", "models/second.obj", "notes.txt"):
            file = self.view.file.with_name("models") / "x"
            file.parent.mkdir(exist_ok=True)
            (self.view.file.parent / name).write_text(cube, encoding="utf-8")
        self.select("/tree/over/1/set/of")
        self.click("[data-parameter=file] .file-field button")
        self.until("document.querySelector('.menu:popover-open')")
        self.assertEqual(self.browser.run("[...document.querySelectorAll('.menu:popover-open .item')].map((e) => e.textContent)"), ["first.obj", "models/second.obj"])
        self.assertEqual(self.browser.run("document.activeElement.textContent"), "first.obj")
        self.shoot("choose-file")
        self.browser.press("ArrowDown")
        self.step(lambda: self.browser.press("Enter", "Enter", "\r"))
        self.assertEqual(self.tree()["over"][1]["set"]["of"], {"mesh": {"file": "models/second.obj"}})
        self.until("document.querySelector('[data-parameter=file] input').value === 'models/second.obj'")

    # ---- measured colours

    def test_measured_colours_are_offered(self):
        self.open(GLASSES.replace('"wood": {"diffuse": {"color": [0.6, 0.3, 0.1]}', '"gold": {"conductor": {"metal": "gold"}}, "wood": {"diffuse": {"color": [0.6, 0.3, 0.1]}'))
        self.select("/phases/gold")
        self.until("document.querySelector('[data-parameter=metal] .choice .swatch')")
        self.select("/phases/wood")
        self.click("[data-parameter=color] .swatch-button")
        self.until("document.querySelector('.colours:popover-open')")
        self.shoot("measured-colours")
        self.step(lambda: self.click(".colours [aria-label='whole milk']"))
        colour = self.scene()["phases"]["wood"]["diffuse"]["color"]
        for a, b in zip(colour, (0.91, 0.88, 0.76)):
            self.assertAlmostEqual(a, b, delta=0.01)

    # ---- a newcomer

    def test_lengths_have_the_unit_of_the_scene(self):
        self.open(GLASSES)
        self.select("/tree/over/1/set/of")
        self.until("document.querySelector('[data-parameter=size] .number')")
        self.select("/tree/over/2/set/of/translate/of")
        self.until("document.querySelector('[data-parameter=radius] .number')")
        text = "document.querySelector('[data-parameter=radius] .control').innerText"
        self.assertNotIn("m", self.browser.run(text))
        self.open(GLASSES.replace('"version": 1,', '"version": 1, "unit": "cm",'))
        self.select("/tree/over/2/set/of/translate/of")
        self.until("document.querySelector('[data-parameter=radius] .number')")
        self.assertIn("cm", self.browser.run(text))

    def test_a_broken_file_is_not_called_saved(self):
        self.open(GLASSES)
        saved = "document.getElementById('saved').textContent"
        self.until(f"{saved} === 'Saved'")
        self.view.file.write_text(GLASSES[:200], encoding="utf-8")
        self.until(f"{saved} === 'Invalid file'")
        self.view.file.write_text(GLASSES.replace('"radius": 0.5', '"radius": -0.5'), encoding="utf-8")
        self.until(f"{saved} === 'Invalid file' && document.getElementById('saved').title.includes('radius')")
        self.view.file.write_text(GLASSES, encoding="utf-8")
        self.until(f"{saved} === 'Saved'")


if __name__ == "__main__":
    unittest.main()
