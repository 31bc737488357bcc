"""Blender on the command line: the tutorial's drink, cancelling, and the exit code of renders that fail.

These tests start Blender themselves, so Blender does not run them: python3 command_line.py
"""

import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import run  # noqa: E402

DRINK = run.ADDON.parent / "examples/drink.py"
TUTORIAL = run.FOLDER.parents[1] / "tracer/manual/tutorials/drink-in-blender.md"


class CommandLine(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.drink = str(self.folder / "drink.blend")
        self.environment = {**run.environment(folder.name), "TMPDIR": folder.name}
        self.environment.pop("PYTHONPATH", None)

    def arguments(self, *words):
        return ["blender", "-b", "--factory-startup", "--addons", run.ADDON.name, "--python-exit-code", "9", *words]

    def blender(self, *words):
        return subprocess.run(self.arguments(*words), env=self.environment, cwd=self.folder, capture_output=True, text=True,
                              check=False)  # fmt: skip

    def left_over(self):
        return [p.name for p in self.folder.iterdir() if p.name.startswith("phasetree_")]

    def test_drink_of_the_tutorial_renders(self):
        made = self.blender("--python", str(DRINK), "--", self.drink)
        self.assertEqual(made.returncode, 0, made.stdout + made.stderr)
        small = (
            "import bpy; from phasetree_blender import last_report; s = bpy.context.scene; "
            "s.render.resolution_percentage, s.phasetree.samples = 4, 1; "
            "bpy.app.handlers.render_post.append(lambda *_: print(last_report.of('Scene').phases))"
        )
        done = self.blender(self.drink, "-E", "PHASETREE", "--python-expr", small, "-o", "//drink_", "-F", "PNG", "-f", "1")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertTrue((self.folder / "drink_0001.png").is_file(), done.stdout)
        self.assertNotIn("phasetree:", done.stdout)  # everything is supported
        self.assertEqual(self.left_over(), [])
        # What the tutorial says of the phases.
        shown = re.findall(r"```text\n(.*?)```", TUTORIAL.read_text(encoding="utf-8"), re.S)
        self.assertEqual(len(shown), 1)
        self.assertIn(shown[0], done.stdout)

    def test_failed_frames_give_an_exit_code_and_no_picture(self):
        broken = "import bpy; s = bpy.context.scene; s.render.engine = 'PHASETREE'; s.camera.data.type = 'PANO'"
        for frames in (["-f", "1"], ["-s", "1", "-e", "2", "-a"]):
            done = self.blender("--python-expr", broken, "-o", f"{self.folder}/frame_", "-F", "PNG", *frames)
            self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
            self.assertIn("phasetree: error: the camera's panorama is of the type", done.stdout)
            self.assertEqual(list(self.folder.glob("frame_*")), [])
            self.assertEqual(self.left_over(), [])

    def test_cancelled_render_ends_its_child(self):
        self.assert_child_ends_on(signal.SIGINT)
        self.assertEqual(self.left_over(), [])
        self.assertEqual(list(self.folder.glob("frame_*")), [])

    @unittest.skipUnless(sys.platform == "linux", "only Linux ends children with their parent")
    def test_child_does_not_outlive_a_killed_blender(self):
        self.assert_child_ends_on(signal.SIGKILL)

    def assert_child_ends_on(self, sent):
        endless = ("import bpy; s = bpy.context.scene; s.render.engine = 'PHASETREE'; s.phasetree.samples = 16777216; "
                   "s.render.resolution_percentage = 5; s.render.threads_mode, s.render.threads = 'FIXED', 1")  # fmt: skip
        started = subprocess.Popen(self.arguments("--python-expr", endless, "-o", "//frame_", "-f", "1"), env=self.environment,
                                   cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # fmt: skip
        try:
            patience = time.monotonic() + 120
            while not (children := self.children_of(started.pid)):
                self.assertIsNone(started.poll())
                self.assertLess(time.monotonic(), patience)
                time.sleep(0.1)
            started.send_signal(sent)
            started.wait(60)
        finally:
            started.kill()
            started.wait()
        patience = time.monotonic() + 10  # a killed process ends soon, not at once
        while alive := [pid for pid in children if os.path.exists(f"/proc/{pid}")]:
            if time.monotonic() > patience:
                for pid in alive:
                    os.kill(pid, signal.SIGKILL)
                self.fail("the child of a Blender that has ended still renders")
            time.sleep(0.1)

    @staticmethod
    def children_of(parent):
        """The processes that run `phasetree render` for a process."""
        found = []
        for entry in pathlib.Path("/proc").iterdir():
            if not entry.name.isdigit():
                continue
            try:
                status, words = (entry / "stat").read_text(), (entry / "cmdline").read_bytes().split(b"\0")
            except OSError:
                continue
            if int(status.rsplit(")", 1)[1].split()[1]) == parent and b"render" in words:
                found.append(int(entry.name))
        return found


if __name__ == "__main__":
    skipped = run.why_skipped()
    if skipped:
        print(f"SKIPPED: {skipped}")
        sys.exit(run.SKIPPED)
    unittest.main()
