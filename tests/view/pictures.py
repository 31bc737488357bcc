"""Pictures that come, from coarse to finished, and are saved."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from support import COMMAND, SCENE, View, changed, is_ready, rendered  # noqa: E402


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
            _, at = shown("phase_to")
            self.assertEqual(len({at(64, 32), at(32, 32), at(2, 2)}), 3)
            self.assertEqual(at(2, 2), (0, 0, 0))
            depth, at = shown("depth")
            self.assertGreater(at(64, 32)[0], 200)
            self.assertEqual(at(2, 2), (0, 0, 0))
            self.assertNotEqual(view.get("picture.png").body, rendered(view, SCENE))
            self.assertIn(b"depth.Z", view.get("picture.exr").body)
            back, _ = shown("")
            self.assertEqual(back.pixels, before.pixels)
            self.assertNotEqual(depth.pixels, before.pixels)

    def test_the_picture_is_saved_as_exr_too(self):
        with View() as view:
            view.ready()
            picture = view.get("picture.exr")
            self.assertEqual(picture.headers["Content-Type"], "image/x-exr")
            self.assertEqual(picture.body, rendered(view, SCENE, "scene.exr"))

    def test_the_exposure_changes_the_picture_that_is_there(self):
        with View() as view:
            before = view.ready()
            view.post("change", {"exposure": 2})
            after = view.wait_for(lambda s: s["exposure"] == 2)
            self.assertEqual(after.state["picture"]["samples"], 4)
            self.assertGreater(sum(after.pixels), sum(before.pixels))


if __name__ == "__main__":
    unittest.main()
