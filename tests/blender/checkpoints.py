"""Renders go on from a checkpoint: after they were cancelled, and with more samples."""

import unittest
from unittest import mock

import bpy
import numpy as np
from phasetree_blender import engine
from support import BlenderTest


class Checkpoints(BlenderTest):
    def setUp(self):
        super().setUp()
        self.scene.phasetree.keeps_checkpoints = True
        self.scene.phasetree.checkpoint_folder = str(self.folder / "checkpoints")
        self.scene.phasetree.update_interval = 0.2

    def checkpoints(self):
        return sorted(path.name for path in (self.folder / "checkpoints").glob("*"))

    def cancelled_render(self):
        """Renders until there is a checkpoint, and cancels."""
        with mock.patch.object(engine.PhasetreeRenderEngine, "_is_cancelled", lambda _: bool(self.checkpoints())):
            bpy.ops.render.render()
        self.assertIn("the render was cancelled", self.notes())

    def test_cancelled_render_goes_on(self):
        self.scene.phasetree.samples = 16384
        self.cancelled_render()
        self.assertEqual(self.checkpoints(), ["unsaved_Scene_ViewLayer_0001.checkpoint"])
        written = (self.folder / "checkpoints" / self.checkpoints()[0]).stat().st_mtime_ns
        # It goes on: fewer samples than the checkpoint has are another render, so it starts again.
        self.scene.phasetree.samples = 1
        first = self.combined()
        self.assertIn("the render started again", self.notes())
        self.assertNotEqual((self.folder / "checkpoints" / self.checkpoints()[0]).stat().st_mtime_ns, written)
        # More samples go on from it, and the picture is that of an uninterrupted render.
        self.scene.phasetree.samples = 8
        resumed = self.combined()
        self.assertEqual(self.notes(), "")
        self.scene.phasetree.keeps_checkpoints = False
        self.assertTrue(np.array_equal(self.combined(), resumed))
        self.assertFalse(np.array_equal(first, resumed))

    def test_changed_scene_starts_again(self):
        self.combined()
        self.assertEqual(self.notes(), "")
        bpy.data.objects["Cube"].location.x = 1
        moved = self.combined()
        self.assertIn("information: the render started again, because the scene or its settings changed", self.notes())
        self.combined()
        self.assertEqual(self.notes(), "")
        self.scene.phasetree.keeps_checkpoints = False
        self.assertTrue(np.array_equal(self.combined(), moved))

    def test_each_frame_has_its_own(self):
        self.combined()
        self.scene.frame_set(7)
        self.combined()
        self.assertEqual([name[-15:] for name in self.checkpoints()], ["0001.checkpoint", "0007.checkpoint"])

    def test_folder_that_cannot_be_made_gives_a_message(self):
        for folder, wanted in (("//checkpoints", "save the .blend file first"), ("/proc/no", "cannot make the folder")):
            self.scene.phasetree.checkpoint_folder = folder
            with self.assertRaisesRegex(RuntimeError, wanted):
                bpy.ops.render.render()
        # The next render works. (Blender's exit code is that of the last render, whatever a script catches.)
        self.scene.phasetree.checkpoint_folder = str(self.folder / "checkpoints")
        self.combined()


if __name__ == "__main__":
    unittest.main()
