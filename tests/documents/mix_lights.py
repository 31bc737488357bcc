"""Blender mixes the light groups of the tutorial "a picture for print" as oiiotool does.

Exits with 77 where Blender is not installed.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from markdown import ROOT

COMMAND = os.environ["PHASETREE_COMMAND"]
TUTORIAL = ROOT / "tracer/manual/tutorials/picture-for-print.md"
SKIPPED = 77


class MixLights(unittest.TestCase):
    def test_blender_and_oiiotool_make_the_same_picture(self) -> None:
        mix = re.search(r"^oiiotool cup(?:\\\n|.)*", TUTORIAL.read_text(encoding="utf-8"), re.M)
        assert mix
        with tempfile.TemporaryDirectory() as folder:

            def run(*words: str) -> str:
                done = subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=300, check=False,
                                      env={**os.environ, "HOME": folder})
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                return done.stdout

            run(COMMAND, "render", str(ROOT / "scenes/manual/cup.json"), "--size", "60x80", "--spp", "4",
                "--planes", "lights", "-o", "cup.{plane}.exr")
            run("bash", "-c", mix[0])
            os.rename(os.path.join(folder, "evening.png"), os.path.join(folder, "expected.png"))
            run("blender", "--background", "--factory-startup", "--python-exit-code", "1", "--python",
                str(TUTORIAL.with_name("mix_lights.py")))
            # Both write 16 bits.
            run("oiiotool", "--fail", "0.0001", "--diff", "evening.png", "expected.png")


if __name__ == "__main__":
    if not shutil.which("blender"):
        print("Blender is not installed")
        sys.exit(SKIPPED)
    unittest.main()
