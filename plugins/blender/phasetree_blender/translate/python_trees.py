"""Trees that Python code in a text block makes. The code runs in another process, with the package `phasetree`."""

import json
import os
import tempfile

from .. import command as commands
from ..notes import TranslationError

# Runs in the other process: CODE OUT NUMBERS. Writes the scene file, or prints the numbers that the code takes.
RUNNER = r"""
import inspect, json, sys, traceback

path, name, out, numbers = sys.argv[1:5]

def fail(text):
    sys.stderr.write(text)
    sys.exit(1)

def is_number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool)

try:
    import phasetree
except ImportError as error:
    fail(f"{sys.executable} cannot import the Python package phasetree ({error}); set the interpreter in the add-on's "
         "preferences, and install the package or set PYTHONPATH")
try:
    with open(path, encoding="utf-8") as file:
        code = compile(file.read(), path, "exec")
    names = {"__name__": "phasetree_object"}
    exec(code, names)
    make = names.get("tree")
    if not callable(make):
        fail(f"{name}: defines no function `tree` that returns an object of phases")
    known = {p.name: p.default for p in inspect.signature(make).parameters.values() if is_number(p.default)}
    if not out:
        print(json.dumps(known))
        sys.exit(0)
    made = make(**{key: value for key, value in json.loads(numbers).items() if key in known})
    if isinstance(made, phasetree.Scene):
        made.save(out)
    elif isinstance(made, phasetree.Object):
        with open(out, "w", encoding="utf-8") as file:
            file.write(made.to_json())
    else:
        fail(f"{name}: `tree` returned {made!r} instead of an object of phases")
except SyntaxError as error:
    fail(f"{name}:{error.lineno}: {error.msg}")
except Exception as error:
    lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == path]
    place = f"{name}:{lines[-1]}" if lines else name
    fail(f"{place}: {error}" if str(error) else f"{place}: {type(error).__name__}")
"""


def environment(command):
    """The environment of the interpreter. In a build folder, the package is beside the command."""
    beside = os.path.join(os.path.dirname(os.path.dirname(os.path.realpath(command))), "plugins", "python")
    paths = [path for path in (os.environ.get("PYTHONPATH"), beside if os.path.isdir(beside) else None) if path]
    return {**os.environ, "PYTHONPATH": os.pathsep.join(paths), "PYTHONDONTWRITEBYTECODE": "1"}


class PythonTrees:
    """Runs code, and remembers what it made."""

    LIMIT = 64

    def __init__(self):
        self._made = {}

    def parameters(self, code, name, interpreter, command):
        """{name: default} of the numbers that the function `tree` takes."""
        return json.loads(self._run(code, name, None, interpreter, command))

    def scene(self, code, name, numbers, interpreter, command, cancelled=lambda: False):
        """The text of the scene file that the code makes with these numbers."""
        return self._run(code, name, numbers, interpreter, command, cancelled)

    def _run(self, code, name, numbers, interpreter, command, cancelled=lambda: False):
        key = (code, json.dumps(numbers, sort_keys=True), interpreter, command)
        if key not in self._made:
            while len(self._made) >= self.LIMIT:
                del self._made[next(iter(self._made))]
            self._made[key] = self._run_again(code, name, numbers, interpreter, command, cancelled)
        return self._made[key]

    @staticmethod
    def _run_again(code, name, numbers, interpreter, command, cancelled):
        with tempfile.TemporaryDirectory(prefix="phasetree_") as folder:
            path, out = os.path.join(folder, "code.py"), os.path.join(folder, "scene.json")
            with open(path, "w", encoding="utf-8") as file:
                file.write(code)
            arguments = [interpreter, "-c", RUNNER, path, name, out if numbers is not None else "", json.dumps(numbers)]
            done = commands.run(arguments, cancelled, env=environment(command))
            if done.returncode != 0:
                raise TranslationError(done.stderr.strip() or f"{interpreter} failed with exit code {done.returncode}")
            if numbers is None:
                return done.stdout.splitlines()[-1]
            with open(out, encoding="utf-8") as file:
                return file.read()


# Kept for as long as the add-on is loaded: a viewport asks for the same trees at every change of the scene.
SHARED = PythonTrees()
