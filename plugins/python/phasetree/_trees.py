"""Fields, objects of phases, and the functions and methods generated from the list of nodes that make them."""

from __future__ import annotations

import json
from typing import NamedTuple

import numpy as np

from phasetree import _phasetree, _reference
from phasetree._errors import Error, Interrupted, interrupted
from phasetree._formula import Expression
from phasetree._phases import Phase, merged, vacuum
from phasetree._registry import classes, functions
from phasetree._values import Value


def _points(values, what="the points", dtype=np.float32):
    """The points as a contiguous array (N, 3), without a copy if possible, and the leading shape."""
    array = np.ascontiguousarray(values, dtype=dtype)
    if array.ndim == 0 or array.shape[-1] != 3:
        raise Error(f"{what} must have the shape (…, 3), but have {array.shape}")
    return array.reshape(-1, 3), array.shape[:-1]


class Crossings(NamedTuple):
    """Every crossing along some rays. Those of ray i have the indices offsets[i] to offsets[i + 1] − 1."""

    start: np.ndarray  #: uint8 (N): the phase at each ray's origin
    offsets: np.ndarray  #: int64 (N + 1)
    t: np.ndarray  #: float32 (M), or float64 by Object.crossings: the crossing is at origin + t·direction
    before: np.ndarray  #: uint8 (M): the phase that the ray leaves
    after: np.ndarray  #: uint8 (M): the phase that the ray enters
    normal: np.ndarray  #: (M, 3), of the type of t: the unit normal, from `before` into `after`

    @property
    def ray(self):
        """The index of the ray of each crossing."""
        return np.repeat(np.arange(len(self.start)), np.diff(self.offsets))

    def of_ray(self, i):
        """The crossings along one ray."""
        if not -len(self.start) <= i < len(self.start):
            raise IndexError(f"there are {len(self.start)} rays")
        i %= len(self.start)
        part = slice(self.offsets[i], self.offsets[i + 1])
        found = self.offsets[i : i + 2] - self.offsets[i]
        arrays = (a[part] for a in (self.t, self.before, self.after, self.normal))
        return Crossings(self.start[i : i + 1], found, *arrays)


class Hits(NamedTuple):
    """The first crossing along each ray. If there is none, t is infinite and `after` is the phase at the origin."""

    t: np.ndarray
    before: np.ndarray
    after: np.ndarray
    normal: np.ndarray


class NextCrossings(NamedTuple):
    """The next crossing along each ray in double precision; see Object.next_crossing.

    If there is none, t is infinite, `near` and `far` are NaN, the normal is zero, and `before` and `after` are the phase
    that the ray is in.
    """

    t: np.ndarray  #: float64 (…): the crossing is at origin + t·direction
    before: np.ndarray  #: uint8 (…): the phase that the ray leaves
    after: np.ndarray  #: uint8 (…): the phase that the ray enters
    normal: np.ndarray  #: float64 (…, 3): the unit normal, from `before` into `after`
    near: np.ndarray  #: float64 (…, 3): the point before the crossing, where a reflected ray starts, in `before`
    far: np.ndarray  #: float64 (…, 3): the point just past the crossing, where the ray continues, in `after`


class Closest(NamedTuple):
    """The closest interface to each point. If there is none, the distance is infinite and the point NaN."""

    distance: np.ndarray
    point: np.ndarray
    before: np.ndarray  #: the phase on the side of the query point
    after: np.ndarray  #: the phase on the other side


class PhaseMesh(NamedTuple):
    """The interfaces of an object as triangles with shared vertices; see Object.mesh."""

    vertices: np.ndarray  #: float32 (N, 3)
    triangles: np.ndarray  #: uint32 (M, 3): counterclockwise as seen from the phase in front
    behind: np.ndarray  #: uint8 (M): the phase behind, which has the higher number
    front: np.ndarray  #: uint8 (M): the phase in front
    names: tuple[str, ...]  #: the names of the phases
    spacing: float  #: the distance between grid points
    crossings: int  #: the number of crossings along the lines of the grid
    skipped: int  #: how many are missing: at edges, and where a phase is thinner than the spacing

    def surface(self, *phases):
        """The surface around some phases together, each given as a Phase or by name. Returns (vertices, triangles).

        The surface is closed, and its triangles are counterclockwise as seen from outside. The surface of a single
        phase, or of all phases except the vacuum, is a manifold.
        """
        wanted = np.zeros(len(self.names), dtype=bool)
        for phase in phases:
            name = phase.name if isinstance(phase, Phase) else phase
            if name not in self.names:
                raise Error(f'the object has no phase {name!r}; it has {", ".join(self.names)}')
            wanted[self.names.index(name)] = True
        bounds = wanted[self.behind] != wanted[self.front]
        triangles = self.triangles[bounds]
        inward = wanted[self.front[bounds]]
        triangles[inward] = triangles[inward][:, ::-1]
        used, numbers = np.unique(triangles, return_inverse=True)
        return self.vertices[used], numbers.reshape(triangles.shape).astype(np.uint32)


