"""What fields and objects are joined by, and what is rejected."""

import unittest

import phasetree as pt
from phasetree import _phasetree


class Fields(unittest.TestCase):
    a, b, c = pt.sphere(1), pt.box((1, 1, 1)), pt.torus(1, 0.2)

    def test_operators_are_the_nodes(self):
        a, b, c = self.a, self.b, self.c
        self.assertEqual(a | b, pt.union(a, b))
        self.assertEqual(a & b, pt.intersection(a, b))
        self.assertEqual(a - b, pt.difference(a, b))
        self.assertEqual(a | b | c, pt.union(a, b, c))
        self.assertEqual((a | b) & c, pt.intersection(pt.union(a, b), c))
        self.assertEqual(a - b - c, pt.difference(pt.difference(a, b), c))

    def test_smooth_operators(self):
        a, b = self.a, self.b
        self.assertEqual(a.smooth(0.2) | b, pt.smooth_union(a, b, radius=0.2))
        self.assertEqual(a & b.smooth(0.2), pt.smooth_intersection(a, b, radius=0.2))
        self.assertEqual(a.smooth(0.2) - b.smooth(0.2), pt.smooth_difference(a, b, radius=0.2))
        # A smooth seam is one seam's, not the next one's.
        self.assertEqual((a.smooth(0.2) | b) | a, pt.union(pt.smooth_union(a, b, radius=0.2), a))
        with self.assertRaisesRegex(pt.Error, "0.2 and 0.3"):
            a.smooth(0.2) | b.smooth(0.3)
        with self.assertRaisesRegex(pt.Error, "positive"):
            a.smooth(0)

    def test_methods_are_the_functions(self):
        a = self.a
        self.assertEqual(a.translate((1, 0, 0)), pt.translate(a, (1, 0, 0)))
        self.assertEqual(a.twist(30), pt.twist(a, rate=30))
        self.assertEqual(a.rotate(30, axis=(1, 0, 0)), pt.rotate(a, 30, (1, 0, 0)))
        self.assertEqual(a.union(self.b, self.c), pt.union([a, self.b, self.c]))

    def test_long_chains_are_one_node(self):
        together = pt.sphere(1)
        for i in range(600):
            together = together | pt.sphere(1).translate((i, 0, 0))
        self.assertEqual(together.nodes, 1 + 600 + 601)
        self.assertEqual(together.bounds[1][0], 600)

    def test_hash_and_array_are_refused(self):
        import numpy as np

        with self.assertRaises(TypeError):
            np.zeros(3) | self.a
        with self.assertRaises(TypeError):
            self.a | 3


class Objects(unittest.TestCase):
    glass = pt.phase("glass", pt.clear(ior=1.5))
    water = pt.phase("water", pt.clear(ior=1.33))
    sand = pt.phase("sand", pt.diffuse((0.8, 0.7, 0.5)))

    def test_operators_of_fields_are_refused_with_names(self):
        a, b = self.glass(pt.sphere(1)), self.water(pt.box((1, 1, 1)))
        for sign, join in (
            ("|", lambda x, y: x | y),
            ("&", lambda x, y: x & y),
            ("-", lambda x, y: x - y),
        ):
            with self.assertRaises(TypeError) as caught:
                join(a, b)
            for text in (f'"{sign}"', '"glass"', '"water"', "a.over(b)"):
                self.assertIn(text, str(caught.exception))
            self.assertLess(str(caught.exception).index("glass"), str(caught.exception).index("water"))
            with self.assertRaisesRegex(TypeError, "a Field and an object of"):
                join(pt.sphere(1), a)
            with self.assertRaisesRegex(TypeError, "and a Field"):
                join(a, pt.sphere(1))

    def test_order_matters(self):
        a, b = self.glass(pt.sphere(1)), self.water(pt.box((1, 1, 1)))
        self.assertEqual([a.over(b).names[i] for i in a.over(b).label([(0, 0, 0.9), (0, 0, 0)])], ["glass"] * 2)
        under = a.under(b)
        self.assertEqual([under.names[i] for i in under.label([(0, 0, 0.9), (0, 0, 0)])], ["glass", "water"])

    def test_phases_are_found_by_name_in_any_order(self):
        a, b = self.glass(pt.sphere(1)), self.water(pt.box((1, 1, 1)))
        both, other = a.over(b), b.over(a)
        self.assertEqual(both.names, ("vacuum", "glass", "water"))
        self.assertEqual(other.names, ("vacuum", "water", "glass"))
        joined = both.translate((3, 0, 0)).over(other)
        self.assertEqual(joined.names, both.names)
        self.assertEqual([joined.names[i] for i in joined.label([(3, 0, 0), (0, 0, 0)])], ["glass", "water"])
        swapped = joined.with_phases(self.sand, self.water, self.glass)
        self.assertEqual(swapped.names, ("vacuum", "sand", "water", "glass"))
        self.assertEqual([swapped.names[i] for i in swapped.label([(3, 0, 0), (0, 0, 0)])], ["glass", "water"])
        self.assertEqual(swapped.with_phases(*joined.phases).label((3, 0, 0)), joined.label((3, 0, 0)))
        with self.assertRaisesRegex(pt.Error, '"glass", which is not among'):
            joined.with_phases(self.water)

    def test_renumbering_keeps_what_is_shared(self):
        ball = pt.sphere(1)
        shared = self.glass(ball)
        twice = shared.translate((1, 0, 0)).over(shared.translate((-1, 0, 0)))
        again = twice.with_phases(self.water, self.glass)
        self.assertEqual(again.nodes, twice.nodes)

    def test_two_materials_of_one_name_are_refused(self):
        other = pt.phase("glass", pt.clear(ior=1.6))
        with self.assertRaisesRegex(pt.Error, 'two phases "glass" with different materials'):
            self.glass(pt.sphere(1)).over(other(pt.sphere(2)))
        # One without a material takes that of the other.
        joined = pt.phase("glass")(pt.sphere(1)).over(self.glass(pt.sphere(2)))
        self.assertEqual(joined.phases[1], self.glass)

    def test_more_than_63_phases_are_refused(self):
        balls = [pt.phase(f"p{i}")(pt.sphere(1)) for i in range(64)]
        self.assertEqual(len(pt.over(balls[:63]).phases), 64)
        with self.assertRaisesRegex(pt.Error, "more than 63 phases"):
            pt.over(balls)

    def test_phases_by_name(self):
        both = self.glass(pt.sphere(2)).under(self.water(pt.sphere(1)))
        self.assertEqual(both.remove("water"), both.remove(self.water))
        with self.assertRaisesRegex(pt.Error, 'unknown phase "watr" .did you mean "water"'):
            both.remove("watr")


