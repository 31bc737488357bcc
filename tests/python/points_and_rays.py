"""Arrays in and out: what the command says of the same points and rays, whatever the array is like."""

import csv
import io
import signal
import time
import unittest

import numpy as np
import phasetree as pt
from support import SCENES, gallery_scenes, gallery_scenes_for_the_command, object_of, run


def rows(text):
    return list(csv.DictReader(io.StringIO(text)))


def lines(array):
    """As the command reads them, to the last bit."""
    return "\n".join(" ".join(repr(float(v)) for v in row) for row in array)


def random_points(shown, count, seed):
    low, high = np.array(shown.bounds)
    low, high = np.maximum(low, -1e3), np.minimum(high, 1e3)
    return np.random.default_rng(seed).uniform(low - 0.1, high + 0.1, (count, 3)).astype(np.float32)


class Points(unittest.TestCase):
    def test_labels_and_distances_are_the_command_s(self):
        for path in gallery_scenes_for_the_command():
            shown = pt.load(path).object
            points = random_points(shown, 300, 1)
            said = rows(run("eval", path, given=lines(points)))
            self.assertEqual([shown.names[i] for i in shown.label(points)], [row["phase"] for row in said], path.name)
            phi = shown.phi(points)
            for i, name in enumerate(shown.names):
                column = [np.float32(row[f"phi.{name}"]) if row[f"phi.{name}"] else np.inf for row in said]
                # The command writes no negative zero.
                self.assertTrue(np.array_equal(phi[:, i] + 0.0, np.array(column, dtype=np.float32)), path.name)

    def test_labels_at_equal_distances_are_the_first_phase_s(self):
        a, b = pt.phase("a"), pt.phase("b")
        half = a(pt.box((1, 1, 1)).translate((-0.5, 0, 0))).over(b(pt.box((1, 1, 1)).translate((0.5, 0, 0))))
        points = np.zeros((9, 3), dtype=np.float32)
        points[:, 1] = np.linspace(-0.4, 0.4, 9)
        phi = half.phi(points)
        self.assertTrue(np.array_equal(half.label(points), np.argmin(phi, axis=1)))

    def test_shapes(self):
        ball = pt.phase("ball")(pt.sphere(1))
        self.assertEqual(ball.label((0, 0, 0)), 1)
        self.assertEqual(ball.label(np.zeros((2, 4, 3))).shape, (2, 4))
        self.assertEqual(ball.phi(np.zeros((2, 4, 3))).shape, (2, 4, 2))
        self.assertEqual(ball.gradient(np.zeros((5, 3))).shape, (5, 3))
        self.assertEqual(ball.label(np.zeros((0, 3))).shape, (0,))
        for shape in ((), (3, 2), (2,)):
            with self.assertRaisesRegex(pt.Error, "the shape"):
                ball.label(np.zeros(shape))
        hits = ball.intersect(np.zeros((2, 4, 3)), (0, 0, 1))
        self.assertEqual([a.shape for a in hits], [(2, 4), (2, 4), (2, 4), (2, 4, 3)])
        closest = ball.closest(np.zeros((2, 4, 3)))
        self.assertEqual([a.shape for a in closest], [(2, 4), (2, 4, 3), (2, 4), (2, 4)])
        self.assertEqual(pt.sphere(1).distance((0, 0, 3)), 2)
        self.assertEqual(ball.label([(0, 0, 0)]).dtype, np.uint8)
        self.assertEqual(ball.phi([(0, 0, 0)]).dtype, np.float32)

    def test_arrays_of_any_layout_are_the_same_points(self):
        shown = pt.load(SCENES / "hourglass.json").object
        points = random_points(shown, 1000, 2)
        label, phi = shown.label(points), shown.phi(points)
        for other in (
            points.astype(np.float64),
            np.asfortranarray(points),
            np.repeat(points, 2, axis=0)[::2],
            points[::-1][::-1],
            points.tolist(),
        ):
            self.assertTrue(np.array_equal(shown.label(other), label))
            self.assertTrue(np.array_equal(shown.phi(other), phi))
        read_only = points.copy()
        read_only.flags.writeable = False
        self.assertTrue(np.array_equal(shown.label(read_only), label))

    def test_contiguous_floats_are_used_in_place(self):
        points = np.zeros((1000, 3), dtype=np.float32)
        from phasetree import _trees

        array, _ = _trees._points(points)
        self.assertTrue(np.shares_memory(array, points))

    def test_what_is_not_finite(self):
        ball = pt.phase("ball")(pt.sphere(1))
        points = [(0, 0, 0), (np.nan, 0, 0), (0, np.inf, 0), (0, 0, 2)]
        self.assertEqual(ball.label(points).tolist(), [1, 0, 0, 0])
        self.assertTrue(np.array_equal(np.isnan(ball.phi(points)[:, 0]), [False, True, True, False]))
        self.assertTrue(np.isnan(ball.gradient(points)[1]).all())
        hits = ball.intersect(points, [(0, 0, 1)] * 4)
        self.assertEqual(np.isfinite(hits.t).tolist(), [True, False, False, False])
        closest = ball.closest(points)
        self.assertEqual(np.isfinite(closest.distance).tolist(), [True, False, False, True])

    def test_gradients_are_slopes(self):
        shown = pt.load(SCENES / "two_pears.json").object
        points = random_points(shown, 200, 3).astype(np.float64)
        gradient = shown.gradient(points)
        step = 1e-3
        label = shown.label(points)
        numeric = np.empty_like(gradient)
        for axis in range(3):
            up, down = points.copy(), points.copy()
            up[:, axis] += step
            down[:, axis] -= step
            difference = (shown.phi(up) - shown.phi(down)) / (2 * step)
            numeric[:, axis] = difference[np.arange(len(points)), label]
        # Beside a seam the two differ.
        self.assertGreater(np.mean(np.abs(gradient - numeric).max(axis=1) < 2e-2), 0.97)
        self.assertTrue((np.linalg.norm(gradient, axis=1) < 1 + 1e-5).all())
        glass = shown.phases[1]
        self.assertTrue(np.array_equal(shown.gradient(points, glass), shown.gradient(points, glass.name)))

    def test_field_is_the_distance_of_its_object(self):
        field = pt.sphere(1).smooth(0.3) | pt.box((1, 1, 1)).translate((1, 0, 0))
        points = np.random.default_rng(4).uniform(-2, 2, (500, 3)).astype(np.float32)
        self.assertTrue(np.array_equal(field.distance(points), pt.phase("a")(field).phi(points)[:, 1]))


