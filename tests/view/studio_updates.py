"""The studio in Chromium while another page changes the scene all the time: between any two keys, and between press and
release. Nothing that is typed, focused, opened or clicked is lost; neither on a slow connection."""

import json
import pathlib
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from studio_case import GLASSES, StudioCase  # noqa: E402
from support import PATIENCE  # noqa: E402

PAINT = '"paint": {"diffuse": {"color": {"measured": {"reflectance": [[400, 0.2], [500, 0.4], [700, 0.8]]}}}}'
BANDS = '"bands": {"diffuse": {"color": {"field": {"of": {"plane": {}}, "ramp": [[-0.5, [0.1, 0.1, 0.8]], [0.5, [0.8, 0.1, 0.1]]]}}}}'
EVERYTHING = GLASSES.replace('"wood": {', f"{PAINT},\n    {BANDS},\n    \"wood\": {{").replace(
    '{"box": {"size": [0.5, 0.5, 0.5]}}', '{"extrude": {"height": 0.5, "of": {"polygon": [[-0.5, -0.4], [0.5, -0.4], [0, 0.5]]}}}').replace(
    '{"sphere": {"radius": 0.3}}', '{"intersection": [{"sphere": {"radius": 0.3}}, {"plane": {"offset": 0.2}}]}').replace(
    '"lights": [{"constant": {"radiance": [1, 1, 1]}}]', '"lights": [{"constant": {"radiance": [1, 1, 1]}}, {"sun": {"direction": [0, 0, 1]}}]').replace(
    '"fov": 30', '"fov": {"keys": [[0, 30], [1, 35]]}')
# Answers come late, as over a slow connection.
SLOW = """(() => {
    const ask = window.fetch;
    window.fetch = async (...request) => {
      const answer = await ask(...request);
      if (/document/.test(request[0])) await new Promise((done) => setTimeout(done, %d));
      return answer;
    };
})()"""