class Sentences(unittest.TestCase):
    """The errors are the reader's."""

    def test_both_spellings_of_names(self):
        self.assertEqual(repr(pt.balls(centers=[(0, 0, 0)], radii=1)), repr(pt.balls(centres=[(0, 0, 0)], radii=1)))
        self.assertEqual(repr(pt.materials.diffuse(colour=(1, 0, 0))), repr(pt.materials.diffuse(color=(1, 0, 0))))
        with self.assertRaisesRegex(TypeError, 'diffuse: "color" is given twice, in two spellings'):
            pt.materials.diffuse(colour=(1, 0, 0), color=(1, 0, 0))

    def test_errors(self):
        glass = pt.phase("glass")
        for expected, call in (
            ('sphere: "radius" must be positive, but is -1', lambda: pt.sphere(-1)),
            ('sphere: "radius" must be a number, but is a string', lambda: pt.sphere("large")),
            ('box: "size" must be', lambda: pt.box((1, 2))),
            ("sphere: missing a required argument: 'radius'", lambda: pt.sphere()),
            ('sphere: there is no parameter "raduis" (did you mean "radius"?)', lambda: pt.sphere(raduis=1)),
            ('sphere: "radius" must be a finite number, but is nan', lambda: pt.sphere(float("nan"))),
            ('translate: "by" must be [x, y, z] as one list or tuple, but is 1', lambda: pt.sphere(1).translate(1, 2, 3)),
            ('translate: "by" must be [x, y, z] as one list', lambda: glass(pt.sphere(1)).translate(by=1.5)),
            ('box: "size" must be [x, y, z] as one list', lambda: pt.box(1, 2, 3)),
            ('capsule: "to" must be [x, y, z] as one list', lambda: pt.capsule((0, 0, 0), 1, 0.1)),
            ('translate: "of" must be', lambda: pt.translate(3, (1, 0, 0))),
            ('"of" is an object of phases, but a plain field is required here', lambda: pt.shell(glass(pt.sphere(1)), 0.1)),
            ('"of[1]" is a plain field, but an object of phases is required', lambda: glass(pt.sphere(1)).over(pt.sphere(1))),
            ('unknown key "over" in "translate"', lambda: pt.sphere(1).translate((1, 0, 0), over=glass)),
            ("a phase cannot be in contact with itself", lambda: glass(pt.sphere(1)).contact(glass(pt.sphere(1)), glass, glass, 0.5)),
            ('the material of "x" must be a material such as', lambda: pt.phase("x", "glass")),
            ('"ior" must be', lambda: pt.clear(ior=0)),
            ("did you mean", lambda: pt.conductor(metal="cooper")),
            ("no such file", lambda: pt.siren("nowhere.json")),
        ):  # fmt: skip
            with self.subTest(expected):
                with self.assertRaises((pt.Error, TypeError)) as caught:
                    call()
                self.assertIn(expected.lower(), str(caught.exception).lower())

    def test_too_deep(self):
        field = pt.sphere(1)
        with self.assertRaisesRegex(pt.Error, "deeper than 400 nodes"):
            for _ in range(500):
                field = field.translate((0, 0, 0.001))

    def test_handles_are_immutable(self):
        phase = pt.phase("glass")
        with self.assertRaises(AttributeError):
            phase.name = "water"
        self.assertTrue(issubclass(pt.SceneError, pt.Error))
        self.assertIs(pt.Error, _phasetree.Error)


if __name__ == "__main__":
    unittest.main()