class Rays(unittest.TestCase):
    def test_crossings_are_the_command_s(self):
        for name in ("hourglass", "drinks", "soap_film", "tentacle"):
            path = SCENES / f"{name}.json"
            shown = pt.load(path).object
            low, high = np.array(shown.bounds)
            generator = np.random.default_rng(5)
            origins = generator.uniform(low, high, (80, 3)).astype(np.float32)
            directions = (generator.normal(size=(80, 3)) * generator.uniform(0.1, 3, (80, 1))).astype(np.float32)
            found = shown.trace(origins, directions)
            said = rows(run("trace", path, given=lines(np.hstack([origins, directions]))))
            for i in range(len(origins)):
                own, its = found.of_ray(i), [row for row in said if row["ray"] == str(i)]
                self.assertEqual(shown.names[own.start[0]], its[0]["to"], (name, i))
                self.assertEqual([shown.names[p] for p in own.before], [row["from"] for row in its[1:]], (name, i))
                self.assertEqual([shown.names[p] for p in own.after], [row["to"] for row in its[1:]], (name, i))
                length = np.linalg.norm(directions[i])
                for t, row in zip(own.t, its[1:]):
                    # Both are within the resolution of the interface.
                    self.assertLess(abs(float(t) - float(row["t"])) * length, 4 * shown.resolution, (name, i))

    def test_arrays_of_crossings(self):
        glass, water = pt.phase("glass"), pt.phase("water")
        shown = pt.sphere(1).thin_shell(glass, water, 0.1)
        origins = np.array([(0, 0, -3), (0, 3, -3), (0, 0, 0)], dtype=np.float32)
        found = shown.trace(origins, (0, 0, 2))
        self.assertEqual(found.start.tolist(), [0, 0, 2])
        self.assertEqual(found.offsets.tolist(), [0, 4, 4, 6])
        self.assertEqual(found.ray.tolist(), [0, 0, 0, 0, 2, 2])
        self.assertEqual(found.before.tolist(), [0, 1, 2, 1, 2, 1])
        self.assertEqual(found.after.tolist(), [1, 2, 1, 0, 1, 0])
        self.assertTrue(np.allclose(found.t, [0.95, 1.05, 1.95, 2.05, 0.45, 0.55], atol=1e-5))
        self.assertTrue(np.allclose(found.normal[:, 2], 1, atol=1e-4))
        hits = shown.intersect(origins, (0, 0, 2))
        self.assertTrue(np.allclose(hits.t[[0, 2]], [0.95, 0.45], atol=1e-5))
        self.assertEqual(hits.t[1], np.inf)
        self.assertEqual(hits.after.tolist(), [1, 0, 1])
        closest = shown.closest(origins)
        self.assertTrue(np.allclose(closest.distance, [1.95 - 0.05, np.sqrt(18) - 1.05, 0.95 - 0.05 + 0.05], atol=0.05))

    def test_closest_is_nearly_the_least(self):
        ball = pt.phase("ball")(pt.sphere(1).translate((0.25, 0, 0)))
        points = np.random.default_rng(6).uniform(-2, 2, (200, 3)).astype(np.float32)
        exact = np.abs(np.linalg.norm(points - np.float32((0.25, 0, 0)), axis=1) - 1)
        closest = ball.closest(points, tolerance=0.01)
        self.assertTrue((closest.distance >= exact - 1e-4).all())
        self.assertTrue((closest.distance <= exact / 0.99 + 1e-4).all())
        self.assertTrue(np.allclose(np.linalg.norm(closest.point - points, axis=1), closest.distance, atol=1e-5))
        near = ball.closest(points, radius=0.1)
        self.assertTrue(np.array_equal(np.isfinite(near.distance), exact < 0.1))
        for wrong in (0, 2, np.nan):
            with self.assertRaisesRegex(pt.Error, "tolerance"):
                ball.closest(points, tolerance=wrong)

    def test_objects_that_cannot_be_traced(self):
        endless = pt.phase("a")(pt.plane())
        with self.assertRaisesRegex(pt.Error, r'unbounded because of its "plane" \(at set\.of\.plane\); intersect it'):
            endless.trace((0, 0, 1), (0, 0, -1))
        self.assertEqual(endless.label((0, 0, -1)), 1)

    def test_a_ray_without_direction_crosses_nothing(self):
        ball = pt.phase("ball")(pt.sphere(1))
        self.assertEqual(len(ball.trace([(0, 0, 0)], [(0, 0, 0)]).t), 0)


