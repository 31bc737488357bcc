"""The zip installs through the preferences, works, and leaves nothing behind when it is removed."""

import importlib
import os
import pathlib
import re
import subprocess
import unittest
import zipfile

import addon_utils
import bpy

ZIP = os.environ["PHASETREE_BLENDER_ZIP"]
NAME = "phasetree_blender"


class Installation(unittest.TestCase):
    def test_install_render_and_remove(self):
        addons = pathlib.Path(bpy.utils.user_resource("SCRIPTS", path="addons"))
        before = set(dir(bpy.types))
        bpy.ops.preferences.addon_install(filepath=ZIP)
        self.assertTrue((addons / NAME / "__init__.py").is_file())
        bpy.ops.preferences.addon_enable(module=NAME)
        self.assertIn(NAME, bpy.context.preferences.addons)
        scene = bpy.context.scene
        scene.render.engine = "PHASETREE"
        scene.render.resolution_x, scene.render.resolution_y, scene.phasetree.samples = 16, 12, 1
        scene.render.filepath = str(addons.parent / "picture.png")
        bpy.ops.render.render(write_still=True)
        self.assertTrue(pathlib.Path(scene.render.filepath).is_file())
        self.assertIn("PHASETREE", bpy.types.RENDER_PT_color_management.COMPAT_ENGINES)

        # Disabled and enabled again, as after an update.
        bpy.ops.preferences.addon_disable(module=NAME)
        registered = [p for p in bpy.types.Panel.__subclasses__() if hasattr(bpy.types, p.__name__)]
        self.assertFalse(any("PHASETREE" in getattr(p, "COMPAT_ENGINES", ()) for p in registered))
        self.assertFalse(hasattr(bpy.types.Scene, "phasetree"))
        bpy.ops.preferences.addon_enable(module=NAME)
        self.assertTrue(hasattr(bpy.types.Scene, "phasetree"))
        bpy.ops.preferences.addon_disable(module=NAME)
        self.assertEqual({n for n in set(dir(bpy.types)) - before if "PHASETREE" in n.upper()}, set())
        window = bpy.context.window_manager.windows[0]
        with bpy.context.temp_override(window=window, area=window.screen.areas[0]):  # which it redraws
            bpy.ops.preferences.addon_remove(module=NAME)
        self.assertFalse((addons / NAME).exists())
        importlib.invalidate_caches()
        self.assertNotIn(NAME, [m.__name__ for m in addon_utils.modules(refresh=True)])

    def test_version_is_that_of_the_command(self):
        printed = subprocess.run([os.environ["PHASETREE_COMMAND"], "--version"], capture_output=True, text=True, check=True).stdout
        text = (pathlib.Path(os.environ["PHASETREE_TEST_FOLDER"]).parents[1] / "plugins/blender" / NAME / "__init__.py").read_text()
        version = ".".join(re.search(r'"version": \((\d+), (\d+), (\d+)\)', text).groups())
        self.assertRegex(printed, rf"\b{re.escape(version)}\b")

    def test_zip_has_what_the_repository_has(self):
        source = pathlib.Path(os.environ["PHASETREE_TEST_FOLDER"]).parents[1] / "plugins/blender"
        files = {str(p.relative_to(source)) for p in (source / NAME).rglob("*.py")}
        with zipfile.ZipFile(ZIP) as packed:
            self.assertEqual(set(packed.namelist()), files)
            for name in files:
                self.assertEqual(packed.read(name), (source / name).read_bytes())


if __name__ == "__main__":
    unittest.main()
