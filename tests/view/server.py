"""The live view's server: what it shows, whom it refuses, and that it outlives what it is sent."""

import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from support import COMMAND, SCENE, View, is_ready  # noqa: E402


def changed(text, old, new):
    assert old in text
    return text.replace(old, new)


# A ball of grains with noise as fine as dust: more than a million cells, and minutes until they are built.
ENDLESS = changed(SCENE, '"ball": {"sphere": {"radius": 0.5}}', """"ball": {"displace": {"amplitude": 0.002,
    "scale": 0.01, "octaves": 6, "of": {"fibonacci_sphere": {"count": 20000, "radius": 1,
        "of": {"smooth_union": {"radius": 0.01, "of": [{"sphere": {"radius": 0.01}}, {"box": {"size": [0.01, 0.01, 0.03]}}]}}}}}}""")


class Pictures(unittest.TestCase):
    def test_the_finished_picture_is_that_of_render(self):
        with View() as view, tempfile.TemporaryDirectory() as folder:
            view.ready()
            picture = view.get("picture.png")
            self.assertEqual(picture.headers["Content-Type"], "image/png")
            out = pathlib.Path(folder) / "scene.png"
            subprocess.run([COMMAND, "render", str(view.file), "-o", str(out), "--quiet"], check=True)
            self.assertEqual(picture.body, out.read_bytes())

    def test_a_coarse_picture_comes_first(self):
        with View(SCENE.replace('"width": 96, "height": 64', '"width": 1200, "height": 800')) as view:
            first = view.wait_for(lambda s: "picture" in s)
            self.assertGreaterEqual(first.state["picture"]["scale"], 2)
            size = first.state["picture"]
            self.assertEqual(len(first.pixels), 3 * size["width"] * size["height"])

    def test_the_camera_turns_and_goes_back(self):
        with View() as view:
            before = view.ready()
            version = json.loads(view.post("change", {"camera": {"position": [5, 0, 0], "look_at": [0, 0, 0]}}).body)
            after = view.wait_for(lambda s: is_ready(s) and s["version"] > version["version"])
            self.assertNotEqual(before.pixels, after.pixels)
            self.assertEqual(json.loads(after.state["camera"]), {"position": [5, 0, 0], "look_at": [0, 0, 0]})
            view.post("change", {"camera": None})
            back = view.wait_for(lambda s: is_ready(s) and s["camera"] == before.state["camera"])
            self.assertEqual(back.pixels, before.pixels)

    def test_the_camera_is_said_as_the_file_says_it(self):
        cameras = ['{"position": [0, -5, 0.25], "look_at": [0, 0, 0], "up": [1, 0, 1], "fov": 31.5, "lens_radius": 0.1, '
                   '"focus_distance": 4.5, "filter": "box"}',
                   '{"orthographic": {"position": [0, -5, 0], "look_at": [0, 0, 0], "height": 3}}']
        for camera in cameras:
            text = changed(SCENE, '{"position": [0, -5, 0], "look_at": [0, 0, 0], "fov": 30}', camera)
            with View(text) as view:
                self.assertEqual(json.loads(view.ready().state["camera"]), json.loads(camera))

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

    def rendered(self, view, text, name="scene.png"):
        """The file that `render` makes of a text beside the view's scene."""
        with tempfile.TemporaryDirectory() as folder:
            file, out = pathlib.Path(folder) / view.file.name, pathlib.Path(folder) / name
            file.write_text(text, encoding="utf-8")
            subprocess.run([COMMAND, "render", str(file), "-o", str(out), "--quiet"], check=True)
            return out.read_bytes()

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
                self.assertEqual(view.get("picture.png").body, self.rendered(view, changed(SCENE, old, new)), change)
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
            self.assertEqual(view.get("picture.png").body, self.rendered(view, smaller))
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
            self.assertEqual(view.get("picture.png").body, self.rendered(view, smaller))

    def test_planes_of_the_film_are_shown_and_saved(self):
        with View() as view:
            before = view.ready()
            self.assertIn("depth", before.state["layers"])
            self.assertEqual(view.post("change", {"layer": "depht"}).status, 400)

            def shown(layer):
                version = json.loads(view.post("change", {"layer": layer}).body)["version"]
                answer = view.wait_for(lambda s: is_ready(s) and s["version"] > version and s["layer"] == layer)
                width = answer.state["width"]
                def at(x, y):
                    return tuple(answer.pixels[3 * (y * width + x):3 * (y * width + x) + 3])
                return answer, at
            # The camera looks along y at a ball of wood, whose front has the normal (0, -1, 0): dithered, 0.5 is 127 or 128.
            _, at = shown("normal")
            for told, wanted in zip(at(64, 32), (127.5, 0, 127.5)):
                self.assertAlmostEqual(told, wanted, delta=16)
            _, at = shown("phase_entered")
            self.assertEqual(len({at(64, 32), at(32, 32), at(2, 2)}), 3)
            self.assertEqual(at(2, 2), (0, 0, 0))
            depth, at = shown("depth")
            self.assertGreater(at(64, 32)[0], 200)
            self.assertEqual(at(2, 2), (0, 0, 0))
            self.assertNotEqual(view.get("picture.png").body, self.rendered(view, SCENE))
            self.assertIn(b"depth.Z", view.get("picture.exr").body)
            back, _ = shown("")
            self.assertEqual(back.pixels, before.pixels)
            self.assertNotEqual(depth.pixels, before.pixels)

    def test_a_point_tells_the_nodes_that_made_it(self):
        def places(x, y):
            told = json.loads(view.post("ask", {"x": x, "y": y}).body)["path"]
            return [(n["name"], n["line"], n["column"], n["pointer"]) for n in told]
        with View() as view:
            view.ready()
            self.assertEqual(places(64, 32), [("under", 4, 10, "/tree/under"),
                                              ("set", 4, 21, "/tree/under/0/set"),
                                              ("translate", 4, 53, "/tree/under/0/set/of/translate"),
                                              ("sphere", 3, 21, "/shapes/ball/sphere")])
            self.assertEqual(places(32, 32)[2], ("translate", 5, 54, "/tree/under/1/set/of/translate"))
            self.assertEqual(places(1, 1), [])
            # What the view itself cuts with is in no file.
            view.post("change", {"cut": {"normal": [0, -1, 0], "offset": 0}})
            view.wait_for(lambda s: is_ready(s) and s["cut"])
            self.assertEqual(places(64, 32), [("intersect_shape", 0, 0, ""), ("plane", 0, 0, "")])

    def test_nodes_of_objects_with_phases_of_their_own_stand_where_their_files_have_them(self):
        objects = """"objects": [
  {"name": "taken", "file": "ball.json", "transform": {"translate": {"by": [0.6, 0, 0]}}},
  {"name": "own", "phases": {"wood": {"diffuse": {"color": [0.1, 0.1, 0.5]}}},
   "tree": {"set": {"phase": "wood", "of": {"translate": {"by": [-0.6, 0, 0], "of": "ball"}}}}}]"""
        text = SCENE[:SCENE.index('"tree"')] + objects + SCENE[SCENE.index(',\n"lights"'):]

        class WithBall(View):
            def prepare(self):
                ball = '{"version": 1, "phases": {"wood": {"clear": {"ior": 1.5}}},\n"tree": {"set": {"phase": "wood", "of": {"sphere": {"radius": 0.5}}}}}'
                (self.file.parent / "ball.json").write_text(ball, encoding="utf-8")

        with WithBall(text) as view:
            view.ready()

            def places(x, y):
                told = json.loads(view.post("ask", {"x": x, "y": y}).body)
                return told["met"], [(n["name"], pathlib.Path(n["file"]).name, n["line"], n["column"], n["pointer"]) for n in told["path"]]
            # What holds the objects together and what places them is in no file.
            self.assertEqual(places(64, 32), ("taken.wood", [("over", "", 0, 0, ""), ("translate", "", 0, 0, ""),
                                                             ("set", "ball.json", 2, 10, ""), ("sphere", "ball.json", 2, 42, "")]))
            own = [("over", "", 0, 0, ""), ("set", "scene.json", 7, 13, "/objects/1/tree/set"),
                   ("translate", "scene.json", 7, 45, "/objects/1/tree/set/of/translate"),
                   ("sphere", "scene.json", 3, 21, "/shapes/ball/sphere")]
            self.assertEqual(places(32, 32), ("own.wood", own))
            # Nodes of which nothing is left are not taken for others that are made where they were.
            for by in (0.61, 0.625, 0.7):
                view.post("change", {"numbers": {"/objects/0/transform/translate/by/0": by}})
                view.wait_for(lambda s, v=by: is_ready(s) and v in s["numbers"].values())
                self.assertEqual(places(32, 32), ("own.wood", own))
            # Numbers that stand there for the file's own, but longer, shift no place of the file.
            view.post("change", {"numbers": {"/objects/1/tree/set/of/translate/by/0": -0.5625, "/phases/glass/clear/ior": 1.50001}})
            view.wait_for(lambda s: is_ready(s) and -0.5625 in s["numbers"].values())
            self.assertEqual(places(32, 32), ("own.wood", own))

    def test_a_clear_phase_has_its_colour_after_half_the_diagonal_of_the_object(self):
        with View() as view:
            view.ready()
            view.post("change", {"looks": {"glass": {"color": [0.25, 0.5, 1]}}})
            after = view.wait_for(lambda s: is_ready(s) and s["phases"][0]["look"])
            text = changed(SCENE, '"ior": 1.5', '"ior": 1.5, "color": [0.25, 0.5, 1], "color_distance": '
                           + repr(after.state["radius"]))
            self.assertEqual(view.get("picture.png").body, self.rendered(view, text))
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

    def test_the_picture_is_saved_as_exr_too(self):
        with View() as view:
            view.ready()
            picture = view.get("picture.exr")
            self.assertEqual(picture.headers["Content-Type"], "image/x-exr")
            self.assertEqual(picture.body, self.rendered(view, SCENE, "scene.exr"))

    def test_a_point_tells_what_trace_and_eval_tell(self):
        with View() as view:
            view.ready()
            told = json.loads(view.post("ask", {"x": 34, "y": 32}).body)
            self.assertEqual(told["met"], "glass")
            ray = " ".join(map(str, told["origin"] + told["direction"]))
            traced = subprocess.run([COMMAND, "trace", str(view.file)], input=ray, capture_output=True, text=True, check=True, timeout=60)
            lines = [line.split(",") for line in traced.stdout.splitlines()[2:]]
            self.assertEqual([(c["from"], c["to"]) for c in told["crossings"]], [(n[2], n[3]) for n in lines])
            for crossing, line in zip(told["crossings"], lines):
                self.assertAlmostEqual(crossing["distance"], float(line[1]), delta=1e-4)
            self.assertEqual([d["phase"] for d in told["distances"]], ["vacuum", "glass", "wood"])
            # The position is the near end of the bracket, which is still in the vacuum.
            self.assertLess(told["distances"][0]["phi"], 0)
            self.assertAlmostEqual(told["distances"][1]["phi"], 0, delta=1e-4)

    def test_the_exposure_changes_the_picture_that_is_there(self):
        with View() as view:
            before = view.ready()
            view.post("change", {"exposure": 2})
            after = view.wait_for(lambda s: s["exposure"] == 2)
            self.assertEqual(after.state["picture"]["samples"], 4)
            self.assertGreater(sum(after.pixels), sum(before.pixels))


