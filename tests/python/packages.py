"""The wheel and the Debian package hold all that the package needs, and are imported from where they were unpacked."""

import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from support import ROOT

BUILD = pathlib.Path(os.environ.get("PHASETREE_BUILD_DIR", ROOT / "build/release"))
PROGRAM = """
import phasetree as pt
assert pt.__file__.startswith({folder!r}), pt.__file__
assert pt.phase("a")(pt.sphere(1)).label([(0, 0, 0)])[0] == 1
"""


class Packages(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def run_in(self, folder, *command, **more):
        done = subprocess.run([*map(str, command)], cwd=folder, capture_output=True, text=True, check=False, **more)
        self.assertEqual(done.returncode, 0, done.stderr + done.stdout)
        return done.stdout

    def check_imports_from(self, folder):
        names = sorted(p.name for p in (ROOT / "plugins/python/phasetree").iterdir() if p.suffix in (".py", ".pyi", ".typed"))
        there = {p.name for p in (folder / "phasetree").iterdir()}
        self.assertLessEqual(set(names), there)
        environment = {**os.environ, "PYTHONPATH": str(folder)}
        self.run_in("/", sys.executable, "-c", PROGRAM.format(folder=str(folder)), env=environment)

    @unittest.skipUnless(
        all(importlib.util.find_spec(m) for m in ("pip", "setuptools", "wheel")), "pip, setuptools or wheel is missing"
    )
    def test_wheel(self):
        # A copy, because setuptools writes beside its sources; the module is that of the build.
        source = self.folder / "repository/plugins/python"
        shutil.copytree(ROOT / "plugins/python", source)
        shutil.copy(ROOT / "CMakeLists.txt", self.folder / "repository")
        environment = {**os.environ, "PHASETREE_BUILD_DIR": str(BUILD), "PIP_DISABLE_PIP_VERSION_CHECK": "1"}
        self.run_in(
            source, sys.executable, "-m", "pip", "wheel", ".", "--no-build-isolation", "--no-deps", "--no-index",
            "-w", self.folder / "wheels", env=environment,
        )  # fmt: skip
        (wheel,) = (self.folder / "wheels").glob("phasetree-*.whl")
        self.assertIn(f"cp{sys.version_info.major}{sys.version_info.minor}", wheel.name)
        target = self.folder / "there"
        shutil.unpack_archive(wheel, target, "zip")
        self.check_imports_from(target)

    @unittest.skipUnless(shutil.which("cpack") and shutil.which("dpkg-deb") and shutil.which("dpkg-shlibdeps"), "no dpkg")
    def test_debian_package(self):
        self.run_in(BUILD, "cpack", "--config", BUILD / "CPackPython.cmake", "-B", self.folder / "package")
        (package,) = (self.folder / "package").glob("*.deb")
        self.assertTrue(package.name.startswith("python3-phasetree_"))
        self.run_in("/", "dpkg-deb", "-x", package, self.folder / "root")
        depends = self.run_in("/", "dpkg-deb", "-f", package, "Depends")
        for needed in ("python3-numpy", "libembree", "libopenimageio", "libtbb", "python3 (>= "):
            self.assertIn(needed, depends)
        self.check_imports_from(self.folder / "root/usr/lib/python3/dist-packages")


if __name__ == "__main__":
    unittest.main()
