"""Motion blur: objects, groups of phases, trees and the camera move as in Cycles, and what cannot is reported."""

import json
import unittest

import bpy
import numpy as np
from mathutils import Matrix
from support import BlenderTest, add_box, dress, principled, shader


def move(item, path, first, last):
    """Changes a property evenly from frame 1 to frame 11."""
    for frame, value in ((1, first), (11, last)):
        setattr(item, path, value)
        item.keyframe_insert(path, frame=frame)
    for curve in item.animation_data.action.fcurves:
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"


class Motion(BlenderTest):
    def setUp(self):
        super().setUp()
        self.cube = bpy.data.objects["Cube"]
        self.scene.render.use_motion_blur, self.scene.render.motion_blur_shutter = True, 0.8
        self.scene.render.film_transparent = True
        camera = self.scene.camera
        camera.data.type, camera.data.ortho_scale = "ORTHO", 8
        camera.location, camera.rotation_euler = (0, 0, 10), (0, 0, 0)
        self.scene.frame_set(6)

    def columns(self, engine="PHASETREE"):
        """The coverage of each column of pixels."""
        self.scene.render.engine = engine
        if engine == "CYCLES":
            self.scene.cycles.samples, self.scene.cycles.device = 64, "CPU"
            self.scene.cycles.use_denoising = False
        self.scene.phasetree.samples = 64
        alpha = self.render()["ViewLayer.Combined.A"]
        self.scene.render.engine = "PHASETREE"
        return alpha.mean(axis=0)

    def assert_like_cycles(self):
        own = self.columns()
        self.assertNotIn("not supported", self.notes())
        cycles = self.columns("CYCLES")
        self.assertLess(np.abs(own - cycles).max(), 0.03, (own, cycles))
        self.scene.render.use_motion_blur = False
        self.assertGreater(np.abs(self.columns() - own).max(), 0.05)  # it is blurred
        self.scene.render.use_motion_blur = True

    def test_opaque_solid_moves(self):
        dress(self.cube, shader("ShaderNodeEmission"))
        move(self.cube, "location", (-8, 0, 0), (12, 0, 0))
        self.assert_like_cycles()
        self.assertEqual(self.notes(), "")
        for position, left in (("START", 2.0), ("END", 0.4)):
            self.scene.phasetree.motion_blur_position = position
            keys = self.export()[1]["objects"][0]["transform"]["keys"]
            self.assertEqual(len(keys), 3)
            self.assertAlmostEqual(keys[0][1]["affine"]["by"][0], left, places=4)
            self.assertAlmostEqual(keys[2][1]["affine"]["by"][0], left + 1.6, places=4)
            self.assertAlmostEqual(keys[2][0] - keys[0][0], 0.8 / 24, places=6)

    def test_camera_moves(self):
        move(self.scene.camera, "location", (-8, 0, 10), (12, 0, 10))
        self.assert_like_cycles()
        self.assertNotIn("objects", self.export()[1])
        camera = self.scene.camera.data
        camera.type = "PERSP"
        move(camera, "lens", 20, 120)
        self.assertEqual(len(self.export()[1]["camera"]["thin_lens"]["fov"]["keys"]), 3)

    def test_rotation_of_a_tree(self):
        path = self.folder / "bar.json"
        path.write_text('{"version": 1, "phases": {"gold": {"diffuse": {"color": [0.5, 0.4, 0.1]}}},'
                        '"tree": {"set": {"phase": "gold", "of": {"box": {"size": [4, 0.4, 0.4]}}}}}')  # fmt: skip
        self.cube.phasetree.source, self.cube.phasetree.file = "FILE", str(path)
        move(self.cube, "rotation_euler", (0, 0, -5), (0, 0, 5))
        self.scene.phasetree.motion_steps = 5
        own = self.columns()
        self.assertEqual(self.notes(), "")
        self.cube.phasetree.source = "NONE"
        self.cube.data.transform(Matrix.Diagonal((2, 0.2, 0.2, 1)))
        cycles = self.columns("CYCLES")
        self.assertLess(np.abs(own - cycles).max(), 0.03, (own, cycles))

    def test_phases_that_move_together_stay_in_contact(self):
        bpy.data.objects.remove(self.cube)
        glass, water = (principled(name, 1, IOR=ior, Roughness=0.0, Base_Color=(1.0, 1.0, 1.0))
                        for name, ior in (("Glass", 1.5), ("Water", 1.33)))  # fmt: skip
        parent = bpy.data.objects.new("Tray", None)
        bpy.context.collection.objects.link(parent)
        add_box("Cup", (-1, -1, -1), (1, 1, 1), glass).parent = parent
        add_box("Water", (0.5, -0.8, -0.8), (2, 0.8, 0.8), water).parent = parent
        add_box("Ice", (-3, -3, -1), (-2, -2, 0), glass)
        move(parent, "location", (-5, 0, 0), (5, 0, 0))
        path, scene = self.export()
        moving = scene["objects"][0]
        self.assertEqual((moving["name"], len(scene["objects"])), ("Cup", 1))
        by = [key[1]["affine"]["by"][0] for key in moving["transform"]["keys"]]
        self.assertTrue(np.allclose(by, (-0.4, 0, 0.4), atol=1e-5), by)
        # Halfway, everything is where the frame has it: the cup keeps the space that the water reaches into.
        self.run_command("check", path)
        keys = moving["transform"].pop("keys")
        moving["transform"] = keys[1][1]
        (self.folder / "still.json").write_text(json.dumps(scene))
        self.assertEqual(self.labels(str(self.folder / "still.json"), [(0.8, 0, 0), (1.5, 0, 0), (-2.5, -2.5, -0.5)]),
                         ["Cup.Glass", "Cup.Water", "Glass"])  # fmt: skip
        self.assertIn("Cup, by itself:", self.check()[1])
        self.assertIn('"Cup" wins', self.check()[1])
        self.assert_like_cycles()

    def test_what_cannot_move_is_reported(self):
        self.cube.data.materials.clear()
        bpy.ops.mesh.primitive_plane_add(location=(0, 3, 0))
        plane = bpy.context.object
        plane.name = "Sheet"
        move(plane, "location", (-5, 3, 0), (5, 3, 0))
        light = bpy.data.objects["Light"]
        move(light, "location", (0, 0, 5), (5, 0, 5))
        wave = self.cube.modifiers.new("Wave", "WAVE")
        wave.speed = 2.0
        image = principled("Picture")
        texture = image.node_tree.nodes.new("ShaderNodeTexImage")
        texture.image = bpy.data.images.new("picture", 4, 4)
        image.node_tree.links.new(texture.outputs[0], image.node_tree.nodes["Principled BSDF"].inputs["Base Color"])
        move(add_box("Box", (0, -4, 0), (1, -3, 1), image), "location", (-5, -3, 0), (5, -3, 0))
        bpy.ops.mesh.primitive_uv_sphere_add(segments=8, ring_count=6)
        bpy.ops.object.shade_smooth()
        move(dress(bpy.context.object, principled("Ball")), "location", (-5, 0, 0), (5, 0, 0))
        bpy.context.object.name = "Ball"
        notes, _ = self.check()
        for wanted in (
            'not supported: object "Sheet": its motion is not blurred, because it is not closed',
            'not supported: object "Box": its motion is not blurred, because its material has images',
            'not supported: light "Light": its motion is not blurred',
            'not supported: object "Cube": its deformation is not blurred, only its motion as a whole',
            'approximate: object "Ball": is shaded flat, because it is rendered as a solid',
        ):
            self.assertIn(wanted, notes)
        self.assertEqual(len(notes.splitlines()), 5, notes)
        self.render()
        self.assertEqual(sorted(self.notes().splitlines()), sorted(notes.splitlines()))
        self.assertEqual((self.scene.frame_current, self.scene.frame_subframe), (6, 0))

    def test_nothing_changes_without_motion(self):
        still = self.combined()
        self.assertNotIn("objects", self.export()[1])
        self.scene.render.use_motion_blur = False
        self.assertTrue(np.array_equal(self.combined(), still))
        self.assertNotIn("shutter", self.export()[1]["render"])


if __name__ == "__main__":
    unittest.main()
