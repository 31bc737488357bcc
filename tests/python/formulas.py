"""Formulas: arithmetic makes a field, what cannot be one is rejected with its place, and files say the same."""

import pathlib
import re
import shutil
import tempfile
import unittest

import numpy as np
import phasetree as pt
from support import run


class Formulas(unittest.TestCase):
    def setUp(self):
        self.x, self.y, self.z = pt.coordinates()
        self.points = np.random.default_rng(1).uniform(-1.4, 1.4, (2000, 3)).astype(np.float32)

    def test_arithmetic_is_numpy_s(self):
        x, y, z = self.x, self.y, self.z
        p = self.points.astype(np.float64)
        for make in (
            lambda m, x, y, z: m.sqrt(x**2 + y**2) - 1,
            lambda m, x, y, z: (x - 2) * (3 - y) / 7 + -z - 1.5e-3,
            lambda m, x, y, z: m.sin(3 * x) * m.cos(2 * y) + m.tan(z / 4) - m.tanh(x * y),
            lambda m, x, y, z: m.exp(-(x**2) - 2 * y**2) - abs(z),
            lambda m, x, y, z: 1 / (1.5 + x * x) - m.square(y) ** 2,
            lambda m, x, y, z: (x + 1.6) ** 0.5 + (y + 2) ** -2 - 2.0**2 * z**3,
        ):
            formula = make(pt, x, y, z)
            field = formula.within(-1.5, 1.5).field()
            expected = make(np, *p.T)
            value = field.distance(self.points)
            inside = np.abs(value) > 1e-4
            self.assertTrue((np.sign(value) == np.sign(expected))[inside & (expected < 0)].all(), formula)
            # Where the box does not take over the value is the formula's over one number.
            low, high = np.array(field.bounds)
            ratio = (expected / value)[((self.points > low + 0.1) & (self.points < high - 0.1)).all(axis=1) & (expected > 1e-2)]
            deep = (expected / value)[(expected < -1e-2) & (np.abs(self.points).max(axis=1) < 0.4)]
            together = np.concatenate([ratio[ratio > 0], deep[deep > 0]])
            self.assertGreater(np.mean(np.abs(together / np.max(together) - 1) < 1e-3), 0.3, formula)

    def test_numpy_s_functions_make_formulas(self):
        x, y, _ = self.x, self.y, self.z
        self.assertEqual(np.sqrt(x**2 + y**2).text, pt.sqrt(x**2 + y**2).text)
        self.assertEqual((np.float32(2) * x).text, (2 * x).text)
        self.assertEqual(np.minimum(x, y).text, pt.min(x, y).text)

    def test_formulas_stand_for_fields(self):
        x, y, z = self.x, self.y, self.z
        ball = pt.length(x, y, z) - 1
        glass = pt.phase("glass")
        points = self.points[np.abs(np.linalg.norm(self.points, axis=1) - 1) > 1e-4]
        self.assertTrue(np.array_equal(glass(ball).label(points), glass(pt.sphere(1)).label(points)))
        self.assertEqual((ball | pt.box((1, 1, 1))), pt.union(ball.field(), pt.box((1, 1, 1))))
        self.assertEqual(pt.box((1, 1, 1)) - ball, pt.difference(pt.box((1, 1, 1)), ball.field()))
        self.assertEqual(ball.translate((1, 0, 0)), pt.translate(ball.field(), (1, 0, 0)))
        self.assertEqual(pt.formula(ball), ball.field())
        self.assertEqual(pt.formula("length(x, y, z) - 1"), ball.field())
        with self.assertRaisesRegex(TypeError, "formula - field is ambiguous"):
            ball - pt.sphere(1)
        with self.assertRaises(TypeError):
            bool(ball)

    def test_what_is_shared_is_written_once(self):
        value = self.x
        for _ in range(40):
            value = value * value + 0.1
        self.assertLess(len(value.text), 2000)
        total = self.x
        for i in range(15):
            total = total + 0.01 * pt.cos(0.05 * i * self.y)
        self.assertLess(pt.formula(total, [(-1, -1, -1), (1, 1, 1)]).nodes, 2)

    def test_refused_with_reason_and_place(self):
        x, y, z = self.x, self.y, self.z
        for expected, call in (
            ("unbounded far from the origin; limit it with \"bounds\"", lambda: (x**2 + y**2 - 1).field()),
            ("divides by zero near", lambda: (1 / x).within(-1, 1).field()),
            ("is zero or negative near", lambda: pt.sqrt(x + y).within(-1, 1).field()),
            ('at "sqrt((x + y))"', lambda: (z - pt.sqrt(x + y)).within(-1, 1).field()),
            ('unknown name "q"', lambda: pt.formula("x + q")),
            ("exponent must be a number", lambda: x**y),
            ("whole number from -64 to 64", lambda: (x**0.3).within(0.1, 1).field()),
            ("must be finite", lambda: x * float("nan")),
            ("two corners", lambda: pt.formula("x", [(0, 0, 0)])),
            ("sin takes numbers", lambda: pt.sin("x")),
        ):
            with self.subTest(expected), self.assertRaisesRegex(pt.Error, re.escape(expected)):
                call()

    def test_files_say_the_same(self):
        folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        path = folder / "a.json"
        path.write_text('{"phases": {"a": 0}, "tree": {"set": {"phase": "a", "of": {"formula": "sqrt(x^2 + y^2) - 1"}}}}')
        made = pt.phase("a")(pt.sqrt(self.x**2 + self.y**2) - 1)
        self.assertTrue(np.array_equal(pt.load(path).object.phi(self.points), made.phi(self.points)))
        pt.Scene(made).save(folder / "b.json")
        self.assertEqual(pt.load(folder / "b.json").object, made)
        given = "\n".join(" ".join(map(repr, map(float, p))) for p in self.points[:50])
        said = [line.split(",")[3] for line in run("eval", path, given=given).splitlines()[1:]]
        self.assertEqual(said, [made.names[i] for i in made.label(self.points[:50])])

    def test_errors_in_files_name_the_column_within_the_text(self):
        folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        path = folder / "a.json"
        for text, column in (("x + q", 5), ('x +\\tq', 6), ("\\u0078 + q", 10), ("v = x; v * foo(y)", 12)):
            path.write_text('{"phases": {"a": 0}, "tree": {"set": {"phase": "a", "of":\n{"formula": "' + text + '"}}}}')
            with self.assertRaises(pt.SceneError) as caught:
                pt.load(path)
            self.assertEqual((caught.exception.line, caught.exception.column), (2, 13 + column), text)


if __name__ == "__main__":
    unittest.main()