class DoublePrecision(unittest.TestCase):
    def test_points(self):
        ball = pt.phase("ball")(pt.sphere(1))
        self.assertEqual(ball.locate((0, 0, 1 - 1e-15)), 1)
        self.assertEqual(ball.locate((0, 0, 1 + 1e-15)), 0)
        self.assertEqual(ball.locate(np.zeros((2, 4, 3))).shape, (2, 4))
        self.assertEqual(ball.locate(np.zeros((2, 4, 3))).dtype, np.uint8)
        self.assertEqual(ball.locate([(np.nan, 0, 0), (0, 0, 0)]).tolist(), [0, 1])
        points = np.random.default_rng(9).uniform(-2, 2, (500, 3))
        exact, safe = np.abs(np.linalg.norm(points, axis=1) - 1), ball.safe_distance(points)
        self.assertEqual(safe.dtype, np.float64)
        self.assertTrue((safe <= exact).all() and (safe > exact * (1 - 1e-5) - 1e-12).all())
        self.assertTrue(np.isnan(ball.safe_distance((np.inf, 0, 0))))
        endless = pt.phase("a")(pt.plane())
        self.assertEqual(endless.locate((0, 0, -1e-12)), 1)
        self.assertAlmostEqual(endless.safe_distance((0, 0, -2)), 2, 4)
        with self.assertRaisesRegex(pt.Error, "the shape"):
            ball.locate(np.zeros(3)[:2])

    def test_crossings(self):
        glass, water = pt.phase("glass"), pt.phase("water")
        shown = pt.sphere(1).thin_shell(glass, water, 0.1)
        origins = np.array([(0, 0, -3), (0, 3, -3), (0, 0, 0)])
        found = shown.crossings(origins, (0, 0, 2))
        self.assertEqual(found.start.tolist(), [0, 0, 2])
        self.assertEqual(found.offsets.tolist(), [0, 4, 4, 6])
        self.assertEqual(found.before.tolist(), [0, 1, 2, 1, 2, 1])
        self.assertEqual(found.after.tolist(), [1, 2, 1, 0, 1, 0])
        wall = float(np.float32(0.1))
        exact = [(3 - 1 - wall) / 2, (3 - 1 + wall) / 2, (3 + 1 - wall) / 2, (3 + 1 + wall) / 2, (1 - wall) / 2, (1 + wall) / 2]
        self.assertTrue(np.allclose(found.t, exact, rtol=0, atol=1e-14))
        self.assertEqual((found.t.dtype, found.normal.dtype), (np.float64, np.float64))
        self.assertTrue(np.allclose(found.normal, (0, 0, 1), atol=1e-12))
        self.assertEqual(len(shown.crossings(origins, (0, 0, 2), limit=1).t), 3)
        self.assertEqual(len(shown.crossings(origins, (0, 0, 2), limit=[1, 1, 0.5]).t), 2)
        self.assertLess(shown.precise_resolution, 1e-8)

    def test_a_walk_chains(self):
        shown = pt.load(SCENES / "hourglass.json").object
        points = random_points(shown, 300, 10).astype(np.float64)
        directions = np.random.default_rng(11).normal(size=(300, 3))
        at_once = shown.crossings(points, directions)
        phase, found = shown.locate(points), [[] for _ in points]
        going = np.arange(len(points))
        while len(going):
            hit = shown.next_crossing(points[going], directions[going], phase[going])
            self.assertTrue(np.array_equal(hit.before, phase[going]))
            crosses = np.isfinite(hit.t)
            self.assertTrue(np.array_equal(shown.locate(hit.far[crosses]), hit.after[crosses]))
            self.assertTrue(np.isnan(hit.far[~crosses]).all())
            going = going[crosses]
            points[going], phase[going] = hit.far[crosses], hit.after[crosses]
            for i, after in zip(going, hit.after[crosses]):
                found[i].append(after)
        for i in range(len(points)):
            self.assertEqual(at_once.of_ray(i).after.tolist(), found[i])
        self.assertGreater(len(at_once.t), 300)

    def test_phases_of_rays(self):
        ball = pt.phase("ball")(pt.sphere(1))
        on = ball.next_crossing((0, 0, 1), (0, 0, -1), "ball")
        self.assertAlmostEqual(float(on.t), 2, 14)
        self.assertEqual(int(on.before), 1)
        shapes = [a.shape for a in ball.next_crossing(np.zeros((2, 4, 3)), (0, 0, 1), 1)]
        self.assertEqual(shapes, [(2, 4), (2, 4), (2, 4), (2, 4, 3), (2, 4, 3), (2, 4, 3)])
        none = ball.next_crossing((0, 0, 5), (0, 0, 1))
        self.assertEqual((float(none.t), int(none.before), int(none.after)), (np.inf, 0, 0))
        for phases, part in (([1, 2, 1], "phases must be 0 … 1"), (1.5, "integers"), ([1, 1], "have the shape"), ("glass", "no phase")):
            with self.assertRaisesRegex(pt.Error, part):
                ball.crossings(np.zeros((3, 3)), (0, 0, 1), phases)
        with self.assertRaisesRegex(pt.Error, "limit must be a number"):
            ball.crossings(np.zeros((3, 3)), (0, 0, 1), limit=[1, 2])
        with self.assertRaisesRegex(pt.Error, "unbounded"):
            pt.phase("a")(pt.plane()).crossings((0, 0, 1), (0, 0, -1))
        self.assertEqual(len(ball.crossings([(0, 0, 0), (np.nan, 0, 0)], [(0, 0, 0), (0, 0, 1)]).t), 0)


