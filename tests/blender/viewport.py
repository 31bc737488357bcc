"""The thread behind the rendered viewport, without a window: what it shows, when it starts again, and its end."""

import os
import pathlib
import threading
import time
import unittest

import bpy
import numpy as np
from mathutils import Matrix
from phasetree_blender import preferences, viewport
from phasetree_blender.command import RenderProcess
from phasetree_blender.notes import Notes
from phasetree_blender.translate.scene import translate
from support import COMMAND, BlenderTest

SIZE = 48, 36


class RenderedViewport(BlenderTest):
    def setUp(self):
        super().setUp()
        self.redrawn = threading.Event()
        self.viewport = viewport.Viewport(preferences.found_command(), self.redrawn.set)
        self.addCleanup(self.viewport.close)

    def show_scene(self):
        depsgraph = bpy.context.evaluated_depsgraph_get()
        self.viewport.show(translation=translate(depsgraph, self.viewport.path(), preferences.found_command(), Notes()))

    def show_camera(self):
        """Shows what the camera sees, by matrices as those of a viewport."""
        camera = self.scene.camera
        onto_region = camera.calc_matrix_camera(bpy.context.evaluated_depsgraph_get(), x=SIZE[0], y=SIZE[1])
        from_world = Matrix(camera.matrix_world.normalized()).inverted()
        self.viewport.show(view=(viewport.camera_of_view(from_world, onto_region), *SIZE))

    def finished(self):
        """The finished picture of what was shown last, the top row first."""
        patience = time.monotonic() + 120

        def is_finished():
            picture = self.viewport.picture
            return picture is not None and picture.shape[:2] == SIZE[::-1] and self.viewport.status == ""

        while not is_finished():
            self.assertLess(time.monotonic(), patience, self.viewport.status)
            time.sleep(0.02)
        picture, self.viewport.picture = self.viewport.picture, None
        return picture[::-1, :, :3]

    def test_pictures_of_views_and_changes(self):
        camera = self.scene.camera
        camera.data.shift_x, camera.data.shift_y = 0.05, -0.1
        self.show_scene()
        self.show_camera()
        first = self.finished()
        self.assertLess(np.abs(first - self.combined()).mean(), 0.02 * first.mean())
        # Another view, of parallel rays.
        camera.data.type, camera.data.ortho_scale = "ORTHO", 5
        self.show_camera()
        second = self.finished()
        self.assertLess(np.abs(second - self.combined()).mean(), 0.02 * second.mean())
        # A scene that has not changed does not start again, and one that has does.
        version = self.viewport._version
        self.show_scene()
        self.assertEqual(self.viewport._version, version)
        bpy.data.objects["Cube"].location.x = 1
        self.show_scene()
        self.assertGreater(np.abs(self.finished() - second).max(), 0.05)
        self.assertTrue(self.redrawn.is_set())

    def test_no_picture_of_an_earlier_render_in_the_folder_is_shown(self):
        path, _ = self.export()
        first = RenderProcess(COMMAND, path, str(self.folder), [], 1)
        while not first.wait(0.1):
            pass
        self.assertTrue(first.preview())
        first.stop()
        second = RenderProcess(COMMAND, path, str(self.folder), ["--spp", "16777216"], 3600)
        try:
            self.assertIsNone(second.preview())
        finally:
            second.stop()

    def test_end_during_a_render_leaves_nothing(self):
        self.scene.phasetree.samples = 16777216
        self.show_scene()
        self.show_camera()
        patience = time.monotonic() + 120
        while self.viewport.picture is None:
            self.assertLess(time.monotonic(), patience, self.viewport.status)
            time.sleep(0.05)
        folder = pathlib.Path(self.viewport._folder.name)
        self.assertTrue(folder.is_dir())
        self.viewport.close()
        self.assertFalse(self.viewport._thread.is_alive())
        self.assertFalse(folder.exists())
        commands = [path.read_bytes() for path in pathlib.Path("/proc").glob("[0-9]*/cmdline") if os.access(path, os.R_OK)]
        self.assertFalse(any(bytes(folder) in command for command in commands))

    def test_errors_become_the_status(self):
        self.viewport._command = "/bin/false"
        self.show_scene()
        self.show_camera()
        patience = time.monotonic() + 60
        while "phasetree ended without a message" not in self.viewport.status:
            self.assertLess(time.monotonic(), patience, self.viewport.status)
            time.sleep(0.05)


if __name__ == "__main__":
    unittest.main()