class Measures(NamedTuple):
    """Volumes, masses and moments of the phases of an object; see Object.measure.

    The last axis of each array up to `high` holds [low, high, estimate]. The number is guaranteed to lie between low
    and high. Areas are statistical estimates. Lengths are in the unit of the scene, usually metres.
    """

    names: tuple[str, ...]  #: the names of the N phases, without the vacuum
    volume: np.ndarray  #: float64 (N, 3)
    mass: np.ndarray  #: float64 (N, 3): the volume times the density, which is 1 by default
    centre: np.ndarray  #: float64 (N, 3, 3): x, y and z of the centre of mass; infinite if the phase may be empty
    inertia: np.ndarray  #: float64 (N, 3, 3, 3): the tensor of inertia about the centre of mass
    low: np.ndarray  #: float64 (N, 3, 3): the smallest x, y and z of the phase
    high: np.ndarray  #: float64 (N, 3, 3): the largest x, y and z of the phase
    stopped: str  #: "tolerance", "precision" (32-bit coordinates allow no better), "time", "boxes" (too many) or "interrupted"
    boxes: int  #: the number of boxes examined
    area: np.ndarray | None = None  #: with areas=True, float64 (N, 2): the area of the surface, and its standard error
    #: With areas=True, float64 (N + 1, N + 1, 2): the area of contact of two phases, the vacuum first, and its error.
    contact: np.ndarray | None = None
    #: With thickness=True, float64 (N, 2): the phase is certainly nowhere thinner than the first, but somewhere thinner
    #: than the second; (0, inf) if nothing is known.
    thickness: np.ndarray | None = None
    thinnest: np.ndarray | None = None  #: with thickness=True, float64 (N, 3): where; nan if unknown


class Proof(NamedTuple):
    """What is known of a statement about an object; see Object.prove."""

    verdict: str  #: "proved", "refuted" or "undecided"
    reason: str  #: why, in words; may be empty
    witnesses: list  #: points that show it: ((x, y, z), name of the phase that certainly is there)
    resolution: float  #: the side of the smallest boxes that were examined; 0 for statements about volumes and masses
    interval: tuple | None  #: (low, high) of a volume or mass, in the unit of the statement


def node_of(handle, phases):
    """The JSON of a field's node, with references to shapes expanded."""
    scene = _phasetree.value_of(handle.text(phases))
    shapes = scene.get("shapes", {})

    def whole(value):
        if isinstance(value, str) and value in shapes:
            return whole(shapes[value])
        if isinstance(value, dict):
            return {key: whole(v) for key, v in value.items()}
        return [whole(v) for v in value] if isinstance(value, list) else value

    return whole(scene["tree"]["set"]["of"])


