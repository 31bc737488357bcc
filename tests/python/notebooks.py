"""The notebooks run, and the values of their last lines can be displayed. The short form solves for a level with
sixteen times the tolerance. In the long form, nbconvert also runs them as Jupyter does. The README's tentacle runs, too."""

import ast
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import unittest.mock

import numpy as np
import phasetree as pt
from support import ROOT, SCENES

os.environ.setdefault("MPLBACKEND", "Agg")
IS_LONG = bool(os.environ.get("PHASETREE_LONG_TESTS"))
NOTEBOOKS = sorted((SCENES / "notebooks").glob("*.ipynb"))


def shown(value):
    """As a notebook shows it: the first form that there is."""
    for form in ("_repr_html_", "_repr_png_"):
        made = getattr(value, form, lambda: None)()
        if made is not None:
            return made
    return repr(value)


def run_cell(source, names):
    """Runs a cell, whose last line is shown if it is an expression."""
    tree = ast.parse(source)
    last = tree.body.pop() if tree.body and isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, "cell", "exec"), names)
    if last:
        value = eval(compile(ast.Expression(last.value), "cell", "eval"), names)
        if value is not None:
            assert shown(value)


def solve_coarsely(*arguments, tolerance, solve=pt.solve, **settings):
    """pt.solve() with sixteen times the tolerance, which takes a fraction of the time."""
    return solve(*arguments, tolerance=16 * tolerance, **settings)


class Notebooks(unittest.TestCase):
    def test_there_are_five(self):
        self.assertEqual([p.stem for p in NOTEBOOKS], ["animation", "bottle", "first_steps", "hourglass", "study"])

    def test_cells_run(self):
        before = os.getcwd()
        self.addCleanup(os.chdir, before)
        os.chdir(SCENES / "notebooks")
        if not IS_LONG:
            coarse = unittest.mock.patch.object(pt, "solve", solve_coarsely)
            coarse.start()
            self.addCleanup(coarse.stop)
        for path in NOTEBOOKS:
            with self.subTest(path.stem):
                notebook = json.loads(path.read_text(encoding="utf-8"))
                self.assertEqual(notebook["nbformat"], 4)
                names = {"__name__": "__main__"}
                for cell in notebook["cells"]:
                    if cell["cell_type"] == "code":
                        self.assertEqual(cell["outputs"], [], "outputs are not kept")
                        run_cell("".join(cell["source"]), names)

    @unittest.skipUnless(IS_LONG, "a long form")
    def test_nbconvert_runs_them(self):
        for path in NOTEBOOKS:
            with self.subTest(path.stem), tempfile.TemporaryDirectory() as folder:
                subprocess.run(
                    [sys.executable, "-m", "nbconvert", "--to", "html", "--execute", "--output-dir", folder, str(path)],
                    check=True,
                )


class Tentacle(unittest.TestCase):
    """The sixty lines that the package's README shows."""

    @classmethod
    def setUpClass(cls):
        readme = (ROOT / "plugins/python/README.md").read_text(encoding="utf-8")
        (cls.text,) = (t for t in re.findall(r"^```python\n(.*?)^```$", readme, re.S | re.M) if "tentacle.png" in t)

    def test_they_are_the_script_and_sixty_at_most(self):
        self.assertEqual(self.text, (SCENES / "python/tentacle.py").read_text(encoding="utf-8"))
        self.assertLessEqual(len(self.text.splitlines()), 60)

    def test_they_make_a_tentacle_as_large_in_each_phase_as_that_of_the_gallery(self):
        names = {"__name__": "tentacle"}
        exec(self.text, names)
        made, other = names["tentacle"], pt.load(SCENES / "tentacle.json").object
        self.assertEqual(sorted(made.names), sorted(other.names))
        low, high = np.array(other.bounds)
        points = np.random.default_rng(1).uniform(low - 0.5, high + 0.5, (400_000 if IS_LONG else 60_000, 3)).astype(np.float32)
        for name in other.names[1:]:
            share, wanted = (np.mean(o.label(points) == o.index(name)) for o in (made, other))
            self.assertAlmostEqual(share / wanted, 1, delta=0.35, msg=name)
        # Each layer touches what is within it: along rays through the arm nothing is between skin, fat and flesh.
        crossings = made.trace(np.array([[-3, 0, z] for z in np.linspace(3, 5, 40)]), (1, 0, 0))
        met = [tuple(made.names[p] for p in pair) for pair in zip(crossings.before, crossings.after)]
        self.assertIn(("skin", "fat"), met)
        self.assertIn(("fat", "flesh"), met)
        self.assertFalse({("skin", "flesh"), ("fat", "vacuum")} & set(met))

    # documents/snippets runs these lines with a small picture.
    @unittest.skipUnless(IS_LONG, "a long form")
    def test_they_run_and_make_a_picture(self):
        with tempfile.TemporaryDirectory() as folder:
            script, picture = pathlib.Path(folder) / "tentacle.py", pathlib.Path(folder) / "tentacle.png"
            script.write_text(self.text, encoding="utf-8")
            subprocess.run([sys.executable, script, picture, "1"], check=True, cwd=folder, stderr=subprocess.DEVNULL)
            self.assertEqual(picture.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")


if __name__ == "__main__":
    unittest.main()
