"""Objects that carry a tree: a scene file or Python code, their numbers, and the mesh that the viewport shows."""

import json
import math
import os
import pathlib
import unittest

import bpy
import numpy as np
from phasetree_blender.translate import scene_text, trees
from support import COMMAND, BlenderTest, add_box, principled

BALL = """// A ball of glass, half full.
{
  "version": 1,
  "phases": {"glass": {"clear": {"ior": 1.5}}, /* red */ "wine": {"coated": {"color": [0.5, 0.02, 0.05]}}},
  "shapes": {"ball": {"sphere": {"radius": 1}}, "level": {"plane": {"offset": 0.25}}},
  "tree": {"intersect_shape": {
    "of": {"thin_shell": {"of": "ball", "shell": "glass", "inside": "wine", "half_thickness": 0.05}},
    "shape": "level", "phases": "wine"
  }}
}
"""
CODE = """import phasetree as pt

def tree(radius=1.0, level=0.25, name="not a number"):
    ball = pt.sphere(radius)
    wine = pt.Phase("wine", pt.coated(color=(0.5, 0.02, 0.05)))
    return wine(ball & pt.plane(offset=level))
"""
PACKAGE = pathlib.Path(COMMAND).resolve().parents[1] / "plugins/python/phasetree"  # in a build folder
needs_package = unittest.skipUnless(PACKAGE.is_dir(), "the Python package was not built")
IN_WINE, ABOVE, IN_SHELL = (0, 0, 0), (0, 0, 0.5), (1, 0, 0)