class Field(Value):
    """A signed distance, negative inside. Immutable.

    a | b is the union, a & b the intersection, a - b the difference. a.smooth(r) | b, and likewise & and -, rounds the
    seam with the radius r. Nodes whose first parameter is a field are also methods: a.translate((0, 0, 1)).
    """

    __slots__ = ("_evaluator_", "_handle_", "_joined", "_phases_", "_radius")
    # NumPy leaves operators between an array and a field to the field, which refuses them.
    __array_ufunc__ = None

    def __init__(self, handle, phases=(vacuum,), radius=None):
        self._handle_ = handle
        self._phases_ = phases  # the phases of the objects in it; usually only the vacuum
        self._joined = None  # (kind, fields) of a | b | c until the handle is asked for
        self._radius = radius
        self._evaluator_ = None

    @property
    def _handle(self):
        if self._handle_ is None:
            kind, fields = self._joined
            made = functions[kind](*fields)
            self._handle_, self._phases_ = made._handle_, made._phases_
        return self._handle_

    @property
    def _phases(self):
        return self._phases_ if self._handle else ()

    def _pickled(self):
        return self._text, self._phases, self._radius

    @classmethod
    def _unpickled(cls, text, phases, radius):
        return cls(_phasetree.field_of_text(text), phases, radius)

    @property
    def _text(self):
        return self._handle.text([p.name for p in self._phases[1:]] or ["phase"])

    def written(self):
        """The node as JSON."""
        return node_of(self._handle, [p.name for p in self._phases[1:]] or ["phase"])

    @property
    def _evaluator(self):
        if self._evaluator_ is None:
            self._evaluator_ = _phasetree.Evaluator(self._handle)
        return self._evaluator_

    def smooth(self, radius):
        """The same field, but the next |, & or - with it rounds the seam with this radius."""
        radius = float(radius)
        if not 0 < radius < float("inf"):
            raise Error(f"the radius of a smooth seam must be positive, but is {radius}")
        return Field(self._handle, self._phases, radius)

    def _with(self, other, sign, sharp, smooth):
        other = other.field() if isinstance(other, Expression) else other
        if isinstance(other, Object) or not isinstance(other, Field):
            return NotImplemented if not isinstance(other, Object) else other._refuse(self, sign)
        radii = {r for r in (self._radius, other._radius) if r is not None}
        if len(radii) > 1:
            raise Error(f'both sides of "{sign}" are smooth, with the radii {self._radius} and {other._radius}')
        if radii:
            return functions[smooth](self, other, radius=radii.pop())
        if sign == "-":
            return functions[sharp](self, other)
        # A long chain is one node, not a deep tree.
        before = self._joined[1] if self._joined and self._joined[0] == sharp else (self,)
        result = Field(None)
        result._joined = (sharp, (*before, other))
        return result

    def __or__(self, other):
        return self._with(other, "|", "union", "smooth_union")

    def __and__(self, other):
        return self._with(other, "&", "intersection", "smooth_intersection")

    def __sub__(self, other):
        return self._with(other, "-", "difference", "smooth_difference")

    def distance(self, points):
        """The signed distance at points given as an array of shape (…, 3): float32, negative inside."""
        array, shape = _points(points)
        return self._evaluator.component(array, 1).reshape(shape)[()]

    def gradient(self, points):
        """The gradient of the distance at points: float32 (…, 3)."""
        array, shape = _points(points)
        return self._evaluator.gradient(array, 1).reshape(*shape, 3)

    @property
    def bounds(self):
        """A box around the points that are not outside: (low, high). Infinite where unbounded; None if empty."""
        return self._handle.bounds

    @property
    def nodes(self):
        """The number of nodes; those that are shared count once."""
        return self._handle.nodes

    def to_json(self):
        """The field as text for a scene file, with its shared shapes."""
        tree = json.loads(self._text)
        node = tree["tree"]["set"]["of"]
        return json.dumps({"shapes": tree["shapes"], "of": node} if "shapes" in tree else node)

    def __eq__(self, other):
        return isinstance(other, Field) and (
            self._handle.is_same(other._handle) or self._text == other._text
        )

    __hash__ = None

    def __repr__(self):
        text = self.to_json()
        return f"<Field {text if len(text) <= 100 else text[:97] + '…'}>"


def _name_of_phase(value):
    """The JSON for a Phase in a statement: its name."""
    if isinstance(value, Phase):
        return value.name
    raise Error(f"statements contain phases, names and numbers, not {type(value).__name__}")


