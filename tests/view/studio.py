"""The studio's endpoints over HTTP: the document, operations on it, undo, the catalogue, and hostile clients."""

import json
import os
import pathlib
import struct
import sys
import threading
import time
import unittest
import zlib

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from support import PATIENCE, SCENE, View, is_ready  # noqa: E402

RADIUS = "/shapes/ball/sphere/radius"


def document(view, after=0):
    answer = view.get(f"document?after={after}")
    assert answer.status == 200, answer.body
    return json.loads(answer.body)


def edit(view, *operations, base=None, label="Edit", **more):
    base = document(view)["version"] if base is None else base
    answer = view.post("document", {"base": base, "label": label, "operations": list(operations), **more})
    return answer.status, json.loads(answer.body)


def entries(outline):
    for entry in outline:
        yield entry
        yield from entries(entry["children"])


class Dragging(unittest.TestCase):
    """The middle of the ball on the left is at 33.7, 32 in the picture."""

    BY = "/tree/under/1/set/of/translate/by"

    def test_a_surface_is_grabbed_and_dragged(self):
        with View() as view:
            view.ready()
            answer = view.post("grab", {"x": 33.7, "y": 32})
            self.assertEqual(answer.status, 200, answer.body)
            told = json.loads(answer.body)
            self.assertEqual((told["inside"], told["outside"]), ("glass", "vacuum"))
            pointers = [one["pointer"] for one in told["influences"]]
            # The other ball has the same radius, but is somewhere else.
            self.assertEqual(sorted(pointers), [RADIUS, *(f"{self.BY}/{i}" for i in range(3))])
            answer = view.post("drag", {"grab": told["grab"], "x": 38.7, "y": 32, "chosen": [f"{self.BY}/0", f"{self.BY}/2"]})
            self.assertEqual(answer.status, 200, answer.body)
            dragged = json.loads(answer.body)
            self.assertTrue(dragged["follows"])
            self.assertLess(dragged["miss"], 0.5)
            self.assertAlmostEqual(dragged["values"][f"{self.BY}/0"], -0.6 + 5 * told["pixel"], delta=0.005)
            self.assertEqual(dragged["values"][RADIUS], 0.5)
            # The text changes only by operations.
            self.assertEqual(document(view)["text"], SCENE)

    def test_what_cannot_be_dragged_is_refused_with_a_reason(self):
        with View() as view:
            view.ready()
            for place, status in (({"x": 1, "y": 1}, 409), ({"x": -1, "y": 1}, 400), ({"x": 1}, 400), ({"x": 1, "y": 1, "z": 1}, 400),
                                  ([], 400), ({"x": "1", "y": 1}, 400)):
                self.assertEqual(view.post("grab", place).status, status, place)
            self.assertIn(b"no surface", view.post("grab", {"x": 1, "y": 1}).body)
            number = json.loads(view.post("grab", {"x": 33.7, "y": 32}).body)["grab"]
            drag = {"grab": number, "x": 34, "y": 32, "chosen": []}
            self.assertEqual(view.post("drag", drag).status, 200)
            for change, status in (({"grab": 99}, 409), ({"grab": -1}, 400), ({"x": 1e9}, 400), ({"chosen": [1]}, 400), ({"chosen": "x"}, 400)):
                self.assertEqual(view.post("drag", {**drag, **change}).status, status, change)
            # Unknown numbers are ignored.
            self.assertEqual(json.loads(view.post("drag", {**drag, "chosen": ["/version"]}).body)["values"][RADIUS], 0.5)
            # Only the last points are kept.
            for _ in range(4):
                view.post("grab", {"x": 33.7, "y": 32})
            self.assertEqual(view.post("drag", drag).status, 409)


