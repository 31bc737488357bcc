"""Builds the wheel: CMake makes the extension module from the whole repository, of which this folder is a part.

PHASETREE_BUILD_DIR names a build folder that is there already, whose module for this Python is taken.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]


class BuildByCMake(build_ext):
    def build_extension(self, ext):
        target = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve()
        build = os.environ.get("PHASETREE_BUILD_DIR")
        if not build:
            build = str(pathlib.Path(self.build_temp).resolve() / "cmake")
            options = {
                "CMAKE_BUILD_TYPE": "Release",
                # As in the presets that build everything once: half the time.
                "CMAKE_UNITY_BUILD": "ON",
                "CMAKE_UNITY_BUILD_BATCH_SIZE": "8",
                "PHASETREE_BUILD_TESTS": "OFF",
                "PHASETREE_INSTALL": "OFF",
                "PHASETREE_WERROR": "OFF",
                "Python_EXECUTABLE": sys.executable,
            }
            subprocess.run(["cmake", "-S", ROOT, "-B", build, *(f"-D{k}={v}" for k, v in options.items())], check=True)
            jobs = os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count() or 1))
            subprocess.run(["cmake", "--build", build, "--target", "phasetree_python", "-j", jobs], check=True)
        module = pathlib.Path(build) / "plugins/python/phasetree" / target.name
        if not module.exists():
            raise RuntimeError(f"{module} was not built: is pybind11 (Debian: pybind11-dev) installed for {sys.executable}?")
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(module, target)


version = re.search(r"project\(phasetree VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text(encoding="utf-8"))[1]
setup(
    version=version,
    packages=["phasetree"],
    package_data={"phasetree": ["*.pyi", "py.typed"]},
    ext_modules=[Extension("phasetree._phasetree", sources=[])],
    cmdclass={"build_ext": BuildByCMake},
)