class Updates(StudioCase):
    changes = 0

    def open(self, text=EVERYTHING):
        super().open(text)
        self.until("document.getElementById('picture').width > 1")

    def select(self, pointer):
        self.browser.run(f"studio.selection.set([{json.dumps(pointer)}])")

    def update(self):
        """Another page changes numbers and colours that are shown everywhere, and its picture arrives."""
        self.changes += 1
        strength = round(0.2 + 0.01 * (self.changes % 60), 2)
        operations = [{"set": "/phases/wood/diffuse/color", "to": f"[{strength}, 0.3, 0.1]"}, {"set": "/phases/wood/density", "to": str(700 + self.changes)},
                      {"set": "/camera/position/2", "to": str(0.001 * self.changes)}]
        version = json.loads(self.view.get("document?after=0").body)["version"]
        self.assertEqual(self.view.post("document", {"base": version, "label": "Elsewhere", "operations": operations, "strict": False}).status, 200)
        end = time.monotonic() + 0.25 * PATIENCE
        while time.monotonic() < end and not self.browser.run(f"studio.scene.text.includes('\"density\": {700 + self.changes}}}')"):
            time.sleep(0.01)

    def press(self, element, modifiers=0):
        """Presses an element, and releases it after an update."""
        x, y = self.place(element)
        self.browser.mouse("mouseMoved", x, y)
        self.update()
        x, y = self.place(element)
        self.browser.mouse("mousePressed", x, y, button="left", clickCount=1, modifiers=modifiers)
        self.update()
        self.browser.mouse("mouseReleased", x, y, button="left", clickCount=1, modifiers=modifiers)

    def presses(self, element, result, modifiers=0):
        self.press(element, modifiers)
        self.wait_for(result)
        self.update()
        self.wait_for(result)

    def wait_for(self, condition):
        try:
            self.until(condition, 20)
        except AssertionError:
            self.fail(f"{condition} does not come")

    def types(self, text):
        for key in text:
            self.browser.press(key, "", key)
            self.update()

    def has(self, part):
        self.wait_for(f"studio.scene.text.includes({json.dumps(part)})")

    # ---- typing

    def test_three_numbers_are_typed_one_after_the_other(self):
        for delay in (0, 400, 1500):
            with self.subTest(delay=delay):
                self.open()
                self.select("/tree/over/0/set/of")
                self.browser.run(SLOW % delay)
                self.click("[data-parameter=by] .number")
                for i, number in enumerate(("0.71", "-0.2", "0.33")):
                    if i > 0:
                        self.browser.press("Tab")
                    self.types(number)
                self.browser.press("Enter")
                self.has('"by": [0.71, -0.2, 0.33]')
                self.wait_for("!studio.scene.isBusy")
                shown = "[...document.querySelectorAll('[data-parameter=by] input')].map((input) => input.value).join()"
                self.assertEqual(self.browser.run(shown), "0.71,-0.2,0.33")

    def test_a_number_is_put_in_without_keys(self):
        """As by a telephone's keyboard, by pasting or by dictation."""
        self.open()
        self.select("/shapes/ball")
        self.click("[data-parameter=radius] .number")
        self.update()
        for text in ("0.", "4", "5"):
            self.browser.call("Input.insertText", text=text)
            self.update()
        self.assertEqual(self.browser.run("document.activeElement.value"), "0.45")
        self.click("#outline-search")
        self.has('"ball": {"sphere": {"radius": 0.45}}')

    def test_the_first_key_replaces_a_number_that_has_just_changed(self):
        self.open()
        self.select("/shapes/ball")
        self.click("[data-parameter=radius] .number")
        version = json.loads(self.view.get("document?after=0").body)["version"]
        self.view.post("document", {"base": version, "label": "Elsewhere", "operations": [{"set": "/shapes/ball/sphere/radius", "to": "0.625"}], "strict": False})
        self.wait_for("document.activeElement.value === '0.625'")
        self.types("0.4")
        self.browser.press("Enter")
        self.has('"ball": {"sphere": {"radius": 0.4}}')

    def test_typing_ends_by_choosing_something_else(self):
        self.open()
        self.select("/shapes/ball")
        self.click("[data-parameter=radius] .number")
        self.types("0.35")
        self.presses(self.row("Camera"), "studio.selection.active === '/camera'")
        self.has('"ball": {"sphere": {"radius": 0.35}}')

    def test_typing_ends_when_the_scene_chooses_something_else(self):
        self.open()
        self.select("/shapes/ball")
        self.click("[data-parameter=radius] .number")
        self.types("0.35")
        self.select("/camera")
        self.has('"ball": {"sphere": {"radius": 0.35}}')

    def test_what_is_rejected_stays_to_be_corrected(self):
        self.open()
        self.expected = "Failed to load resource"
        self.select("/shapes/ball")
        self.click("[data-parameter=radius] .number")
        self.types("-3")
        self.browser.press("Tab")
        self.wait_for("!document.querySelector('[data-parameter=radius] .problem').hidden")
        self.update()
        self.assertEqual(self.browser.run("document.querySelector('[data-parameter=radius] input').value"), "-3")
        self.assertFalse(self.browser.run("document.querySelector('[data-parameter=radius] .problem').hidden"))
        self.click("[data-parameter=radius] .number")
        self.browser.press("Escape")
        self.update()
        self.assertEqual(self.browser.run("document.querySelector('[data-parameter=radius] input').value"), "0.5")
        self.assertTrue(self.browser.run("document.querySelector('[data-parameter=radius] .problem').hidden"))

    def test_names_colours_and_texts_are_typed(self):
        self.open()
        self.select("/phases/glass")
        self.click("#inspector-head .name")
        self.types("glas2")
        self.assertEqual(self.browser.run("document.activeElement.value"), "glas2")
        self.browser.press("Enter", "Enter", "\r")
        self.has('"glas2": {"clear"')
        self.until("studio.selection.active === '/phases/glas2'")
        self.click("#outline-search")
        self.types("sph")
        self.assertEqual(self.browser.run("document.activeElement.value"), "sph")
        for _ in range(3):
            self.browser.press("Backspace")
        self.select("/phases/paint/diffuse/color")
        self.click("[data-parameter=reflectance] .point-fields .number:nth-child(2)")
        self.types("0.3")
        self.browser.press("Enter")
        self.has("[400, 0.3]")
        self.select("/phases/bands/diffuse/color")
        self.click("[data-parameter=ramp] .hex")
        self.browser.run("document.activeElement.select()")
        self.types("#00ff00")
        self.browser.press("Enter", "Enter", "\r")
        self.has("[-0.5, [0, 1, 0]]")
        self.select("/tree/over/1/set/of/extrude/of")
        self.click("[data-parameter=points] .list-row:nth-child(3) .number:nth-child(2)")
        self.types("0.7")
        self.browser.press("Enter")
        self.has("[0, 0.7]")

    def test_dialogs_popups_and_the_text_are_typed_in(self):
        self.open()
        self.press("#add")
        self.wait_for("document.querySelector('dialog.palette .card')")
        self.types("torus")
        self.assertEqual(self.browser.run("document.activeElement.value"), "torus")
        self.browser.press("Escape")  # clears the field
        self.browser.press("Escape")
        self.wait_for("!document.querySelector('dialog')")
        self.select("/phases/glass")
        self.browser.run("document.activeElement.blur()")
        self.browser.press("F2")
        self.wait_for("document.querySelector('dialog input')")
        self.types("clear")
        self.browser.press("Enter", "Enter", "\r")
        self.has('"clear": {"clear"')
        self.select("/tree/over/0")
        self.press("[data-handle='move x'] circle")
        self.wait_for("document.querySelector('.typed:popover-open')")
        self.types("0.9")
        self.browser.press("Enter")
        self.has('"by": [0.9, 0, 0]')
        self.press("#text-toggle")
        self.wait_for("document.activeElement.id === 'text'")
        at = self.browser.run("(() => { const at = text.value.indexOf('Two phases'); text.setSelectionRange(at, at); return at; })()")
        self.types("As few as ")
        self.assertEqual(self.browser.run("text.selectionStart"), at + len("As few as "))
        self.has("// As few as Two phases.")
        self.update()
        self.has(f'"density": {700 + self.changes}')

    # ---- clicks

    def test_the_bar_and_the_outline_are_clicked(self):
        self.open()
        self.presses("#add", "document.querySelector('dialog.palette[open]')")
        self.presses("dialog.palette .chapters button:nth-child(3)", "document.querySelector('dialog.palette .chapters button:nth-child(3)').getAttribute('aria-pressed') === 'true'")
        self.presses("dialog.palette header .icon-button", "!document.querySelector('dialog')")
        self.presses(self.row("Glass extrude"), "studio.selection.active === '/tree/over/1'")
        self.presses("#wrap", "document.querySelector('.menu:popover-open')")
        self.presses(self.named(".menu .item", "Rotate"), "studio.scene.text.includes('\"rotate\"')")
        self.press("#undo")
        self.wait_for("studio.scene.redo !== null")
        twist = f"({self.row('Wood over glass')}).querySelector('.twist')"
        self.presses(f"[...document.querySelectorAll('#outline')].map(() => {twist})[0]", f"({self.row('Wood over glass')}).getAttribute('aria-expanded') === 'false'")
        self.presses("[aria-label='Add to materials']", "document.querySelector('.menu:popover-open')")
        self.browser.press("Escape")
        self.presses("#text-toggle", "!document.getElementById('drawer').hidden")
        self.presses("#text-toggle", "document.getElementById('drawer').hidden")
        self.presses("[data-tab=view]", "document.body.dataset.tab === 'view'")
        self.presses("#phases > div:nth-of-type(1) summary", "document.querySelector('#phases > div:nth-of-type(1) details').open")
        self.presses("#cut-direction + .choice", "document.querySelector('.menu:popover-open')")
        self.presses(self.named(".menu .item", "+x"), "document.getElementById('cut-direction').value === '1 0 0'")

    def test_the_inspector_is_clicked(self):
        self.open()
        self.select("/tree/over/1")
        self.presses("[data-action=more]", "document.querySelector('.menu:popover-open')")
        self.update()
        self.wait_for("document.querySelector('.menu:popover-open')")
        self.browser.press("Escape")
        self.presses("[data-parameter=phase] .choice", "document.querySelector('.menu:popover-open')")
        self.presses(self.named(".menu .item", "paint"), "studio.scene.text.includes('\"set\": {\"phase\": \"paint\"')")
        self.presses("[data-parameter=phase] .about-it", "!document.querySelector('[data-parameter=phase] .help').hidden")
        self.presses("#inspector .node-title", "studio.selection.active === '/tree/over/1/set/of'")
        self.presses("#inspector-head .crumbs button", "studio.selection.active === '/tree'")
        self.presses("#inspector .slot-item", "studio.selection.active === '/tree/over/0'")
        self.select("/tree")
        self.presses("#inspector .slot-add", "document.querySelector('dialog.palette[open]')")
        self.presses("dialog.palette header .icon-button", "!document.querySelector('dialog')")
        self.presses("[data-operator=under]", "studio.scene.text.includes('\"tree\": {\"under\"')")
        self.select("/tree/under/1/set/of/extrude/of")
        for count in (4, 5):
            self.presses("[data-parameter=points] .slot-add", f"document.querySelectorAll('[data-parameter=points] .list-row').length === {count}")
        self.presses("[data-parameter=points] .list-row:nth-child(5) .icon-button", "document.querySelectorAll('[data-parameter=points] .list-row').length === 4")
        self.select("/lights/0")
        self.presses("[data-parameter=radiance] .swatch-button", "document.querySelector('.colours:popover-open')")
        self.presses(".colours .swatches button:nth-child(5)", "!studio.scene.text.includes('\"radiance\": [1, 1, 1]')")
        self.browser.press("Escape")
        self.select("/camera")
        self.presses(".time-key:nth-child(2)", "document.querySelector('.time-key:nth-child(2)').classList.contains('now')")
        self.presses("[data-parameter=fov] .key", "studio.scene.text.includes('\"fov\": 30')")

    def test_two_clicks_on_a_slow_connection_add_two_points(self):
        self.open()
        self.select("/tree/over/1/set/of/extrude/of")
        self.browser.run(SLOW % 600)
        for _ in range(2):
            self.click("[data-parameter=points] .slot-add")
        self.wait_for("!studio.scene.isBusy && document.querySelectorAll('[data-parameter=points] .list-row').length === 5")
        self.assertEqual(len(self.tree()["over"][1]["set"]["of"]["extrude"]["of"]["polygon"]), 5)

    def test_keys_press_buttons_and_keep_the_focus(self):
        self.open()
        self.select("/tree/over/1")
        self.browser.run("document.querySelector('[data-action=more]').focus()")
        self.update()
        self.assertEqual(self.browser.run("document.activeElement.dataset.action"), "more")
        parameters = {"key": " ", "code": "Space", "windowsVirtualKeyCode": 32}
        self.browser.call("Input.dispatchKeyEvent", type="keyDown", text=" ", **parameters)
        self.update()
        self.browser.call("Input.dispatchKeyEvent", type="keyUp", **parameters)
        self.wait_for("document.querySelector('.menu:popover-open')")
        self.browser.press("Escape")
        self.select("/tree")
        self.browser.run("document.querySelector('#inspector .slot-item').focus()")
        self.update()
        self.assertEqual(self.browser.run("document.activeElement.className"), "slot-item")
        self.browser.run("document.querySelector('[data-key=\"/tree/over/0\"]').focus()")
        self.update()
        self.assertEqual(self.browser.run("document.activeElement.dataset.key"), "/tree/over/0")

    # ---- drags

    def test_drags_follow_the_pointer_whatever_arrives(self):
        self.open()
        self.select("/tree/over/0")
        for element, part in (("[data-handle='move x'] circle", "by"), ("[data-parameter=by] .number", "by")):
            with self.subTest(element=element):
                before = self.browser.run("studio.scene.entry('/tree/over/0/set/of').parameters.by.text")
                x, y = self.place(element)
                self.browser.mouse("mouseMoved", x, y)
                self.browser.mouse("mousePressed", x, y, button="left", clickCount=1)
                for i in range(1, 5):
                    self.update()
                    self.browser.mouse("mouseMoved", x + 12 * i, y, button="left", buttons=1)
                self.update()
                self.wait_for(f"studio.scene.entry('/tree/over/0/set/of').parameters.by.text !== {json.dumps(before)}")
                self.browser.mouse("mouseReleased", x + 48, y, button="left", clickCount=1)
                self.wait_for("!studio.scene.isBusy")

    def test_a_second_drag_begins_where_the_first_ended(self):
        self.open()
        self.select("/tree/over/0")
        self.browser.run(SLOW % 1500)
        for name, (dx, dy) in (("move x", (40, 0)), ("move z", (0, -40))):
            x, y = self.place(f"[data-handle='{name}'] circle")
            self.browser.drag((x, y), (x + dx, y + dy))
        self.until("!studio.scene.isBusy")
        x, _, z = self.tree()["over"][0]["set"]["of"]["translate"]["by"]
        self.assertGreater(x, 0.7)
        self.assertGreater(z, 0.1)

    def test_a_second_drag_of_what_is_not_moved_yet_wraps_it_once(self):
        self.open()
        self.select("/tree/over/1")
        self.browser.run(SLOW % 1500)
        for name, (dx, dy) in (("move x", (40, 0)), ("move z", (0, -40))):
            x, y = self.place(f"[data-handle='{name}'] circle")
            self.browser.drag((x, y), (x + dx, y + dy))
        self.until("!studio.scene.isBusy")
        self.assertEqual(self.file().count('"translate"'), EVERYTHING.count('"translate"') + 1)

    def test_what_is_pressed_while_the_page_loads_is_done_when_it_has_loaded(self):
        self.open()
        delayed = """(() => {
            const ask = window.fetch;
            window.fetch = async (...request) => {
              if (request[0] === "catalogue") await new Promise((done) => setTimeout(done, 2000));
              return ask(...request);
            };
        })()"""
        script = self.browser.call("Page.addScriptToEvaluateOnNewDocument", source=delayed)["identifier"]
        self.addCleanup(lambda: self.browser.call("Page.removeScriptToEvaluateOnNewDocument", identifier=script))
        self.browser.open("about:blank")
        self.browser.open(self.view.url)
        self.until("window.studio && document.getElementById('add').getBoundingClientRect().width > 0")
        self.click("#add")
        self.wait_for("document.querySelector('dialog.palette .card')")


if __name__ == "__main__":
    unittest.main()
