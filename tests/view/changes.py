"""Changes that the page asks for look as if the file said so, and are written into it when asked."""

import json
import pathlib
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from support import SCENE, View, changed, is_ready, rendered  # noqa: E402


class Changes(unittest.TestCase):
    def test_phases_are_hidden(self):
        with View() as view:
            before = view.ready()
            self.assertEqual([p["name"] for p in before.state["phases"]], ["glass", "wood"])
            # The wood is on the right.
            self.assertEqual(json.loads(view.post("ask", {"x": 64, "y": 32}).body)["met"], "wood")
            view.post("change", {"hidden": ["wood"]})
            after = view.wait_for(lambda s: is_ready(s) and s["phases"][1]["hidden"])
            self.assertNotEqual(before.pixels, after.pixels)
            self.assertEqual(json.loads(view.post("ask", {"x": 64, "y": 32}).body)["met"], "")
            view.post("change", {"hidden": ["wood", "glass"]})
            view.wait_for(lambda s: s["phases"][0]["hidden"])
            view.post("change", {"hidden": []})
            back = view.wait_for(lambda s: is_ready(s) and not any(p["hidden"] for p in s["phases"]))
            self.assertEqual(back.pixels, before.pixels)

    def test_what_is_edited_looks_as_if_the_file_said_so(self):
        color, glass = '{"diffuse": {"color": [0.6, 0.3, 0.1]}}', '{"clear": {"ior": 1.5}}'
        tree = SCENE[SCENE.index('"tree": ') + 8:SCENE.index(',\n"lights"')]
        cut = '{"intersect_shape": {"shape": {"plane": {"normal": [0, -1, 0.5], "offset": 0.125}}, "of": ' + tree + "}}"
        removed = '{"remove": {"phases": "wood", "of": ' + tree + "}}"
        cases = [({"looks": {"wood": {"color": [0.125, 0.25, 0.5]}}}, color, '{"diffuse": {"color": [0.125, 0.25, 0.5]}}'),
                 ({"looks": {"glass": {"ior": 1.25, "roughness": 0.25}}}, glass, '{"clear": {"ior": 1.25, "roughness": 0.25}}'),
                 ({"looks": {"wood": {"clear": True}}}, color, glass),
                 ({"cut": {"normal": [0, -1, 0.5], "offset": 0.125}}, tree, cut),
                 ({"hidden": ["wood"]}, tree, removed)]
        undone = {"hidden": [], "looks": {}, "cut": None}
        with View() as view:
            before = view.ready()
            for change, old, new in cases:
                version = json.loads(view.post("change", {**undone, **change}).body)["version"]
                after = view.wait_for(lambda s, v=version: is_ready(s) and s["version"] > v)
                self.assertNotEqual(after.pixels, before.pixels, change)
                self.assertEqual(view.get("picture.png").body, rendered(view, changed(SCENE, old, new)), change)
            version = json.loads(view.post("change", undone).body)["version"]
            back = view.wait_for(lambda s: is_ready(s) and s["version"] > version)
            self.assertEqual(back.pixels, before.pixels)
            self.assertEqual(view.file.read_text(encoding="utf-8"), SCENE)

    def test_numbers_of_the_file_are_changed_and_written(self):
        radius = "/shapes/ball/sphere/radius"
        smaller = changed(SCENE, '"radius": 0.5', '"radius": 0.375')
        with View() as view:
            before = view.ready()
            told = json.loads(view.get("numbers").body)
            self.assertEqual(told["version"], before.state["numbers_version"])
            self.assertIn({"pointer": radius, "line": 3, "value": 0.5}, told["numbers"])
            view.post("change", {"numbers": {radius: 0.375, "/gone": 1}})
            after = view.wait_for(lambda s: is_ready(s) and s["numbers"])
            self.assertEqual(view.get("picture.png").body, rendered(view, smaller))
            self.assertEqual(view.file.read_text(encoding="utf-8"), SCENE)
            # What the reader refuses is said as of a file, over the last picture.
            view.post("change", {"numbers": {radius: -1}})
            wrong = view.wait_for(lambda s: s["error"])
            self.assertIn("scene.json:3:42: ", wrong.state["error"])
            self.assertEqual(wrong.state["picture"]["number"], after.state["picture"]["number"])
            # Turning the camera shows the last good object, and what is wrong with the numbers stays said.
            view.post("change", {"camera": {"position": [0, -4, 0], "look_at": [0, 0, 0]}})
            turned = view.wait_for(lambda s: is_ready(s))
            self.assertIn("scene.json:3:42: ", turned.state["error"])
            view.post("change", {"camera": None, "numbers": {}})
            back = view.wait_for(lambda s: is_ready(s) and not s["error"] and not s["numbers"])
            self.assertEqual(back.pixels, before.pixels)
            view.post("change", {"numbers": {radius: 0.375}})
            view.wait_for(lambda s: is_ready(s) and s["numbers"])
            self.assertEqual(view.post("write_numbers", {}).status, 200)
            self.assertEqual(view.file.read_text(encoding="utf-8"), smaller)
            view.wait_for(lambda s: is_ready(s) and not s["numbers"])
            self.assertEqual(view.get("picture.png").body, rendered(view, smaller))

    def test_a_clear_phase_has_its_colour_after_half_the_diagonal_of_the_object(self):
        with View() as view:
            view.ready()
            view.post("change", {"looks": {"glass": {"color": [0.25, 0.5, 1]}}})
            after = view.wait_for(lambda s: is_ready(s) and s["phases"][0]["look"])
            text = changed(SCENE, '"ior": 1.5', '"ior": 1.5, "color": [0.25, 0.5, 1], "color_distance": '
                           + repr(after.state["radius"]))
            self.assertEqual(view.get("picture.png").body, rendered(view, text))
            for told, wanted in zip(after.state["phases"][0]["color"], (0.25, 0.5, 1)):
                self.assertAlmostEqual(told, wanted, places=5)

    def test_what_is_edited_outlives_a_saved_file(self):
        with View() as view:
            view.ready()
            view.post("change", {"looks": {"wood": {"clear": True}, "brass": {"ior": 2}}, "cut": {"normal": [0, 0, 2], "offset": 0}})
            view.wait_for(lambda s: is_ready(s) and s["cut"])
            view.file.write_text(changed(SCENE, '"radius": 0.5', '"radius": 0.4'), encoding="utf-8")
            view.wait_for(lambda s: s["doing"] == "Reading the scene" or "cells" in s["doing"])
            state = view.wait_for(lambda s: is_ready(s) and s["radius"] < 1.2).state
            self.assertEqual([p["kind"] for p in state["phases"]], ["clear", "clear"])
            self.assertEqual(state["cut"], {"normal": [0, 0, 2], "offset": 0})

    def test_while_a_slider_is_drawn_pictures_come(self):
        # Cells that take longer than it takes from one wish to the next.
        with View(changed(SCENE, '"sphere": {"radius": 0.5}', '"displace": {"amplitude": 0.01, "scale": 0.1, "of": {"sphere": {"radius": 0.5}}}')) as view:
            before = view.ready().state["picture"]["number"]
            end = time.monotonic() + 4
            for i in range(10000):
                if time.monotonic() > end:
                    break
                view.post("change", {"cut": {"normal": [1, 0, 0], "offset": 0.0001 * i}})
            self.assertGreater(view.get("picture").state["picture"]["number"], before)


if __name__ == "__main__":
    unittest.main()
