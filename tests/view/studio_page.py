"""The studio in Chromium: scenes are built by pointer and keyboard, and every kind of the catalogue is added, edited and
removed.

PHASETREE_SCREENSHOTS names a folder for pictures of it."""

import json
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from studio_case import GLASSES, StudioCase  # noqa: E402
from studio_user import ALT, CONTROL, EMPTY, GLASS_OF_WATER, build_glass_of_water  # noqa: E402

# Adds a kind of the catalogue to GLASSES, steps the first number that the inspector shows, deletes what was added, and
# undoes everything.
ADDED_EDITED_REMOVED = """async (index) => {
    const {actions, scene, selection} = studio;
    const kind = actions.catalogue.kinds[index], before = scene.text;
    const pause = () => new Promise((done) => setTimeout(done, 5));
    selection.set([kind.type === "field" && kind.chapter !== "shapes" ? "/tree/over/1/set/of" : "/tree/over/1"]);
    document.getElementById("toasts").replaceChildren();
    if (!await actions.addKind(kind)) return {error: document.getElementById("toasts").textContent};
    const told = {edited: true, removed: true}, entry = actions.active, added = scene.text;
    told.shown = entry !== null && entry.key !== "/tree/over/1" && document.querySelector("#inspector-head h2, #inspector-head .name") !== null;
    const field = document.querySelector("#inspector .number input");
    if (field) {
      field.dispatchEvent(new KeyboardEvent("keydown", {key: "ArrowUp"}));
      while (scene.text === added && !document.querySelector(".problem:not([hidden])")) await pause();
      told.edited = scene.text !== added;
      if (told.edited) await scene.goBack();
    }
    if (entry.pointer !== "/camera") {
      await actions.delete();
      told.removed = scene.entry(entry.key) === null || scene.text.length < added.length;
      await scene.goBack();
    }
    told.same = scene.text === added;
    await scene.goBack();
    told.back = told.same && scene.text === before;
    return told;
}"""


