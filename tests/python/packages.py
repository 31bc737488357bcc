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

# Without the package of the build, which the tests are otherwise run with.
PLAIN = {
    **{k: v for k, v in os.environ.items() if k not in ("PYTHONPATH", "PHASETREE_BUILD_DIR", "PHASETREE_LONG_TESTS")},
    "PIP_DISABLE_PIP_VERSION_CHECK": "1",
}
OFFLINE = ("--no-build-isolation", "--no-deps", "--no-index")
HAS_PIP = unittest.skipUnless(
    all(importlib.util.find_spec(m) for m in ("pip", "setuptools", "wheel", "ensurepip")),
    "python3-pip, python3-setuptools, python3-wheel or python3-venv is missing",
)


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

    def source(self):
        """A copy of the package's, because setuptools writes beside it, and what pip takes to make it of the build."""
        source = self.folder / "repository/plugins/python"
        shutil.copytree(ROOT / "plugins/python", source)
        shutil.copy(ROOT / "CMakeLists.txt", self.folder / "repository")
        return source, {**PLAIN, "PHASETREE_BUILD_DIR": str(BUILD)}

    @HAS_PIP
    def test_wheel(self):
        source, environment = self.source()
        self.run_in(source, sys.executable, "-m", "pip", "wheel", ".", *OFFLINE, "-w", self.folder / "wheels", env=environment)
        (wheel,) = (self.folder / "wheels").glob("phasetree-*.whl")
        self.assertIn(f"cp{sys.version_info.major}{sys.version_info.minor}", wheel.name)
        target = self.folder / "there"
        shutil.unpack_archive(wheel, target, "zip")
        self.check_imports_from(target)

    @HAS_PIP
    def test_pip_installs_it_into_a_virtual_environment(self):
        self.check_installed(*self.source())

    @HAS_PIP
    @unittest.skipUnless(os.environ.get("PHASETREE_LONG_TESTS"), "a long form")
    def test_pip_builds_all_of_it_and_the_tests_pass_with_what_it_installs(self):
        repository = self.folder / "repository"
        shutil.copytree(ROOT, repository, ignore=shutil.ignore_patterns(".git", "build", "build-*", "out"))
        python = self.check_installed(repository / "plugins/python", PLAIN)
        for test in sorted((ROOT / "tests/python").glob("*.py")):
            if test.stem not in ("support", "packages"):
                self.run_in(ROOT / "tests/python", python, test, env={**PLAIN, "PYTHONDONTWRITEBYTECODE": "1"})

    def check_installed(self, source, environment):
        """Installs into a virtual environment that has Debian's packages, and imports from there; its Python."""
        made = self.folder / "environment"
        self.run_in("/", sys.executable, "-m", "venv", "--system-site-packages", made)
        python = made / "bin/python"
        self.run_in(source, python, "-m", "pip", "install", ".", *OFFLINE, env=environment)
        folder = self.run_in("/", python, "-c", "import phasetree; print(phasetree.__path__[0])", env=PLAIN).strip()
        self.assertTrue(folder.startswith(str(made)), folder)
        self.run_in("/", python, "-c", PROGRAM.format(folder=str(made)), env=PLAIN)
        self.assertIn("phasetree", self.run_in("/", python, "-m", "pip", "list", env=PLAIN))
        return python

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
