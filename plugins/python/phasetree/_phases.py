"""Phases: the named materials of objects."""

from __future__ import annotations

from phasetree._errors import Error
from phasetree._parts import Part
from phasetree._registry import functions
from phasetree._values import Value


class Phase(Value):
    """A phase of an object: its name and its material.

    phase(field, …) returns an object that has this phase wherever a field is negative. Two phases with the same name
    and the same material are equal. An object whose phases have no materials can be measured, but not rendered.
    """

    __slots__ = ("material", "name")

    def __init__(self, name, material=None):
        if not isinstance(name, str) or not name:
            raise Error(f"a phase needs a name, but this is {name!r}")
        if name == "vacuum" and material is not None:
            raise Error('"vacuum" is always there and cannot be a phase of one\'s own')
        if material is not None and not (isinstance(material, Part) and material.chapter == "Materials"):
            raise Error(f'the material of "{name}" must be one, such as pt.clear(ior=1.5), but is {material!r}')
        object.__setattr__(self, "name", name)
        object.__setattr__(self, "material", material)

    def __setattr__(self, name, value):
        raise AttributeError(f"a phase cannot be changed; make another one for another {name}")

    def _pickled(self):
        return self.name, self.material

    def __call__(self, *fields):
        """Returns an object that has this phase wherever a field is negative. Several fields are united."""
        if len(fields) == 1 and not isinstance(fields[0], (list, tuple)):
            return functions["set"](fields[0], self)
        return functions["set"](functions["union"](*fields), self)

    def __eq__(self, other):
        return isinstance(other, Phase) and self.name == other.name and self.material == other.material

    def __hash__(self):
        return hash(self.name)

    def __repr__(self):
        return f"pt.phase({self.name!r})" if self.material is None else f"pt.phase({self.name!r}, {self.material!r})"


def phase(name, material=None):
    """Returns the phase with this name and material: pt.phase("glass", pt.clear(ior=1.5))."""
    if name == "vacuum":
        raise Error('"vacuum" is always there and cannot be a phase of one\'s own')
    return Phase(name, material)


vacuum = Phase("vacuum")


most = 64  # the vacuum among them


def merged(*several):
    """Merges lists of phases. The vacuum comes first, then the phases in the order in which they first appear."""
    found = {"vacuum": vacuum}
    for phases in several:
        for one in phases:
            known = found.setdefault(one.name, one)
            if known.material is None and one.material is not None:
                found[one.name] = one
            elif one.material is not None and known.material != one.material:
                raise Error(f'there are two phases "{one.name}" with different materials')
    if len(found) > most:
        raise Error(f"more than {most - 1} phases in one object")
    return tuple(found.values())
