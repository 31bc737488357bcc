"""Finding the number for which a phase has a volume or mass."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from phasetree import _phasetree
from phasetree._errors import Error, interrupted
from phasetree._phases import Phase
from phasetree._trees import Object


class Solution(NamedTuple):
    """The result of solve: the number at which a volume or mass has the given value, with its guaranteed bounds.

    The arrays hold [low, high, estimate]. The measure is guaranteed to lie between low and high.
    """

    value: float  #: a number in the bracket at which the measure is close to the target
    low: float  #: the lower end of the bracket
    high: float  #: its upper end
    measure: np.ndarray  #: float64 (3): at the value; infinite if there was no time to measure it
    at_low: np.ndarray  #: float64 (3): at the lower end, certainly on one side of the target
    at_high: np.ndarray  #: float64 (3): at the upper end, certainly on the other
    stopped: str  #: "tolerance", "undecided" (32-bit coordinates allow no narrower bracket), "time" or "interrupted"
    measurements: int  #: how often an object was measured


def solve(make, target, low, high, phase=None, densities=None, tolerance=0, seconds=None, progress=None):
    """Finds the number between `low` and `high` for which a phase has a given volume or mass. Returns a Solution.

    make: a function that returns the object for a number. target: the volume, in cubed units of length; with densities,
    the mass. low, high: the first bracket, at whose ends the measure must be on different sides of the target. phase: a
    Phase or its name, by default all but the vacuum. densities: a dict from phases, or their names, to densities;
    phases that are not in it have no mass (unlike in Object.measure). tolerance: the width of the final bracket, by
    default a thousandth of the first. seconds: a time limit. progress: called with "solving" and an estimate of the
    fraction done.

    The bracket is halved repeatedly. An end moves only if the guaranteed interval of the measure lies entirely on one
    side of the target. The measure is therefore guaranteed to pass the target within the final bracket; it may do so
    several times.

    Raises Error if both ends are on the same side, or if an argument is out of its range. Ctrl-C raises Interrupted,
    whose `result` is the Solution with the bracket so far, or KeyboardInterrupt if there is none yet.
    """
    names = _object(make(float(low))).names
    wanted = names[1:] if phase is None else [_name(phase)]
    if densities is None:
        weights = dict.fromkeys(wanted, 1.0)
    else:
        given = {_name(p): float(d) for p, d in densities.items()}
        for name in given:
            _check(name, names)
        weights = {name: given[name] for name in wanted if name in given}
    for name in wanted:
        _check(name, names)

    def handle(number):
        object = _object(make(number))
        if object.names != names:
            there, here = ", ".join(names), ", ".join(object.names)
            raise Error(f"the object has the phases {there} for {low}, but {here} for {number}")
        return object._handle

    numbers = [(names.index(name), weight) for name, weight in weights.items()]
    seconds = None if seconds is None else float(seconds)
    try:
        found = _phasetree.solve(
            handle, numbers, float(target), float(low), float(high), float(tolerance), seconds, progress
        )
    except KeyboardInterrupt as e:
        raise interrupted(e, _bracket) from None
    stopped, best, first, last, undecided, count = found
    if stopped == "same side":
        raise Error(
            f"there is no bracket: the measure is {_interval(first)}, and {_interval(last)}; both are "
            f'{"less" if first[1][0, 1] < target else "more"} than {target:.9g}'
        )
    if best is None and stopped == "undecided":
        raise Error(
            f"there is no bracket: the measure is {_interval(undecided)}, which does not show on which side of "
            f"{target:.9g} it is; move this end farther away"
        )
    if best is None:
        raise Error("time ran out before both ends of the bracket were measured; allow more seconds")
    return Solution(best[0], first[0], last[0], best[1][0], first[1][0], last[1][0], stopped, count)


def _bracket(found):
    """The Solution so far; None if there is no bracket yet."""
    stopped, best, first, last, _, count = found
    if best is None or first is None or last is None:
        return None
    return Solution(best[0], first[0], last[0], best[1][0], first[1][0], last[1][0], stopped, count)


def _object(made):
    if not isinstance(made, Object):
        raise Error(f"the function must return an object of phases, but returned {made!r}")
    return made


def _name(phase):
    return phase.name if isinstance(phase, Phase) else phase


def _check(name, names):
    if name not in names[1:]:
        raise Error(f'the object has no phase {name!r} with a volume; it has {", ".join(names[1:])}')


def _interval(point):
    at, measure = point
    return f"from {measure[0, 0]:.9g} to {measure[0, 1]:.9g} at {at:.9g}"
