"""Selections, hidden parts and file lists over HTTP: the pixels of selected parts, pictures without hidden parts, and
the files that a parameter may name."""

import json
import os
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from support import View, changed, is_ready, rendered  # noqa: E402

WIDTH, HEIGHT = 96, 64
# From the left: a glass ball with a wooden ball inside, and a wooden ball behind a glass wall. A floor reaches to the
# horizon.
SCENE = """{"version": 1,
"phases": {"glass": {"clear": {"ior": 1.5}}, "pane": {"clear": {"ior": 1.5}}, "wood": {"diffuse": {"color": [0.6, 0.3, 0.1]}}},
"shapes": {"ball": {"sphere": {"radius": 0.5}}},
"tree": {"over": [
  {"set": {"phase": "wood", "of": {"translate": {"by": [-0.8, 0, 0], "of": {"sphere": {"radius": 0.2}}}}}},
  {"set": {"phase": "glass", "of": {"translate": {"by": [-0.8, 0, 0], "of": "ball"}}}},
  {"set": {"phase": "wood", "of": {"translate": {"by": [0.8, 1, 0], "of": "ball"}}}},
  {"set": {"phase": "pane", "of": {"translate": {"by": [0.8, 0, 0], "of": {"box": {"size": [1, 0.1, 1]}}}}}}
]},
"meshes": [{"floor": {"height": -2, "material": {"diffuse": {"color": [0.5, 0.5, 0.5]}}}}],
"lights": [{"constant": {"radiance": [1, 1, 1]}}],
"camera": {"position": [0, -5, 0], "look_at": [0, 0, 0], "fov": 30},
"render": {"width": 96, "height": 64, "samples": 4}}
"""