class Object(Value):
    """An object of several phases. Every point is in exactly one of them. Immutable.

    Objects are joined with methods rather than operators, because the order matters: a.over(b), a.under(b),
    a.contact(b, …). Arrays identify phases by their index in `phases`.

    label, trace and intersect work in single precision. locate, crossings and next_crossing are their counterparts in
    double precision.
    """

    __slots__ = ("_evaluator_", "_handle", "_precise_", "_precise_evaluator_", "_prepared_", "phases")
    __array_ufunc__ = None

    def __init__(self, handle, phases):
        self._handle = handle
        self.phases = phases
        self._evaluator_ = None
        self._prepared_ = None
        self._precise_ = None
        self._precise_evaluator_ = None

    @property
    def _phases(self):
        return self.phases

    def _pickled(self):
        return self._handle.text(self._materials, ["null"] * len(self._materials)), self.phases

    @classmethod
    def _unpickled(cls, text, phases):
        handle, _ = _phasetree.read_text(text, "<pickle>")
        return cls(handle, phases)

    @property
    def names(self):
        """The names of the phases, the vacuum first."""
        return tuple(p.name for p in self.phases)

    @property
    def _materials(self):
        return [p.name for p in self.phases[1:]]

    def _refuse(self, other, sign, swapped=True):
        a, b = (other, self) if swapped else (self, other)
        raise TypeError(
            f'"{sign}" combines fields, but the operands are {_named(a)} and {_named(b)}. For objects, the order '
            "matters: use a.over(b), a.under(b), a.contact(b, …), or a.unite_shape_below(…) with a field"
        )

    def __or__(self, other):
        return self._refuse(other, "|", False)

    def __and__(self, other):
        return self._refuse(other, "&", False)

    def __sub__(self, other):
        return self._refuse(other, "-", False)

    def __ror__(self, other):
        return self._refuse(other, "|")

    def __rand__(self, other):
        return self._refuse(other, "&")

    def __rsub__(self, other):
        return self._refuse(other, "-")

    def with_phases(self, *phases):
        """The same object with its phases in this order. Where two phases have the same distance, the first one wins.

        The list must contain all phases of the object, and may contain others. A material given here replaces the
        phase's own.
        """
        wanted = (vacuum, *(p for p in phases if p != vacuum))
        numbers = {}
        for i, p in enumerate(wanted):
            if not isinstance(p, Phase):
                raise Error(f"{p!r} is not a phase")
            if p.name in numbers:
                raise Error(f'"{p.name}" is listed twice')
            numbers[p.name] = i
        used = self._handle.phases
        kept = []
        for i, p in enumerate(self.phases):
            if p.name not in numbers and i in used:
                raise Error(f'the object has the phase "{p.name}", which is not among those given')
            kept.append(numbers.get(p.name))
        spare = iter(sorted(set(range(len(wanted), len(wanted) + len(kept)))))
        handle = self._handle.renumbered([next(spare) if i is None else i for i in kept])
        return Object(handle, wanted)

    @property
    def _evaluator(self):
        if self._evaluator_ is None:
            self._evaluator_ = _phasetree.Evaluator(self._handle)
        return self._evaluator_

    @property
    def _precise_evaluator(self):
        if self._precise_evaluator_ is None:
            self._precise_evaluator_ = _phasetree.PreciseEvaluator(self._handle)
        return self._precise_evaluator_

    def label(self, points):
        """The phase at points given as an array of shape (…, 3): uint8, an index into `phases`.

        A contiguous float32 array is not copied. Points with infinite or NaN coordinates are in the vacuum.
        """
        array, shape = _points(points)
        return self._evaluator.label(array).reshape(shape)[()]

    def phi(self, points):
        """Φ at points: float32 (…, phases), the signed distance to each phase, negative in the phase.

        Column i is for phases[i]. It is infinite if the object does not have that phase anywhere.
        """
        array, shape = _points(points)
        return self._evaluator.phi(array, len(self.phases)).reshape(*shape, len(self.phases))

    def gradient(self, points, phase=None):
        """The gradient of the distance to a phase, at points. By default, of the phase in which each point lies."""
        array, shape = _points(points)
        return self._evaluator.gradient(array, self.index(phase) if phase is not None else -1).reshape(*shape, 3)

    def index(self, phase):
        """The index of a phase in arrays. The phase is given as a Phase or by name."""
        name = phase.name if isinstance(phase, Phase) else phase
        if name not in self.names:
            raise Error(f'the object has no phase {name!r}; it has {", ".join(self.names)}')
        return self.names.index(name)

    def prepare(self, quality="medium", resolution=0, progress=None):
        """Builds the cells in which rays are traced. If this is not called, the first ray builds them.

        quality: "low" builds faster and traces more slowly. resolution: phases thinner than this along a ray may be
        missed. 0 selects 2·10⁻⁶ of the diagonal, or 10⁻⁶ of the largest coordinate if that is more.
        progress: called with "preparing" and the fraction done, up to 1.
        """
        if quality not in ("low", "medium"):
            raise Error(f'the quality must be "low" or "medium", but is {quality!r}')
        self._prepared_ = _phasetree.PreparedObject(self._handle, quality == "low", resolution, progress)
        return self

    @property
    def _prepared(self):
        if self._prepared_ is None:
            self.prepare()
        return self._prepared_

    @property
    def resolution(self):
        """Phases thinner than this along a ray may be missed. A grazing ray may also miss slightly thicker ones."""
        return self._prepared.resolution

    def trace(self, origins, directions):
        """Every crossing along rays, which are given as arrays of shape (…, 3). Returns Crossings."""
        origins, directions, _ = _rays(origins, directions)
        return Crossings(*self._prepared.trace(origins, directions))

    def intersect(self, origins, directions):
        """The first crossing along each ray; the rays are given as arrays of shape (…, 3). Returns Hits."""
        origins, directions, shape = _rays(origins, directions)
        t, before, after, normal = self._prepared.intersect(origins, directions)
        return Hits(t.reshape(shape), before.reshape(shape), after.reshape(shape), normal.reshape(*shape, 3))

    def closest(self, points, radius=float("inf"), tolerance=0.01):
        """The closest interface to each point, within a radius. Returns Closest.

        tolerance: the accepted relative error of the distance.
        """
        array, shape = _points(points)
        distance, point, before, after = self._prepared.closest(array, radius, tolerance)
        return Closest(distance.reshape(shape), point.reshape(*shape, 3), before.reshape(shape), after.reshape(shape))

    @property
    def _precise(self):
        if self._precise_ is None:
            self._precise_ = _phasetree.PreciseTracer(self._handle, 0)
        return self._precise_

    @property
    def precise_resolution(self):
        """Phases thinner than this along a ray may be missed by `crossings` and `next_crossing`."""
        return self._precise.resolution

    def locate(self, points):
        """The phase at points in double precision: uint8 (…), an index into `phases`.

        points: of shape (…, 3), in the unit of the object. A contiguous float64 array is not copied. The equations are
        those of `label`, evaluated in double precision. Points with infinite or NaN coordinates are in the vacuum.
        """
        array, shape = _points(points, dtype=np.float64)
        return self._precise_evaluator.locate(array).reshape(shape)[()]

    def safe_distance(self, points):
        """The radius of a ball around each point that is guaranteed to contain only one phase: float64 (…).

        points: of shape (…, 3). Points and radii are in the unit of the object. A radius is 0 at an interface, and at
        most the distance to the closest one. It is infinite if the object has only one phase, and NaN for a point that
        is not finite.
        """
        array, shape = _points(points, dtype=np.float64)
        try:
            error = self._precise.value_error
        except Error:  # rays cannot be traced through unbounded objects, but points have distances
            error = 0
        return self._precise_evaluator.safe_distance(array, error).reshape(shape)[()]

    def crossings(self, origins, directions, phases=None, limit=float("inf")):
        """Every crossing along rays in double precision, as Crossings with float64 arrays.

        origins, directions: of shape (…, 3). Directions may have any length but zero; t is in units of this length.
        phases: the phase that each ray is in (an integer array, a phase, or its name), by default that at its origin.
        If a ray's phase differs from that at its origin, there is a crossing at t = 0. limit: the largest t, a number
        or one per ray.

        Phases thinner than `precise_resolution` along the ray may be missed, and so may phases that the ray only
        grazes. `after` of a crossing is always `before` of the next. Rays that are not finite have no crossings. Uses
        all cores and does not need `prepare`. Raises Error if the object is empty or unbounded.
        """
        arrays, _ = self._precise_rays(origins, directions, phases, limit)
        return Crossings(*self._precise.crossings(*arrays))

    def next_crossing(self, origins, directions, phases=None, limit=float("inf")):
        """The first crossing along each ray in double precision, as NextCrossings.

        Arguments and guarantees are those of `crossings`. To continue a ray, start at `far` in the phase `after`. To
        reflect it, start at `near` in the phase `before`. No offset is needed, and no crossing is found twice.
        """
        arrays, shape = self._precise_rays(origins, directions, phases, limit)
        t, before, after, *vectors = self._precise.next_crossing(*arrays)
        vectors = (v.reshape(*shape, 3) for v in vectors)
        return NextCrossings(t.reshape(shape), before.reshape(shape), after.reshape(shape), *vectors)

    def _precise_rays(self, origins, directions, phases, limit):
        origins, directions, shape = _rays(origins, directions, np.float64)
        if phases is not None:
            if isinstance(phases, (str, Phase)):
                phases = self.index(phases)
            phases = np.asarray(phases)
            if phases.dtype.kind not in "iu":
                raise Error(f"phases must be integers, but are {phases.dtype}")
            if phases.size and not (0 <= phases.min() and phases.max() < len(self.phases)):
                raise Error(f"phases must be 0 … {len(self.phases) - 1}, the indices of the object's phases")
            phases = _per_ray(phases, shape, np.uint8, "phases")
        return (origins, directions, phases, _per_ray(limit, shape, np.float64, "limit")), shape

    def mesh(self, spacing=0, progress=None):
        """The interfaces of the phases as triangles. Returns a PhaseMesh.

        spacing: the distance between grid points, about the size of the smallest detail that is kept; 0 selects 1/256
        of the object's longest side. progress: called with "meshing" and the fraction done, up to 1.
        """
        spacing = float(spacing)
        if not (0 <= spacing < 3.4e38) or (spacing > 0 and np.float32(spacing) == 0):
            raise Error(f"the spacing is {spacing}; it must be a length")
        made = _phasetree.mesh(self._prepared, spacing, progress)
        return PhaseMesh(*made[:4], self.names, *made[4:])

    def measure(self, tolerance=1e-3, seconds=None, densities=None, progress=None, areas=False, thickness=False):
        """Volumes, masses, centres of mass, tensors of inertia and bounding boxes of the phases, as Measures.

        Each number comes with an interval that is guaranteed to contain it, unless a rounding error of a distance
        exceeds half of `Object.resolution`.

        tolerance: measuring ends once each volume's interval is at most this fraction of the volume. seconds: measuring
        also ends after this time, by default never. densities: a dict from phases, or their names, to densities, for
        masses; phases that are not in it have a density of 1 (unlike in solve). progress: called with "measuring" and
        an estimate of the fraction done, up to 1. areas: also estimate the areas of surfaces and contacts, to a
        standard error of `tolerance` or 0.002. thickness: also find the smallest thickness of each phase. Each of
        these takes up to `seconds` more.

        Uses all cores. Several threads may measure at once. Raises Error if the object is empty or unbounded, or if
        an argument is out of its range. Ctrl-C raises Interrupted, whose `result` has what was known by then.
        """
        numbers = []
        for phase, density in (densities or {}).items():
            name = phase.name if isinstance(phase, Phase) else phase
            if name not in self.names:
                raise Error(f'the object has no phase {name!r}; it has {", ".join(self.names)}')
            numbers.append((self.names.index(name), float(density)))
        seconds = None if seconds is None else float(seconds)

        def measures(found):
            return Measures(tuple(self.names[i] for i in found[0]), *found[1:]) if found[0] else None

        try:
            found = measures(_phasetree.measure(self._handle, float(tolerance), seconds, numbers, progress))
        except KeyboardInterrupt as e:
            raise interrupted(e, measures) from None
        if areas:

            def add_areas(parts):
                return found._replace(**_areas(self.names, found.names, *parts))

            try:
                found = add_areas(_phasetree.areas(self._prepared, float(tolerance), seconds, progress))
            except KeyboardInterrupt as e:
                raise Interrupted(found) if not hasattr(e, "result") else interrupted(e, add_areas) from None
        if thickness:

            def add_walls(walls):
                return found._replace(**_walls(self.names, found.names, walls))

            try:
                found = add_walls(_phasetree.thicknesses(self._handle, seconds, progress))
            except KeyboardInterrupt as e:
                raise Interrupted(found) if not hasattr(e, "result") else interrupted(e, add_walls) from None
        return found

    def prove(self, *statements, unit="m", resolution=0, seconds=None, progress=None):
        """Proves or refutes statements about the object. Returns a list of Proof.

        statements: dicts as in "expect" of a scene file, such as {"wall": {"phase": "glass", "at_least": 0.002}}. A
        phase is given by its name, or as a Phase. unit: that of the object's lengths, for volumes and masses. Masses
        need phases with a density. resolution: the side of the smallest boxes; 0 selects 1/256 of the longest side.
        seconds: a time limit, by default none. progress: called with "proving" and an estimate of the fraction done,
        up to 1.

        Nothing false is proved and nothing true is refuted, unless a rounding error of a distance exceeds half of
        `Object.resolution`. Raises Error if a statement is malformed, or if the object is empty or unbounded. Ctrl-C
        raises Interrupted, whose `result` has what was known by then.
        """
        densities = [(i, p.density) for i, p in enumerate(self.phases) if p.density is not None]
        text = json.dumps({"expect": list(statements)}, ensure_ascii=False, default=_name_of_phase)
        seconds = None if seconds is None else float(seconds)
        try:
            found = _phasetree.prove(
                self._handle, list(self.names), text, unit, densities, float(resolution), seconds, progress
            )
        except KeyboardInterrupt as e:
            raise interrupted(e, lambda known: [Proof(*one) for one in known] or None) from None
        return [Proof(*one) for one in found]

    @property
    def bounds(self):
        """A box around everything but the vacuum: (low, high). Infinite where unbounded; None if empty."""
        return self._handle.bounds

    @property
    def nodes(self):
        """The number of nodes; those that are shared count once."""
        return self._handle.nodes

    def to_json(self):
        """The object as the text of a scene file without a camera."""
        return self._handle.text(self._materials, [_material(p) for p in self.phases[1:]])

    def __eq__(self, other):
        return isinstance(other, Object) and self.phases == other.phases and self.to_json() == other.to_json()

    __hash__ = None

    def __repr__(self):
        return f"<Object of {_listed(self.names[1:])}, {self.nodes} nodes>"


