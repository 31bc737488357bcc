"""The live view from Python: what its page shows is what was given."""

import gc
import json
import os
import time
import unittest
import urllib.error
import urllib.request

import phasetree as pt
from scenes import small_scene


def state(view):
    with urllib.request.urlopen(view.url + "picture") as answer:
        return json.loads(answer.read().split(b"\n", 1)[0])


def ready(view, condition=lambda state: True):
    end = time.monotonic() + 60
    while time.monotonic() < end:
        now = state(view)
        if now["doing"] == "Ready" and condition(now):
            return now
        time.sleep(0.02)
    raise AssertionError(now)


def edit(view, *operations):
    """What the page sends when something is changed."""
    with urllib.request.urlopen(view.url + "document") as answer:
        base = json.loads(answer.read())["version"]
    body = json.dumps({"base": base, "label": "Edit", "operations": operations}).encode()
    request = urllib.request.Request(view.url + "document", body, {"Content-Type": "application/json"})
    with urllib.request.urlopen(request) as answer:
        return json.loads(answer.read())["version"]


def is_served(url):
    try:
        with urllib.request.urlopen(url):
            return True
    except urllib.error.URLError:
        return False


class Viewing(unittest.TestCase):
    def test_a_scene_is_shown_as_it_is_rendered(self):
        scene = small_scene()
        with pt.view(scene, open=False) as view:
            ready(view)
            with urllib.request.urlopen(view.url + "picture.png") as answer:
                shown = answer.read()
            scene.save(view.file)
            self.assertEqual(pt.load(view.file), scene)
            self.assertEqual(shown[:8], b"\x89PNG\r\n\x1a\n")
            # The file's name is in the picture's description, so the pixels are compared: without the descriptions.
            self.assertEqual(without_text(shown), without_text(scene.render().png()))
            self.assertIn("frame-ancestors http://127.0.0.1:*", urllib.request.urlopen(view.url).headers["Content-Security-Policy"])

    def test_an_object_alone_has_a_sky_a_camera_and_colours_and_another_is_shown_in_its_place(self):
        ball = pt.phase("a")(pt.sphere(1)).over(pt.phase("b", pt.clear(ior=1.5))(pt.box((3, 3, 1))))
        view = pt.view(ball, width=60, samples=2, open=False)
        first = ready(view)
        self.assertEqual([(p["name"], p["kind"]) for p in first["phases"]], [("a", "diffuse"), ("b", "clear")])
        self.assertEqual((first["width"], first["wanted_samples"]), (60, 2))
        view.show(ball.translate((0, 0, 1)))
        second = ready(view, lambda s: s["centre"][2] == 1)
        self.assertEqual(first["centre"], [0, 0, 0])
        self.assertNotEqual(second["camera"], first["camera"])
        self.assertIn(view.url, view._repr_html_())
        view.close()
        self.assertFalse(is_served(view.url))
        self.assertFalse(os.path.exists(view.file))
        view.close()

    def test_what_the_page_changes_comes_back(self):
        ball = pt.phase("a", pt.diffuse((0.5, 0.3, 0.1)))(pt.sphere(1))
        view = pt.view(ball, width=60, samples=1, open=False)
        self.assertEqual(view.scene().object, ball)
        edit(view, {"set": "/tree/set/of/sphere/radius", "to": "0.75"})
        self.assertEqual(view.scene().object, pt.phase("a", pt.diffuse((0.5, 0.3, 0.1)))(pt.sphere(0.75)))
        edit(view, {"set": "/camera/thin_lens/fov", "to": "30"}, {"rename": "/phases/a", "to": "b", "references": True})
        self.assertEqual(view.scene().camera.parameters()["fov"], 30)
        self.assertEqual([phase.name for phase in view.scene().object.phases[1:]], ["b"])
        # What comes back can be shown and changed again.
        view.show(view.scene())
        edit(view, {"set": "/tree/set/of/sphere/radius", "to": "0.5"})
        self.assertEqual(view.scene().object.phases[1].name, "b")
        edit(view, {"set": "/tree/set/of/sphere/radius", "to": "-1"})
        with self.assertRaisesRegex(pt.SceneError, "radius"):
            view.scene()
        view.close()
        with self.assertRaisesRegex(pt.Error, "the view is closed"):
            view.scene()

    def test_a_view_that_nobody_holds_ends(self):
        view = pt.view(small_scene(), open=False)
        url = view.url
        self.assertTrue(is_served(url))
        del view
        gc.collect()
        self.assertFalse(is_served(url))

    def test_what_cannot_be_viewed_is_refused(self):
        with self.assertRaisesRegex(pt.Error, "an object of phases or a scene"):
            pt.view(pt.sphere(1), open=False)
        with self.assertRaisesRegex(pt.Error, "unbounded, so the view cannot place a camera"):
            pt.view(pt.phase("a")(pt.plane()), open=False)
        # What only the reader of scenes finds: the camera is inside wood.
        wood = pt.phase("wood", pt.diffuse((0.5, 0.3, 0.1)))
        inside = pt.Scene(wood(pt.sphere(2)), camera=pt.camera((0, 0, 0), (1, 0, 0)))
        with self.assertRaisesRegex(pt.SceneError, 'inside the phase "wood"'):
            pt.view(inside, open=False)


def without_text(png):
    """The chunks of a PNG file that have pixels."""
    chunks, at = {}, 8
    while at < len(png):
        length, kind = int.from_bytes(png[at : at + 4], "big"), png[at + 4 : at + 8]
        if kind in (b"IHDR", b"IDAT"):
            chunks[kind] = chunks.get(kind, b"") + png[at + 8 : at + 8 + length]
        at += 12 + length
    return chunks


if __name__ == "__main__":
    unittest.main()