class Selected(unittest.TestCase):
    def mask(self, view, *pointers, phases=()):
        """The selected pixels, as rows of booleans."""
        answer = view.post("selected", {"pointers": pointers, "phases": phases})
        self.assertEqual(answer.status, 200, answer.body)
        told = json.loads(answer.body)
        self.assertEqual((told["width"], told["height"]), (WIDTH, HEIGHT))
        pixels = [i % 2 == 1 for i, run in enumerate(told["runs"]) for _ in range(run)]
        self.assertEqual(len(pixels), WIDTH * HEIGHT)
        return [pixels[y * WIDTH:(y + 1) * WIDTH] for y in range(HEIGHT)]

    @staticmethod
    def box(mask):
        """The bounding box of the selected pixels, and their number."""
        places = [(x, y) for y, row in enumerate(mask) for x, pixel in enumerate(row) if pixel]
        xs, ys = [x for x, _ in places], [y for _, y in places]
        return (min(xs), min(ys), max(xs) + 1, max(ys) + 1, len(places)) if places else None

    def assert_is(self, mask, expected, pixels):
        """Checks the box to a pixel, and the number of pixels to 3 %."""
        found = self.box(mask)
        self.assertIsNotNone(found)
        for a, b in zip(found[:4], expected):
            self.assertLessEqual(abs(a - b), 1, (found, expected))
        self.assertLessEqual(abs(found[4] - pixels), 0.03 * pixels + 4, (found, pixels))

    def test_parts_are_where_they_are_seen(self):
        # Pixels per unit at a distance of 5, where 64 pixels cover 2·5·tan 15°.
        scale = 64 / (2 * 5 * 0.2679492)
        with View(SCENE) as view:
            view.ready()
            # The silhouette of a ball is a bit larger than its circle.
            centre, radius = 48 - 0.8 * scale, 0.5 * scale * (1 + 0.5 * 0.5 ** 2 / 25)
            ball = (centre - radius, 32 - radius, centre + radius, 32 + radius)
            self.assert_is(self.mask(view, "/tree/over/1"), ball, 3.14159 * radius ** 2)
            self.assertEqual(self.mask(view, "/tree/over/1/set/of"), self.mask(view, "/tree/over/1"))
            # Behind clear surfaces, without refraction.
            small = 0.2 * scale
            self.assert_is(self.mask(view, "/tree/over/0"), (centre - small, 32 - small, centre + small, 32 + small), 3.14159 * small ** 2)
            farther = 64 / (2 * 6 * 0.2679492)
            x, radius = 48 + 0.8 * farther, 0.5 * farther * (1 + 0.5 * 0.5 ** 2 / 36)
            self.assert_is(self.mask(view, "/tree/over/2"), (x - radius, 32 - radius, x + radius, 32 + radius), 3.14159 * radius ** 2)
            pane = self.box(self.mask(view, "/tree/over/3"))
            # Several parts, and whole phases.
            both = self.box(self.mask(view, "/tree/over/1", "/tree/over/3"))
            self.assertEqual((both[0], both[2]), (self.box(self.mask(view, "/tree/over/1"))[0], pane[2]))
            wood = self.mask(view, phases=["wood"])
            either = [[a or b for a, b in zip(*rows)] for rows in zip(self.mask(view, "/tree/over/0"), self.mask(view, "/tree/over/2"))]
            self.assertEqual(wood, either)
            self.assertEqual(self.mask(view, "/shapes/ball"), [[a or b for a, b in zip(*rows)] for rows in zip(self.mask(view, "/tree/over/1"), self.mask(view, "/tree/over/2"))])
            floor = self.box(self.mask(view, "/meshes/0"))
            self.assertEqual((floor[0], floor[2], floor[3]), (0, WIDTH, HEIGHT))
            self.assertGreaterEqual(floor[1], HEIGHT // 2)
            for nothing in ((), ("/tree/over/9",), ("/camera",)):
                self.assertIsNone(self.box(self.mask(view, *nothing)))

    def test_what_is_behind_something_opaque_is_not_selected(self):
        with View(changed(SCENE, '"pane": {"clear": {"ior": 1.5}}', '"pane": {"diffuse": {"color": [0.5, 0.5, 0.5]}}')) as view:
            view.ready()
            self.assertIsNone(self.box(self.mask(view, "/tree/over/2")))
            self.assertIsNotNone(self.box(self.mask(view, "/tree/over/3")))

    def test_it_follows_the_camera(self):
        with View(SCENE) as view:
            view.ready()
            before = self.box(self.mask(view, "/tree/over/1"))
            view.post("change", {"camera": {"position": [0, 5, 0], "look_at": [0, 0, 0], "fov": 30}})
            view.wait_for(lambda s: is_ready(s) and "[0, 5, 0]" in s["camera"])
            after = self.box(self.mask(view, "/tree/over/1"))
            self.assertLessEqual(abs(before[0] - (WIDTH - after[2])), 1)

    def test_wrong_requests_are_rejected(self):
        with View(SCENE) as view:
            view.ready()
            for body in ("", "[]", {}, {"pointers": []}, {"pointers": 1, "phases": []}, {"pointers": [1], "phases": []},
                         {"pointers": ["/tree"] * 501, "phases": []}, {"pointers": [], "phases": [], "more": 1}):
                self.assertEqual(view.post("selected", body).status, 400, body)
            self.assertIsNone(self.box(self.mask(view, "tree", "/~9", "/tree/over/99999999999999999999")))


class Hidden(unittest.TestCase):
    def hide(self, view, *pointers):
        version = json.loads(view.post("change", {"hidden_parts": pointers}).body)["version"]
        return view.wait_for(lambda s: s["version"] >= version and is_ready(s))

    def edit(self, view, *operations):
        version = json.loads(view.get("document?after=0").body)["version"]
        before = view.ready().state["version"]
        self.assertEqual(view.post("document", {"base": version, "label": "Edit", "operations": operations, "strict": True}).status, 200)
        return view.wait_for(lambda s: s["version"] > before and is_ready(s))

    def picture(self, view):
        return view.get("picture.png").body

    def test_the_picture_is_that_of_the_scene_without_them_and_the_file_keeps_them(self):
        lines = SCENE.splitlines(keepends=True)
        without = "".join(lines[:5] + lines[6:])
        with View(SCENE) as view:
            view.ready()
            whole = self.picture(view)
            shown = self.hide(view, "/tree/over/1")
            self.assertEqual(shown.state["hidden_parts"], ["/tree/over/1"])
            self.assertEqual(self.picture(view), rendered(view, without))
            self.assertNotEqual(self.picture(view), whole)
            self.assertEqual(view.file.read_text(encoding="utf-8"), SCENE)
            # A click reports places in the file, as before.
            view.post("save", {})
            self.assertEqual(view.file.read_text(encoding="utf-8"), SCENE)
            self.hide(view)
            self.assertEqual(self.picture(view), whole)

    def test_they_stay_hidden_while_the_scene_is_edited(self):
        with View(SCENE) as view:
            view.ready()
            self.hide(view, "/tree/over/2")
            self.assertEqual(self.edit(view, {"set": "/camera/fov", "to": "31"}).state["hidden_parts"], ["/tree/over/2"])
            self.assertEqual(self.edit(view, {"remove": "/tree/over/0"}).state["hidden_parts"], ["/tree/over/1"])
            self.assertEqual(self.edit(view, {"move": "/tree/over/1", "to": "/tree/over/0"}).state["hidden_parts"], ["/tree/over/0"])
            hidden = self.picture(view)
            self.assertEqual(self.edit(view, {"remove": "/tree/over/0"}).state["hidden_parts"], [])
            # The removed part was the hidden one.
            self.assertEqual(self.picture(view), hidden)

    def test_numbers_and_the_time_may_be_changed_meanwhile(self):
        with View(SCENE) as view:
            view.ready()
            self.hide(view, "/tree/over/0", "/tree/over/1")
            view.post("change", {"numbers": {"/shapes/ball/sphere/radius": 0.25}})
            shown = view.wait_for(lambda s: is_ready(s) and s["numbers"])
            self.assertEqual(shown.state["hidden_parts"], ["/tree/over/0", "/tree/over/1"])
            lines = changed(SCENE, '"sphere": {"radius": 0.5}', '"sphere": {"radius": 0.25}').splitlines(keepends=True)
            self.assertEqual(self.picture(view), rendered(view, "".join(lines[:4] + lines[6:])))

    def test_everything_cannot_be_hidden(self):
        with View(SCENE) as view:
            before = view.ready()
            view.post("change", {"hidden_parts": ["/tree"]})
            state = view.wait_for(lambda s: s["error"]).state
            self.assertIn("every part of the object is hidden", state["error"])
            self.assertEqual(state["picture"]["number"], before.state["picture"]["number"])
            # The file itself is valid.
            self.assertIsNone(json.loads(view.get("document?after=0").body)["error"])
            self.assertEqual(self.hide(view).state["error"], "")
            for wrong in (["/tree/over/0"] * 501, [1], "/tree"):
                self.assertEqual(view.post("change", {"hidden_parts": wrong}).status, 400)


class Files(unittest.TestCase):
    def names(self, view, kind_of, kind):
        answer = view.get(f"files?type={kind_of}&kind={kind}")
        self.assertEqual((answer.status, answer.headers["Content-Type"]), (200, "application/json"))
        told = json.loads(answer.body)
        self.assertFalse(told["has_more"])
        return told["names"]

    def test_files_that_a_kind_can_read_are_listed(self):
        with View() as view:
            folder = view.file.parent
            for name in ("b.obj", "a.PLY", "lamp.ies", "sub/deep/c.stl", ".hidden.obj", ".git/d.obj", "photo.jpg", "sky.exr", "x.txt", "no_extension"):
                file = folder / name
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_bytes(b"")
            self.assertEqual(self.names(view, "field", "mesh"), ["a.PLY", "b.obj", "sub/deep/c.stl"])
            self.assertEqual(self.names(view, "mesh", "obj"), ["b.obj"])
            self.assertEqual(self.names(view, "light", "ies"), ["lamp.ies"])
            self.assertEqual(self.names(view, "light", "image"), ["photo.jpg", "sky.exr"])
            self.assertIn("x.txt", self.names(view, "unknown", "unknown"))

    def test_nothing_outside_the_folder_is_listed(self):
        with View() as outer:
            secret = outer.file.parent / "secret.obj"
            secret.write_bytes(b"")
            with View() as view:
                folder = view.file.parent
                os.symlink(secret, folder / "link.obj")
                os.symlink(outer.file.parent, folder / "folder")
                os.symlink(folder, folder / "loop")
                os.symlink("missing", folder / "broken.obj")
                os.mkfifo(folder / "pipe.obj")
                (folder / "own.obj").write_bytes(b"")
                os.symlink(folder / "own.obj", folder / "alias.obj")
                self.assertEqual(self.names(view, "mesh", "obj"), ["alias.obj", "own.obj"])
                for value in ("../", "%2e%2e/", "/etc"):
                    self.assertEqual(self.names(view, "mesh", f"obj&folder={value}"), ["alias.obj", "own.obj"])
                self.assertEqual(view.request("GET", f"/{'0' * 32}/files?type=mesh&kind=obj").status, 403)
                self.assertEqual(view.get("files?type=mesh&kind=obj", headers={"Origin": "http://example.org"}).status, 403)

    def test_the_list_of_a_large_folder_is_limited(self):
        with View() as view:
            for i in range(600):
                (view.file.parent / f"{i:03}.obj").write_bytes(b"")
            told = json.loads(view.get("files?type=mesh&kind=obj").body)
            self.assertEqual((len(told["names"]), told["has_more"]), (500, True))


if __name__ == "__main__":
    unittest.main()
