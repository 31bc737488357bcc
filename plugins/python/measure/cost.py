"""What a call from Python costs beside the same loop in C++: python3 cost.py SCENE [MILLIONS]

Both are run in turn, and the processor time of all threads is compared: the least of each of some rounds.
"""

import sys
import time

import _loops
import numpy as np
import phasetree as pt


def least(calls, rounds=7):
    """The least processor time of each call, taken in turn."""
    best = [float("inf")] * len(calls)
    for _ in range(rounds):
        for i, call in enumerate(calls):
            began = time.process_time()
            call()
            best[i] = min(best[i], time.process_time() - began)
    return best


def main():
    shown = pt.load(sys.argv[1]).object
    count = int(float(sys.argv[2]) * 1e6) if len(sys.argv) > 2 else 1_000_000
    low, high = np.array(shown.bounds)
    generator = np.random.default_rng(1)
    points = generator.uniform(low, high, (count, 3)).astype(np.float32)
    directions = generator.normal(size=(count, 3)).astype(np.float32)
    shown.prepare()
    evaluator, prepared, columns = shown._evaluator, shown._prepared, len(shown.phases)
    for name, python, loop in (
        ("label", lambda: shown.label(points), lambda: _loops.label(evaluator, points)),
        ("phi", lambda: shown.phi(points), lambda: _loops.phi(evaluator, points, columns)),
        (
            "intersect",
            lambda: shown.intersect(points, directions),
            lambda: _loops.intersect(prepared, points, directions),
        ),
        ("trace", lambda: shown.trace(points, directions), lambda: _loops.trace(prepared, points, directions)),
    ):
        own, cpp = least((python, loop))
        print(f"{name}: {own:.3f} s from Python, {cpp:.3f} s in C++: {100 * (own / cpp - 1):+.1f} %")


if __name__ == "__main__":
    main()