class Studio(StudioCase):
    def test_a_glass_of_water_with_ice_is_built_from_nothing(self):
        empty = EMPTY.replace('"width": 480, "height": 360, "samples": 64', '"width": 96, "height": 72, "samples": 1')
        self.open(empty)
        self.assertFalse(self.browser.run("document.getElementById('empty').hidden"))
        build_glass_of_water(self, lambda name: self.shoot(f"studio-{name}"))
        self.assertEqual(self.tree(), GLASS_OF_WATER)
        self.assertEqual(self.scene()["meshes"][0]["floor"]["height"], -0.78)
        self.assertEqual(list(self.scene()["phases"]), ["glass", "water", "ice"])
        # All the way back, by the key.
        while self.browser.run("studio.scene.undo !== null"):
            self.step(lambda: (self.browser.run("document.activeElement.blur()"), self.key("z", CONTROL)))
        self.assertEqual(self.file(), empty)

    def test_a_whole_scene_replaces_an_empty_one_and_undo_brings_it_back(self):
        empty = EMPTY.replace('"width": 480, "height": 360, "samples": 64', '"width": 96, "height": 72, "samples": 1')
        self.open(empty)
        self.click("#empty-scene")
        self.until("document.querySelectorAll('.menu .item').length === 6")
        self.menu("A jar of honey")
        jar = pathlib.Path(__file__).parents[2] / "tracer/src/studio/starts/jar.json"
        self.assertEqual(self.file(), jar.read_text(encoding="utf-8"))
        self.step(lambda: self.click("#undo"))
        self.assertEqual(self.file(), empty)

    def test_phases_that_must_differ_are_exchanged(self):
        self.open(GLASSES.replace('{"set": {"phase": "glass", "of": {"box": {"size": [0.5, 0.5, 0.5]}}}}',
                                  '{"thin_shell": {"of": {"box": {"size": [0.5, 0.5, 0.5]}}, "shell": "wood", "inside": "glass", "half_thickness": 0.05}}'))
        self.expected = "Failed to load resource"
        self.click(self.row("Wood filled with glass"))
        self.click("[data-parameter=shell] .choice")
        self.menu("glass")
        shell = self.tree()["over"][1]["thin_shell"]
        self.assertEqual((shell["shell"], shell["inside"]), ("glass", "wood"))

    def test_every_kind_is_added_edited_and_removed(self):
        self.open(GLASSES)
        self.expected = "Failed to load resource"
        kinds = self.browser.run("studio.actions.catalogue.kinds.map(({type, kind, template}) => [type, kind, template.includes('<file>')])")
        added = 0
        for i, (kind_type, kind, is_file) in enumerate(kinds):
            if kind_type not in ("field", "object", "light", "mesh", "material", "camera", "statement"):
                continue
            with self.subTest(type=kind_type, kind=kind):
                told = self.browser.run(f"({ADDED_EDITED_REMOVED})({i})")
                if is_file:  # which does not exist
                    self.assertIn("error", told)
                    continue
                if kind in ("thin_glass", "thin_diffuse", "two_sided"):  # only meshes have them; the palette leaves them out
                    self.assertIn("a phase cannot be thin", told["error"])
                    continue
                self.assertNotIn("error", told)
                self.assertEqual(told["shown"], True)
                self.assertEqual(told["edited"], True)
                self.assertEqual(told["removed"], True)
                self.assertEqual(told["back"], True)
                added += 1
        self.assertGreater(added, 100)
        self.assertEqual(self.file(), GLASSES)

    def test_numbers_are_dragged_typed_and_stepped_and_each_gesture_is_one_step(self):
        self.open(GLASSES)
        self.click(self.row("ballsphere"))
        x, y = self.place("[data-parameter=radius] .number")
        self.drag((x, y), (x + 40, y))
        dragged = self.scene()["shapes"]["ball"]["sphere"]["radius"]
        self.assertGreater(dragged, 0.5)
        self.set_number("radius", "1/4")
        self.assertEqual(self.scene()["shapes"]["ball"]["sphere"]["radius"], 0.25)
        self.step(lambda: self.browser.press("ArrowUp"))
        self.step(lambda: self.browser.press("ArrowUp"))
        self.assertEqual(self.scene()["shapes"]["ball"]["sphere"]["radius"], 0.27)
        for radius in (0.25, dragged, 0.5):
            self.step(lambda: self.click("#undo"))
            self.assertEqual(self.scene()["shapes"]["ball"]["sphere"]["radius"], radius)
        self.assertEqual(self.file(), GLASSES)

    def test_what_is_impossible_is_said_at_the_control(self):
        self.open(GLASSES)
        self.expected = "Failed to load resource"
        self.click(self.row("ballsphere"))
        self.click("[data-parameter=radius] .number")
        self.type("-2")
        self.browser.press("Enter")
        self.until("!document.querySelector('[data-parameter=radius] .problem').hidden")
        self.assertEqual(self.file(), GLASSES)
        self.shoot("studio-refused")
        self.set_number("radius", "0.4")
        self.until("document.querySelector('[data-parameter=radius] .problem').hidden")

    def test_the_outline_is_a_tree_for_the_keyboard(self):
        self.open(GLASSES)
        self.click(self.row("Wood over glass"))
        active = "document.activeElement.querySelector('.name').textContent"
        for key, name in (("ArrowDown", "Wood ball"), ("ArrowLeft", "Wood ball"), ("ArrowDown", "Glass box"), ("ArrowUp", "Wood ball"),
                          ("ArrowRight", "Wood ball"), ("ArrowRight", "Move"), ("ArrowLeft", "Move"), ("ArrowLeft", "Wood ball"), ("Home", "Wood over glass")):
            self.browser.press(key)
            self.assertEqual(self.browser.run(active), name, key)
        nodes = self.browser.call("Accessibility.getFullAXTree")["nodes"]
        told = {(n["role"]["value"], n["name"]["value"]) for n in nodes if n.get("name", {}).get("value")}
        for role, name in (("tree", "What is in the scene"), ("button", "Undo"), ("button", "Add"), ("tab", "Edit"), ("searchbox", "Search the scene")):
            self.assertIn((role, name), told)
        self.assertTrue(any(role == "treeitem" and name.startswith("Wood ball") for role, name in told))
        # By words.
        self.click("#outline-search")
        self.type("box")
        self.assertIn("Glass box", self.browser.run("document.getElementById('outline').textContent"))
        self.assertNotIn("Wood ball", self.browser.run("document.getElementById('outline').textContent"))

    def test_several_are_grouped_put_in_order_and_deleted(self):
        self.open(GLASSES)
        wood, box, sphere = self.tree()["over"]
        self.click(self.row("Glass box"))
        self.click(self.row("Glass sphere"), modifiers=CONTROL)
        self.step(lambda: self.key("g", CONTROL))
        self.assertEqual(self.tree(), {"over": [wood, {"over": [box, sphere]}]})
        self.step(lambda: self.key("z", CONTROL))
        self.assertEqual(self.file(), GLASSES)
        # Dragged by the mouse before the first, and moved back by the keys.
        (x, y), (_, to) = self.place(self.row("Glass sphere")), self.place(self.row("Wood ball"))
        self.drag((x, y), (x, to - 9))
        self.assertEqual(self.tree(), {"over": [sphere, wood, box]})
        self.step(lambda: self.key("ArrowDown", ALT))
        self.assertEqual(self.tree(), {"over": [wood, sphere, box]})
        self.step(lambda: self.key("d", CONTROL))
        self.assertEqual(len(self.tree()["over"]), 4)
        self.step(lambda: self.key("Delete"))
        self.assertEqual(self.tree(), {"over": [wood, sphere, box]})
        # Forwards, where the list is shorter once the row is out of it.
        (x, y), (_, to) = self.place(self.row("Wood ball")), self.place(self.row("Glass box"))
        self.drag((x, y), (x, to - 9))
        self.assertEqual(self.tree(), {"over": [sphere, wood, box]})
        self.assertIn("// on the right", self.file())
        self.assertIn('"ior": 1.50', self.file())

    def test_a_part_becomes_a_shape_and_its_name_changes_everywhere(self):
        self.open(GLASSES)
        self.click(self.row("Box"))
        self.click("[data-action=more]")
        self.until("document.querySelector('.menu:popover-open')")
        self.click(self.named(".menu .item", "Make reusable"))
        self.until("document.querySelector('dialog input')")
        self.type("crate")
        self.step(lambda: self.browser.press("Enter", "Enter", "\r"))
        self.assertEqual(self.scene()["shapes"]["crate"], {"box": {"size": [0.5, 0.5, 0.5]}})
        self.assertEqual(self.tree()["over"][1], {"set": {"phase": "glass", "of": "crate"}})
        self.click(self.row("wood"))
        self.click("#inspector-head .name")
        self.type("oak")
        self.step(lambda: self.browser.press("Tab"))
        self.assertEqual(self.tree()["over"][0]["set"]["phase"], "oak")

    def test_handles_move_what_is_selected(self):
        self.open(GLASSES)
        self.click(self.row("Glass sphere"))
        x, y = self.place("#handles .x circle")
        self.drag((x, y), (x + 60, y))
        by = self.tree()["over"][2]["set"]["of"]["translate"]["by"]
        self.assertGreater(by[0], -0.8)
        self.assertEqual(by[1:], [0, 0])
        self.step(lambda: self.click("#undo"))
        self.assertEqual(self.file(), GLASSES)
        # What has not been moved before is wrapped, in the same step.
        self.click(self.row("Glass box"))
        x, y = self.place("#handles .z circle")
        self.drag((x, y), (x, y - 40))
        by = self.tree()["over"][1]["set"]["of"]["translate"]["by"]
        self.assertGreater(by[2], 0)
        self.step(lambda: self.click("#undo"))
        self.assertEqual(self.file(), GLASSES)

    def test_a_ring_rotates(self):
        rotated = GLASSES.replace('{"box": {"size": [0.5, 0.5, 0.5]}}', '{"rotate": {"axis": [0, 1, 0], "angle": 30, "of": {"box": {"size": [0.5, 0.5, 0.5]}}}}')
        self.open(rotated)
        self.click(self.row("Glass box"))
        x, y = self.place("#handles .ring circle")
        box = self.browser.run("document.getElementById('picture').getBoundingClientRect().toJSON()")
        # A quarter of a turn, as the picture shows it: the camera looks along the axis, so the angle decreases anticlockwise.
        right, down = x - (box["x"] + box["width"] / 2), y - (box["y"] + box["height"] / 2)
        self.drag((x, y), (x - right + down, y - down - right))
        self.assertAlmostEqual(self.tree()["over"][1]["set"]["of"]["rotate"]["angle"], -60, delta=2)
        self.step(lambda: self.click("#undo"))
        self.assertEqual(self.file(), rotated)

    def test_the_picture_selects(self):
        self.open(GLASSES)
        self.until("document.getElementById('status').textContent.startsWith('Ready')")
        box = self.browser.run("document.getElementById('picture').getBoundingClientRect().toJSON()")
        # The picture is 2.68 high where the balls are.
        self.browser.click(box["x"] + box["width"] * (0.5 + 0.8 / 2.68 * 0.75 * -1), box["y"] + box["height"] / 2)
        self.until("document.querySelector('#outline .row.active .name')?.textContent === 'Glass sphere'")

    def test_the_text_is_edited_and_its_mistakes_are_marked(self):
        self.open(GLASSES)
        self.expected = "Failed to load resource"
        self.key("e", CONTROL)
        self.until("!document.getElementById('drawer').hidden")
        text = "document.getElementById('text')"
        self.browser.run(f"(() => {{ {text}.value = {json.dumps(GLASSES.replace('0.5}', '0.5}}', 1))}; {text}.dispatchEvent(new Event('input')); }})()")
        self.until("document.querySelector('#text-lines .wrong')")
        self.assertFalse(self.browser.run("document.getElementById('text-problem').hidden"))
        self.shoot("studio-text")
        smaller = GLASSES.replace('"radius": 0.5', '"radius": 0.25')
        self.browser.run(f"(() => {{ {text}.value = {json.dumps(smaller)}; {text}.dispatchEvent(new Event('input')); }})()")
        self.until("!document.querySelector('#text-lines .wrong') && studio.scene.text.includes('0.25')")
        self.assertEqual(self.file(), smaller)

    def test_names_in_the_text_are_completed(self):
        self.open(GLASSES)
        self.key("e", CONTROL)
        self.until("!document.getElementById('drawer').hidden")
        at = GLASSES.index('"sphere": {"radius": 0.5') + len('"sphere": {')
        self.browser.run(f"document.getElementById('text').setSelectionRange({at}, {at} + '\"radius\"'.length)")
        self.type('"ra')
        self.until("document.querySelector('#text-names .chip')?.textContent.startsWith('radius')")
        self.shoot("studio-names")
        self.browser.press("Tab")
        self.assertEqual(self.browser.run("document.getElementById('text').value"), GLASSES)
        # The name of a kind, in an empty object.
        self.assertIn("rounded_box", self.browser.run("""(async () => {
            const {completions} = await import("./completion.js"), text = '{"tree": {"set": {"phase": "glass", "of": {"round';
            return completions(text, text.length, studio.actions.catalogue).names;
        })()"""))

    def test_changes_from_elsewhere_are_shown_and_said(self):
        self.open(GLASSES)
        version = self.browser.run("studio.scene.version")
        # Another page.
        answer = self.view.post("document", {"base": version, "label": "Shrink the ball", "operations": [{"set": "/shapes/ball/sphere/radius", "to": "0.25"}]})
        self.assertEqual(answer.status, 200)
        self.until("document.getElementById('toasts').textContent.includes('Shrink the ball')")
        self.until("studio.scene.text.includes('0.25')")
        # An editor.
        self.view.file.write_text(GLASSES.replace('"radius": 0.5', '"radius": 0.35'), encoding="utf-8")
        self.until("studio.scene.text.includes('0.35')")
        self.step(lambda: self.key("z", CONTROL))
        self.assertEqual(self.scene()["shapes"]["ball"]["sphere"]["radius"], 0.25)

    def test_an_answer_that_comes_late_does_not_replace_a_later_one(self):
        self.open(GLASSES)
        told = self.browser.run("""(async () => {
            const {SceneDocument} = await import("./document.js"), scene = new SceneDocument(), fetched = window.fetch;
            const answers = [[2, "second"], [1, "first"], [3, "third"]];
            const seen = [];
            scene.addEventListener("change", () => seen.push(scene.text));
            window.fetch = (address, ...rest) => {
              if (!address.startsWith("document?") || answers.length === 0) return fetched(address, ...rest);
              const [version, text] = answers.shift();
              return Promise.resolve(new Response(JSON.stringify({version, text, outline: null, error: null, undo: null, redo: null, saved: true, file: ""})));
            };
            scene.follow(() => {});
            for (let i = 0; i < 100 && seen.length < 2; ++i) await new Promise((done) => setTimeout(done, 20));
            window.fetch = fetched;
            return seen;
        })()""")
        self.assertEqual(told[:2], ["second", "third"])

    def test_contrast_is_enough(self):
        self.open(GLASSES)
        ratio = """(() => {
            const style = getComputedStyle(document.documentElement);
            const light = (name) => {
              const probe = document.createElement("canvas").getContext("2d");
              probe.fillStyle = style.getPropertyValue(name).trim();
              const shares = [1, 3, 5].map((i) => parseInt(probe.fillStyle.slice(i, i + 2), 16) / 255);
              const [r, g, b] = shares.map((x) => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4));
              return 0.2126 * r + 0.7152 * g + 0.0722 * b;
            };
            const pairs = [];
            for (const ink of ["--ink", "--faint"]) for (const ground of ["--panel", "--raised", "--field", "--hover", "--chosen"]) pairs.push([ink, ground]);
            pairs.push(["--accent", "--panel"], ["--on-accent", "--accent"], ["--wrong", "--wrong-ground"], ["--wrong", "--raised"], ["--ground", "--ink"],
              ["--x", "--field"], ["--y", "--field"], ["--z", "--field"]);
            return pairs.map(([a, b]) => {
              const [low, high] = [light(a), light(b)].sort((p, q) => p - q);
              return [a, b, (high + 0.05) / (low + 0.05)];
            });
        })()"""
        self.addCleanup(self.browser.call, "Emulation.setEmulatedMedia", features=[])
        for scheme in ("light", "dark"):
            self.browser.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
            for ink, ground, contrast in self.browser.run(ratio):
                self.assertGreaterEqual(contrast, 4.5, (scheme, ink, ground))

    def test_it_fits_desks_and_telephones(self):
        self.open(GLASSES)
        self.addCleanup(self.browser.resize, 1280, 720)
        self.addCleanup(self.browser.call, "Emulation.setEmulatedMedia", features=[])
        for scheme in ("light", "dark"):
            self.browser.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-color-scheme", "value": scheme}])
            for name, width, height in (("laptop", 1280, 720), ("desk", 1920, 1080), ("telephone", 390, 844)):
                self.browser.resize(width, height)
                for tab in ("outline", "edit", "view", "point"):
                    self.browser.run(f"document.querySelector('[data-tab={tab}]').click()")
                    self.assertLessEqual(self.browser.run("document.documentElement.scrollWidth"), width)
                    self.assertLessEqual(self.browser.run("document.documentElement.scrollHeight"), height)
                self.browser.run("document.querySelector('[data-tab=edit]').click()")
                self.shoot(f"studio-{name}-{scheme}")


if __name__ == "__main__":
    unittest.main()
