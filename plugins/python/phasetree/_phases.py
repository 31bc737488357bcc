"""Phases: the named materials of objects."""

from __future__ import annotations

from phasetree._errors import Error
from phasetree._parts import Part
from phasetree._registry import functions
from phasetree._values import Value


class Phase(Value):
    """A phase of an object: its name, its material and its density in kg/m³.

    phase(field, …) returns an object that has this phase wherever a field is negative. Two phases with the same name,
    material and density are equal. An object whose phases have no materials can be measured, but not rendered.
    """

    __slots__ = ("density", "material", "name")

    def __init__(self, name, material=None, density=None):
        if not isinstance(name, str) or not name:
            raise Error(f"a phase needs a name, but this is {name!r}")
        if name == "vacuum" and material is not None:
            raise Error('"vacuum" is predefined; choose another name for the phase')
        if material is not None and not (isinstance(material, Part) and material.chapter == "Materials"):
            raise Error(f'the material of "{name}" must be a material such as pt.clear(ior=1.5), but is {material!r}')
        if density is not None and not 0 <= float(density) <= 1e12:
            raise Error(f'the density of "{name}" must be from 0 to 1e12 kg/m³, but is {density!r}')
        object.__setattr__(self, "name", name)
        object.__setattr__(self, "material", material)
        object.__setattr__(self, "density", None if density is None else float(density))

    def __setattr__(self, name, value):
        raise AttributeError(f"a phase is immutable; to change its {name}, create another one")

    def _pickled(self):
        return self.name, self.material, self.density

    def __call__(self, *fields):
        """Returns an object that has this phase wherever a field is negative. Several fields are united."""
        if len(fields) == 1 and not isinstance(fields[0], (list, tuple)):
            return functions["set"](fields[0], self)
        return functions["set"](functions["union"](*fields), self)

    def __eq__(self, other):
        return isinstance(other, Phase) and self._pickled() == other._pickled()

    def __hash__(self):
        return hash(self.name)

    def __repr__(self):
        density = "" if self.density is None else f", density={self.density!r}"
        material = "" if self.material is None else f", {self.material!r}"
        return f"pt.phase({self.name!r}{material}{density})"


def phase(name, material=None, density=None):
    """Returns the phase with this name, material and density in kg/m³: pt.phase("glass", pt.clear(ior=1.5), 2500)."""
    if name == "vacuum":
        raise Error('"vacuum" is predefined; choose another name for the phase')
    return Phase(name, material, density)


vacuum = Phase("vacuum")


max_phases = 64  # including the vacuum


def merged(*several):
    """Merges lists of phases. The vacuum comes first, then the phases in the order in which they first appear."""
    found = {"vacuum": vacuum}
    for phases in several:
        for one in phases:
            known = found.setdefault(one.name, one)
            for what in ("material", "density"):
                here, there = getattr(known, what), getattr(one, what)
                if None not in (here, there) and here != there:
                    plural = "materials" if what == "material" else "densities"
                    raise Error(f'there are two phases "{one.name}" with different {plural}')
            if known == vacuum:
                continue
            material = one.material if known.material is None else known.material
            density = one.density if known.density is None else known.density
            if (material, density) != (known.material, known.density):
                found[one.name] = Phase(one.name, material, density)
    if len(found) > max_phases:
        raise Error(f"more than {max_phases - 1} phases in one object")
    return tuple(found.values())
