"""Measures: what is known in closed form lies in the intervals, and the command and Python agree."""

import json
import signal
import subprocess
import tempfile
import time
import unittest

import numpy as np
import phasetree as pt
from support import COMMAND

GLASS, WATER = pt.phase("glass"), pt.phase("water")


class Measures(unittest.TestCase):
    def setUp(self):
        self.object = pt.under(GLASS(pt.sphere(1).translate([0, 0, 3])), WATER(pt.box([1, 2, 0.5])))
        self.volumes = {"glass": 4 / 3 * np.pi, "water": 1.0}

    def test_intervals_contain_closed_forms(self):
        m = self.object.measure(tolerance=0.02)
        self.assertEqual((m.names, m.stopped), (("glass", "water"), "tolerance"))
        for name, (low, high, estimate) in zip(m.names, m.volume):
            self.assertLessEqual(low, self.volumes[name] * (1 + 1e-6))
            self.assertGreaterEqual(high, self.volumes[name] * (1 - 1e-6))
            self.assertLess(high - low, 0.02 * self.volumes[name])
            self.assertTrue(low <= estimate <= high)
        self.assertEqual(m.centre.shape, (2, 3, 3))
        self.assertEqual(m.inertia.shape, (2, 3, 3, 3))
        self.assertTrue((m.centre[0, 2, 0] <= 3 + 1e-6) and (m.centre[0, 2, 1] >= 3 - 1e-6))
        self.assertTrue((m.low[1, 1, 0] <= -1 + 1e-6) and (m.low[1, 1, 1] >= -1 - 1e-6))

    def test_densities(self):
        m = self.object.measure(tolerance=0.1, densities={GLASS: 2.5, "water": 0})
        np.testing.assert_allclose(m.mass[0], 2.5 * m.volume[0], rtol=1e-12)
        np.testing.assert_allclose(m.mass[1], 0, atol=1e-9)
        self.assertTrue(np.isinf(m.centre[1, :, :2]).all())

    def test_bad_arguments(self):
        for arguments, message in (
            ({"tolerance": 0}, "tolerance must be a positive number"),
            ({"tolerance": float("nan")}, "tolerance must be a positive number"),
            ({"seconds": -1}, "time must be a positive number"),
            ({"densities": {"gold": 1}}, "no phase 'gold'"),
            ({"densities": {"vacuum": 1}}, "vacuum has no density"),
            ({"densities": {"glass": -1}}, "must not be negative"),
        ):
            with self.subTest(arguments), self.assertRaisesRegex(pt.Error, message):
                self.object.measure(**arguments)
        with self.assertRaisesRegex(pt.Error, "unbounded"):
            GLASS(pt.plane()).measure()

    def test_progress(self):
        told = []
        self.object.measure(tolerance=0.003, progress=lambda stage, share: told.append((stage, share)))
        self.assertTrue(told)
        shares = [share for stage, share in told if stage]
        self.assertEqual({stage for stage, share in told if stage} - {"measuring"}, set())
        self.assertEqual(shares, sorted(shares))
        self.assertTrue(all(0 < share <= 1 for share in shares))

    def test_areas_and_thickness(self):
        m = self.object.measure(tolerance=0.05, areas=True)
        self.assertIsNone(m.thickness)
        for (area, error), exact in zip(m.area, (4 * np.pi, 7.0)):
            self.assertLess(abs(area - exact), 6 * error + 1e-6)
            self.assertLess(error, 0.06 * exact)
        np.testing.assert_array_equal(m.contact[0, 1:], m.area)
        np.testing.assert_array_equal(m.contact[1, 2], 0)
        np.testing.assert_array_equal(m.contact, m.contact.swapaxes(0, 1))
        m = WATER(pt.box([1, 2, 0.5])).measure(tolerance=0.1, seconds=4, thickness=True)
        self.assertIsNone(m.area)
        low, high = m.thickness[0]
        self.assertLessEqual(low, 0.5)
        self.assertGreaterEqual(high, 0.5)
        self.assertLess(high, 0.7)
        self.assertEqual(m.thinnest.shape, (1, 3))
        self.assertTrue((np.abs(m.thinnest[0]) <= (0.5, 1, 0.25)).all())

    def test_ctrl_c_at_any_moment_keeps_what_is_known(self):
        slow = GLASS(pt.sphere(1).displace(amplitude=0.1, scale=0.3, octaves=3))
        exact = slow.measure(tolerance=0.1).volume[0]
        calls = {
            "measure": lambda: slow.measure(tolerance=1e-9),
            "prove": lambda: slow.prove({"wall": {"phase": "glass", "at_least": 1.7}}, resolution=0.001),
            "solve": lambda: pt.solve(lambda r: GLASS(pt.sphere(r)), 1, 0.1, 2, tolerance=1e-12),
        }
        known = dict.fromkeys(calls, 0)
        for name, call in calls.items():
            for moment in (0.01, 0.05, 0.2, 0.6):
                sent = []

                def interrupt(*_):
                    sent.append(time.process_time())
                    raise KeyboardInterrupt

                before = signal.signal(signal.SIGALRM, interrupt)
                signal.setitimer(signal.ITIMER_REAL, moment)
                raised = None
                try:
                    call()
                except KeyboardInterrupt as e:
                    raised = e
                finally:
                    signal.setitimer(signal.ITIMER_REAL, 0)
                    signal.signal(signal.SIGALRM, before)
                if not sent:  # it ended before
                    continue
                self.assertIsNotNone(raised, (name, moment))
                # Processor time of all threads, so that a busy machine does not matter.
                self.assertLess(time.process_time() - sent[0], 1.5)
                if not isinstance(raised, pt.Interrupted):
                    continue
                known[name] += 1
                result = raised.result
                if name == "measure":
                    self.assertEqual(result.stopped, "interrupted")
                    self.assertTrue(result.volume[0, 0] <= exact[1] and result.volume[0, 1] >= exact[0])
                elif name == "prove":
                    self.assertEqual((result[0].verdict, result[0].reason), ("undecided", "interrupted"))
                else:
                    self.assertLess(result.at_low[1], 1)
                    self.assertGreater(result.at_high[0], 1)
        self.assertGreaterEqual(known["measure"], 3)
        self.assertGreaterEqual(known["prove"], 2)
        self.assertGreaterEqual(known["solve"], 1)

    def test_an_interruption_prints_what_is_known(self):
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            file.write(self.object.to_json())
            file.flush()
            run = subprocess.Popen(
                [COMMAND, "measure", file.name, "--tolerance", "1e-9", "--time", "5m", "--json"],
                stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
            )
            # The first line of progress appears once signals are handled and the work goes on for more than a second.
            self.assertIn("%", run.stderr.readline())
            run.send_signal(signal.SIGINT)
            out, err = run.communicate(timeout=120)
        self.assertEqual(run.returncode, 130)
        self.assertIn("interrupted", err)
        found = json.loads(out)
        self.assertEqual(found["stopped"], "interrupted")
        for phase in found["phases"]:
            self.assertLessEqual(phase["volume"]["low"], self.volumes[phase["name"]])
            self.assertGreaterEqual(phase["volume"]["high"], self.volumes[phase["name"]])

    def test_areas_end_with_the_time(self):
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            file.write(self.object.to_json())
            file.flush()
            run = [COMMAND, "measure", file.name, "--time", "0.000001"]
            found = subprocess.run([*run, "--json"], capture_output=True, text=True)
            table = subprocess.run(run, capture_output=True, text=True)
        for each in (found, table):
            self.assertEqual(each.returncode, 0)
            self.assertEqual(
                each.stderr,
                "phasetree: warning: areas are left out, because preparing the object takes more than 50 % of the time; "
                "allow more with --time\n",
            )
        measures = json.loads(found.stdout)
        self.assertEqual((measures["stopped"], measures["lines"], measures["contacts"]), ("time", 0, []))
        for phase in measures["phases"]:
            self.assertNotIn("area", phase)
            self.assertLessEqual(phase["volume"]["low"], self.volumes[phase["name"]])
            self.assertGreaterEqual(phase["volume"]["high"], self.volumes[phase["name"]])
        self.assertIn("time ran out", table.stdout)
        self.assertNotIn("contact", table.stdout)

    def test_the_command_rejects_bad_arguments(self):
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            file.write(self.object.to_json())
            file.flush()
            for argument, message in (
                (["--tolerance", "0"], "--tolerance: must be a number from 1e-09 to 1"),
                (["--tolerance", "-1"], "--tolerance: must be a number from 1e-09 to 1"),
                (["--tolerance", "nan"], "--tolerance: must be a number from 1e-09 to 1"),
                (["--time", "0"], '--time: must be a positive time such as 90s, 5m or 2h, but is "0"'),
                (["--time", "-1"], '--time: must be a positive time such as 90s, 5m or 2h, but is "-1"'),
                (["--time", "nan"], '--time: must be a positive time such as 90s, 5m or 2h, but is "nan"'),
                (["--density", "glass"], "--density: must be PHASE=VALUE"),
                (["--density", "glass=nan"], "--density: must be PHASE=VALUE"),
                (["--density", "vacuum=1"], "the vacuum has no density"),
                (["--density", "glass=1", "--density", "glass=2"], '"glass" has two densities'),
            ):
                with self.subTest(argument):
                    run = subprocess.run([COMMAND, "measure", file.name, *argument], capture_output=True, text=True)
                    self.assertEqual((run.returncode, run.stdout), (2, ""))
                    self.assertIn(message, run.stderr)

    def test_the_command_agrees(self):
        with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
            file.write(self.object.to_json())
            file.flush()
            run = [COMMAND, "measure", file.name, "--tolerance", "0.02", "--density", "glass=2.5"]
            found = json.loads(subprocess.run([*run, "--json"], capture_output=True, text=True, check=True).stdout)
            table = subprocess.run(run, capture_output=True, text=True, check=True).stdout
            wrong = subprocess.run([*run, "--density", "glas=1"], capture_output=True, text=True)
        m = self.object.measure(tolerance=0.02)
        self.assertEqual([p["name"] for p in found["phases"]], list(m.names))
        for phase, numbers in zip(found["phases"], m.volume):
            self.assertEqual([phase["volume"][k] for k in ("low", "high", "estimate")], list(numbers))
        areas = {p["name"]: p["area"] for p in found["phases"]}
        for name, area in (("glass", 4 * np.pi), ("water", 7.0)):
            self.assertLess(abs(areas[name]["estimate"] - area), 5 * areas[name]["standard_error"] + 1e-3 * area)
            self.assertLess(areas[name]["standard_error"], 0.03 * area)
        self.assertEqual([c["phases"] for c in found["contacts"]], [["vacuum", "glass"], ["vacuum", "water"]])
        self.assertIn("all volumes are within the tolerance", table)
        self.assertEqual(wrong.returncode, 2)
        self.assertIn('unknown phase "glas" (did you mean "glass"?)', wrong.stderr)


if __name__ == "__main__":
    unittest.main()