class Editing(unittest.TestCase):
    def test_an_operation_changes_the_text_the_file_and_the_picture(self):
        with View() as view:
            before = view.ready()
            told = document(view)
            self.assertEqual(told["text"], SCENE)
            self.assertEqual((told["undo"], told["redo"], told["saved"], told["file"]), (None, None, True, "scene.json"))
            by_pointer = {entry["pointer"]: entry for entry in entries(told["outline"])}
            self.assertEqual(by_pointer["/shapes/ball"]["parameters"]["radius"],
                             {"pointer": RADIUS, "text": "0.5", "keyed": False})
            self.assertEqual(by_pointer["/tree/under/0"]["kind"], "set")
            status, answer = edit(view, {"set": RADIUS, "to": "0.375"}, label="Make the balls smaller")
            self.assertEqual(status, 200)
            smaller = SCENE.replace('"radius": 0.5', '"radius": 0.375')
            self.assertEqual(view.file.read_text(encoding="utf-8"), smaller)
            after = view.wait_for(lambda s: is_ready(s) and s["version"] > before.state["version"])
            self.assertNotEqual(after.pixels, before.pixels)
            told = document(view)
            self.assertGreaterEqual(told["version"], answer["version"])
            self.assertEqual((told["text"], told["undo"]), (smaller, "Make the balls smaller"))
            self.assertTrue(told["checked"])
            self.assertEqual(view.post("undo", {}).status, 200)
            self.assertEqual(view.file.read_text(encoding="utf-8"), SCENE)
            back = view.wait_for(lambda s: is_ready(s) and s["version"] > after.state["version"])
            self.assertEqual(back.pixels, before.pixels)
            self.assertEqual(view.post("redo", {}).status, 200)
            self.assertEqual(document(view)["text"], smaller)

    def test_a_drag_is_one_step(self):
        with View() as view:
            for i in range(5):
                self.assertEqual(edit(view, {"set": RADIUS, "to": str(0.3 + i / 100)}, merge="drag-1")[0], 200)
            view.post("undo", {})
            self.assertEqual(document(view)["text"], SCENE)

    def test_an_invalid_scene_is_kept_with_its_error_and_the_picture_stays(self):
        with View() as view:
            before = view.ready()
            strict, answer = edit(view, {"set": RADIUS, "to": "-1"}, strict=True)
            self.assertEqual((strict, answer["error"]["line"], answer["error"]["column"]), (400, 3, 42))
            self.assertEqual(document(view)["text"], SCENE)
            status, answer = edit(view, {"set": RADIUS, "to": "-1"})
            self.assertEqual(status, 200)
            state = view.wait_for(lambda s: s["error"])
            self.assertEqual(state.state["picture"]["number"], before.state["picture"]["number"])
            told = document(view)
            while not told["checked"]:
                told = document(view, told["version"])
            self.assertEqual((told["error"]["line"], told["error"]["column"]), (3, 42))
            self.assertIn('"radius"', told["error"]["message"])
            self.assertIsNotNone(told["outline"])
            edit(view, {"text": SCENE[:100]})
            told = document(view)
            self.assertIsNone(told["outline"])
            self.assertEqual(told["error"]["line"], 2)
            self.assertEqual(edit(view, {"set": RADIUS, "to": "1"})[0], 400)
            view.post("undo", {})
            view.post("undo", {})
            back = view.wait_for(lambda s: is_ready(s) and not s["error"])
            self.assertEqual(back.pixels, before.pixels)

    def test_an_editor_outside_makes_a_step_and_a_waiting_page_is_told(self):
        with View() as view:
            view.ready()
            version = document(view)["version"]
            other = SCENE.replace('"radius": 0.5', '"radius": 0.25')
            threading.Timer(0.3, lambda: view.file.write_text(other, encoding="utf-8")).start()
            told = document(view, version)
            self.assertEqual((told["text"], told["undo"]), (other, "Change made in another program"))

    def test_a_request_for_an_older_version_is_a_conflict_if_it_may_mean_something_else(self):
        with View() as view:
            base = document(view)["version"]
            self.assertEqual(edit(view, {"remove": "/tree/under/0"}, base=base)[0], 200)
            status, answer = edit(view, {"remove": "/tree/under/0"}, base=base)
            self.assertEqual(status, 409)
            self.assertIn("message", answer["error"])
            self.assertEqual(edit(view, {"set": "/camera/fov", "to": "31"}, base=base)[0], 200)

    def test_buttons_that_write_into_the_file_are_steps(self):
        with View() as view:
            view.ready()
            view.post("change", {"camera": {"position": [5, 0, 0], "look_at": [0, 0, 0]}})
            view.wait_for(lambda s: "[5, 0, 0]" in s["camera"])
            self.assertEqual(view.post("write", {}).status, 200)
            self.assertEqual(document(view)["undo"], "Write the camera")
            view.post("change", {"numbers": {RADIUS: 0.375}})
            view.wait_for(lambda s: s["numbers"])
            self.assertEqual(view.post("write_numbers", {}).status, 200)
            self.assertEqual(document(view)["undo"], "Write numbers")
            view.post("undo", {})
            view.post("undo", {})
            self.assertEqual(view.file.read_text(encoding="utf-8"), SCENE)

    def test_nothing_is_saved_until_asked(self):
        with View(SCENE, "--no-save") as view:
            edit(view, {"set": RADIUS, "to": "0.25"})
            self.assertEqual(view.file.read_text(encoding="utf-8"), SCENE)
            self.assertFalse(document(view)["saved"])
            self.assertEqual(view.post("save", {}).status, 200)
            self.assertIn("0.25", view.file.read_text(encoding="utf-8"))
            self.assertTrue(document(view)["saved"])

    def test_a_scene_that_is_wrong_from_the_start_is_repaired(self):
        with View('{"version": 1}\n') as view:
            self.assertIn("phases", view.wait_for(lambda s: s["error"]).state["error"])
            edit(view, {"text": SCENE})
            view.ready()


