"""Numbers found by solve: those of closed forms, within certain brackets; mistakes, exceptions and interruptions."""

import os
import signal
import threading
import unittest

import numpy as np
import phasetree as pt

IS_LONG = bool(os.environ.get("PHASETREE_LONG_TESTS"))
GLASS, WATER = pt.phase("glass"), pt.phase("water")


def filled(level):
    return WATER(pt.cylinder(1, 2)).intersect_shape(pt.plane(offset=level))


class Solutions(unittest.TestCase):
    def test_closed_forms(self):
        tolerance = 1e-3 if IS_LONG else 4e-3
        ball = pt.solve(lambda r: GLASS(pt.sphere(r)), 10, 1, 2, tolerance=tolerance)
        self.assertEqual(ball.stopped, "tolerance")
        self.assertLessEqual(ball.high - ball.low, tolerance)
        radius = (30 / (4 * np.pi)) ** (1 / 3)
        self.assertTrue(ball.low - 1e-6 <= radius <= ball.high + 1e-6)
        self.assertTrue(ball.low <= ball.value <= ball.high)
        self.assertLess(ball.at_low[1], 10)
        self.assertGreater(ball.at_high[0], 10)
        self.assertTrue(ball.measure[0] <= ball.measure[2] <= ball.measure[1])
        level = pt.solve(filled, np.pi, -0.9, 0.8, phase=WATER, tolerance=2 * tolerance)
        self.assertTrue(level.low - 1e-6 <= 0 <= level.high + 1e-6)
        self.assertLessEqual(level.high - level.low, 2 * tolerance)

    def test_masses(self):
        def beads(x):
            return pt.over(GLASS(pt.sphere(x)), WATER(pt.box([1, 1, 1]).translate([4, 0, 0])))

        total = pt.solve(beads, 2.5 * 4 / 3 * np.pi + 1, 0.5, 1.5, densities={"glass": 2.5, WATER: 1})
        self.assertTrue(total.low - 1e-6 <= 1 <= total.high + 1e-6)
        alone = pt.solve(beads, 2.5 * 4 / 3 * np.pi, 0.5, 1.6, "glass", {"glass": 2.5, WATER: 1})
        self.assertTrue(alone.low - 1e-6 <= 1 <= alone.high + 1e-6)

    def test_mistakes(self):
        for arguments, message in (
            (("x", 10, 1, 2), "'str' object is not callable"),
            ((lambda r: r, 10, 1, 2), "must return an object of phases"),
            ((filled, 1, 0.5, 0.9), "there is no bracket: .* both are more than 1$"),
            ((filled, 9, 0.5, 0.9), "there is no bracket: .* both are less than 9$"),
            ((filled, 1, 0.9, 0.5), "the lower one first"),
            ((filled, float("nan"), 0, 0.5), "target must be a finite number"),
            ((filled, 1, 0, 0.5, "oil"), "no phase 'oil'"),
            ((filled, 1, 0, 0.5, "vacuum"), "no phase 'vacuum' with a volume"),
            ((filled, 1, 0, 0.5, None, {"water": -1}), "must not be negative"),
            ((filled, 1, 0, 0.5, None, {}), "no phase has a positive weight"),
            ((filled, 1, 0, 0.5, None, None, -1), "width of the bracket"),
            ((filled, 1, 0, 0.5, None, None, 0, -1), "time must be a positive number"),
            ((lambda r: (GLASS if r < 1.2 else WATER)(pt.sphere(r)), 10, 1, 2), "the object has the phases vacuum, glass"),
        ):
            with self.subTest(message), self.assertRaisesRegex((pt.Error, TypeError), message):
                pt.solve(*arguments)

    def test_exceptions_of_the_function(self):
        def broken(x):
            if x > 1.2:
                raise KeyError("no such part")
            return GLASS(pt.sphere(x))

        with self.assertRaisesRegex(KeyError, "no such part"):
            pt.solve(broken, 10, 1, 2)

    def test_progress(self):
        told = []
        pt.solve(filled, 3, -0.9, 0.8, progress=lambda stage, share: told.append((stage, share)))
        self.assertLessEqual({stage for stage, _ in told if stage}, {"solving"})
        self.assertTrue(all(0 <= share <= 1 for _, share in told))

    def test_interruption(self):
        threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            while True:
                pt.solve(filled, 3, -0.9, 0.8, tolerance=1e-9)


if __name__ == "__main__":
    unittest.main()
