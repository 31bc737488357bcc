"""cmake for the documents' shell blocks: nothing is built; presets and build folders must exist."""

import json
import os
import pathlib
import sys

root = pathlib.Path(os.environ["PHASETREE_ROOT"])
presets = json.loads((root / "CMakePresets.json").read_text(encoding="utf-8"))
arguments = sys.argv[1:]
kind = "buildPresets" if "--build" in arguments else "configurePresets"
names = {preset["name"] for preset in presets[kind] if not preset.get("hidden")}
if "--preset" in arguments:
    name = arguments[arguments.index("--preset") + 1]
elif arguments[:1] in (["--install"], ["--build"]):
    name = pathlib.PurePath(arguments[1]).name
    names = {preset["name"] for preset in presets["configurePresets"]}
else:
    sys.exit(f"cmake {' '.join(arguments)}: the documents' test does not know this form")
sys.exit(0 if name in names else f"cmake: there is no preset {name!r}")