class Quick(unittest.TestCase):
    def seconds(self, view):
        """Of processor time, of all threads."""
        fields = pathlib.Path(f"/proc/{view.process.pid}/stat").read_text(encoding="ascii").rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def test_a_step_does_not_make_the_skies_of_the_scene_again(self):
        # Half a second each.
        skies = ", ".join(f'{{"sky": {{"sun_elevation": {elevation}}}}}' for elevation in (10, 20, 30, 40))
        with View(SCENE.replace('"lights": [', f'"lights": [{skies}, ')) as view:
            view.ready()
            begun = self.seconds(view)
            for i in range(4):
                self.assertEqual(edit(view, {"set": RADIUS, "to": str(0.4 + i / 100)}, strict=True)[0], 200)
            view.wait_for(lambda s: is_ready(s) and s["version"] > 0)
            self.assertLess(self.seconds(view) - begun, 4 * PATIENCE)

    def test_a_picture_is_shown_with_the_current_view(self):
        """The studio keeps display transforms per exposure, so they must not outlive a change of the view."""
        with View() as view:
            view.ready()
            pixels = []
            for name in ("Standard", "Photographic", "Standard"):
                text = SCENE.replace('"samples": 4}', f'"samples": 4, "view": "{name}"}}')
                before = view.ready().state["version"]
                self.assertEqual(edit(view, {"text": text})[0], 200)
                pixels.append(view.wait_for(lambda s: is_ready(s) and s["version"] > before).pixels)
            self.assertNotEqual(pixels[0], pixels[1])
            self.assertEqual(pixels[0], pixels[2])

    def test_a_step_does_not_read_images_again_unless_their_files_change(self):
        def write_image(file, value, size=2048):
            row = b"\0" + bytes((value, 64, 255 - value)) * size
            chunk = lambda name, data: struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
            header = struct.pack(">IIBBBBB", size, size, 8, 2, 0, 0, 0)
            file.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(row * size, 1)) + chunk(b"IEND", b""))

        class WithImage(View):
            def prepare(self):
                write_image(self.file.with_name("paint.png"), 255)

        with WithImage(SCENE.replace('"color": [0.6, 0.3, 0.1]', '"color": {"image": {"file": "paint.png"}}'), "--threads", "1") as view:
            first = view.ready()
            begun = self.seconds(view)
            for i in range(16):
                self.assertEqual(edit(view, {"set": "/camera/fov", "to": str(30.1 + i / 100)}, strict=True)[0], 200)
            last = view.wait_for(lambda s: is_ready(s) and s["version"] > first.state["version"])
            # Each reading of the image would take a quarter of a second.
            self.assertLess(self.seconds(view) - begun, 1.6 * PATIENCE)
            write_image(view.file.with_name("paint.png"), 0, 16)
            changed = view.wait_for(lambda s: is_ready(s) and s["version"] > last.state["version"] + 3)
            self.assertNotEqual(changed.pixels, last.pixels)

    def test_a_text_is_sent_once(self):
        with View() as view:
            view.ready()
            told = document(view)
            self.assertNotIn("text", json.loads(view.get(f"document?after=0&text={told['text_version']}").body))
            edit(view, {"set": RADIUS, "to": "0.25"})
            now = json.loads(view.get(f"document?after={told['version']}&text={told['text_version']}").body)
            self.assertIn("0.25", now["text"])
            # What is saved or checked later has the same text.
            later = json.loads(view.get(f"document?after=0&text={now['text_version']}").body)
            self.assertNotIn("text", later)
            self.assertNotIn("outline", later)
            self.assertEqual(later["text_version"], now["text_version"])


