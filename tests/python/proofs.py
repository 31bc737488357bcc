"""Statements about objects: verdicts, witnesses and intervals, and scenes that keep units, densities and statements."""

import json
import os
import tempfile
import unittest

import phasetree as pt

GLASS = pt.phase("glass", pt.clear(ior=1.5), 2500)
WATER = pt.phase("water", pt.clear(ior=1.33))


class Proofs(unittest.TestCase):
    def setUp(self):
        self.object = pt.sphere(1).thin_shell(GLASS, WATER, half_thickness=0.2)

    def test_verdicts(self):
        closed, leak, mass = self.object.prove(
            {"closed": {"walls": GLASS, "around": [WATER]}},
            {"closed": {"walls": ["water"], "around": "glass"}},
            {"mass": {"phase": "glass", "at_least": 1, "unit": "t"}},
            resolution=0.05,
        )
        self.assertEqual((closed.verdict, leak.verdict, mass.verdict), ("proved", "refuted", "proved"))
        self.assertEqual(leak.witnesses[0][1], "glass")
        self.assertEqual(leak.witnesses[-1][1], "vacuum")
        volume = 4 / 3 * 3.14159265 * (1.2**3 - 0.8**3)
        self.assertTrue(mass.interval[0] <= 2.5 * volume <= mass.interval[1])

    def test_mistakes(self):
        with self.assertRaisesRegex(pt.Error, "unknown phase"):
            self.object.prove({"present": {"phase": "glas"}})
        with self.assertRaisesRegex(pt.Error, "not set"):
            self.object.prove({"present": {"phase": {"glass"}}})
        with self.assertRaisesRegex(pt.Error, "the unit must be"):
            self.object.prove({"present": {"phase": "glass"}}, unit="ell")
        with self.assertRaisesRegex(pt.Error, "density"):
            pt.phase("glass", density=-1)

    def test_scenes_keep_them(self):
        expect = [{"present": {"phase": "glass"}}]
        scene = pt.Scene(self.object, unit="mm", expect=expect)
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "scene.json")
            scene.save(file)
            again = pt.load(file)
            with open(file, encoding="utf-8") as written:
                phases = json.load(written)["phases"]
        self.assertEqual(phases["glass"]["density"], 2500)
        self.assertEqual((again.unit, again.expect), ("mm", expect))
        self.assertEqual([p.density for p in again.phases], [None, 2500, None])
        self.assertEqual([p.material for p in again.phases], [None, GLASS.material, WATER.material])


if __name__ == "__main__":
    unittest.main()