class Files(unittest.TestCase):
    def test_a_saved_file_is_read_again_and_an_error_is_shown_over_the_last_picture(self):
        with View() as view:
            before = view.ready()
            view.file.write_text(changed(SCENE, '"radius": 0.5', '"raduis": 0.5'), encoding="utf-8")
            wrong = view.wait_for(lambda s: s["error"])
            self.assertEqual(wrong.pixels, before.pixels)
            checked = subprocess.run([COMMAND, "check", str(view.file)], capture_output=True, text=True, check=False, timeout=60)
            self.assertEqual(checked.returncode, 2)
            self.assertEqual(wrong.state["error"] + "\n", checked.stderr)
            self.assertIn("scene.json:3:", wrong.state["error"])
            self.assertIn(wrong.state["error"], view.said())
            # The last picture can still be rotated.
            view.post("change", {"camera": {"position": [5, 0, 0], "look_at": [0, 0, 0]}})
            turned = view.wait_for(lambda s: is_ready(s) and "[5, 0, 0]" in s["camera"])
            self.assertNotEqual(turned.pixels, before.pixels)
            self.assertEqual(turned.state["error"], wrong.state["error"])
            view.post("change", {"camera": None})
            view.file.write_text(changed(SCENE, '"radius": 0.5', '"radius": 0.4'), encoding="utf-8")
            right = view.wait_for(lambda s: is_ready(s) and not s["error"] and "fov" in s["camera"])
            self.assertNotEqual(right.pixels, before.pixels)

    def test_a_file_that_vanishes_leaves_the_last_picture_until_it_is_there_again(self):
        with View() as view:
            before = view.ready()
            view.file.unlink()
            gone = view.wait_for(lambda s: s["error"])
            self.assertEqual(gone.pixels, before.pixels)
            checked = subprocess.run([COMMAND, "check", str(view.file)], capture_output=True, text=True, check=False, timeout=60)
            self.assertEqual(gone.state["error"] + "\n", checked.stderr)
            self.assertEqual(view.post("write", {}).status, 400)
            self.assertFalse(view.file.exists())
            view.file.write_text(SCENE, encoding="utf-8")
            back = view.wait_for(lambda s: is_ready(s) and not s["error"])
            self.assertEqual(back.pixels, before.pixels)

    def test_a_file_that_the_scene_names_is_watched_even_before_it_is_there(self):
        text = changed(SCENE, '"lights"', '"meshes": [{"obj": {"file": "leaf.obj", "material": {"diffuse": {"color": [0.2, 0.6, 0.2]}}}}], "lights"')
        leaf = "v -1 1 -1\nv 1 1 -1\nv 0 1 1\nf 1 2 3\n"
        with View() as view:
            before = view.ready()
            view.file.write_text(text, encoding="utf-8")
            self.assertIn("leaf.obj", view.wait_for(lambda s: s["error"]).state["error"])
            (view.file.parent / "leaf.obj").write_text(leaf, encoding="utf-8")
            there = view.wait_for(lambda s: is_ready(s) and not s["error"])
            self.assertNotEqual(there.pixels, before.pixels)
            (view.file.parent / "leaf.obj").write_text(leaf.replace("1 1 -1", "3 1 -1"), encoding="utf-8")
            view.wait_for(lambda s: is_ready(s) and s["version"] > there.state["version"] + 2)

    def test_an_image_of_a_stack_is_watched(self):
        def image(numbers):
            return b"P5\n2 2\n255\n" + bytes(numbers)

        def save(file, numbers):
            file.write_bytes(image(numbers))
            # Long ago, so that what the reading made of it is kept.
            os.utime(file, ns=(time.time_ns() - 10**11, time.time_ns() - 10**11))

        class Stack(View):
            def prepare(self):
                for n in range(2):
                    save(self.file.parent / f"layer_{n}.pgm", [1, 1, 0, 1])

        labels = '{"labels": {"file": "layer_#.pgm", "phases": ["wood"], "spacing": [0.5, 0.5, 0.5]}}'
        text = SCENE[:SCENE.index('"shapes": ')] + '"tree": ' + labels + SCENE[SCENE.index(',\n"lights"'):]
        with Stack(text) as view:
            before = view.ready()
            save(view.file.parent / "layer_1.pgm", [1, 1, 1, 1])
            saved = view.wait_for(lambda s: is_ready(s) and s["version"] > before.state["version"] + 2)
            self.assertNotEqual(saved.pixels, before.pixels)
            # One more, in the folder that is watched, and then what was there at first.
            save(view.file.parent / "layer_2.pgm", [1, 1, 1, 1])
            more = view.wait_for(lambda s: is_ready(s) and s["version"] > saved.state["version"] + 2)
            self.assertNotEqual(more.pixels, saved.pixels)
            (view.file.parent / "layer_2.pgm").unlink()
            save(view.file.parent / "layer_1.pgm", [1, 1, 0, 1])
            back = view.wait_for(lambda s: is_ready(s) and s["version"] > more.state["version"] + 2)
            self.assertEqual(back.pixels, before.pixels)

    def test_groups_that_stand_nowhere_are_warned_of(self):
        ball = SCENE[SCENE.index('"tree": '):SCENE.index(',\n"lights"')]
        groups = '"groups": {"lost": [{"of": "balls"}]}'
        text = changed(SCENE, ball, '"objects": [{"name": "balls", ' + ball + "}], " + groups + ', "instances": [{"of": "balls"}]')
        with View(text) as view:
            warning = view.ready().state["warning"]
            checked = subprocess.run([COMMAND, "check", str(view.file)], capture_output=True, text=True, check=False, timeout=60)
            self.assertIn('the group "lost" is not in the scene', checked.stderr)
            self.assertIn(checked.stderr.splitlines()[0], warning)
            self.assertIn(warning.strip(), view.said())

    def test_the_camera_is_written_into_the_file_and_nothing_else_changes(self):
        old = '{"position": [0, -5, 0], "look_at": [0, 0, 0], "fov": 30}'
        commented = '{"position": [0, -5, 0], // not "here}"\n "look_at": /* {{ */ [0, 0, 0], "fov": 30}'
        text = "// Two balls { in one file }.\n" + changed(SCENE, old, commented)
        with View(text) as view:
            view.file.chmod(0o640)
            view.ready()
            view.post("change", {"camera": {"position": [5, 0, 0], "look_at": [0, 0, 0]}})
            turned = view.wait_for(lambda s: is_ready(s) and "[5, 0, 0]" in s["camera"])
            self.assertEqual(view.post("write", {}).status, 200)
            new = '{"position": [5, 0, 0], "look_at": [0, 0, 0]}'
            self.assertEqual(view.file.read_text(encoding="utf-8"), changed(text, commented, new))
            self.assertEqual(view.file.stat().st_mode & 0o777, 0o640)
            again = view.wait_for(lambda s: is_ready(s) and s["version"] > turned.state["version"])
            self.assertEqual(again.pixels, turned.pixels)
            # A file that is wrong by now is left as it is.
            view.file.write_text("{", encoding="utf-8")
            self.assertEqual(view.post("write", {}).status, 400)
            self.assertEqual(view.file.read_text(encoding="utf-8"), "{")

    def test_a_scene_that_takes_for_ever_is_left_by_the_next_change(self):
        with View() as view:
            before = view.ready()
            view.file.write_text(ENDLESS, encoding="utf-8")
            view.wait_for(lambda s: s["doing"] == "Building better cells")
            time.sleep(0.5)
            self.assertEqual(view.get("picture").state["doing"], "Building better cells")
            view.file.write_text(SCENE + "\n", encoding="utf-8")
            self.assertEqual(view.ready().pixels, before.pixels)

    def test_control_c_leaves_it_too(self):
        with View(ENDLESS) as view:
            view.wait_for(lambda s: s["doing"] == "Building better cells")
            self.assertEqual(view.end(signal.SIGINT), 0)