class LongCalls(unittest.TestCase):
    def test_a_signal_ends_a_call(self):
        shown = pt.load(SCENES / "tentacle.json").object
        points = random_points(shown, 400_000, 7)
        shown.prepare("low")
        directions = np.ones_like(points)
        for call in (
            lambda: [shown.label(points) for _ in range(100)],
            lambda: [shown.trace(points, directions) for _ in range(20)],
            lambda: [shown.crossings(points, directions) for _ in range(20)],
        ):
            was = signal.signal(signal.SIGALRM, signal.default_int_handler)
            began = time.monotonic()
            signal.setitimer(signal.ITIMER_REAL, 0.2)
            try:
                with self.assertRaises(KeyboardInterrupt):
                    call()
            finally:
                signal.setitimer(signal.ITIMER_REAL, 0)
                signal.signal(signal.SIGALRM, was)
            self.assertLess(time.monotonic() - began, 10)

    def test_other_threads_run_meanwhile(self):
        import threading

        shown = pt.load(SCENES / "tentacle.json").object
        points = random_points(shown, 200_000, 8)
        seen = []
        stop = threading.Event()

        def count():
            while not stop.is_set():
                seen.append(time.monotonic())
                time.sleep(0.001)

        thread = threading.Thread(target=count)
        thread.start()
        began = time.monotonic()
        shown.label(points)
        ended = time.monotonic()
        stop.set()
        thread.join()
        within = [t for t in seen if began < t < ended]
        self.assertGreater(len(within), 2, f"in {ended - began} s")


class Calls(unittest.TestCase):
    def test_gallery_by_calls_alone(self):
        """Scenes written again with the package's functions have the labels of their files."""
        for path in gallery_scenes():
            file = pt.load(path).object
            made = object_of(path)
            points = random_points(file, 200, 9)
            self.assertEqual(made.names, file.names)
            self.assertTrue(np.array_equal(made.phi(points), file.phi(points)), path.name)


if __name__ == "__main__":
    unittest.main()
