"""Runs a test in Blender, without a window: python3 run.py TEST.py

The test is a module of unittest that Blender's own Python runs, with the add-on enabled from plugins/blender and with user
folders that are empty. The environment has PHASETREE_COMMAND and PHASETREE_BLENDER_ZIP. Exits with 77 where there is no
Blender.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
FOLDER = pathlib.Path(__file__).resolve().parent
ADDON = FOLDER.parents[1] / "plugins/blender/phasetree_blender"
LEAST = (3, 4)


def why_skipped():
    """Why there is nothing to run tests with; empty if there is."""
    if shutil.which("blender") is None:
        return "there is no blender (on Debian and Ubuntu: apt install blender)"
    done = subprocess.run(["blender", "--version"], capture_output=True, text=True, check=False)
    version = re.search(r"Blender (\d+)\.(\d+)", done.stdout)
    if not version:
        return f"blender does not start: {(done.stderr or done.stdout).strip()}"
    if tuple(map(int, version.groups())) < LEAST:
        return f"Blender {version[1]}.{version[2]} is older than {LEAST[0]}.{LEAST[1]}"
    return ""


def environment(folder, has_addon=True):
    """The environment for a Blender whose user folders are in the folder."""
    scripts = pathlib.Path(folder) / "scripts"
    (scripts / "addons").mkdir(parents=True)
    if has_addon:
        (scripts / "addons" / ADDON.name).symlink_to(ADDON)
    # Debian's Blender takes the modules of the first python3 on PATH, which must be Debian's, too.
    path = f"{pathlib.Path(shutil.which('blender')).parent}:{os.environ['PATH']}"
    return {**os.environ, "PATH": path, "BLENDER_USER_SCRIPTS": str(scripts), "BLENDER_USER_CONFIG": f"{folder}/config",
            "BLENDER_USER_DATAFILES": f"{folder}/datafiles", "HOME": folder, "PYTHONDONTWRITEBYTECODE": "1",
            "PHASETREE_TEST_FOLDER": str(FOLDER)}  # fmt: skip


def main():
    skipped = why_skipped()
    if skipped:
        print(f"SKIPPED: {skipped}")
        return SKIPPED
    test = pathlib.Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        addons = [] if test.stem == "installation" else ["--addons", ADDON.name]
        command = ["blender", "-b", "--factory-startup", *addons, "--python-exit-code", "1", "--python", str(FOLDER / "suite.py"),
                   "--", str(test), *sys.argv[2:]]  # fmt: skip
        return subprocess.run(command, env=environment(folder, bool(addons)), cwd=folder, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