class Refusals(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.view = View().__enter__()
        cls.view.ready()

    @classmethod
    def tearDownClass(cls):
        code = cls.view.end(signal.SIGTERM)
        cls.view.__exit__()
        assert code == 0, code

    def tearDown(self):
        # After any request, the server still answers.
        self.assertEqual(self.view.get("").status, 200)
        self.assertEqual(self.view.get("picture").status, 200)

    def test_only_the_token_opens(self):
        view = self.view
        for path in ("/", "/picture", f"/{'0' * 32}/", f"/{view.token[:-1]}/", f"/{view.token}", f"//{view.token}/",
                     f"/{view.token}0/picture", "/../../etc/passwd"):
            self.assertEqual(view.request("GET", path).status, 403, path)
        self.assertEqual(view.request("POST", "/change", "{}", {"Content-Type": "application/json"}).status, 403)
        self.assertEqual(view.get("../../etc/passwd").status, 404)
        self.assertEqual(view.request("PUT", f"/{view.token}/change", "{}").status, 405)

    def test_only_its_own_host_and_origin(self):
        view = self.view
        own = f"127.0.0.1:{view.port}"
        for host in ("evil.example", f"evil.example:{view.port}", "127.0.0.1", f"127.0.0.1:{view.port}.evil.example", ""):
            self.assertEqual(view.get("", headers={"Host": host}).status, 403, host)
        for origin in ("http://evil.example", "null", f"https://{own}", f"http://{own}.evil.example"):
            for method in ("GET", "POST"):
                answer = view.request(method, f"/{view.token}/change", "{}", {"Host": own, "Origin": origin})
                self.assertEqual(answer.status, 403, origin)
        self.assertEqual(view.get("", headers={"Host": own, "Origin": f"http://{own}"}).status, 200)
        self.assertEqual(view.get("", headers={"Host": f"localhost:{view.port}"}).status, 200)

    def test_nobody_may_frame_it_or_learn_its_address(self):
        headers = self.view.get("").headers
        self.assertIn("default-src 'none'", headers["Content-Security-Policy"])
        self.assertIn("frame-ancestors 'none'", headers["Content-Security-Policy"])
        self.assertEqual(headers["Referrer-Policy"], "no-referrer")

    def test_it_listens_on_the_loopback_address_alone(self):
        listening = []
        for table in ("/proc/net/tcp", "/proc/net/tcp6"):
            for line in pathlib.Path(table).read_text(encoding="ascii").splitlines()[1:]:
                address, port = line.split()[1].split(":")
                if line.split()[3] == "0A" and int(port, 16) == self.view.port:
                    listening.append(address)
        self.assertEqual(listening, ["0100007F"])

    def test_wrong_changes_are_refused_and_told(self):
        view = self.view
        before = view.get("picture").state["version"]
        for wish in ("", "{", "[]", "{}x", "1e999", '{"camera": 5}', '{"camera": {"position": [0, 0, 0]}}', '{"exposure": 99}',
                     '{"camera": {"position": [0, 0, 0], "look_at": [0, 0, 0]}}', '{"hidden": "glass"}', '{"hiden": []}',
                     '{"looks": []}', '{"looks": {"wood": 1}}', '{"looks": {"wood": {"ior": 0}}}', '{"looks": {"wood": {"color": "brown"}}}',
                     '{"looks": {"wood": {"roughness": 2}}}', '{"looks": {"wood": {"clear": 1}}}', '{"cut": {"normal": [0, 0, 1]}}',
                     '{"cut": {"normal": [0, 0, 0], "offset": 1}}', '{"cut": {"normal": [0, 0, 1], "offset": 1e30}}',
                     "[" * 60000, b'{"hidden": ["\xff"]}'):
            answer = view.post("change", wish)
            self.assertEqual(answer.status, 400, wish[:60])
        self.assertIn(b'did you mean "hidden"', view.post("change", '{"hiden": []}').body)
        for place in ("{}", '{"x": -1, "y": 0}', '{"x": 1e9, "y": 0}', '{"x": 1, "y": 1, "z": 1}'):
            self.assertEqual(view.post("ask", place).status, 400, place)
        self.assertEqual(view.get("picture").state["version"], before)

    def test_large_and_strange_bodies_are_refused(self):
        view = self.view
        path = f"/{view.token}/change"
        kind = {"Content-Type": "application/json"}
        self.assertEqual(view.post("change", " " * 65537).status, 413)
        self.assertEqual(view.request("POST", path, "{}", {"Content-Type": "text/plain"}).status, 415)
        self.assertEqual(view.request("POST", path, "{}", {**kind, "Content-Encoding": "gzip"}).status, 411)
        self.assertEqual(view.request("POST", path, iter([b"{}"]), {**kind, "Transfer-Encoding": "chunked"}).status, 411)

    def answer_to(self, *parts, pause=0.0):
        with self.view.connect() as connection:
            try:
                for part in parts:
                    connection.sendall(part)
                    time.sleep(pause)
                return connection.recv(100)
            except (BrokenPipeError, ConnectionResetError):
                return b""

    def test_heads_are_limited(self):
        head = f"GET /{self.view.token}/ HTTP/1.1\r\nHost: 127.0.0.1:{self.view.port}\r\n".encode()
        for line in (b"X: " + b"x" * 20000 + b"\r\n\r\n", b"X: y\r\n" * 5000 + b"\r\n", b"\0" * 20000):
            self.assertNotIn(b"200 OK", self.answer_to(head + line))
        self.assertNotIn(b"200 OK", self.answer_to(b"GET /" + b"a" * 15000 + b" HTTP/1.1\r\n\r\n"))
        # A thousand times the picture, or a pattern that is matched by recursion.
        ranges = b"Range: bytes=" + b",".join([b"0-"] * 2000) + b"\r\n\r\n"
        self.assertIn(b"200 OK", self.answer_to(head + ranges))

    def test_half_requests_run_out_of_time(self):
        begun = f"POST /{self.view.token}/change HTTP/1.1\r\nHost: 127.0.0.1:{self.view.port}\r\n".encode()
        body = begun + b"Content-Type: application/json\r\nContent-Length: 100\r\n\r\n{"
        for half in (b"", b"GET", begun, body):
            with self.view.connect() as connection:
                connection.sendall(half)
                start = time.monotonic()
                while connection.recv(100):
                    pass
                self.assertLess(time.monotonic() - start, 15)

    def test_a_request_that_drips_runs_out_of_time(self):
        start = time.monotonic()
        with self.view.connect() as connection:
            try:
                while time.monotonic() - start < 20:
                    connection.sendall(b"X")
                    time.sleep(0.05)
            except (BrokenPipeError, ConnectionResetError):
                pass
        self.assertLess(time.monotonic() - start, 15)

    def test_floods_are_refused(self):
        threads = pathlib.Path(f"/proc/{self.view.process.pid}/task")
        before = len(list(threads.iterdir()))
        flood = [self.view.connect() for _ in range(300)]
        try:
            time.sleep(0.5)
            self.assertLessEqual(len(list(threads.iterdir())), before + 2)
        finally:
            for connection in flood:
                connection.close()


class Ends(unittest.TestCase):
    def test_a_signal_ends_it_as_soon_as_the_address_is_there(self):
        # The thread that listens may not have begun to.
        for _ in range(20):
            with View() as view:
                self.assertEqual(view.end(signal.SIGTERM), 0)

    def test_it_ends_while_requests_are_open(self):
        with View() as view:
            state = view.ready().state
            waiting = view.connect()
            waiting.sendall(f"GET /{view.token}/picture?after={state['version']} HTTP/1.1\r\n"
                            f"Host: 127.0.0.1:{view.port}\r\n\r\n".encode())
            half = view.connect()
            half.sendall(b"GET /")
            start = time.monotonic()
            self.assertEqual(view.end(signal.SIGTERM), 0)
            self.assertLess(time.monotonic() - start, 10)
            waiting.close()
            half.close()

    def test_a_scene_that_is_wrong_from_the_start_is_said_and_can_be_repaired(self):
        with View(SCENE.replace("wood", "wod", 1)) as view:
            self.assertIn("scene.json:4:", view.wait_for(lambda s: s["error"]).state["error"])
            self.assertIn("scene.json:4:", view.said())
            view.file.write_text(SCENE, encoding="utf-8")
            view.wait_for(lambda s: is_ready(s) and not s["error"])

    def test_a_scene_that_is_in_no_file(self):
        run = subprocess.run([COMMAND, "view", "-"], input=SCENE, capture_output=True, text=True, check=False, timeout=60)
        self.assertEqual((run.returncode, run.stdout), (2, ""))
        run = subprocess.run([COMMAND, "view", "/nowhere/scene.json"], capture_output=True, text=True, check=False, timeout=60)
        self.assertEqual((run.returncode, run.stdout), (2, ""))
        self.assertIn("/nowhere/scene.json: ", run.stderr)

    def test_a_port_that_is_taken(self):
        with View() as view:
            run = subprocess.run([COMMAND, "view", str(view.file), "--port", str(view.port)], capture_output=True, text=True,
                                 check=False, timeout=60)
            self.assertEqual((run.returncode, run.stdout), (1, ""))
            self.assertIn(str(view.port), run.stderr)


if __name__ == "__main__":
    unittest.main()
