"""The studio's editors in Chromium: curves, ramps of colours, lists and keys, and operations on several parts."""

import json
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))

from studio_case import GLASSES, StudioCase  # noqa: E402
from studio_user import CONTROL  # noqa: E402

RAMPS = GLASSES.replace('"wood": {"diffuse": {"color": [0.6, 0.3, 0.1]}, "density": 700}', """"wood": {"diffuse": {"color": {"field": {
      "of": {"plane": {}}, "ramp": [[-0.5, [0.1, 0.1, 0.8]], [0, [0.5, 0.5, 0.5]],  // grey
        [0.5, [0.8, 0.1, 0.1]]]}}}},
    "paint": {"diffuse": {"color": {"measured": {"reflectance": [[400, 0.2], [500, 0.4], [700, 0.8]]}}}}""").replace(
    '"lights": [{"constant": {"radiance": [1, 1, 1]}}]', '"lights": [{"constant": {"radiance": [1, 1, 1]}}, {"sun": {"direction": [0, 0, 1], "spectrum": {"blackbody": 3000}}}]')
POLYGON = GLASSES.replace('{"box": {"size": [0.5, 0.5, 0.5]}}', '{"extrude": {"height": 0.5, "of": {"polygon": [[-0.5, -0.4], [0.5, -0.4],\n      [0, 0.5]]}}}')
MOVING = GLASSES.replace('"by": [0.6, 0, 0]', '"by": {"keys": [[0, [0.6, 0, 0]], [1, [0.6, 0, 1]], [2, [0.6, 0, 0]]]}')