class Trees(BlenderTest):
    def setUp(self):
        super().setUp()
        bpy.data.objects.remove(bpy.data.objects["Cube"])
        trees._approved.clear()

    def add_file(self, text=BALL, name="ball"):
        path = self.folder / f"{name}.json"
        path.write_text(text)
        bpy.ops.phasetree.add_tree(filepath=str(path))
        bpy.context.object.phasetree.detail = 16
        return bpy.context.object

    def add_code(self, code=CODE):
        item = bpy.data.objects.new("Bowl", bpy.data.meshes.new("Bowl"))
        bpy.context.collection.objects.link(item)
        bpy.context.view_layer.objects.active = item
        text = bpy.data.texts.new("bowl.py")
        text.write(code)
        item.phasetree.source, item.phasetree.text, item.phasetree.detail = "TEXT", text, 16
        return item

    def labels_of(self, *points):
        return self.labels(self.export()[0], points)

    def message(self):
        with self.assertRaises(RuntimeError) as raised:
            bpy.ops.render.render()
        return str(raised.exception)

    def test_tree_of_a_file_is_rendered_as_the_command_renders_it(self):
        item = self.add_file()
        item.location, item.rotation_euler, item.scale = (0.2, 0.1, -0.3), (0.3, 0, 0.5), (1.2, 1.2, 0.8)
        picture = self.combined()
        self.assertEqual(self.notes(), "")
        path, scene = self.export()
        self.assertNotIn("tree", scene)
        self.assertNotIn("meshes", scene)
        # The same by hand: the scene with its tree in place.
        x, y, z, by = np.array(item.matrix_world)[:3].T.tolist()
        tree = scene_text.parsed(BALL, "ball")
        by_hand = {**scene, **{k: tree[k] for k in ("phases", "shapes")},
                   "tree": {"affine": {"x": x, "y": y, "z": z, "by": by, "of": tree["tree"]}}}  # fmt: skip
        del by_hand["objects"]
        (self.folder / "by_hand.json").write_text(json.dumps(by_hand))
        rendered = self.rendered("by_hand.json")
        self.assertGreater(picture.std(), 0.01)
        self.assertLess(np.abs(picture - rendered).mean(), 0.01 * picture.mean())
        self.assertTrue(np.array_equal(picture, self.rendered(path)))

    def rendered(self, scene):
        from phasetree_blender import exr

        self.run_command("render", str(scene), "-o", "again.exr", "--quiet")
        pixels = exr.read(str(self.folder / "again.exr"))
        return np.stack([pixels[c] for c in "RGB"], axis=-1)

    def test_numbers_of_a_file_are_driven_and_keyframed(self):
        item = self.add_file()
        self.assertEqual(self.labels_of(IN_WINE, ABOVE, IN_SHELL), ["ball.wine", "vacuum", "ball.glass"])
        bpy.ops.phasetree.add_number(pointer="/shapes/level/plane/offset")
        bpy.ops.phasetree.add_number(pointer="/shapes/ball/sphere/radius", name="radius")
        self.assertEqual((item["offset"], item["radius"]), (0.25, 1.0))
        item["offset"] = 0.6
        self.assertEqual(self.labels_of(ABOVE), ["ball.wine"])
        for frame, offset in ((1, 0.0), (11, 1.0)):
            item["offset"] = offset
            item.keyframe_insert('["offset"]', frame=frame)
        for curve in item.animation_data.action.fcurves:
            for key in curve.keyframe_points:
                key.interpolation = "LINEAR"
        self.scene.frame_set(4)  # 0.3
        self.assertEqual(self.labels_of((0, 0, 0.29), (0, 0, 0.31)), ["ball.wine", "vacuum"])
        driver = item.driver_add('["radius"]').driver
        driver.type = "SUM"
        variable = driver.variables.new()
        variable.type = "TRANSFORMS"
        variable.targets[0].id, variable.targets[0].transform_type = self.scene.camera, "LOC_X"
        self.scene.camera.location.x = 2
        bpy.context.view_layer.update()
        self.assertEqual(self.labels_of((2, 0, 0), IN_SHELL), ["ball.glass", "ball.wine"])
        bpy.ops.phasetree.remove_number(name="offset")
        self.assertNotIn("offset", item)
        self.assertEqual(self.labels_of((0, 0, 0.24), (0, 0, 0.26)), ["ball.wine", "vacuum"])

    def test_lost_numbers_are_reported(self):
        item = self.add_file()
        bpy.ops.phasetree.add_number(pointer="/shapes/level/plane/offset")
        del item["offset"]
        self.assertIn('object "ball": its property "offset" was removed; the number in the scene file is used', self.check()[0])
        item["offset"] = 0.5
        item.phasetree.numbers[0].pointer = "/shapes/levle/plane/offset"
        self.assertIn('object "ball": ball.json has no number at /shapes/levle/plane/offset', self.check()[0])
        with self.assertRaisesRegex(TypeError, "not found"):
            bpy.ops.phasetree.add_number(pointer="/tree/nothing")

    def test_viewport_shows_the_mesh_of_the_tree(self):
        item = self.add_file()
        bpy.ops.phasetree.add_number(pointer="/shapes/ball/sphere/radius")
        item["radius"], item.phasetree.detail = 2.0, 48
        bpy.ops.phasetree.update_tree()
        self.assertGreater(len(item.data.polygons), 100)
        corners = np.array(item.bound_box)
        self.assertTrue(np.allclose(corners.max(axis=0), 2.05, atol=0.03), corners)
        self.assertEqual({m.name for m in item.data.materials}, {"ball: glass", "ball: wine"})
        wine = item.data.materials["ball: wine"].diffuse_color
        self.assertTrue(np.allclose(wine[:3], (0.5, 0.02, 0.05), atol=0.01), tuple(wine))
        self.assertFalse(item.data.validate())

    @needs_package
    def test_tree_of_code(self):
        item = self.add_code()
        bpy.ops.phasetree.update_tree()
        self.assertEqual([n.name for n in item.phasetree.numbers], ["radius", "level"])
        self.assertEqual((item["radius"], item["level"]), (1.0, 0.25))
        self.assertEqual(self.labels_of(IN_WINE, ABOVE), ["Bowl.wine", "vacuum"])
        item["level"] = 0.7
        item.location.z = 1
        bpy.context.view_layer.update()
        self.assertEqual(self.labels_of((0, 0, 1.65), (0, 0, 1.75)), ["Bowl.wine", "vacuum"])
        bpy.ops.phasetree.update_tree()
        self.assertAlmostEqual(max(c[2] for c in item.bound_box), 0.7, delta=0.02)
        # A parameter that is gone is no longer a number; the others keep their values.
        item.phasetree.text.from_string(CODE.replace("radius=1.0, ", "").replace("(radius)", "(1.5)"))
        bpy.ops.phasetree.update_tree()
        self.assertEqual([n.name for n in item.phasetree.numbers], ["level"])
        self.assertEqual(item["level"], 0.7)

    @needs_package
    def test_code_of_files_runs_only_if_allowed(self):
        ran = self.folder / "ran"
        item = self.add_code(f"open({str(ran)!r}, 'w')\n" + CODE)
        self.assertIn('the code of "Bowl" was not run, because the preferences do not allow scripts of files', self.message())
        self.assertFalse(ran.exists())
        paths = bpy.context.preferences.filepaths
        paths.use_scripts_auto_execute = True
        try:
            self.render()
        finally:
            paths.use_scripts_auto_execute = False
        self.assertTrue(ran.exists())
        bpy.ops.phasetree.update_tree()
        self.render()
        item.phasetree.text.write("\n# changed")
        self.assertIn("was not run", self.message())

    @needs_package
    def test_mistakes_give_messages(self):
        item = self.add_code("import phasetree as pt\n\ndef tree(radius=-1.0):\n    return pt.sphere(radius)\n")
        for code, wanted in (
            ("def tree(:\n", "bowl.py:1: "),
            ("x = 1\n", "bowl.py: defines no function `tree`"),
            ("def tree():\n    return 1\n", "bowl.py: `tree` returned 1 instead of an object of phases"),
            ("\ndef tree():\n    return 1 / 0\n", "bowl.py:3: division by zero"),
            ("import phasetree as pt\ndef tree():\n    return pt.sphere(-1)\n", "bowl.py:3: "),
        ):
            item.phasetree.text.from_string(code)
            trees.approve(code)
            self.assertIn(wanted, self.message())
        item.phasetree.text = None
        self.assertIn('"Bowl" has no text block', self.message())
        item.phasetree.source = "FILE"
        self.assertIn('"Bowl" has no scene file', self.message())
        item.phasetree.file = str(self.folder / "missing.json")
        self.assertIn("missing.json: No such file or directory", self.message())
        (self.folder / "missing.json").write_text('{"version": 1,\n "tree": }')
        self.assertIn("missing.json:2:10: ", self.message())
        (self.folder / "missing.json").write_text(BALL.replace('"ball": {"sphere"', '"ball": {"shpere"'))
        self.assertRegex(self.message(), r'/missing.json:5:23: unknown node "shpere" \(did you mean "sphere"\?\)')

    def test_tree_beside_phases_and_meshes(self):
        self.add_file()
        add_box("Ice", (1.5, -0.5, -0.5), (2.5, 0.5, 0.5), principled("Ice", 1, IOR=1.31, Roughness=0.0, Base_Color=(1.0, 1.0, 1.0)))
        add_box("Table", (-3, -3, -1.3), (3, 3, -1.1), principled("Oak"))
        path, scene = self.export()
        self.assertEqual(self.labels(path, [IN_WINE, (2, 0, 0)]), ["ball.wine", "Ice"])
        self.assertEqual(len(scene["meshes"]), 1)
        self.assertGreater(self.combined().std(), 0.01)
        self.assertEqual(self.notes(), "")

    def test_instances_share_a_tree(self):
        item = self.add_file()
        group = bpy.data.collections.new("Balls")
        group.objects.link(item)
        bpy.context.collection.objects.unlink(item)
        for x in (0, 3, 6):
            empty = bpy.data.objects.new("Ball", None)
            empty.instance_type, empty.instance_collection, empty.location.x = "COLLECTION", group, x
            bpy.context.collection.objects.link(empty)
        empty.rotation_euler.y = math.pi
        bpy.context.view_layer.update()
        path, scene = self.export()
        self.assertEqual(len(scene["objects"]), 1)
        self.assertEqual(self.labels(path, [IN_WINE, (3, 0, 0), (3, 0, 0.5), (6, 0, 0.5), (6, 0, -0.5)]),
                         ["ball.wine", "ball.wine", "vacuum", "ball.wine", "vacuum"])  # fmt: skip
        self.assertEqual(scene["objects"][0]["file"], str(self.folder / "ball.json"))
        empty.scale = (0, 1, 1)
        self.assertIn("is scaled to nothing, so it is left out", self.check()[0])

    def test_files_of_the_scene_are_found(self):
        """A scene file may name files relative to its own folder."""
        os.mkdir(self.folder / "parts")
        corners = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1))
        faces = "1 2 4 3|5 7 8 6|1 5 6 2|3 4 8 7|1 3 7 5|2 6 8 4".split("|")
        (self.folder / "parts" / "box.obj").write_text(corners + "".join(f"f {face}\n" for face in faces))
        box = '{"set": {"phase": "ice", "of": {"mesh": {"file": "parts/box.obj"}}}}'
        self.add_file(f'{{"version": 1, "phases": {{"ice": {{"clear": {{"ior": 1.31}}}}}}, "tree": {box}}}', "box")
        self.assertEqual(self.labels_of((0.5, 0.5, 0.5)), ["box.ice"])


class SceneText(unittest.TestCase):
    def test_comments_are_not_in_texts(self):
        text = '{"a": "// not", /* one\n two */ "b": [1, 2.5, true, {"c~/": -3}] // end\n}'
        document = scene_text.parsed(text, "x")
        self.assertEqual(document, {"a": "// not", "b": [1, 2.5, True, {"c~/": -3}]})
        self.assertEqual(scene_text.numbers_in(document), {"/b/0": 1, "/b/1": 2.5, "/b/3/c~0~1": -3})
        self.assertTrue(scene_text.with_number(document, "/b/3/c~0~1", 4.0))
        self.assertEqual(document["b"][3]["c~/"], 4)
        for pointer in ("/b/4", "/b/2", "/a", "/x/y", "/b/3/d"):
            self.assertFalse(scene_text.with_number(document, pointer, 1.0), pointer)


if __name__ == "__main__":
    unittest.main()
