"""Intervals of volumes by `object.measure`, against those of random points in the same processor time.

    PYTHONPATH=build/release/plugins/python python3 benchmarks/measures.py [--tolerances 0.2,0.05] scenes/hourglass.json …

Prints a row for each scene and tolerance: for the largest phase, the width of the guaranteed interval, and the width of
the interval that contains the volume with a probability of 95 % if the share of random points is all that is known,
both as fractions of the volume; and the ratio of the second to the first.
"""

import argparse
import time

import numpy as np
import phasetree as pt

BLOCK = 1 << 17


def sampled(obj, phase, low, high, seconds):
    """The volume by random points, and the width of its interval."""
    rng = np.random.default_rng(1)
    inside = count = 0
    start = time.process_time()
    while count == 0 or time.process_time() - start < seconds:
        points = rng.uniform(low, high, (BLOCK, 3)).astype(np.float32)
        inside += int(np.count_nonzero(obj.label(points) == phase))
        count += BLOCK
    share = inside / count
    box = float(np.prod(np.subtract(high, low, dtype=float)))
    return box * share, 2 * 1.96 * box * np.sqrt(share * (1 - share) / count)


def rows(file, tolerances):
    obj = pt.load(file).object
    low, high = obj.bounds
    obj.label(np.zeros((1, 3), dtype=np.float32))  # records the program
    for tolerance in tolerances:
        start = time.process_time()
        m = obj.measure(tolerance=tolerance)
        seconds = time.process_time() - start
        largest = int(np.argmax(m.volume[:, 2]))
        below, above, estimate = m.volume[largest]
        other, width = sampled(obj, obj.names.index(m.names[largest]), low, high, seconds)
        yield m.names[largest], seconds, (above - below) / estimate, width / other


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--tolerances", default="0.2,0.05", help="of the volume, separated by commas (default: %(default)s)")
    parser.add_argument("scenes", nargs="+")
    chosen = parser.parse_args()
    tolerances = [float(t) for t in chosen.tolerances.split(",")]
    print("| scene | phase | seconds | guaranteed interval | random points, 95 % | ratio |\n|---|---|---|---|---|---|")
    for file in chosen.scenes:
        for name, seconds, certain, random in rows(file, tolerances):
            print(f"| {file} | {name} | {seconds:.2f} | {certain:.1e} | {random:.1e} | {random / certain:.2f} |", flush=True)


if __name__ == "__main__":
    main()