class Editors(StudioCase):
    def select(self, pointer):
        self.browser.run(f"studio.selection.set([{json.dumps(pointer)}])")

    # ---- curves, ramps and lists

    def test_a_spectrum_is_a_curve(self):
        self.open(RAMPS)
        pointer = self.browser.run("studio.scene.entries.find((e) => e.kind === 'measured').key")
        self.select(pointer)
        points = lambda: self.scene()["phases"]["paint"]["diffuse"]["color"]["measured"]["reflectance"]
        # Dragged upwards: only this point changes, by one step.
        x, y = self.place("[data-parameter=reflectance] [data-point='1']")
        self.drag((x, y), (x, y - 20))
        self.assertGreater(points()[1][1], 0.4)
        self.assertEqual([points()[0], points()[2], points()[1][0]], [[400, 0.2], [700, 0.8], 500])
        self.step(lambda: self.click("#undo"))
        self.assertEqual(self.file(), RAMPS)
        # A click adds a point, which Delete removes.
        (x, y), (to, _) = self.place("[data-parameter=reflectance] [data-point='1']"), self.place("[data-parameter=reflectance] [data-point='2']")
        self.step(lambda: self.browser.click((x + to) / 2, y - 10))
        self.assertEqual(len(points()), 4)
        self.assertAlmostEqual(points()[2][0], 600, delta=5)
        self.shoot("studio-curve")
        self.step(lambda: self.browser.press("Delete"))
        self.assertEqual(points(), [[400, 0.2], [500, 0.4], [700, 0.8]])
        # Points are moved by keys, and their numbers typed.
        self.click("[data-parameter=reflectance] [data-point='1']")
        self.browser.press("ArrowUp")
        self.until("studio.scene.text.includes('[500, 0.40')")
        self.click("[data-parameter=reflectance] .point-fields .number:nth-child(2)")
        self.type("3/4")
        self.step(lambda: self.browser.press("Enter"))
        self.assertEqual(points()[1], [500, 0.75])
        # A reflectance is at most 1, which the server says.
        self.expected = "Failed to load resource"
        self.type("5")
        self.browser.press("Enter")
        self.until("!document.querySelector('[data-parameter=reflectance] .problem').hidden")
        self.assertEqual(points()[1], [500, 0.75])

    def test_a_black_body_becomes_a_curve_and_back(self):
        self.open(RAMPS)
        self.select("/lights/1")
        row = "[data-parameter=spectrum]"
        self.click(f"{row} .spectrum > .number")
        self.type("4200")
        self.step(lambda: self.browser.press("Enter"))
        self.assertEqual(self.scene()["lights"][1]["sun"]["spectrum"], {"blackbody": 4200})
        self.step(lambda: self.click(self.named(f"{row} button", "Use a curve")))
        self.assertEqual(len(self.scene()["lights"][1]["sun"]["spectrum"]), 3)
        self.until(f"document.querySelector('{row} .plot').getBoundingClientRect().width > 100")
        self.step(lambda: self.click(self.named(f"{row} button", "Use a black body")))
        self.assertEqual(self.scene()["lights"][1]["sun"]["spectrum"], {"blackbody": 3000})

    def test_a_ramp_of_colours_is_a_bar_with_stops(self):
        self.open(RAMPS)
        self.select(self.browser.run("studio.scene.entries.find((e) => e.kind === 'field' && e.type === 'texture').key"))
        stops = lambda: self.scene()["phases"]["wood"]["diffuse"]["color"]["field"]["ramp"]
        x, y = self.place("[data-parameter=ramp] [data-point='1']")
        self.drag((x, y), (x + 30, y))
        self.assertGreater(stops()[1][0], 0.05)
        self.assertEqual(stops()[1][1], [0.5, 0.5, 0.5])
        self.assertIn("// grey", self.file())
        self.step(lambda: self.click("#undo"))
        # A stop added between two has the colour that is there.
        (x, y), (to, _) = self.place("[data-parameter=ramp] [data-point='0']"), self.place("[data-parameter=ramp] [data-point='1']")
        bar = self.place("[data-parameter=ramp] .ramp-bar")[1]
        self.step(lambda: self.browser.click((x + to) / 2, bar))
        self.assertEqual(len(stops()), 4)
        for found, wanted in zip(stops()[1][1], (0.3, 0.3, 0.65)):
            self.assertAlmostEqual(found, wanted, delta=0.02)
        self.shoot("studio-ramp")
        self.click("[data-parameter=ramp] .hex")
        self.browser.run("document.activeElement.select()")
        self.type("#ff0000")
        self.step(lambda: self.browser.press("Enter", "Enter", "\r"))
        self.assertEqual(stops()[1][1], [1, 0, 0])
        self.click("[data-parameter=ramp] [data-point='1']")
        self.step(lambda: self.browser.press("Delete"))
        self.assertEqual(len(stops()), 3)

    def test_points_are_a_list(self):
        self.open(POLYGON)
        self.select("/tree/over/1/set/of/extrude/of")
        points = lambda: self.tree()["over"][1]["set"]["of"]["extrude"]["of"]["polygon"]
        rows = "[data-parameter=points] .list-row"
        self.click(f"{rows}:nth-child(3) .number:nth-child(2)")
        self.browser.run("document.activeElement.select()")
        self.type("0.6")
        self.step(lambda: self.browser.press("Enter"))
        self.assertEqual(points(), [[-0.5, -0.4], [0.5, -0.4], [0, 0.6]])
        self.assertIn("-0.4],\n", self.file())
        self.step(lambda: self.click("[data-parameter=points] .slot-add"))
        self.assertEqual(points(), [[-0.5, -0.4], [0.5, -0.4], [0, 0.6], [-0.5, 1.6]])
        self.step(lambda: self.click(f"{rows}:nth-child(2) .icon-button"))
        self.assertEqual(points(), [[-0.5, -0.4], [0, 0.6], [-0.5, 1.6]])

    # ---- keys and the timeline

    def test_a_number_gets_keys_that_are_moved_and_deleted(self):
        self.open(GLASSES)
        self.select("/camera")
        self.step(lambda: self.click("[data-parameter=fov] .key"))
        self.assertEqual(self.scene()["camera"]["fov"], {"keys": [[0, 30], [1, 30]]})
        self.until("!document.getElementById('timeline').hidden && document.querySelectorAll('.time-key').length === 2")
        # At another time, another value.
        self.click(".time-key:nth-child(2)")
        self.until("document.querySelector('.time-key:nth-child(2)').classList.contains('now')")
        self.set_number("fov", "40")
        self.assertEqual(self.scene()["camera"]["fov"], {"keys": [[0, 30], [1, 40]]})
        self.shoot("studio-timeline")
        x, y = self.place(".time-key:nth-child(2)")
        self.drag((x, y), (x - 80, y))
        keys = self.scene()["camera"]["fov"]["keys"]
        self.assertLess(keys[1][0], 0.95)
        self.assertEqual([keys[0], keys[1][1]], [[0, 30], 40])
        # A key between two is made by its button, and removed by it.
        self.browser.run("studio.view.seek(0.25)")
        self.until("document.querySelector('#timeline output').value.startsWith('0.25')")
        self.step(lambda: self.click("[data-parameter=fov] .key"))
        self.assertEqual(len(self.scene()["camera"]["fov"]["keys"]), 3)
        self.until("document.querySelector('[data-parameter=fov] .key').classList.contains('now')")
        self.step(lambda: self.click("[data-parameter=fov] .key"))
        self.assertEqual(len(self.scene()["camera"]["fov"]["keys"]), 2)
        # By the keyboard: typed, and deleted, which leaves a constant.
        self.browser.run("document.querySelector('.time-key:nth-child(2)').focus()")
        self.browser.press("Enter")
        self.until("document.querySelector('.typed:popover-open')")
        self.type("3/2")
        self.step(lambda: self.browser.press("Enter"))
        self.assertEqual(self.scene()["camera"]["fov"]["keys"][1], [1.5, 40])
        self.until("document.querySelectorAll('.time-key').length === 2 && !document.querySelector('.typed')")
        self.browser.run("document.querySelector('.time-key:nth-child(2)').focus()")
        self.step(lambda: self.browser.press("Delete"))
        self.assertEqual(self.scene()["camera"]["fov"], 30)
        self.until("document.getElementById('timeline').hidden")
        while self.browser.run("studio.scene.undo !== null"):
            self.step(lambda: self.browser.run("studio.scene.goBack()"))
        self.assertEqual(self.file(), GLASSES)

    def test_a_handle_sets_the_key_of_its_time(self):
        self.open(MOVING)
        self.until("!document.getElementById('timeline').hidden")
        self.browser.run("studio.view.seek(1)")
        self.select("/tree/over/0")
        self.until("document.querySelector('#timeline output').value.startsWith('1.00') && document.querySelector('[data-handle=\"move z\"]')")
        x, y = self.place("[data-handle='move z'] circle")
        self.drag((x, y), (x, y - 30))
        keys = self.tree()["over"][0]["set"]["of"]["translate"]["by"]["keys"]
        self.assertEqual([keys[0], keys[2]], [[0, [0.6, 0, 0]], [2, [0.6, 0, 0]]])
        self.assertGreater(keys[1][1][2], 1.1)

    # ---- several parts, and reusable shapes

    def select_both(self):
        self.click(self.row("Glass box"))
        self.click(self.row("Glass sphere"), modifiers=CONTROL)

    def many(self, text):
        return self.named("#inspector .wide-button", text)

    def test_several_parts_are_wrapped_together(self):
        self.open(GLASSES)
        wood, box, sphere = self.tree()["over"]
        self.select_both()
        self.shoot("studio-several")
        self.click(self.many("Wrap"))
        self.menu("Coat with a layer")
        self.assertEqual(self.tree(), {"over": [wood, {"layered": {"phase": "wood", "thickness": 0.05, "of": {"over": [box, sphere]}}}]})
        self.step(lambda: self.click("#undo"))
        self.assertEqual(self.file(), GLASSES)
        self.select_both()
        self.click(self.many("Wrap"))
        self.menu("Repeat in a ring")
        self.assertEqual(self.tree()["over"][1], {"polar_array": {"count": 6, "of": {"over": [box, sphere]}}})

    def test_several_parts_become_one_shape_which_is_used_again_and_copied(self):
        self.open(GLASSES)
        wood, box, sphere = self.tree()["over"]
        self.select_both()
        self.click(self.many("Make reusable"))
        self.until("document.querySelector('dialog input')")
        self.type("pair")
        self.step(lambda: self.browser.press("Enter", "Enter", "\r"))
        self.assertEqual(self.scene()["shapes"]["pair"], {"over": [box, sphere]})
        self.assertEqual(self.tree(), {"over": [wood, "pair"]})
        # Once more, from the palette; then as the replacement of a part.
        self.click(self.row("Wood ball"))
        self.click("#add")
        self.choose("pair")
        self.assertEqual(self.tree(), {"over": [wood, "pair", "pair"]})
        self.click(self.row("Wood ball"))
        self.click("[data-action=replace]")
        self.choose("pair")
        self.assertEqual(self.tree(), {"over": ["pair", "pair", "pair"]})
        # A copy of its own does not refer to the shape.
        self.click("[data-action=more]")
        self.menu("Make a copy of its own")
        self.assertEqual(self.tree(), {"over": [{"over": [box, sphere]}, "pair", "pair"]})

    def test_the_last_one_is_put_under_the_others(self):
        self.open(GLASSES)
        wood, box, sphere = self.tree()["over"]
        self.click(self.row("Glass sphere"))
        self.click(self.row("Wood ball"), modifiers=CONTROL)
        self.step(lambda: self.click(self.many("Put the last under")))
        self.assertEqual(self.tree(), {"over": [box, sphere, wood]})
        self.click(self.row("Glass box"))
        self.click(self.row("Wood ball"), modifiers=CONTROL)
        self.step(lambda: self.click(self.many("Put the last over")))
        self.assertEqual(self.tree(), {"over": [wood, box, sphere]})

    def test_a_step_that_ends_late_does_not_take_the_selection_away(self):
        self.open(GLASSES)
        active = """(async (click) => {
            studio.selection.set(["/tree/over/0"]);
            const step = studio.actions.run({label: "x", operations: [{insert: "/phases/new", value: '{"clear": {"ior": 1.4}}'}], select: ["/phases/new"]});
            if (click) studio.selection.set([click]);
            await step;
            const now = studio.selection.active;
            await studio.scene.goBack();
            return now;
        })"""
        self.assertEqual(self.browser.run(f"{active}(null)"), "/phases/new")
        self.assertEqual(self.browser.run(f"{active}('/tree/over/1')"), "/tree/over/1")

    def test_operators_between_phases_are_explained_where_they_are_chosen(self):
        self.open(GLASSES)
        operators = self.tree()["over"]
        self.click(self.row("Wood over glass"))
        panels = "[...document.querySelectorAll('#inspector-head .operator')]"
        self.assertEqual(self.browser.run(f"{panels}.map((e) => [e.dataset.operator, e.tagName, e.ariaPressed])"),
                         [["over", "BUTTON", "true"], ["under", "BUTTON", "false"], ["contact", "DIV", None], ["layered", "DIV", None]])
        self.shoot("studio-combining")
        self.step(lambda: self.click("#inspector-head [data-operator=under]"))
        self.assertEqual(self.tree(), {"under": operators})
        self.assertIn("// on the right", self.file())
        self.assertEqual(self.browser.run("document.activeElement.dataset.operator"), "under")
        self.step(lambda: self.click("#undo"))
        self.assertEqual(self.file(), GLASSES)
        # Nothing else combines phases.
        self.click(self.row("Glass box"))
        self.until("!document.querySelector('.combining')")
        # In the palette, a panel chooses its kind.
        self.click("#add")
        self.until("document.querySelectorAll('dialog .operator').length === 4")
        self.browser.run("document.querySelector('dialog .combining').scrollIntoView()")
        self.shoot("studio-combining-palette")
        self.step(lambda: self.click("dialog [data-operator=contact]"))
        self.assertIn("contact", self.tree()["over"][2])

    def test_a_vessel_is_filled_up_to_where_the_picture_was_clicked(self):
        bowl = '{"bowl": {"radius": 0.6, "cut": 0.3, "thickness": 0.1}}'
        self.open(GLASSES.replace('{"box": {"size": [0.5, 0.5, 0.5]}}', bowl))
        self.until("document.getElementById('status').textContent.startsWith('Ready')")
        self.browser.run("studio.actions.pointed = null")
        box = self.browser.run("document.getElementById('picture').getBoundingClientRect().toJSON()")
        self.browser.click(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
        self.until("studio.actions.pointed")
        self.click(self.row("Glass bowl"))
        self.wrap("Fill up to here")
        vessel, content = self.tree()["over"][1:3]
        self.assertEqual(vessel["set"]["of"], json.loads(bowl))
        self.assertEqual(content["intersect_shape"]["of"], {"set": {"phase": "wood", "of": {"sphere": {"radius": 0.6}}}})
        self.assertAlmostEqual(content["intersect_shape"]["shape"]["plane"]["offset"], 0, delta=0.02)
        # A difference, moved, has the hollow that was cut out of it.
        self.assertEqual(self.browser.run("""(async () => {
            const {hollowOf} = await import("./several.js");
            return hollowOf({translate: {by: [1, 0, 0], of: {set: {phase: "glass", of: {difference: {from: "a", subtract: ["b", "c"]}}}}}}, {});
        })()"""), {"translate": {"by": [1, 0, 0], "of": {"union": ["b", "c"]}}})


if __name__ == "__main__":
    unittest.main()
