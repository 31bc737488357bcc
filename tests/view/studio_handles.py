"""The handles over the picture, in Chromium: each of every kind is dragged by the mouse, and follows it.

PHASETREE_KINDS names the kinds to drag, separated by blanks. By default, kinds with every sort of handle are dragged, and all
kinds in the long form (PHASETREE_LONG_TESTS=1), which takes five minutes."""

import json
import math
import os
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from studio_case import GLASSES, StudioCase  # noqa: E402
from studio_user import CONTROL, SHIFT  # noqa: E402

# Kinds that say little with the values of their template, or that need a file.
EXAMPLES = {
    "polyline": {"polyline": {"points": [[-0.5, 0, 0], [0, 0, 0.4], [0.5, 0, 0]], "radius": 0.05}},
    "polygon": {"extrude": {"height": 0.3, "of": {"polygon": [[-0.5, -0.4], [0.5, -0.4], [0, 0.5]]}}},
    "bezier": {"extrude": {"height": 0.3, "of": {"bezier": {
        "points": [[-0.5, -0.3], [0, -0.6], [0.5, -0.3], [0, 0.5]], "thickness": 0.02}}}},
    "balls": {"balls": {"centres": [[-0.4, 0, 0], [0.4, 0, 0]], "radii": 0.2}},
    "endless_grid": {"intersection": [{"endless_grid": {"spacing": [0.5, 0.5, 0.5], "of": {"sphere": {"radius": 0.1}}}}, {"box": {"size": [1, 1, 1]}}]},
    "plane": {"intersection": [{"sphere": {"radius": 0.6}}, {"plane": {"normal": [1, 0, 1], "offset": 0.2}}]},
}
# Between them, they have all sorts of handles: balls, rims, edges, points, lengths along a normal, numbers without a place, …
SHORT = ("sphere", "rounded_box", "capsule", "torus", "slab", "bezier", "smooth_union", "revolve", "thin_shell", "checker", "endless_grid",
         "instances", "spot", "backdrop")
# Where to look from, so that no handle leads into the picture.
CAMERA = '"camera": {"position": [3, -4, 2.5], "look_at": [0, 0, 0], "fov": 30}'
TREE = '"of": {"box": {"size": [0.5, 0.5, 0.5]}}'
SCENE = GLASSES.replace('"camera": {"position": [0, -5, 0], "look_at": [0, 0, 0], "fov": 30}', CAMERA)
NAMES = "[...document.querySelectorAll('#handles .handle')].map((e) => e.dataset.handle)"
MOVING = ("move x", "move y", "move z", "move", "rotate", "scale x", "scale y", "scale z", "scale")


