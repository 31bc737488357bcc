"""What tests of the studio in Chromium begin with: a scene, a browser, and a person who uses it.

PHASETREE_SCREENSHOTS names a folder for pictures of the page."""

import json
import os
import pathlib
import re
import unittest

import browser
from studio_user import OPENED, User
from support import View, skip

SMALL = '"render": {"width": 96, "height": 72, "samples": 1}'
# What a scene has after a few steps. The comment and the notation must survive what is done elsewhere in it.
GLASSES = f"""{{
  "version": 1,
  // Two phases.
  "phases": {{
    "glass": {{"clear": {{"ior": 1.50}}, "density": 2500}},
    "wood": {{"diffuse": {{"color": [0.6, 0.3, 0.1]}}, "density": 700}}
  }},
  "shapes": {{"ball": {{"sphere": {{"radius": 0.5}}}}}},
  "tree": {{"over": [
    {{"set": {{"phase": "wood", "of": {{"translate": {{"by": [0.6, 0, 0], "of": "ball"}}}}}}}},  // on the right
    {{"set": {{"phase": "glass", "of": {{"box": {{"size": [0.5, 0.5, 0.5]}}}}}}}},
    {{"set": {{"phase": "glass", "of": {{"translate": {{"by": [-0.8, 0, 0], "of": {{"sphere": {{"radius": 0.3}}}}}}}}}}}}
  ]}},
  "lights": [{{"constant": {{"radiance": [1, 1, 1]}}}}],
  "camera": {{"position": [0, -5, 0], "look_at": [0, 0, 0], "fov": 30}},
  {SMALL}
}}
"""


def uncommented(text):
    return json.loads(re.sub(r'"(?:[^"\\]|\\.)*"|//[^\n]*', lambda m: m[0] if m[0][0] == '"' else "", text))


class StudioCase(unittest.TestCase, User):
    @classmethod
    def setUpClass(cls):
        if not browser.program():
            skip("Chromium is not installed (package chromium)")
        cls.browser = browser.Browser(1280, 720).__enter__()

    @classmethod
    def tearDownClass(cls):
        if hasattr(cls, "browser"):
            cls.browser.__exit__()

    def open(self, text):
        self.expected = ()  # what the browser may say on its console
        self.view = View(text).__enter__()
        self.addCleanup(self.view.__exit__)
        self.addCleanup(self.browser.open, "about:blank")
        self.browser.run("0")
        self.browser.events.clear()
        self.browser.open(self.view.url)
        self.until(OPENED)

    def tearDown(self):
        if hasattr(self, "view"):
            self.assertEqual([c for c in self.browser.complaints() if not c.startswith(self.expected)], [])

    def shoot(self, name):
        if folder := os.environ.get("PHASETREE_SCREENSHOTS"):
            self.browser.screenshot(pathlib.Path(folder) / f"{name}.png")

    def file(self):
        return self.view.file.read_text(encoding="utf-8")

    def scene(self):
        return uncommented(self.file())

    def tree(self):
        return self.scene()["tree"]
