"""Run by Blender: runs the test that run.py names, and reports as unittest does."""

import importlib.util
import os
import sys
import unittest

sys.path.insert(0, os.environ["PHASETREE_TEST_FOLDER"])
path, *words = sys.argv[sys.argv.index("--") + 1 :]
spec = importlib.util.spec_from_file_location("test", path)
module = importlib.util.module_from_spec(spec)
sys.modules["test"] = module
spec.loader.exec_module(module)
program = unittest.main(module, argv=[path, *words], exit=False, verbosity=2)
sys.stderr.flush()
if not program.result.wasSuccessful():
    raise SystemExit(1)
