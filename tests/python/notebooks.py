"""The notebooks run, and what their last lines give can be shown. In the long form nbconvert runs them as Jupyter does."""

import ast
import json
import os
import subprocess
import sys
import tempfile
import unittest

from support import SCENES

os.environ.setdefault("MPLBACKEND", "Agg")
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


class Notebooks(unittest.TestCase):
    def test_there_are_four(self):
        self.assertEqual([p.stem for p in NOTEBOOKS], ["animation", "first_steps", "hourglass", "study"])

    def test_cells_run(self):
        before = os.getcwd()
        self.addCleanup(os.chdir, before)
        os.chdir(SCENES / "notebooks")
        for path in NOTEBOOKS:
            with self.subTest(path.stem):
                notebook = json.loads(path.read_text(encoding="utf-8"))
                self.assertEqual(notebook["nbformat"], 4)
                names = {"__name__": "__main__"}
                for cell in notebook["cells"]:
                    if cell["cell_type"] == "code":
                        self.assertEqual(cell["outputs"], [], "outputs are not kept")
                        run_cell("".join(cell["source"]), names)

    @unittest.skipUnless(os.environ.get("PHASETREE_LONG_TESTS"), "a long form")
    def test_nbconvert_runs_them(self):
        for path in NOTEBOOKS:
            with self.subTest(path.stem), tempfile.TemporaryDirectory() as folder:
                subprocess.run(
                    [sys.executable, "-m", "nbconvert", "--to", "html", "--execute", "--output-dir", folder, str(path)],
                    check=True,
                )


class Scripts(unittest.TestCase):
    def test_tentacle_has_the_labels_of_its_file(self):
        import numpy as np
        import phasetree as pt

        sys.path.insert(0, str(SCENES / "python"))
        import tentacle

        text = (SCENES / "python/tentacle.py").read_text(encoding="utf-8")
        self.assertLessEqual(len(text.splitlines()), 60)
        file = pt.load(SCENES / "tentacle.json").object
        low, high = np.array(file.bounds)
        points = np.random.default_rng(1).uniform(low, high, (200_000, 3)).astype(np.float32)
        self.assertEqual(tentacle.tentacle.names, file.names)
        self.assertTrue(np.array_equal(tentacle.tentacle.label(points), file.label(points)))
        self.assertEqual(tentacle.tentacle.phases, file_phases(SCENES / "tentacle.json"))


def file_phases(path):
    import phasetree as pt

    return pt.load(path).object.phases


if __name__ == "__main__":
    unittest.main()