class Handles(StudioCase):
    def grip(self, name):
        """The middle of what is pressed: the last circle or square of a handle."""
        part = f"[...document.querySelectorAll('[data-handle={json.dumps(name)}] :is(circle, rect)')].at(-1)"
        box = self.browser.run(f"(({part}))?.getBoundingClientRect().toJSON()")
        self.assertIsNotNone(box, name)
        return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2

    def drag_each(self, names, distance=(23, -17)):
        """Drags each handle; where it has a place, it is then where the pointer was, in its direction."""
        for name in names:
            # Handles that are in front of others are out of the way, so that each is reached.
            self.browser.run(f"(() => {{ for (const e of document.querySelectorAll('#handles .handle')) e.style.display = e.dataset.handle === {json.dumps(name)} ? '' : 'none'; }})()")
            start = self.grip(name)
            before = self.browser.run("studio.scene.text")
            self.step(lambda: self.browser.drag(start, (start[0] + distance[0], start[1] + distance[1])))
            self.settle()
            after = self.browser.run("studio.scene.text")
            self.assertNotEqual(after, before, name)
            yield name, start, self.grip(name)
            self.browser.run("(async () => { await studio.scene.goBack(); })()")
            self.until(f"studio.scene.text === {json.dumps(before)}")

    def settle(self):
        """Waits until the last step of a drag is part of the scene."""
        last = None
        while (now := self.browser.run("new Promise((done) => setTimeout(() => done(studio.scene.isBusy ? null : studio.scene.text), 40))")) is None or now != last:
            last = now

    def select(self, pointer):
        self.browser.run(f"studio.selection.set([{json.dumps(pointer)}])")

    def test_every_handle_of_every_kind_drags(self):
        self.open(SCENE)
        self.expected = "Failed to load resource"
        kinds = self.browser.run("""studio.actions.catalogue.kinds
            .filter((k) => k.template && ["field", "object", "light", "mesh"].includes(k.type) && !k.template.includes("<file>")).map(({type, kind}) => [type, kind])""")
        is_all = os.environ.get("PHASETREE_LONG_TESTS") == "1"
        chosen = os.environ.get("PHASETREE_KINDS", "").split()
        wanted = chosen or ([kind for _, kind in kinds] if is_all else SHORT)
        dragged, without = 0, []
        for kind_type, kind in kinds:
            if kind not in wanted:
                continue
            with self.subTest(type=kind_type, kind=kind):
                before = self.file()
                if kind in EXAMPLES and kind_type == "field":
                    self.browser.run(f"studio.scene.perform({{label: 'x', operations: [{{set: '/tree/over/1/set/of', to: {json.dumps(json.dumps(EXAMPLES[kind]))}}}]}})")
                    pointer = f"/tree/over/1/set/of{'/intersection/1' if kind == 'plane' else '/intersection/0' if kind == 'endless_grid' else ''}"
                else:
                    self.select("/tree/over/1/set/of" if kind_type == "field" else "/tree/over/1")
                    added = self.browser.run(f"studio.actions.addKind(studio.actions.catalogue.named({json.dumps(kind)}, {json.dumps(kind_type)}))")
                    self.assertTrue(added)
                    pointer = self.browser.run("studio.selection.active")
                    # Fields are boxed where they fill space.
                    pointer = self.browser.run(f"studio.scene.entries.find((e) => e.pointer.startsWith({json.dumps(pointer)}) && e.kind === {json.dumps(kind)})?.key") or pointer
                self.select(pointer)
                names = [n for n in self.browser.run(NAMES) if n not in MOVING]
                if not names:
                    without.append(kind)
                for _ in self.drag_each(names):
                    dragged += 1
                while self.file() != before:
                    self.step(lambda: self.browser.run("studio.scene.goBack()"))
        print(dragged, "handles; without:", *sorted(set(without)), file=sys.stderr)
        if chosen:
            return
        self.assertGreater(dragged, 200 if is_all else 30)
        # These only combine, or have no lengths: "constant" light, for example, is everywhere.
        for kind in ("sphere", "box", "rounded_box", "cylinder", "capsule", "torus", "ellipsoid", "polygon", "bezier", "polyline", "plane", "slab", "extrude", "revolve", "shell", "offset",
                     "smooth_union", "thin_shell", "layered", "grid", "rectangle", "spot", "point", "floor", "backdrop"):
            self.assertNotIn(kind, without)
        if not is_all:
            self.assertEqual(without, [])

    def test_what_has_a_place_follows_the_pointer(self):
        self.open(SCENE)
        for tree, names in (
            ({"ellipsoid": {"radii": [0.5, 0.4, 0.6]}}, ("radii, x", "radii, y", "radii, z")),
            ({"translate": {"by": [0.1, 0.2, 0], "of": {"rotate": {"axis": [1, 1, 0], "angle": 30, "of": {"scale": {"factor": 1.5, "of": {"box": {"size": [0.5, 0.6, 0.7]}}}}}}}},
             ("size, x", "size, y", "size, z")),
            ({"capsule": {"from": [-0.4, 0, 0], "to": [0.4, 0, 0.2], "radius": 0.15}}, ("from", "to", "radius")),
            ({"extrude": {"height": 0.3, "of": {"polygon": [[-0.5, -0.4], [0.5, -0.4], [0, 0.5]]}}}, ("points 1", "points 2", "points 3", "height")),
            ({"revolve": {"offset": 0.3, "of": {"circle": {"radius": 0.15}}}}, ("offset", "radius")),
            (EXAMPLES["bezier"], ("points 1", "points 4")),
        ):
            self.browser.run(f"studio.scene.perform({{label: 'x', operations: [{{set: '/tree/over/1/set/of', to: {json.dumps(json.dumps(tree))}}}]}})")
            self.select("/tree/over/1")
            for name, start, end in self.drag_each(names, (26, -22)):
                moved = (end[0] - start[0], end[1] - start[1])
                if name in ("from", "to", "points 1", "points 2", "points 3", "points 4"):
                    # Rounded to about a pixel.
                    self.assertLess(math.dist(moved, (26, -22)), 2, (tree, name))
                else:
                    # Along a line: the foot of the perpendicular from the pointer.
                    size = math.hypot(*moved)
                    along = (26 * moved[0] - 22 * moved[1]) / size
                    self.assertAlmostEqual(abs(along), size, delta=2, msg=(tree, name))

    def test_moving_rotating_and_scaling_wrap_or_change_in_one_step(self):
        self.open(SCENE)
        box = {"box": {"size": [0.5, 0.5, 0.5]}}
        inner = {"stretch": {"factors": [1, 1, 1], "of": {"scale": {"factor": 1, "of": box}}}}
        placed = SCENE.replace(TREE, '"of": ' + json.dumps({"translate": {"by": [0.1, 0, 0], "of": {"rotate": {"angle": 20, "of": inner}}}}))
        for text in (SCENE, placed):
            self.browser.run(f"studio.scene.perform({{label: 'x', operations: [{{text: {json.dumps(text)}}}]}})")
            self.select("/tree/over/1")
            self.assertLessEqual(set(MOVING), set(self.browser.run(NAMES)))
            for name, *_ in self.drag_each(MOVING):
                node = self.tree()["over"][1]["set"]["of"]
                kinds = []
                while "box" not in node:
                    (kind, members), = node.items()
                    kinds.append(kind)
                    node = members["of"]
                wanted = {"move": "translate", "rotate": "rotate", "scale": "scale"}[name.split()[0]] if " " not in name or name.startswith("move") else "stretch"
                self.assertEqual(kinds.count(wanted), 1, (name, kinds))
                if text == SCENE:
                    self.assertEqual(kinds, [wanted], name)

    def test_ctrl_snaps_and_shift_is_fine(self):
        self.open(SCENE)
        self.select("/tree/over/1")
        x, y = self.grip("move z")
        self.step(lambda: self.browser.drag((x, y), (x, y - 70), CONTROL))
        self.until("!studio.scene.isBusy")
        by = self.tree()["over"][1]["set"]["of"]["translate"]["by"]
        self.assertEqual(by[:2], [0, 0])
        self.assertAlmostEqual(by[2] / 0.1, round(by[2] / 0.1), places=6)
        self.step(lambda: self.browser.run("studio.scene.goBack()"))
        self.step(lambda: self.browser.drag((x, y), (x, y - 70), SHIFT))
        self.until("!studio.scene.isBusy")
        fine = self.tree()["over"][1]["set"]["of"]["translate"]["by"][2]
        self.assertLess(fine, by[2] / 5)
        self.assertGreater(fine, 0)

    def test_a_click_types_numbers(self):
        self.open(SCENE)
        self.select("/tree/over/1")
        x, y = self.grip("move z")
        self.browser.click(x, y)
        self.until("document.querySelector('.typed:popover-open')")
        self.assertEqual(self.browser.run("document.querySelectorAll('.typed input').length"), 3)
        self.browser.run("document.querySelectorAll('.typed input')[2].focus()")
        self.type("1/4")
        self.step(lambda: self.browser.press("Enter"))
        self.assertEqual(self.tree()["over"][1]["set"]["of"], {"translate": {"by": [0, 0, 0.25], "of": {"box": {"size": [0.5, 0.5, 0.5]}}}})
        self.until("!document.querySelector('.typed')")
        self.step(lambda: self.browser.run("studio.scene.goBack()"))
        self.assertEqual(self.file(), SCENE)

    def test_lights_meshes_and_the_camera_have_handles(self):
        self.open(SCENE.replace('"lights": [', '"lights": [{"rectangle": {"centre": [0.8, 0, 0.9], "target": [0, 0, 0], "width": 0.4, "height": 0.3, "radiance": [1, 1, 1]}}, '))
        for pointer, names in (("/lights/0", ["centre", "target", "width", "height"]), ("/camera", ["look_at"])):
            self.select(pointer)
            self.assertLessEqual(set(names), set(self.browser.run(NAMES)))
            for _ in self.drag_each(names):
                pass


if __name__ == "__main__":
    unittest.main()