def _areas(all_names, names, areas, contacts):
    """The arrays of Measures from lists of (phase, area, error) and (first, second, area, error)."""
    area, contact = np.zeros((len(names), 2)), np.zeros((len(names) + 1, len(names) + 1, 2))
    place = {all_names.index(name): k + 1 for k, name in enumerate(names)}
    place[0] = 0
    for phase, *numbers in areas:
        area[place[phase] - 1] = numbers
    for first, second, *numbers in contacts:
        contact[place[first], place[second]] = contact[place[second], place[first]] = numbers
    return {"area": area, "contact": contact}


def _walls(all_names, names, walls):
    """The arrays of Measures from a list of (phase, low, high, place)."""
    thickness, thinnest = np.tile([0, np.inf], (len(names), 1)), np.full((len(names), 3), np.nan)
    for phase, low, high, place in walls:
        k = names.index(all_names[phase])
        thickness[k] = low, high
        if place is not None:
            thinnest[k] = place
    return {"thickness": thickness, "thinnest": thinnest}


def _material(phase):
    """The entry of a phase in a scene file: its material, and its density beside it."""
    if phase.material is None and phase.density is None:
        return "null"
    entry = {} if phase.material is None else dict(phase.material.written())
    if phase.density is not None:
        entry["density"] = phase.density
    return json.dumps(entry, ensure_ascii=False)


