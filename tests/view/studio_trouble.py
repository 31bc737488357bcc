"""The studio in Chromium when something goes wrong: two people edit one scene, the connection breaks, files vanish or cannot be
written, numbers are enormous, and texts are invalid. The page says what is wrong, and shows in the end what is in the file."""

import json
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

import browser  # noqa: E402
from studio_case import GLASSES, StudioCase, uncommented  # noqa: E402
from studio_user import CONTROL, User  # noqa: E402
from support import PATIENCE  # noqa: E402

FILE_IS_SHOWN = "fetch('document?after=0').then((answer) => answer.json()).then(({text}) => text === studio.scene.text && !studio.scene.isBusy)"


class Trouble(StudioCase):
    def select(self, pointer):
        self.browser.run(f"studio.selection.set([{json.dumps(pointer)}])")

    def toast(self, text):
        self.until(f"document.getElementById('toasts').textContent.includes({json.dumps(text)})", 10)

    def hold(self, element, *places):
        """Presses an element and moves, without releasing it; returns the last place."""
        x, y = self.place(element)
        self.browser.mouse("mouseMoved", x, y)
        self.browser.mouse("mousePressed", x, y, button="left", clickCount=1)
        for dx, dy in places:
            self.browser.mouse("mouseMoved", x + dx, y + dy, button="left", buttons=1)
        return x, y

    def release(self, x, y):
        self.browser.mouse("mouseReleased", x, y, button="left", clickCount=1)

    def settles(self):
        """The page shows what the server has, and the file has it, too."""
        self.browser.wait_for(FILE_IS_SHOWN, 30 * PATIENCE)
        self.until("studio.scene.saved", 5)
        self.assertEqual(self.file(), self.browser.run("studio.scene.text"))

    # ---- two people

    def test_two_pages_drag_and_type_at_the_same_time(self):
        self.open(GLASSES)
        with browser.Browser(1000, 700) as second:
            other = User(second)
            other.open(self.view.url)
            self.select("/tree/over/0")
            second.run("studio.selection.set(['/tree/over/1/set/of'])")
            x, y = self.hold("[data-handle='move x'] circle", (8, 0))
            other.click("[data-parameter=size] .number")
            for i, number in enumerate(("0.61", "0.62", "0.63")):
                if i > 0:
                    second.press("Tab")
                for j, key in enumerate(number):
                    second.press(key, "", key)
                    self.browser.mouse("mouseMoved", x + 10 + 4 * i + j, y, button="left", buttons=1)
            second.press("Enter")
            other.until("studio.scene.text.includes('\"size\": [0.61, 0.62, 0.63]')")
            self.browser.mouse("mouseMoved", x + 40, y, button="left", buttons=1)
            self.release(x + 40, y)
            self.settles()
            second.wait_for(FILE_IS_SHOWN, 30 * PATIENCE)
            self.assertEqual(second.run("studio.scene.text"), self.file())
            self.assertEqual(self.tree()["over"][1]["set"]["of"]["box"]["size"], [0.61, 0.62, 0.63])
            self.assertGreater(self.tree()["over"][0]["set"]["of"]["translate"]["by"][0], 0.7)
            self.assertEqual([c for c in second.complaints() if "409" not in c], [])

    def test_what_is_dragged_is_deleted_by_somebody_else(self):
        self.open(GLASSES)
        self.expected = "Failed to load resource"
        self.select("/tree/over/2")
        x, y = self.hold("[data-handle='move x'] circle", (8, 0), (16, 0))
        version = json.loads(self.view.get("document?after=0").body)["version"]
        self.assertEqual(self.view.post("document", {"base": version, "label": "Delete", "operations": [{"remove": "/tree/over/2"}], "strict": True}).status, 200)
        self.until("studio.scene.entry('/tree/over/2') === null")
        for i in range(4):
            self.browser.mouse("mouseMoved", x + 20 + 4 * i, y, button="left", buttons=1)
        self.release(x + 32, y)
        self.settles()
        self.assertEqual(len(self.tree()["over"]), 2)
        self.until("studio.scene.entry(studio.selection.active) !== null")

    def test_an_editor_saves_during_a_drag(self):
        self.open(GLASSES)
        self.select("/tree/over/2")
        x, y = self.hold("[data-handle='move x'] circle", (8, 0), (16, 0))
        self.until("studio.scene.undo !== null && !studio.scene.isBusy")
        self.view.file.write_text(self.file().replace('"density": 2500', '"density": 2400'), encoding="utf-8")
        self.until("studio.scene.text.includes('2400')")
        for i in range(4):
            self.browser.mouse("mouseMoved", x + 20 + 6 * i, y, button="left", buttons=1)
        self.release(x + 38, y)
        self.settles()
        self.assertIn('"density": 2400', self.file())
        self.assertGreater(self.tree()["over"][2]["set"]["of"]["translate"]["by"][0], -0.7)

    def test_texts_typed_at_the_same_time_are_merged_or_asked_about(self):
        self.open(GLASSES)
        self.click("#text-toggle")
        self.until("document.activeElement.id === 'text'")

        def elsewhere(old, new):
            told = json.loads(self.view.get("document?after=0").body)
            self.assertEqual(self.view.post("document", {"base": told["version"], "label": "Elsewhere", "operations": [{"text": told["text"].replace(old, new)}], "strict": False}).status, 200)

        # In different lines.
        self.browser.run("text.setSelectionRange(text.value.indexOf(' phases.'), text.value.indexOf(' phases.'))")
        self.browser.press("!", "", "!")
        elsewhere('"density": 700', '"density": 750')
        self.until("text.value.includes('750')")
        self.browser.press("!", "", "!")
        self.until("studio.scene.text.includes('Two!! phases') && studio.scene.text.includes('750')", 10)
        # In the same line, the other text is taken …
        self.browser.press("?", "", "?")
        elsewhere("// Two!! phases.", "// Two or three phases.")
        self.until("!document.getElementById('text-problem').hidden")
        self.assertEqual(self.browser.run("text.value.includes('Two!!? phases')"), True)
        self.click(self.named("#text-problem button", "Take the other"))
        self.assertEqual(self.browser.run("text.value"), self.browser.run("studio.scene.text"))
        self.assertIn("// Two or three phases.", self.file())
        # … or one's own is kept.
        self.click("#text")
        self.browser.run("text.setSelectionRange(text.value.indexOf(' phases.'), text.value.indexOf(' phases.'))")
        self.browser.press("?", "", "?")
        elsewhere("// Two or three phases.", "// Many phases.")
        self.until("!document.getElementById('text-problem').hidden")
        self.click(self.named("#text-problem button", "Keep my text"))
        self.until("studio.scene.text.includes('three? phases') && !studio.scene.text.includes('Many')", 10)
        self.settles()
        self.assertTrue(self.browser.run("document.getElementById('text-problem').hidden"))

    # ---- the connection and the server

    def test_the_connection_breaks_during_a_drag(self):
        self.open(GLASSES)
        self.expected = "Failed to load resource"
        self.select("/tree/over/0")
        x, y = self.hold("[data-handle='move x'] circle", (8, 0), (16, 0))
        self.until("studio.scene.undo !== null && !studio.scene.isBusy")
        conditions = {"latency": 0, "downloadThroughput": -1, "uploadThroughput": -1}
        self.browser.call("Network.emulateNetworkConditions", offline=True, **conditions)
        for i in range(3):
            self.browser.mouse("mouseMoved", x + 20 + 4 * i, y, button="left", buttons=1)
        self.toast("does not answer")
        self.release(x + 28, y)
        self.browser.call("Network.emulateNetworkConditions", offline=False, **conditions)
        self.settles()
        before = self.tree()["over"][0]["set"]["of"]["translate"]["by"][0]
        self.drag(self.place("[data-handle='move x'] circle"), (x + 80, y))
        self.assertGreater(self.tree()["over"][0]["set"]["of"]["translate"]["by"][0], before + 0.05)
        self.settles()

    def test_the_server_ends_during_a_drag(self):
        self.open(GLASSES)
        self.expected = "Failed to load resource"
        self.select("/tree/over/0")
        x, y = self.hold("[data-handle='move x'] circle", (8, 0), (16, 0))
        self.view.process.kill()
        self.view.process.wait()
        for i in range(3):
            self.browser.mouse("mouseMoved", x + 20 + 4 * i, y, button="left", buttons=1)
        self.release(x + 28, y)
        self.toast("does not answer")
        self.until("document.getElementById('status').textContent.includes('does not answer')", 10)
        self.click("#add")  # the palette still opens
        self.until("document.querySelector('dialog.palette .card')")
        uncommented(self.file())  # a complete file

    # ---- steps

    def test_undo_during_a_drag(self):
        self.open(GLASSES)
        self.select("/tree/over/0")
        for element in ("[data-handle='move x'] circle", "[data-parameter=by] .number"):
            with self.subTest(element=element):
                x, y = self.hold(element, (8, 0), (16, 0))
                self.until("studio.scene.undo !== null && !studio.scene.isBusy")
                self.browser.run("document.activeElement.blur()")
                self.key("z", CONTROL)
                self.until("!studio.scene.isBusy")
                for i in range(3):
                    self.browser.mouse("mouseMoved", x + 20 + 6 * i, y, button="left", buttons=1)
                self.release(x + 32, y)
                self.settles()
                while self.browser.run("studio.scene.undo !== null"):
                    self.step(lambda: (self.browser.run("document.activeElement.blur()"), self.key("z", CONTROL)))
                self.assertEqual(self.file(), GLASSES)

    def test_enormous_numbers_and_nonsense(self):
        self.open(GLASSES)
        self.expected = "Failed to load resource"
        self.select("/shapes/ball")
        for text in ("1e39", "-1e300", "9" * 400, "1/0", "0/0", "1e-300", "NaN", "((1", "3e3", "1e18", "--", "0x10", "½", "1 2", "'\"<b>&"):
            with self.subTest(text=text):
                self.click("[data-parameter=radius] .number")
                self.browser.run("document.activeElement.select()")
                self.browser.call("Input.insertText", text=text)
                self.browser.press("Enter")
                self.until("!studio.scene.isBusy")
                self.assertEqual(self.browser.complaints(), [c for c in self.browser.complaints() if c.startswith(self.expected)])
                self.browser.wait_for(FILE_IS_SHOWN, 30 * PATIENCE)
                # Either the number is rejected beside it, or a message says that it is none.
                self.until("document.querySelector('[data-parameter=radius] .problem').textContent !== '' || document.querySelector('.toast.wrong')", 10)
                self.assertEqual(self.file(), GLASSES)
                self.browser.run("document.getElementById('toasts').replaceChildren()")
                self.browser.press("Escape")
        self.set_number("radius", "2e-1")
        self.settles()
        self.assertEqual(self.scene()["shapes"]["ball"]["sphere"]["radius"], 0.2)

    def test_a_name_that_exists_is_not_given_again(self):
        self.open(GLASSES)
        self.expected = "Failed to load resource"
        self.select("/phases/glass")
        for name in ("wood", "vacuum", "", " ", "a" * 300):
            with self.subTest(name=name):
                self.click("#inspector-head .name")
                self.browser.run("document.activeElement.select()")
                self.browser.call("Input.insertText", text=name) if name else self.browser.press("Delete")
                self.browser.press("Enter", "Enter", "\r")
                if name.strip():
                    self.until("document.querySelector('.toast.wrong') || studio.selection.active !== '/phases/glass'")
                self.until("!studio.scene.isBusy")
                if self.browser.run("studio.selection.active") == "/phases/glass":
                    self.until("document.querySelector('#inspector-head .name').value === 'glass'", 5)
                    self.assertEqual(self.file(), GLASSES)
                else:
                    self.step(lambda: self.click("#undo"))
                    self.select("/phases/glass")
                self.browser.run("document.getElementById('toasts').replaceChildren()")

    # ---- files

    def test_a_file_vanishes_and_comes_back(self):
        self.open(GLASSES)
        self.view.file.unlink()
        self.until("document.getElementById('error').textContent !== ''", 10)
        # The next step writes it again.
        self.select("/shapes/ball")
        self.set_number("radius", "0.4")
        self.settles()
        self.assertEqual(self.scene()["shapes"]["ball"]["sphere"]["radius"], 0.4)
        self.until("document.getElementById('error').textContent === ''", 10)

    def test_a_file_that_cannot_be_written_is_kept_until_it_can(self):
        self.open(GLASSES)
        self.expected = "Failed to load resource"
        # A folder of the same name cannot be replaced by a file, not even by root.
        self.view.file.unlink()
        self.view.file.mkdir()
        (self.view.file / "inside").write_text("", encoding="utf-8")
        self.select("/shapes/ball")
        self.click("[data-parameter=radius] .number")
        self.type("0.4")
        self.browser.press("Enter")
        self.until("studio.scene.text.includes('\"radius\": 0.4')", 10)
        self.toast("Not saved")
        self.until("!document.getElementById('save-file').hidden")
        (self.view.file / "inside").unlink()
        self.view.file.rmdir()
        self.click("#save-file")
        self.settles()
        self.until("document.getElementById('save-file').hidden && document.getElementById('saved').textContent === 'Saved'")
        self.assertEqual(self.scene()["shapes"]["ball"]["sphere"]["radius"], 0.4)


if __name__ == "__main__":
    unittest.main()