class Catalogue(unittest.TestCase):
    def test_kinds_and_their_pictures(self):
        with View() as view:
            catalogue = json.loads(view.get("catalogue").body)
            kinds = {(kind["type"], kind["kind"]): kind for kind in catalogue["kinds"]}
            sphere = kinds["field", "sphere"]
            self.assertEqual(json.loads(sphere["template"]), {"sphere": {"radius": 0.5}})
            self.assertEqual(sphere["parameters"][0]["control"], "length")
            self.assertEqual(sphere["parameters"][0]["type"], "number")
            points = next(p for p in kinds["field", "polygon"]["parameters"] if p["name"] == "points")
            self.assertEqual(points["type"], "list of [x, y]")
            if sphere["picture"]:
                picture = view.get(sphere["picture"])
                self.assertEqual(picture.headers["Content-Type"], "image/jpeg")
                self.assertEqual(picture.body[:2], b"\xff\xd8")
            for name in ("pictures/", "pictures/../README.md", "pictures/nodes/fields/sphere.json", "pictures/%2e%2e/README.md"):
                self.assertEqual(view.get(name).status, 404, name)


    def test_colours_of_measured_substances(self):
        with View() as view:
            told = json.loads(view.get("catalogue").body)
            colours = {one["name"]: one for one in told["measured_colors"]}
            choices = {p["name"]: p["choices"] for kind in told["kinds"] if kind["type"] == "material" for p in kind["parameters"]}
            for name in choices["metal"]:
                if name != "aluminum":
                    self.assertEqual(colours[name]["group"], "metals")
            for name in choices["medium"]:
                self.assertEqual(colours[name]["group"], "materials")
            # The diffuse reflectance in figure 5 of Jensen et al. 2001.
            for name, expected in (("whole_milk", (0.91, 0.88, 0.76)), ("ketchup", (0.16, 0.01, 0))):
                for x, y in zip(colours[name]["color"], expected):
                    self.assertAlmostEqual(x, y, delta=0.006)
            red, green, blue = colours["gold"]["color"]
            self.assertTrue(1 > red > green > blue > 0.2, (red, green, blue))


