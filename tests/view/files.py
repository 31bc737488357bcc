"""Files that are saved, vanish and come back while a scene is viewed, and what is written into them."""

import os
import pathlib
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from support import COMMAND, SCENE, View, changed, is_ready  # noqa: E402


# A ball of grains with noise as fine as dust: more than a million cells, and minutes until they are built.
ENDLESS = changed(SCENE, '"ball": {"sphere": {"radius": 0.5}}', """"ball": {"displace": {"amplitude": 0.002,
    "scale": 0.01, "octaves": 6, "of": {"fibonacci_sphere": {"count": 20000, "radius": 1,
        "of": {"smooth_union": {"radius": 0.01, "of": [{"sphere": {"radius": 0.01}}, {"box": {"size": [0.01, 0.01, 0.03]}}]}}}}}}""")


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


if __name__ == "__main__":
    unittest.main()