def _listed(names):
    return ", ".join(f'"{n}"' for n in names)


def _named(value):
    return f"an object of {_listed(value.names[1:])}" if isinstance(value, Object) else f"a {type(value).__name__}"


def _rays(origins, directions, dtype=np.float32):
    origins = np.asarray(origins, dtype=dtype)
    directions = np.asarray(directions, dtype=dtype)
    if origins.shape != directions.shape:
        origins, directions = np.broadcast_arrays(origins, directions)
    origins, shape = _points(origins, "the origins", dtype)
    directions, _ = _points(directions, "the directions", dtype)
    return origins, directions, shape


def _per_ray(values, shape, dtype, what):
    """One number per ray, as a contiguous array."""
    try:
        values = np.broadcast_to(np.asarray(values, dtype=dtype), shape)
    except ValueError:
        raise Error(f"{what} must be a number or have the shape {shape}, but have {np.shape(values)}") from None
    return np.ascontiguousarray(values).reshape(-1)


_A = {"field": "a field", "object": "an object of phases", "list of fields": "fields", "list of objects": "objects"}


def _node_text(kind, values):
    """A node's text, all its phases, and the handles that the text names, renumbered to these phases."""
    handles, phases = [], []
    for p, value in values.items():
        several = value if p.is_handle and p.is_list else [value]
        if p.is_handle and p.is_list and (isinstance(value, str) or not hasattr(value, "__iter__")):
            raise Error(f'{kind.name}: "{p.name}" must be several fields or objects, but is {value!r}')
        for i, one in enumerate(several):
            if p.is_handle:
                one = one.field() if isinstance(one, Expression) else one
                if not isinstance(one, (Field, Object)):
                    raise Error(f'{kind.name}: "{p.name}" must be {_A[p.type]}, but is {one!r}')
                handles.append((f"{p.name}[{i}]" if p.is_list else p.name, one))
            elif isinstance(one, Phase):
                phases.append(one)
            elif isinstance(one, (list, tuple)):
                phases += [v for v in one if isinstance(v, Phase)]
    all_phases = merged(*(h._phases for _, h in handles), phases)
    number = {p.name: i for i, p in enumerate(all_phases)}
    parts = {}
    for name, handle in handles:
        numbers = [number[p.name] for p in handle._phases]
        is_other = numbers != list(range(len(numbers)))
        parts[name] = handle._handle.renumbered(numbers) if is_other else handle._handle
    names = iter(parts)
    text = {}
    for p, value in values.items():
        if p.is_handle:
            text[p.name] = [next(names) for _ in value] if p.is_list else next(names)
        elif p.type == "name of a file":
            text[p.name] = _reference.file_name(value)
        else:
            text[p.name] = _text_of(value, f'{kind.name}: "{p.name}"')
    return json.dumps({kind.name: text}), all_phases, parts