class Hostile(unittest.TestCase):
    def test_wrong_requests_are_refused_and_nothing_changes(self):
        with View() as view:
            good = {"base": 1, "label": "x", "operations": [{"set": RADIUS, "to": "1"}]}
            for change in ({"base": -1}, {"base": "1"}, {"base": 1e300}, {"label": 1}, {"label": "x" * 300}, {"merge": 1}, {"merge": "x" * 201},
                           {"operations": 1}, {"operations": [1]}, {"operations": [{}]}, {"operations": [{"set": RADIUS}]},
                           {"operations": [{"set": RADIUS, "to": 1}]}, {"operations": [{"set": RADIUS, "to": ""}]},
                           {"operations": [{"set": RADIUS, "to": "[" * 100000}]}, {"operations": [{"set": "x", "to": "1"}]},
                           {"operations": [{"remove": ""}]}, {"operations": [{"remove": "/tree/~2"}]},
                           {"operations": [{"move": "/tree", "to": "/tree/under/0"}]},
                           {"operations": [{"insert": "/tree/under/99999999999999999999", "value": "1"}]},
                           {"operations": [{"wrap": "/tree", "in": "{}"}]}, {"operations": [{"set": RADIUS, "to": "1", "more": 1}]},
                           {"operations": [{"remove": "/tree"}] * 1001}, {"more": 1}):
                answer = view.post("document", {**good, **change})
                self.assertEqual(answer.status, 400, (change, answer.body))
                self.assertIn("message", json.loads(answer.body)["error"])
            for body in ("", "{", "[]", "null", '{"base": 1}', b"\xff\xfe", "[" * 50000):
                self.assertEqual(view.post("document", body).status, 400, body[:20])
            self.assertEqual(document(view)["text"], SCENE)
            self.assertEqual(view.file.read_text(encoding="utf-8"), SCENE)

    def test_sizes_are_limited(self):
        with View() as view:
            self.assertEqual(edit(view, {"text": " " * (5 << 20)})[0], 400)
            self.assertEqual(view.post("document", " " * (9 << 20)).status, 413)
            self.assertEqual(view.post("undo", " " * 65537).status, 413)
            self.assertEqual(edit(view, {"text": SCENE + " " * (3 << 20)})[0], 200)
            started = time.monotonic()
            self.assertEqual(edit(view, *[{"set": RADIUS, "to": "1"}] * 900)[0], 400)
            self.assertLess(time.monotonic() - started, 60)

    def test_only_the_token_and_its_own_pages_edit(self):
        with View() as view:
            body = json.dumps({"base": 1, "label": "x", "operations": [{"set": RADIUS, "to": "1"}]})
            kind = {"Content-Type": "application/json"}
            self.assertEqual(view.request("POST", "/" + "0" * 32 + "/document", body, kind).status, 403)
            own = f"/{view.token}/document"
            self.assertEqual(view.request("POST", own, body, {**kind, "Origin": "http://example.org"}).status, 403)
            self.assertEqual(view.request("POST", own, body, {"Content-Type": "text/plain"}).status, 415)
            self.assertEqual(view.get("document", headers={"Origin": "http://example.org"}).status, 403)
            self.assertEqual(document(view)["text"], SCENE)

    def test_pages_that_edit_at_the_same_time_agree(self):
        with View() as view:
            def drag(pointer, values):
                for value in values:
                    edit(view, {"set": pointer, "to": str(value)}, merge=pointer)
            pages = [threading.Thread(target=drag, args=(RADIUS, [0.3 + i / 1000 for i in range(20)])),
                     threading.Thread(target=drag, args=("/camera/fov", range(20, 40)))]
            for page in pages:
                page.start()
            for page in pages:
                page.join()
            scene = json.loads(view.file.read_text(encoding="utf-8"))
            self.assertEqual((scene["shapes"]["ball"]["sphere"]["radius"], scene["camera"]["fov"]), (0.319, 39))
            self.assertEqual(json.loads(document(view)["text"]), scene)


if __name__ == "__main__":
    unittest.main()