def _text_of(value, what):
    if isinstance(value, Phase):
        return value.name
    if isinstance(value, (list, tuple)) and any(isinstance(v, Phase) for v in value):
        return [_text_of(v, what) for v in value]
    text = _reference.written(value, what)
    _reference.check_still(text, what)
    return text


def _function(name, of_field, of_object):
    """The function of a node. If a field node and an object node share the name, the first argument selects one."""
    kind = of_object or of_field
    signature = kind.signature()

    def make(*arguments, **named):
        values = kind.bound(signature, arguments, named)
        first = next(iter(values.values()), None)
        if isinstance(first, (list, tuple)):
            first = next(iter(first), None)
        if isinstance(first, Expression) and kind.parameters[0].is_handle:
            first = first.field()
        chosen, is_field = kind, of_object is None
        if of_field and of_object and isinstance(first, Field):
            chosen, is_field = of_field, True
        text, phases, parts = _node_text(chosen, values)
        materials = [p.name for p in phases[1:]]
        if is_field:
            return Field(_phasetree.make_field(text, materials, parts), phases)
        return Object(_phasetree.make_object(text, materials, parts), phases)

    make.__name__ = make.__qualname__ = name
    make.__doc__ = kind.doc
    make.__signature__ = signature
    make.__module__ = "phasetree"
    make.kind = kind
    make.makes = tuple(t for t, of in ((Field, of_field), (Object, of_object)) if of)
    return make


def _all_functions():
    makes = {"Shapes": "field", "Operators on fields": "field", "Objects": "object", "Warps": "warp"}
    by_name = {}
    for title, kinds in _reference.chapters():
        for kind in kinds if title in makes else ():
            by_name.setdefault(kind.name, {})[makes[title]] = kind
    made = {}
    for name, of in by_name.items():
        warp = of.get("warp")
        made[name] = _function(name, of.get("field") or warp, of.get("object") or warp)
    return made


def _add_methods():
    """Makes each function whose first parameter is a field or an object a method of that class."""
    for name, function in functions.items():
        first = function.kind.parameters[0] if function.kind.parameters else None
        if first is None or not first.is_handle or first.optional:
            continue
        takers = (Field, Object) if len(function.makes) == 2 else (Field if "field" in first.type else Object,)
        for taker in takers:
            if hasattr(taker, name):
                raise AssertionError(f"{taker.__name__}.{name} is there already")
            setattr(taker, name, function)


functions.update(_all_functions())
classes.update(Field=Field, Object=Object)
_add_methods()
