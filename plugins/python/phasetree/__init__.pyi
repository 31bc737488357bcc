"""Written by python3 -m phasetree._stubs from the library's lists; see plugins/python/README.md."""

from os import PathLike
from typing import Any, Literal, NamedTuple, Sequence, overload

import numpy as np

__version__: str
build_id: str

class Error(ValueError): ...

class SceneError(Error):
    file: str
    line: int
    column: int
    message: str
    suggestion: str | None

class Interrupted(KeyboardInterrupt):
    result: Any

class Material:
    kind: str
    def parameters(self) -> dict[str, Any]: ...

class Texture:
    kind: str
    def parameters(self) -> dict[str, Any]: ...

class Number:
    kind: str
    def parameters(self) -> dict[str, Any]: ...

class NormalMap:
    kind: str
    def parameters(self) -> dict[str, Any]: ...

class PhaseFunction:
    kind: str
    def parameters(self) -> dict[str, Any]: ...

class Voxels:
    kind: str
    def parameters(self) -> dict[str, Any]: ...

class Light:
    kind: str
    def parameters(self) -> dict[str, Any]: ...

class Mesh:
    kind: str
    def parameters(self) -> dict[str, Any]: ...

class Camera:
    kind: str
    def parameters(self) -> dict[str, Any]: ...

class ImageSettings:
    kind: str
    def parameters(self) -> dict[str, Any]: ...

class Phase:
    name: str
    material: Material | None
    density: float | None
    def __call__(self, *fields: Field | Expression) -> Object: ...

vacuum: Phase

def phase(name: str, material: Material | None = ..., density: float | None = ...) -> Phase: ...

class Crossings(NamedTuple):
    r"""Every crossing along some rays. Those of ray i have the indices offsets[i] to offsets[i + 1] − 1."""
    @property
    def ray(self):
        r"""The index of the ray of each crossing."""
    def of_ray(self, i):
        r"""The crossings along one ray."""
    start: np.ndarray
    offsets: np.ndarray
    t: np.ndarray
    before: np.ndarray
    after: np.ndarray
    normal: np.ndarray

class Hits(NamedTuple):
    r"""The first crossing along each ray. If there is none, t is infinite and `after` is the phase at the origin."""
    t: np.ndarray
    before: np.ndarray
    after: np.ndarray
    normal: np.ndarray

class NextCrossings(NamedTuple):
    r"""The next crossing along each ray in double precision; see Object.next_crossing.

    If there is none, t is infinite, `near` and `far` are NaN, the normal is zero, and `before` and `after` are the phase
    that the ray is in."""
    t: np.ndarray
    before: np.ndarray
    after: np.ndarray
    normal: np.ndarray
    near: np.ndarray
    far: np.ndarray

class Closest(NamedTuple):
    r"""The closest interface to each point. If there is none, the distance is infinite and the point NaN."""
    distance: np.ndarray
    point: np.ndarray
    before: np.ndarray
    after: np.ndarray

class PhaseMesh(NamedTuple):
    r"""The interfaces of an object as triangles with shared vertices; see Object.mesh."""
    def surface(self, *phases):
        r"""The surface around some phases together, each given as a Phase or by name. Returns (vertices, triangles).

The surface is closed, and its triangles are counterclockwise as seen from outside. The surface of a single
phase, or of all phases except the vacuum, is a manifold."""
    vertices: np.ndarray
    triangles: np.ndarray
    behind: np.ndarray
    front: np.ndarray
    names: tuple[str, ...]
    spacing: float
    crossings: int
    skipped: int

class Measures(NamedTuple):
    r"""Volumes, masses and moments of the phases of an object; see Object.measure.

    The last axis of each array up to `high` holds [low, high, estimate]. The number is guaranteed to lie between low
    and high. Areas are statistical estimates. Lengths are in the unit of the scene, usually metres."""
    names: tuple[str, ...]
    volume: np.ndarray
    mass: np.ndarray
    centre: np.ndarray
    inertia: np.ndarray
    low: np.ndarray
    high: np.ndarray
    stopped: str
    boxes: int
    area: np.ndarray | None
    contact: np.ndarray | None
    thickness: np.ndarray | None
    thinnest: np.ndarray | None

class Proof(NamedTuple):
    r"""What is known of a statement about an object; see Object.prove."""
    verdict: str
    reason: str
    witnesses: list
    resolution: float
    interval: tuple | None

class Solution(NamedTuple):
    r"""The result of solve: the number at which a volume or mass has the given value, with its guaranteed bounds.

    The arrays hold [low, high, estimate]. The measure is guaranteed to lie between low and high."""
    value: float
    low: float
    high: float
    measure: np.ndarray
    at_low: np.ndarray
    at_high: np.ndarray
    stopped: str
    measurements: int

class Field:
    r"""A signed distance, negative inside. Immutable.

    a | b is the union, a & b the intersection, a - b the difference. a.smooth(r) | b, and likewise & and -, rounds the
    seam with the radius r. Nodes whose first parameter is a field are also methods: a.translate((0, 0, 1))."""
    def written(self):
        r"""The node as JSON."""
    def smooth(self, radius):
        r"""The same field, but the next |, & or - with it rounds the seam with this radius."""
    def distance(self, points):
        r"""The signed distance at points given as an array of shape (…, 3): float32, negative inside."""
    def gradient(self, points):
        r"""The gradient of the distance at points: float32 (…, 3)."""
    @property
    def bounds(self):
        r"""A box around the points that are not outside: (low, high). Infinite where unbounded; None if empty."""
    @property
    def nodes(self):
        r"""The number of nodes; those that are shared count once."""
    def to_json(self):
        r"""The field as text for a scene file, with its shared shapes."""
    def __or__(self, other: Field | Expression) -> Field: ...
    def __and__(self, other: Field | Expression) -> Field: ...
    def __sub__(self, other: Field | Expression) -> Field: ...
    def union(self, *of: Field) -> Field:
        r"""The points that are inside any field.

            min fᵢ

        of: The fields, at least one. (list of fields)
        """
    def intersection(self, *of: Field) -> Field:
        r"""The points that are inside all fields.

            max fᵢ

        of: The fields, at least one. (list of fields)
        """
    def difference(self, *subtract: Field | Expression | Sequence[Field | Expression]) -> Field:
        r"""Subtracts fields from a field.

            max(f, −min gᵢ)

        from_: The field to cut. (field)
        subtract: The fields to cut away, at least one. (list of fields)
        """
    def smooth_union(self, *of: Field, radius: float) -> Field:
        r"""Union with filleted seams; applied pairwise, from the first field to the last.

            smin(a, b) = min(a, b) − r/6 · max(1 − |b − a|/r, 0)³

        Section 9.3 of Galin et al. (2026).

        of: The fields, at least one. (list of fields)
        radius: Blending radius: surfaces blend where they are closer to each other than this. (number in m; positive)
        """
    def smooth_intersection(self, *of: Field, radius: float) -> Field:
        r"""Intersection with rounded edges; applied pairwise, from the first field to the last.

            −smin(−a, −b)

        Section 9.3 of Galin et al. (2026).

        of: The fields, at least one. (list of fields)
        radius: Blending radius: surfaces blend where they are closer to each other than this. (number in m; positive)
        """
    def smooth_difference(self, *subtract: Field | Expression | Sequence[Field | Expression], radius: float) -> Field:
        r"""Subtracts fields from a field and rounds the new edges.

            −smin(−f, smin gᵢ)

        Section 9.3 of Galin et al. (2026).

        from_: The field to cut. (field)
        subtract: The fields to cut away, at least one. (list of fields)
        radius: Blending radius: surfaces blend where they are closer to each other than this. (number in m; positive)
        """
    def offset(self, distance: float) -> Field:
        r"""Inflates a field by t, or deflates it if t is negative.

            f − t

        Section 4.1 of Galin et al. (2026).

        of: The field. (field)
        distance: Distance by which the surface moves outwards. (number in m)
        """
    def shell(self, half_thickness: float) -> Field:
        r"""A wall of thickness 2t about a field's surface.

            |f| − t

        Section 4.1 of Galin et al. (2026).

        of: The field. (field)
        half_thickness: Half of the wall's thickness, t. (number in m; positive)
        """
    def displace(self, amplitude: float, scale: float, octaves: float | None = ...) -> Field:
        r"""Displaces the surface of a field by fractal noise.

            min(max((f + a n)/λ, f − a), f + a),  λ = 1 + a L,  L = 15 octaves/(4 scale Σ 2⁻ⁱ)

        of: The field. (field)
        amplitude: Largest displacement, a. (number in m; zero or more)
        scale: Size of the largest bumps. (number in m; positive)
        octaves: Number of octaves of noise, each with half the size of the one before. (number; at least 1 and at most 6; default 1)
        """
    def instances(self, positions: Sequence[Sequence[float]] | np.ndarray, turns: float | Sequence[float] | None = ..., scales: float | Sequence[float] | None = ...) -> Field:
        r"""Copies at the given positions, optionally rotated about the z axis and scaled.

            min over i of sᵢ φ(R(−aᵢ)(p − vᵢ)/sᵢ); for objects, later copies replace earlier ones

        of: The field or object to copy. (object)
        positions: Positions of the copies' origins. (list of [x, y, z] in m)
        turns: Rotation of each copy about its own z axis; one number applies to all. (number or list of numbers in degrees; default [])
        scales: Scale factor of each copy; one number applies to all. (number or list of numbers; positive; default [])
        """
    def polar_array(self, count: int, angle: float | None = ...) -> Field:
        r"""Copies rotated about the z axis by equal angles.

            min over i < n of φ(R(−i a/n) p); for objects, later copies replace earlier ones

        of: The field or object to copy. (object)
        count: Number of copies. (whole number; at least 1 and at most 10000)
        angle: Total angle: copy i is rotated by i/count of it. Default: a full turn. (number in degrees; default 360)
        """
    def grid(self, spacing: Sequence[float] | np.ndarray, count_x: int | None = ..., count_y: int | None = ..., count_z: int | None = ...) -> Field:
        r"""Copies in rows along x, y and z; the first stays in place. They may overlap. They are ordered by k, then j, then i.

            min over i, j, k of φ(p − (i dx, j dy, k dz)); for objects, later copies replace earlier ones

        of: The field or object to copy. (object)
        spacing: Distance between copies along x, y and z. ([x, y, z] in m)
        count_x: Number of copies along x. (whole number; at least 1 and at most 10000; default 1)
        count_y: Number of copies along y. (whole number; at least 1 and at most 10000; default 1)
        count_z: Number of copies along z. (whole number; at least 1 and at most 10000; default 1)
        """
    def endless_grid(self, spacing: Sequence[float] | np.ndarray) -> Field:
        r"""Copies repeated endlessly along the axes; their bounding boxes must not touch.

            max(b, min(φ(q), 2g − b)),  q = p − s ⌊(p − c)/s + ½⌋,  b = distance to the copies' boxes,  g = half the smallest gap between boxes

        of: The field or object to copy. (object)
        spacing: Distance between copies along x, y and z; 0 for no repetition along that axis. ([x, y, z] in m; zero or more)
        """
    def fibonacci_disk(self, count: int, radius: float, turned: int | None = ...) -> Field:
        r"""Copies spread evenly over a disk about the z axis, on a Fibonacci spiral.

            copies at ρᵢ = R √((i + ½)/n), θᵢ = i π(3 − √5); for objects, later copies replace earlier ones

        Section 7.7 of Galin et al. (2026).

        of: The field or object to copy. (object)
        count: Number of copies. (whole number; at least 1 and at most 100000)
        radius: Radius of the disk of the copies' origins. (number in m; positive)
        turned: 1: each copy is rotated so that its x axis points away from the centre; 0: all copies have the same orientation. (whole number; at least 0 and at most 1; default 0)
        """
    def fibonacci_sphere(self, count: int, radius: float) -> Field:
        r"""Copies spread evenly over a sphere along a Fibonacci spiral, each with its z axis pointing outward.

            copies at R nᵢ, nᵢ of height 1 − (2i + 1)/n and longitude i π(3 − √5), their z axis along nᵢ; for objects, later copies replace earlier ones

        Section 7.7 of Galin et al. (2026).

        of: The field or object to copy. (object)
        count: Number of copies. (whole number; at least 1 and at most 100000)
        radius: Radius of the sphere of the copies' origins. (number in m; positive)
        """
    def scatter(self, on: Field | Expression, count: int, spacing: float | None = ..., smallest: float | None = ..., seed: int | None = ...) -> Field:
        r"""Copies scattered over the surface of a field, each with its z axis pointing outward, and with random rotations.

            copies at random points of the surface f = 0, their z axis along ∇f; for objects, later copies replace earlier ones

        of: The field or object to copy. (object)
        on: The field whose surface the copies stand on; it must be bounded. (field)
        count: Number of copies; fewer if there is not enough space. (whole number; at least 1 and at most 100000)
        spacing: Minimum distance between the copies' origins. (number in m; zero or more; default 0)
        smallest: Minimum size: sizes are random between this factor and 1. (number; at least 0.01 and at most 1; default 1)
        seed: Seed of the random positions. (whole number; at least 0 and at most 1000000; default 1)
        """
    def extrude(self, height: float) -> Field:
        r"""Extrudes a field's cross-section at z = 0 along z; exact where the field is the exact distance to its cross-section.

            a = f(x, y, 0),  b = |z| − h/2;  |(max(a, 0), max(b, 0))| + min(max(a, b), 0)

        of: The field, for example a circle, a rectangle or a star. (field)
        height: Whole height, centred at z = 0. (number in m; positive)
        """
    def revolve(self, offset: float | None = ...) -> Field:
        r"""Revolves a field's cross-section at z = 0 about its y axis, which becomes the z axis; exact if the field is the exact distance to its cross-section, and the section is on one side of the axis or symmetric about it.

            f(|pxy| − o, z, 0)

        of: The field; the part of its section beyond the axis is cut off. (field)
        offset: Distance by which the section is first moved away from the axis. (number in m; default 0)
        """
    def bounding_volume(self, margin: float, volume: Field | Expression | None = ...) -> Field:
        r"""A field or an object with a bounding volume, whose distance replaces it far away. Parts outside the volume are cut off.

            max(b, min(f, 2m − b));  φᵢ likewise,  φ₀ = min(−b, max(a₀, b − 2m))

        Sections 4.1 and 7.3 of Galin et al. (2026).

        of: The field or object to bound. (object)
        margin: Distance from the volume, or from the proxy's surface, beyond which its distance replaces that of the child. (number in m; positive)
        volume: The bounding volume, a field. Default: the bounding box. (field; default none)
        """
    def proxy(self, proxy: Field | Expression, error: float, margin: float, inside: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
        r"""A field or an object with a proxy, a simpler field g near it, which replaces it away from the surface, outside and inside. Parts more than e outside the proxy are cut off, and gaps more than e inside it are filled.

            min(c, max(h, −2m − c)),  h = max(b, min(f, 2m − b)),  b = g − e,  c = g + e

        Sections 4.1 and 7.3 of Galin et al. (2026).

        of: The field or object to replace. (object)
        proxy: The simpler field, g. (field)
        error: Maximum distance e between the two surfaces. (number in m; zero or more)
        margin: Distance from the volume, or from the proxy's surface, beyond which its distance replaces that of the child. (number in m; positive)
        inside: For an object: the phase that fills the part of the proxy deeper than e. By default, the proxy is used only outside. (phase or list of phases; default none)
        """
    def level_of_detail(self, *of: Field, viewpoint: Sequence[float] | np.ndarray | None = ..., distances: Sequence[float] | np.ndarray | None = ..., errors: Sequence[float] | np.ndarray | None = ...) -> Field:
        r"""Levels of detail of a field or an object, from fine to coarse, each used within a range of distances from a viewpoint. Without distances, the finest level is used everywhere, unless distances are chosen for a view (`phasetree render --detail`; in C++, with_levels_of_detail()).

            min(max(a, n), max(b, −n), max(a, b)),  n = |p − v| − d;  φᵢ and φ₀ alike

        Sections 4.1 and 7.3 of Galin et al. (2026).

        of: The levels, fields or objects, the finest first. (list of objects)
        viewpoint: The viewpoint from which distances are measured. ([x, y, z] in m; default [0, 0, 0])
        distances: Increasing distances at which each level is replaced by the next; one less than there are levels. (list of numbers in m; positive; default [])
        errors: For each coarser level, the distance of its surface from that of the finest level, in increasing order. --detail compares these with the size of a pixel. They are trusted, not checked. (list of numbers in m; positive; default [])
        """
    def set(self, phase: Phase | str) -> Object:
        r"""Fills a field with one phase.

            φₖ = f,  φ₀ = −f

        Section 4.1 of Galin et al. (2026).

        of: The field. (field)
        phase: The phase inside. (phase)
        """
    def thin_shell(self, shell: Phase | str, inside: Phase | str, half_thickness: float) -> Object:
        r"""A wall of thickness 2t about the surface of a field, and its interior.

            φᵢ = |f| − t,  φⱼ = f + t,  φ₀ = t − f

        Section 4.1 of Galin et al. (2026).

        of: The field, whose surface is the middle of the wall. (field)
        shell: The phase of the wall. (phase)
        inside: The phase within. (phase)
        half_thickness: Half of the wall's thickness, t. (number in m; positive)
        """
    def translate(self, by: Sequence[float] | np.ndarray, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
        r"""Translates.

            φ(p − v)

        Section 6 of Galin et al. (2026).

        of: The field or object to warp. (object)
        by: Image of the origin. ([x, y, z] in m)
        over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
        under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
        """
    def rotate(self, angle: float, axis: Sequence[float] | np.ndarray | None = ..., over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
        r"""Rotates about an axis through the origin, by the right-hand rule.

            φ(Rᵀ p)

        Section 6 of Galin et al. (2026).

        of: The field or object to warp. (object)
        angle: Angle. (number in degrees)
        axis: Direction of the axis; any length but zero. ([x, y, z]; default [0, 0, 1])
        over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
        under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
        """
    def scale(self, factor: float, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
        r"""Scales by the same factor along all axes.

            s · φ(p / s)

        Section 6 of Galin et al. (2026).

        of: The field or object to warp. (object)
        factor: The factor. (number; positive)
        over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
        under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
        """
    def twist(self, rate: float, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
        r"""Twists about the z axis.

            φ(R(−k z) p) / λ,  λ = (kρ + √(k²ρ² + 4))/2,  ρ the largest within the bounds

        Section 6 of Galin et al. (2026).

        of: The field or object to warp. (object)
        rate: Angle per unit of height. (number in degrees/m)
        over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
        under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
        """
    def stretch(self, factors: Sequence[float] | np.ndarray, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
        r"""Scales by a different factor along each axis.

            φ(x/sx, y/sy, z/sz) · min(sx, sy, sz)

        Section 6 of Galin et al. (2026).

        of: The field or object to warp. (object)
        factors: The factors along x, y and z. ([x, y, z]; positive)
        over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
        under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
        """
    def mirror(self, normal: Sequence[float] | np.ndarray | None = ..., over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
        r"""Mirrors at a plane through the origin: keeps the half to which the normal points, and adds its mirror image.

            φ(p − 2 min(p·n, 0) n)

        Section 6 of Galin et al. (2026).

        of: The field or object to warp. (object)
        normal: Direction that points into the half that is kept; any length but zero. ([x, y, z]; default [1, 0, 0])
        over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
        under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
        """
    def taper(self, rate: float, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
        r"""Narrows or widens along the z axis.

            φ(x/s, y/s, z) / λ,  s = 1 + c z

        Section 6 of Galin et al. (2026).

        of: The field or object to warp. (object)
        rate: Change of size per unit of height; the size at z = 0 is unchanged. (number in 1/m)
        over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
        under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
        """
    def bend(self, rate: float, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
        r"""Bends the x axis into an arc towards +z.

            φ(θ/k, y, (1 − r)/k) / λ,  (r, θ) polar: r sin θ = k x, r cos θ = 1 − k z

        Section 6 of Galin et al. (2026).

        of: The field or object to warp. (object)
        rate: Angle per unit of length along x; negative to bend towards −z. (number in degrees/m)
        over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
        under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
        """
    def affine(self, x: Sequence[float] | np.ndarray | None = ..., y: Sequence[float] | np.ndarray | None = ..., z: Sequence[float] | np.ndarray | None = ..., by: Sequence[float] | np.ndarray | None = ..., over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
        r"""Maps the unit vectors to any three vectors that span space, and the origin to a point: shears, stretches, rotates and mirrors.

            φ(M⁻¹(p − v))/λ,  M = (x y z),  λ = ‖M⁻¹‖₂

        Section 6 of Galin et al. (2026).

        of: The field or object to warp. (object)
        x: Image of the vector [1, 0, 0]. ([x, y, z]; default [1, 0, 0])
        y: Image of the vector [0, 1, 0]. ([x, y, z]; default [0, 1, 0])
        z: Image of the vector [0, 0, 1]. ([x, y, z]; default [0, 0, 1])
        by: Image of the origin. ([x, y, z] in m; default [0, 0, 0])
        over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
        under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
        """
    def distort(self, amplitude: float, scale: float, octaves: float | None = ..., over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
        r"""Distorts space by fractal noise, as in rock or smoke.

            φ(p + a (n(p), n(p + u), n(p + v)))/λ,  λ = 1 + √3 a L,  L = 15 octaves/(4 scale Σ 2⁻ⁱ)

        Section 6 of Galin et al. (2026).

        of: The field or object to warp. (object)
        amplitude: Largest displacement along each axis, a. (number in m; zero or more)
        scale: Size of the largest swirls. (number in m; positive)
        octaves: Number of octaves of swirls, each with half the size of the one before. (number; at least 1 and at most 6; default 1)
        over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
        under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
        """

class Object:
    phases: tuple[Phase, ...]
    r"""An object of several phases. Every point is in exactly one of them. Immutable.

    Objects are joined with methods rather than operators, because the order matters: a.over(b), a.under(b),
    a.contact(b, …). Arrays identify phases by their index in `phases`.

    label, trace and intersect work in single precision. locate, crossings and next_crossing are their counterparts in
    double precision."""
    @property
    def names(self):
        r"""The names of the phases, the vacuum first."""
    def with_phases(self, *phases):
        r"""The same object with its phases in this order. Where two phases have the same distance, the first one wins.

The list must contain all phases of the object, and may contain others. A material given here replaces the
phase's own."""
    def label(self, points):
        r"""The phase at points given as an array of shape (…, 3): uint8, an index into `phases`.

A contiguous float32 array is not copied. Points with infinite or NaN coordinates are in the vacuum."""
    def phi(self, points):
        r"""Φ at points: float32 (…, phases), the signed distance to each phase, negative in the phase.

Column i is for phases[i]. It is infinite if the object does not have that phase anywhere."""
    def gradient(self, points, phase=...):
        r"""The gradient of the distance to a phase, at points. By default, of the phase in which each point lies."""
    def index(self, phase):
        r"""The index of a phase in arrays. The phase is given as a Phase or by name."""
    def prepare(self, quality=..., resolution=..., progress=...):
        r"""Builds the cells in which rays are traced. If this is not called, the first ray builds them.

quality: "low" builds faster and traces more slowly. resolution: phases thinner than this along a ray may be
missed. 0 selects 2·10⁻⁶ of the diagonal, or 10⁻⁶ of the largest coordinate if that is more.
progress: called with "preparing" and the fraction done, up to 1."""
    @property
    def resolution(self):
        r"""Phases thinner than this along a ray may be missed. A grazing ray may also miss slightly thicker ones."""
    def trace(self, origins, directions):
        r"""Every crossing along rays, which are given as arrays of shape (…, 3). Returns Crossings."""
    def intersect(self, origins, directions):
        r"""The first crossing along each ray; the rays are given as arrays of shape (…, 3). Returns Hits."""
    def closest(self, points, radius=..., tolerance=...):
        r"""The closest interface to each point, within a radius. Returns Closest.

tolerance: the accepted relative error of the distance."""
    @property
    def precise_resolution(self):
        r"""Phases thinner than this along a ray may be missed by `crossings` and `next_crossing`."""
    def locate(self, points):
        r"""The phase at points in double precision: uint8 (…), an index into `phases`.

points: of shape (…, 3), in the unit of the object. A contiguous float64 array is not copied. The equations are
those of `label`, evaluated in double precision. Points with infinite or NaN coordinates are in the vacuum."""
    def safe_distance(self, points):
        r"""The radius of a ball around each point that is guaranteed to contain only one phase: float64 (…).

points: of shape (…, 3). Points and radii are in the unit of the object. A radius is 0 at an interface, and at
most the distance to the closest one. It is infinite if the object has only one phase, and NaN for a point that
is not finite."""
    def crossings(self, origins, directions, phases=..., limit=...):
        r"""Every crossing along rays in double precision, as Crossings with float64 arrays.

origins, directions: of shape (…, 3). Directions may have any length but zero; t is in units of this length.
phases: the phase that each ray is in (an integer array, a phase, or its name), by default that at its origin.
If a ray's phase differs from that at its origin, there is a crossing at t = 0. limit: the largest t, a number
or one per ray.

Phases thinner than `precise_resolution` along the ray may be missed, and so may phases that the ray only
grazes. `after` of a crossing is always `before` of the next. Rays that are not finite have no crossings. Uses
all cores and does not need `prepare`. Raises Error if the object is empty or unbounded."""
    def next_crossing(self, origins, directions, phases=..., limit=...):
        r"""The first crossing along each ray in double precision, as NextCrossings.

Arguments and guarantees are those of `crossings`. To continue a ray, start at `far` in the phase `after`. To
reflect it, start at `near` in the phase `before`. No offset is needed, and no crossing is found twice."""
    def measure(self, tolerance=..., seconds=..., densities=..., progress=..., areas=..., thickness=...):
        r"""Volumes, masses, centres of mass, tensors of inertia and bounding boxes of the phases, as Measures.

Each number comes with an interval that is guaranteed to contain it, unless a rounding error of a distance
exceeds half of `Object.resolution`.

tolerance: measuring ends once each volume's interval is at most this fraction of the volume. seconds: measuring
also ends after this time, by default never. densities: a dict from phases, or their names, to densities, for
masses; phases that are not in it have a density of 1 (unlike in solve). progress: called with "measuring" and
an estimate of the fraction done, up to 1. areas: also estimate the areas of surfaces and contacts, to a
standard error of `tolerance` or 0.002. thickness: also find the smallest thickness of each phase. Each of
these takes up to `seconds` more.

Uses all cores. Several threads may measure at once. Raises Error if the object is empty or unbounded, or if
an argument is out of its range. Ctrl-C raises Interrupted, whose `result` has what was known by then."""
    def prove(self, *statements, unit=..., resolution=..., seconds=..., progress=...):
        r"""Proves or refutes statements about the object. Returns a list of Proof.

statements: dicts as in "expect" of a scene file, such as {"wall": {"phase": "glass", "at_least": 0.002}}. A
phase is given by its name, or as a Phase. unit: that of the object's lengths, for volumes and masses. Masses
need phases with a density. resolution: the side of the smallest boxes; 0 selects 1/256 of the longest side.
seconds: a time limit, by default none. progress: called with "proving" and an estimate of the fraction done,
up to 1.

Nothing false is proved and nothing true is refuted, unless a rounding error of a distance exceeds half of
`Object.resolution`. Raises Error if a statement is malformed, or if the object is empty or unbounded. Ctrl-C
raises Interrupted, whose `result` has what was known by then."""
    @property
    def bounds(self):
        r"""A box around everything but the vacuum: (low, high). Infinite where unbounded; None if empty."""
    @property
    def nodes(self):
        r"""The number of nodes; those that are shared count once."""
    def to_json(self):
        r"""The object as the text of a scene file without a camera."""
    def merge(self, phases: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
        r"""Phases of an object as a plain field; it is zero on the interfaces between them.

            min over k of φₖ

        Section 4.2 of Galin et al. (2026).

        of: The object. (object)
        phases: The phases to merge; by default all but the vacuum. (phase or list of phases; default none)
        """
    def instances(self, positions: Sequence[Sequence[float]] | np.ndarray, turns: float | Sequence[float] | None = ..., scales: float | Sequence[float] | None = ...) -> Object:
        r"""Copies at the given positions, optionally rotated about the z axis and scaled.

            min over i of sᵢ φ(R(−aᵢ)(p − vᵢ)/sᵢ); for objects, later copies replace earlier ones

        of: The field or object to copy. (object)
        positions: Positions of the copies' origins. (list of [x, y, z] in m)
        turns: Rotation of each copy about its own z axis; one number applies to all. (number or list of numbers in degrees; default [])
        scales: Scale factor of each copy; one number applies to all. (number or list of numbers; positive; default [])
        """
    def polar_array(self, count: int, angle: float | None = ...) -> Object:
        r"""Copies rotated about the z axis by equal angles.

            min over i < n of φ(R(−i a/n) p); for objects, later copies replace earlier ones

        of: The field or object to copy. (object)
        count: Number of copies. (whole number; at least 1 and at most 10000)
        angle: Total angle: copy i is rotated by i/count of it. Default: a full turn. (number in degrees; default 360)
        """
    def grid(self, spacing: Sequence[float] | np.ndarray, count_x: int | None = ..., count_y: int | None = ..., count_z: int | None = ...) -> Object:
        r"""Copies in rows along x, y and z; the first stays in place. They may overlap. They are ordered by k, then j, then i.

            min over i, j, k of φ(p − (i dx, j dy, k dz)); for objects, later copies replace earlier ones

        of: The field or object to copy. (object)
        spacing: Distance between copies along x, y and z. ([x, y, z] in m)
        count_x: Number of copies along x. (whole number; at least 1 and at most 10000; default 1)
        count_y: Number of copies along y. (whole number; at least 1 and at most 10000; default 1)
        count_z: Number of copies along z. (whole number; at least 1 and at most 10000; default 1)
        """
    def endless_grid(self, spacing: Sequence[float] | np.ndarray) -> Object:
        r"""Copies repeated endlessly along the axes; their bounding boxes must not touch.

            max(b, min(φ(q), 2g − b)),  q = p − s ⌊(p − c)/s + ½⌋,  b = distance to the copies' boxes,  g = half the smallest gap between boxes

        of: The field or object to copy. (object)
        spacing: Distance between copies along x, y and z; 0 for no repetition along that axis. ([x, y, z] in m; zero or more)
        """
    def fibonacci_disk(self, count: int, radius: float, turned: int | None = ...) -> Object:
        r"""Copies spread evenly over a disk about the z axis, on a Fibonacci spiral.

            copies at ρᵢ = R √((i + ½)/n), θᵢ = i π(3 − √5); for objects, later copies replace earlier ones

        Section 7.7 of Galin et al. (2026).

        of: The field or object to copy. (object)
        count: Number of copies. (whole number; at least 1 and at most 100000)
        radius: Radius of the disk of the copies' origins. (number in m; positive)
        turned: 1: each copy is rotated so that its x axis points away from the centre; 0: all copies have the same orientation. (whole number; at least 0 and at most 1; default 0)
        """
    def fibonacci_sphere(self, count: int, radius: float) -> Object:
        r"""Copies spread evenly over a sphere along a Fibonacci spiral, each with its z axis pointing outward.

            copies at R nᵢ, nᵢ of height 1 − (2i + 1)/n and longitude i π(3 − √5), their z axis along nᵢ; for objects, later copies replace earlier ones

        Section 7.7 of Galin et al. (2026).

        of: The field or object to copy. (object)
        count: Number of copies. (whole number; at least 1 and at most 100000)
        radius: Radius of the sphere of the copies' origins. (number in m; positive)
        """
    def scatter(self, on: Field | Expression, count: int, spacing: float | None = ..., smallest: float | None = ..., seed: int | None = ...) -> Object:
        r"""Copies scattered over the surface of a field, each with its z axis pointing outward, and with random rotations.

            copies at random points of the surface f = 0, their z axis along ∇f; for objects, later copies replace earlier ones

        of: The field or object to copy. (object)
        on: The field whose surface the copies stand on; it must be bounded. (field)
        count: Number of copies; fewer if there is not enough space. (whole number; at least 1 and at most 100000)
        spacing: Minimum distance between the copies' origins. (number in m; zero or more; default 0)
        smallest: Minimum size: sizes are random between this factor and 1. (number; at least 0.01 and at most 1; default 1)
        seed: Seed of the random positions. (whole number; at least 0 and at most 1000000; default 1)
        """
    def bounding_volume(self, margin: float, volume: Field | Expression | None = ...) -> Object:
        r"""A field or an object with a bounding volume, whose distance replaces it far away. Parts outside the volume are cut off.

            max(b, min(f, 2m − b));  φᵢ likewise,  φ₀ = min(−b, max(a₀, b − 2m))

        Sections 4.1 and 7.3 of Galin et al. (2026).

        of: The field or object to bound. (object)
        margin: Distance from the volume, or from the proxy's surface, beyond which its distance replaces that of the child. (number in m; positive)
        volume: The bounding volume, a field. Default: the bounding box. (field; default none)
        """
    def proxy(self, proxy: Field | Expression, error: float, margin: float, inside: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
        r"""A field or an object with a proxy, a simpler field g near it, which replaces it away from the surface, outside and inside. Parts more than e outside the proxy are cut off, and gaps more than e inside it are filled.

            min(c, max(h, −2m − c)),  h = max(b, min(f, 2m − b)),  b = g − e,  c = g + e

        Sections 4.1 and 7.3 of Galin et al. (2026).

        of: The field or object to replace. (object)
        proxy: The simpler field, g. (field)
        error: Maximum distance e between the two surfaces. (number in m; zero or more)
        margin: Distance from the volume, or from the proxy's surface, beyond which its distance replaces that of the child. (number in m; positive)
        inside: For an object: the phase that fills the part of the proxy deeper than e. By default, the proxy is used only outside. (phase or list of phases; default none)
        """
    def level_of_detail(self, *of: Object, viewpoint: Sequence[float] | np.ndarray | None = ..., distances: Sequence[float] | np.ndarray | None = ..., errors: Sequence[float] | np.ndarray | None = ...) -> Object:
        r"""Levels of detail of a field or an object, from fine to coarse, each used within a range of distances from a viewpoint. Without distances, the finest level is used everywhere, unless distances are chosen for a view (`phasetree render --detail`; in C++, with_levels_of_detail()).

            min(max(a, n), max(b, −n), max(a, b)),  n = |p − v| − d;  φᵢ and φ₀ alike

        Sections 4.1 and 7.3 of Galin et al. (2026).

        of: The levels, fields or objects, the finest first. (list of objects)
        viewpoint: The viewpoint from which distances are measured. ([x, y, z] in m; default [0, 0, 0])
        distances: Increasing distances at which each level is replaced by the next; one less than there are levels. (list of numbers in m; positive; default [])
        errors: For each coarser level, the distance of its surface from that of the finest level, in increasing order. --detail compares these with the size of a pixel. They are trusted, not checked. (list of numbers in m; positive; default [])
        """
    def under(self, *of: Object) -> Object:
        r"""Combines objects; where they overlap, later ones replace earlier ones. Applied pairwise, from the first object to the last.

            φᵢ = max(min(aᵢ, bᵢ), −min over j ≠ i of bⱼ),  φ₀ = max(a₀, b₀)

        Section 4.3 of Galin et al. (2026).

        of: The objects, at least one. (list of objects)
        """
    def over(self, *of: Object) -> Object:
        r"""Combines objects; where they overlap, earlier ones replace later ones. Applied pairwise, from the last object to the first.

            A ∪₊ B = B ∪₋ A;  A ∪₊ (B ∪₊ (C ∪₊ …))

        Section 4.3 of Galin et al. (2026).

        of: The objects, at least one. (list of objects)
        """
    def layered(self, phase: Phase | str, thickness: float) -> Object:
        r"""Embeds an object in a layer of another phase.

            φₖ = max(−a₀ − t, a₀),  φ₀ = a₀ + t

        Section 4.5 of Galin et al. (2026).

        of: The object. (object)
        phase: The phase of the layer. (phase)
        thickness: Thickness of the layer. (number in m; positive)
        """
    def intersect_shape(self, shape: Field | Expression, phases: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
        r"""Cuts all phases of an object, or only some of them, to the inside of a shape.

            φₖ = max(aₖ, f),  φ₀ = min(a₀, −f) if all phases are cut, else min(a₀, min over the cut k of max(aₖ, −f))

        Section 5.1 of Galin et al. (2026).

        of: The object. (object)
        shape: The field to keep within. (field)
        phases: The phases to cut; by default all. (phase or list of phases; default none)
        """
    def subtract_shape(self, shape: Field | Expression, phases: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
        r"""Cuts a shape out of all phases of an object, or out of only some of them.

            φₖ = max(aₖ, −f),  φ₀ = min(a₀, f) if all phases are cut, else min(a₀, min over the cut k of max(aₖ, f))

        Section 5.1 of Galin et al. (2026).

        of: The object. (object)
        shape: The field to cut away. (field)
        phases: The phases to cut; by default all. (phase or list of phases; default none)
        """
    def change(self, from_: Phase | str, to: Phase | str, shape: Field | Expression | None = ...) -> Object:
        r"""Turns one phase into another inside a shape, or everywhere if no shape is given.

            φᵢ = max(aᵢ, −f),  φₖ = min(aₖ, max(aᵢ, f)),  φ₀ = a₀

        Section 5.2 of Galin et al. (2026).

        of: The object. (object)
        from_: The phase to change. (phase)
        to: The phase that it becomes. (phase)
        shape: The field inside which to change it; by default everywhere. (field; default none)
        """
    def remove(self, phases: Phase | str | Sequence[Phase | str]) -> Object:
        r"""Replaces phases by vacuum.

            φₖ absent,  φ₀ = min(a₀, aₖ)

        Section 5.2 of Galin et al. (2026).

        of: The object. (object)
        phases: The phases to remove. (phase or list of phases)
        """
    def contact(self, b: Object, phase_a: Phase | str, phase_b: Phase | str, alpha: float) -> Object:
        r"""Two phases pressed against each other: they share the overlap.

            f = α aᵢ − (1 − α) bⱼ,  φᵢ = max(aᵢ, f),  φⱼ = max(bⱼ, −f),  φ₀ = max(a₀, b₀)

        Section 4.4 of Galin et al. (2026).

        a: The object A. (object)
        b: The object B, which replaces A where they overlap without being in contact. (object)
        phase_a: The phase of A that is in contact. (phase)
        phase_b: The phase of B that is in contact. (phase)
        alpha: Where in the overlap they meet: 0 gives it all to B, 1 to A; at 1/2 both are equally deep in it. (number; at least 0 and at most 1)
        """
    def contacts(self, b: Object, alpha: float, phases_a: Phase | str | Sequence[Phase | str] | None = ..., phases_b: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
        r"""Contact between sets of phases: objects that press against each other and keep their phases.

            f = α a_K − (1 − α) b_L,  a_K = −min over k ∉ K of aₖ,  b_L likewise,  bⱼ ← max(bⱼ, −f) for j ∈ L,  then A ∪₋ B

        Section 4.4 of Galin et al. (2026).

        a: The object A. (object)
        b: The object B, which replaces A where they overlap without being in contact. (object)
        alpha: Where in the overlap they meet: 0 gives it all to B, 1 to A; at 1/2 both are equally deep in it. (number; at least 0 and at most 1)
        phases_a: The phases of A in contact; by default all. (phase or list of phases; default none)
        phases_b: The phases of B in contact; by default all. (phase or list of phases; default none)
        """
    def close_gaps(self, phases: Sequence[Phase | str], gap: float) -> Object:
        r"""Fills thin gaps between phases, such as those between a glass and a liquid that was modelled a little too small. Vacuum becomes part of a phase where its distances to two phases add up to less than the gap. Combine the phases with over or under first, so that they no longer overlap.

            dₖ = (aₖ + min over l after k of aₗ − g)/2;  for each k in order, φₖ ← max(min(φₖ, dₖ), −min over j ≠ 0, k of φⱼ),  φ₀ ← max(φ₀, −dₖ)

        of: The object. (object)
        phases: The phases between which gaps are closed, at least two. A gap becomes part of the phase listed first. (list of phases)
        gap: Gaps narrower than this are closed. Make it at least twice as wide as the gaps, because those in corners are wider. (number in m; positive)
        """
    def layered_sequence(self, phases: Sequence[Phase | str], thicknesses: Sequence[float] | np.ndarray) -> Object:
        r"""Embeds an object in layers, the innermost first.

            φₖ = max(−a₀ − Tₖ, a₀ + Tₖ₋₁),  Tₖ = t₁ + … + tₖ,  φ₀ = a₀ + Tₙ

        Section 4.5 of Galin et al. (2026).

        of: The object. (object)
        phases: The phase of each layer, from the inside out. (list of phases)
        thicknesses: The thickness of each layer, from the inside out. (list of numbers in m; positive)
        """
    def smooth_layered(self, phase: Phase | str, thickness: float, radius: float) -> Object:
        r"""Embeds an object in a layer that fills the grooves between its phases, which are blended in the order of their indices.

            m = smin over i of aᵢ, less t;  φₖ = max(m, a₀),  φ₀ = max(a₀, −m)

        Section 4.5 of Galin et al. (2026).

        of: The object. (object)
        phase: The phase of the layer. (phase)
        thickness: Thickness of the layer away from the grooves. (number in m; positive)
        radius: Blending radius: surfaces blend where they are closer to each other than this. (number in m; positive)
        """
    def unite_shape_below(self, shape: Field | Expression, phase: Phase | str) -> Object:
        r"""Adds a shape to one phase, below the other phases.

            φₖ = max(min(aₖ, f), −min over j ≠ k of aⱼ),  φ₀ = max(a₀, −f)

        Section 5.1 of Galin et al. (2026).

        of: The object. (object)
        shape: The field to add. (field)
        phase: The phase that grows. (phase)
        """
    def smooth_unite_shape(self, shape: Field | Expression, phase: Phase | str, radius: float) -> Object:
        r"""Blends a shape into one phase, over the other phases.

            s = smin(aₖ, f),  φₖ = s,  φᵢ = max(aᵢ, −s),  φ₀ = max(a₀, −s)

        Section 5.3 of Galin et al. (2026).

        of: The object. (object)
        shape: The field to add. (field)
        phase: The phase that grows. (phase)
        radius: Blending radius: surfaces blend where they are closer to each other than this. (number in m; positive)
        """
    def smooth_unite_shape_below(self, shape: Field | Expression, phase: Phase | str, radius: float) -> Object:
        r"""Blends a shape into one phase, below the other phases.

            s = smin(aₖ, f),  φₖ = max(s, −min over j ≠ k of aⱼ),  φ₀ = max(a₀, −s)

        Section 5.3 of Galin et al. (2026).

        of: The object. (object)
        shape: The field to add. (field)
        phase: The phase that grows. (phase)
        radius: Blending radius: surfaces blend where they are closer to each other than this. (number in m; positive)
        """
    def smooth_intersect_shape(self, shape: Field | Expression, phase: Phase | str, radius: float) -> Object:
        r"""Keeps only the part of one phase inside a shape, and rounds the new edges.

            s = −smin(−aₖ, −f),  φₖ = s,  φ₀ = min(a₀, max(aₖ, −s, −f − r))

        Section 5.3 of Galin et al. (2026).

        of: The object. (object)
        shape: The field to keep within. (field)
        phase: The phase to cut. (phase)
        radius: Blending radius: surfaces blend where they are closer to each other than this. (number in m; positive)
        """
    def smooth_subtract_shape(self, shape: Field | Expression, phase: Phase | str, radius: float) -> Object:
        r"""Cuts a shape away from one phase, and rounds the new edges.

            s = −smin(−aₖ, f),  φₖ = s,  φ₀ = min(a₀, max(aₖ, −s, f − r))

        Section 5.3 of Galin et al. (2026).

        of: The object. (object)
        shape: The field to cut away. (field)
        phase: The phase to cut. (phase)
        radius: Blending radius: surfaces blend where they are closer to each other than this. (number in m; positive)
        """
    def interface(self, phase_a: Phase | str, phase_b: Phase | str, half_thickness: float) -> Object:
        r"""A thin volume about the interface between two phases, equally deep in both.

            S = max(aᵢ, aⱼ) − ε,  φᵢ = max(aᵢ, S),  φⱼ = max(aⱼ, S),  φ₀ = min(a₀, −S, min over k ≠ i, j of aₖ)

        Section 7.4 of Galin et al. (2026).

        of: The object. (object)
        phase_a: The phase on one side. (phase)
        phase_b: The phase on the other side. (phase)
        half_thickness: Depth ε in each phase. (number in m; positive)
        """
    def interfaces(self, half_thickness: float) -> Object:
        r"""Thin volumes about all interfaces between phases.

            S = (second smallest of a₁ … aₙ) − ε,  φᵢ = max(aᵢ, S),  φ₀ = min(a₀, −S)

        Section 7.4 of Galin et al. (2026).

        of: The object, with at least two phases. (object)
        half_thickness: Depth ε in each phase. (number in m; positive)
        """
    def translate(self, by: Sequence[float] | np.ndarray, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
        r"""Translates.

            φ(p − v)

        Section 6 of Galin et al. (2026).

        of: The field or object to warp. (object)
        by: Image of the origin. ([x, y, z] in m)
        over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
        under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
        """
    def rotate(self, angle: float, axis: Sequence[float] | np.ndarray | None = ..., over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
        r"""Rotates about an axis through the origin, by the right-hand rule.

            φ(Rᵀ p)

        Section 6 of Galin et al. (2026).

        of: The field or object to warp. (object)
        angle: Angle. (number in degrees)
        axis: Direction of the axis; any length but zero. ([x, y, z]; default [0, 0, 1])
        over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
        under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
        """
    def scale(self, factor: float, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
        r"""Scales by the same factor along all axes.

            s · φ(p / s)

        Section 6 of Galin et al. (2026).

        of: The field or object to warp. (object)
        factor: The factor. (number; positive)
        over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
        under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
        """
    def twist(self, rate: float, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
        r"""Twists about the z axis.

            φ(R(−k z) p) / λ,  λ = (kρ + √(k²ρ² + 4))/2,  ρ the largest within the bounds

        Section 6 of Galin et al. (2026).

        of: The field or object to warp. (object)
        rate: Angle per unit of height. (number in degrees/m)
        over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
        under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
        """
    def stretch(self, factors: Sequence[float] | np.ndarray, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
        r"""Scales by a different factor along each axis.

            φ(x/sx, y/sy, z/sz) · min(sx, sy, sz)

        Section 6 of Galin et al. (2026).

        of: The field or object to warp. (object)
        factors: The factors along x, y and z. ([x, y, z]; positive)
        over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
        under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
        """
    def mirror(self, normal: Sequence[float] | np.ndarray | None = ..., over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
        r"""Mirrors at a plane through the origin: keeps the half to which the normal points, and adds its mirror image.

            φ(p − 2 min(p·n, 0) n)

        Section 6 of Galin et al. (2026).

        of: The field or object to warp. (object)
        normal: Direction that points into the half that is kept; any length but zero. ([x, y, z]; default [1, 0, 0])
        over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
        under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
        """
    def taper(self, rate: float, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
        r"""Narrows or widens along the z axis.

            φ(x/s, y/s, z) / λ,  s = 1 + c z

        Section 6 of Galin et al. (2026).

        of: The field or object to warp. (object)
        rate: Change of size per unit of height; the size at z = 0 is unchanged. (number in 1/m)
        over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
        under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
        """
    def bend(self, rate: float, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
        r"""Bends the x axis into an arc towards +z.

            φ(θ/k, y, (1 − r)/k) / λ,  (r, θ) polar: r sin θ = k x, r cos θ = 1 − k z

        Section 6 of Galin et al. (2026).

        of: The field or object to warp. (object)
        rate: Angle per unit of length along x; negative to bend towards −z. (number in degrees/m)
        over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
        under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
        """
    def affine(self, x: Sequence[float] | np.ndarray | None = ..., y: Sequence[float] | np.ndarray | None = ..., z: Sequence[float] | np.ndarray | None = ..., by: Sequence[float] | np.ndarray | None = ..., over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
        r"""Maps the unit vectors to any three vectors that span space, and the origin to a point: shears, stretches, rotates and mirrors.

            φ(M⁻¹(p − v))/λ,  M = (x y z),  λ = ‖M⁻¹‖₂

        Section 6 of Galin et al. (2026).

        of: The field or object to warp. (object)
        x: Image of the vector [1, 0, 0]. ([x, y, z]; default [1, 0, 0])
        y: Image of the vector [0, 1, 0]. ([x, y, z]; default [0, 1, 0])
        z: Image of the vector [0, 0, 1]. ([x, y, z]; default [0, 0, 1])
        by: Image of the origin. ([x, y, z] in m; default [0, 0, 0])
        over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
        under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
        """
    def distort(self, amplitude: float, scale: float, octaves: float | None = ..., over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
        r"""Distorts space by fractal noise, as in rock or smoke.

            φ(p + a (n(p), n(p + u), n(p + v)))/λ,  λ = 1 + √3 a L,  L = 15 octaves/(4 scale Σ 2⁻ⁱ)

        Section 6 of Galin et al. (2026).

        of: The field or object to warp. (object)
        amplitude: Largest displacement along each axis, a. (number in m; zero or more)
        scale: Size of the largest swirls. (number in m; positive)
        octaves: Number of octaves of swirls, each with half the size of the one before. (number; at least 1 and at most 6; default 1)
        over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
        under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
        """

class Image:
    r"""A picture: linear Rec.709 radiance, and optional planes.

    pixels: float32 (height, width, 3), the top row first. planes: float32 (height, width) each, by the names of their
    channels in EXR files, such as "depth.Z" or "normal.X". crop: (x0, y0, width, height): the position of this
    picture's first pixel in the uncropped picture, and the size of the uncropped picture; None if not cropped. (This is
    not the form that Scene.render takes.) attributes: further EXR attributes, such as the
    names in a Cryptomatte."""
    def __init__(self, pixels, planes=..., exposure=..., view=..., samples=..., seconds=..., scene=..., seed=..., crop=..., attributes=...):
        r"""Initialize self.  See help(type(self)) for accurate signature."""
    def png(self, exposure=..., view=...):
        r"""The bytes of a PNG file of the picture, after the display transform. exposure: in stops."""
    def save(self, path, exposure=..., view=...):
        r"""Writes .exr (linear, with all planes), .png, .jpg or .tif; one file per plane if an .exr name has "{plane}"."""

class Scene:
    r"""One or several objects, with everything that a picture of them needs. Immutable; `with_` replaces parts.

    object: an Object; to render it, give its phases materials. A scene has either this object, or `objects`, or only
    meshes. objects: {name: object}, or {name: (object, map)}, where the map is a position or a 3x4 or 4x4 matrix.
    Objects may touch, but must not overlap. instances: one or several pt.instances_of(name, transforms), which place
    objects and groups. An object with instances appears only where they place it, not at its own map as well. groups:
    {name: instances}.

    unit: the unit of lengths, "mm", "cm", "m" or "in"; it does not affect rendering. expect: statements, as in "expect"
    of a scene file, which `phasetree check --prove` proves or refutes.

    camera: pt.camera(…), or one of pt.cameras. lights, meshes: one or several. background: the colour that the camera
    sees instead of the lights at infinity. image: pt.image(…)."""
    def __init__(self, object=..., camera=..., lights=..., meshes=..., background=..., image=..., name=..., *, objects=..., groups=..., instances=..., unit=..., expect=...):
        r"""Initialize self.  See help(type(self)) for accurate signature."""
    def with_(self, **parts):
        r"""The same scene with some parts replaced: scene.with_(camera=…)."""
    def to_json(self, **image):
        r"""The scene as the text of a scene file. image: settings that replace the scene's own."""
    def save(self, path):
        r"""Writes a scene file, from which load() makes an equal scene.

Files within the folder of the scene file are named relative to it."""
    def render(self, *, progress=..., threads=..., crop=..., quality=..., max_bytes=..., planes=..., denoise=..., time_limit=..., at=..., **image):
        r"""Path-traces the scene. Returns an Image, which does not depend on the number of threads. Ctrl-C ends it.

image: settings that replace the scene's own, such as samples=16, width=400. crop: (x0, y0, x1, y1) in pixels.
progress: True for a line on standard error, or a function of the stage and the fraction done, in [0, 1].

planes: the names of the planes to record in Image.planes, such as ["depth", "normal"], or "all", as for
--planes of the command. denoise: True for the best method available, "oidn", or "regression", whose result does
not depend on the version of Open Image Denoise. Image.planes then has the picture before denoising as
"noisy.R", "noisy.G" and "noisy.B".

time_limit: in seconds; rendering stops with the last pass that fits. Unless samples is also given, only the
time ends the render. at: the time in seconds at which animated values are evaluated."""

class Instances:
    of: str
    transforms: np.ndarray
    def __len__(self) -> int: ...

def instances_of(of: str, transforms: Sequence[float] | Sequence[Sequence[float]] | np.ndarray) -> Instances:
    r"""Instances of an object or a group, for the `instances` or `groups` of a Scene. Returns Instances.

    of: the name of the object or group. transforms: positions of shape (3,) or (N, 3), or matrices of
    affine maps, of shape (3, 4), (4, 4), (N, 3, 4) or (N, 4, 4)."""

class View:
    r"""A live view, served until close() is called or the program ends.

    url: the address of the page; anyone on this machine who knows it can see the page. file: the scene file, which the
    page edits."""
    def __init__(self, what, width=..., samples=..., threads=..., port=...):
        r"""Initialize self.  See help(type(self)) for accurate signature."""
    def show(self, what):
        r"""Shows another object or scene on the same page.

The camera stays as the user turned it, unless the camera of the new scene differs from that of the last one."""
    def scene(self):
        r"""The scene with the changes made in the page, except those of the tab View.

An object that was shown without a scene has a sky, a camera and plain colours; `scene().object` is the object.
Raises SceneError if the text typed in the page has an error, and Error after close()."""
    def close(self):
        r"""Ends the view. The page then shows that it has lost the connection."""
    url: str
    file: str
    def __enter__(self) -> View: ...
    def __exit__(self, *_: object) -> None: ...

def view(what: Object | Scene, *, width: int | None = ..., samples: int | None = ..., threads: int = ..., port: int = ..., open: bool | None = ...) -> View:
    r"""Shows an object or a scene in the browser, where it can be turned, cut and edited. Returns a View.

    An object without a scene is shown under a plain sky, and phases without a material get a plain colour. width: of
    the picture, in pixels. samples: final number per pixel. port: on 127.0.0.1; 0 for any free port. open: whether to
    open the page in the browser; by default True, except in notebooks, which embed the page. Raises
    pt.Error if it cannot be shown, and RuntimeError if the port is unavailable."""

class Expression:
    r"""A formula in x, y and z. Immutable.

    It can be used wherever a field is expected, as in glass(x**2 + y**2 - 1); the solid is where the formula is
    negative. within(low, high) cuts the solid to a box. Formulas whose slope grows without bound need this. Formulas
    are evaluated in the precision of the call: double in locate, crossings and so on, otherwise single. When the field
    is made, an upper bound on the slope is determined, and the formula is divided by it."""
    def within(self, low, high):
        r"""The same formula, cut to a box. Each corner is a point, or a number for three equal coordinates."""
    def field(self):
        r"""The formula as a field. Raises Error, with the position in the formula, if the slope has no bound."""
    def __add__(self, other: Expression | float) -> Expression: ...
    def __radd__(self, other: Expression | float) -> Expression: ...
    def __sub__(self, other: Expression | float) -> Expression: ...
    def __rsub__(self, other: Expression | float) -> Expression: ...
    def __mul__(self, other: Expression | float) -> Expression: ...
    def __rmul__(self, other: Expression | float) -> Expression: ...
    def __truediv__(self, other: Expression | float) -> Expression: ...
    def __rtruediv__(self, other: Expression | float) -> Expression: ...
    def __pow__(self, other: float) -> Expression: ...
    def __neg__(self) -> Expression: ...
    def __abs__(self) -> Expression: ...
    def __or__(self, other: Field | Expression) -> Field: ...
    def __and__(self, other: Field | Expression) -> Field: ...

def coordinates() -> tuple[Expression, Expression, Expression]: ...

def sqrt(*values: Expression | float) -> Expression: ...
def abs(*values: Expression | float) -> Expression: ...
def min(*values: Expression | float) -> Expression: ...
def max(*values: Expression | float) -> Expression: ...
def sin(*values: Expression | float) -> Expression: ...
def cos(*values: Expression | float) -> Expression: ...
def tan(*values: Expression | float) -> Expression: ...
def exp(*values: Expression | float) -> Expression: ...
def tanh(*values: Expression | float) -> Expression: ...
def length(*values: Expression | float) -> Expression: ...
def clamp(*values: Expression | float) -> Expression: ...
def smooth_min(*values: Expression | float) -> Expression: ...
def smooth_max(*values: Expression | float) -> Expression: ...
def square(*values: Expression | float) -> Expression: ...

def solve(make, target, low, high, phase=..., densities=..., tolerance=..., seconds=..., progress=...):
    r"""Finds the number between `low` and `high` for which a phase has a given volume or mass. Returns a Solution.

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
whose `result` is the Solution with the bracket so far, or KeyboardInterrupt if there is none yet."""

def load(path: str | PathLike[str]) -> Scene:
    r"""Reads a scene file. Raises SceneError with file, line and column. Comments and names of shapes are not kept.

    Objects taken from another scene file are read from there and become part of this scene. Trees and transforms are
    read at time 0, with a warning if they have keyframes ("keys"); everything else keeps its keyframes.
    """

def sphere(radius: float) -> Field:
    r"""A ball about the origin; exact.

        |p| − r

    radius: Radius. (number in m; positive)
    """

def box(size: Sequence[float] | np.ndarray) -> Field:
    r"""A box about the origin; exact.

        q = |p| − s/2;  |max(q, 0)| + min(max(qx, qy, qz), 0)

    size: Edge lengths along x, y and z. ([x, y, z] in m; positive)
    """

def rounded_box(size: Sequence[float] | np.ndarray, radius: float) -> Field:
    r"""A box with rounded edges and corners, without a change of size; exact.

        box(s − 2r) − r

    size: Edge lengths along x, y and z, rounding included. ([x, y, z] in m; positive)
    radius: Radius of the edges, at most half the shortest edge. (number in m; zero or more)
    """

def cylinder(radius: float, height: float) -> Field:
    r"""A cylinder about the z axis, centred at the origin; exact.

        q = (|pxy| − r, |pz| − h/2);  |max(q, 0)| + min(max(qx, qy), 0)

    radius: Radius. (number in m; positive)
    height: Whole height. (number in m; positive)
    """

def capped_cone(radius_bottom: float, radius_top: float, height: float) -> Field:
    r"""A truncated cone about the z axis, centred at the origin; exact.

        ± min(distance to the caps, distance to the slanted side)

    radius_bottom: Radius at z = −height/2. (number in m; zero or more)
    radius_top: Radius at z = height/2. (number in m; zero or more)
    height: Whole height. (number in m; positive)
    """

def capsule(from_: Sequence[float] | np.ndarray, to: Sequence[float] | np.ndarray, radius: float) -> Field:
    r"""All points within r of a segment; exact.

        |p − nearest point of the segment| − r

    from_: One end of the segment. ([x, y, z] in m)
    to: The other end. ([x, y, z] in m)
    radius: Radius. (number in m; positive)
    """

def torus(major: float, minor: float) -> Field:
    r"""A ring about the z axis; exact if the tube's radius is at most the ring's.

        |(|pxy| − R, pz)| − r

    major: Radius of the ring's centre line. (number in m; positive)
    minor: Radius of the tube. (number in m; positive)
    """

def plane(normal: Sequence[float] | np.ndarray | None = ..., offset: float | None = ...) -> Field:
    r"""The half-space below a plane: the solid is where p·n < d; exact.

        p·n − d

    normal: Direction that points out of the solid; any length but zero. ([x, y, z]; default [0, 0, 1])
    offset: Distance of the plane from the origin along the normal. (number in m; default 0)
    """

def ellipsoid(radii: Sequence[float] | np.ndarray) -> Field:
    r"""An ellipsoid about the origin; a lower bound, exact at the ends of the axes.

        max(min r · (|p/r| − 1), box(p, 2r), |p| − max r)

    radii: Half axes along x, y and z. ([x, y, z] in m; positive)
    """

def capped_torus(major: float, minor: float, angle: float) -> Field:
    r"""Part of a ring about the z axis, with round ends, centred on the x axis; exact if the tube's radius is at most the ring's.

        |p − nearest point of the arc| − r

    major: Radius of the arc. (number in m; positive)
    minor: Radius of the tube. (number in m; positive)
    angle: Angle of the whole arc. (number in degrees; more than 0 and at most 360)
    """

def link(length: float, major: float, minor: float) -> Field:
    r"""A link of a chain in the xy plane, long along y; exact if the rod's radius is at most the ring's.

        y = max(|py| − l/2, 0);  |(|(px, y)| − R, pz)| − r

    length: Length of the straight part. (number in m; zero or more)
    major: Radius of the centre line of the half rings. (number in m; positive)
    minor: Radius of the rod. (number in m; positive)
    """

def tube(radius: float, inner_radius: float, height: float) -> Field:
    r"""A hollow cylinder about the z axis, open at both ends; exact.

        q = (||pxy| − (R + r)/2| − (R − r)/2, |pz| − h/2);  |max(q, 0)| + min(max(qx, qy), 0)

    radius: Outer radius. (number in m; positive)
    inner_radius: Radius of the hole, less than the outer one. (number in m; positive)
    height: Whole height. (number in m; positive)
    """

def rounded_cylinder(radius: float, height: float, edge: float) -> Field:
    r"""A cylinder with rounded rims, without a change of size; exact.

        cylinder(r − e, h − 2e) − e

    radius: Radius, rounding included. (number in m; positive)
    height: Whole height, rounding included. (number in m; positive)
    edge: Radius of the rims, at most the radius and half the height. (number in m; zero or more)
    """

def round_cone(from_: Sequence[float] | np.ndarray, radius_from: float, to: Sequence[float] | np.ndarray, radius_to: float) -> Field:
    r"""The convex hull of two balls; exact.

        k = c x − s y;  k < 0: |p − from| − a;  k > c l: |p − to| − b;  else s x + c y − a

    from_: Centre of one ball. ([x, y, z] in m)
    radius_from: Its radius. (number in m; positive)
    to: Centre of the other ball. ([x, y, z] in m)
    radius_to: Its radius. (number in m; positive)
    """

def spherical_cap(radius: float, cut: float | None = ...) -> Field:
    r"""The part of a ball about the origin above the plane z = c; exact.

        ± min(distance to the disk, ||p| − r| where r pz ≥ c |p|)

    radius: Radius of the ball. (number in m; positive)
    cut: Height z of the plane; 0 leaves a hemisphere. (number in m; default 0)
    """

def prism(sides: float, radius: float, height: float) -> Field:
    r"""A prism about the z axis, whose base is a regular polygon with an edge perpendicular to the x axis; exact.

        fold to one sector;  q = (polygon, |pz| − h/2);  |max(q, 0)| + min(max(qx, qy), 0)

    sides: Number of sides of the polygon. (number; at least 3 and at most 64)
    radius: Radius of the circle through the corners. (number in m; positive)
    height: Whole height. (number in m; positive)
    """

def wedge(size: Sequence[float] | np.ndarray) -> Field:
    r"""Half of a box about the origin, below the plane x/sx + z/sz = 0; exact.

        q = (± distance to the triangle's sides, |py| − sy/2);  |max(q, 0)| + min(max(qx, qy), 0)

    size: Edge lengths along x, y and z. ([x, y, z] in m; positive)
    """

def pyramid(base: float, height: float) -> Field:
    r"""A pyramid with a square base about the z axis, with the origin at half its height; exact.

        ± min(distance to the base, distance to the nearest slanted face)

    base: Edge of the square at z = −height/2. (number in m; positive)
    height: Height of the apex above the base. (number in m; positive)
    """

def octahedron(radius: float) -> Field:
    r"""A regular octahedron about the origin; exact.

        distance to the projection of |p| onto x + y + z = r

    radius: Distance of the corners, which lie on the axes, from the origin. (number in m; positive)
    """

def tetrahedron(radius: float) -> Field:
    r"""A regular tetrahedron about the origin, with corners on the space diagonals; exact.

        fold to x ≥ y ≥ |z|;  m, or |(m, e, max(t − √2 k, 0))| beyond the edge,  m the height above the face's plane, e the distance beyond its edge, t along the edge, k = radius/√3

    radius: Distance of the corners from the origin. (number in m; positive)
    """

def gyroid(period: float, thickness: float) -> Field:
    r"""A wall along Schoen's gyroid, repeated endlessly along all axes; a lower bound.

        |sin x cos y + sin y cos z + sin z cos x|/(√3 k) − t/2,  (x, y, z) = k p,  k = 2π/period

    period: Edge length of the unit cell. (number in m; positive)
    thickness: Minimum thickness of the wall. (number in m; positive)
    """

def schwarz_p(period: float, thickness: float) -> Field:
    r"""A wall along Schwarz' primitive surface, repeated endlessly along all axes; a lower bound.

        |cos x + cos y + cos z|/(√3 k) − t/2,  (x, y, z) = k p,  k = 2π/period

    period: Edge length of the unit cell. (number in m; positive)
    thickness: Minimum thickness of the wall. (number in m; positive)
    """

def schwarz_d(period: float, thickness: float) -> Field:
    r"""A wall along Schwarz' diamond surface, repeated endlessly along all axes; a lower bound.

        |sin x cos(y − z) + cos x sin(y + z)|/(√3 k) − t/2,  (x, y, z) = k p,  k = 2π/period

    period: Edge length of the unit cell. (number in m; positive)
    thickness: Minimum thickness of the wall. (number in m; positive)
    """

def polyline(points: Sequence[Sequence[float]] | np.ndarray, radius: float) -> Field:
    r"""A round wire along a chain of straight segments.

        min over segments ab of |p − a − t (b − a)| − r, t in [0, 1]

    points: The chain's points, at least two. (list of [x, y, z] in m)
    radius: Radius of the wire. (number in m; positive)
    """

def voronoi_cells(size: float, gap: float, rounding: float | None = ..., jitter: float | None = ..., seed: float | None = ...) -> Field:
    r"""Blocks with gaps between them, filling space: the cells of an irregular lattice of sites.

        g/2 − max(v, 0),  v = (Σ over t ≠ s of (bₜ + c)⁻⁸)^(−1/8) − c,  bₜ = (|p − t|² − |p − s|²)/(2|t − s|),  s the nearest site

    Sections 4.3 and 9.1 of Galin et al. (2026).

    size: Edge length of the cubes, each of which has one site. (number in m; positive)
    gap: Width of the gap between blocks. (number in m; positive)
    rounding: Rounding c of the edges; 0 for sharp ones. (number in m; zero or more; default 0)
    jitter: Irregularity: 0 puts the sites on a cubic lattice, 1 anywhere in their cubes. (number; at least 0 and at most 1; default 0.9)
    seed: Seed of the pattern. (number; at least 0 and at most 288; default 0)
    """

def siren(file: str | PathLike[str], samples: int | None = ...) -> Field:
    r"""A neural field with sinusoidal layers, from a file of weights.

        max(|p| − R, f(p)/λ),  λ = Π ‖Wᵢ‖₂

    Sections 7.5 and 9.4 of Galin et al. (2026).

    file: File of weights: JSON, {"radius": R, "layers": [{"weights": [[…], …], "bias": […]}, …]}, with the frequencies multiplied in. (name of a file)
    samples: 0: λ is the product of the layers' spectral norms, a proven bound on the slope. n > 0: λ is 1.1 times the steepest slope found at n points, which is tighter and faster, but not proven. (whole number; at least 0 and at most 10000000; default 0)
    """

def height_map(file: str | PathLike[str], size_x: float, size_y: float, height: float) -> Field:
    r"""The ground below a height map, which is centred on the z axis; black is low and white is high.

        min(max((z − h(x, y))/√(1 + Lx² + Ly²), z − max h), z − min h),  h the quadratic B-spline of the pixels

    Section 7.1 of Galin et al. (2026).

    file: Image file, of which the first channel is used. (name of a file)
    size_x: Width of the image, along x. (number in m; positive)
    size_y: Height of the image, along y. (number in m; positive)
    height: Height of white; black is at z = 0. (number in m; positive)
    """

def mesh(file: str | PathLike[str], rule: Literal["winding_number", "even_odd", "non_zero"] | None = ..., thickness: float | None = ...) -> Field:
    r"""The solid inside a surface of triangles, exact; or a wall along the surface.

        ± min over the triangles of |p − nearest point|; with a thickness, min … − thickness/2

    file: Mesh file: OBJ, PLY or STL. Coordinates are used as they are, as lengths in the scene's unit. Place the mesh by wrapping the node in `scale`, `rotate` and `translate`; a file whose y axis points up needs {"rotate": {"axis": [1, 0, 0], "angle": 90, "of": …}}. Materials, colours, normals and texture coordinates of the file are ignored: the phases define the materials. Triangles are counter-clockwise seen from outside. Vertices that differ only by rounding are merged. Holes are closed, parts that intersect are joined, and parts that are inside out are flipped. A surface that encloses nothing is rejected unless it has a `thickness`; so are parts that coincide within rounding. Walls and gaps thinner than a millionth of the mesh's size may be confused. (name of a file)
    rule: Which points are inside, by how often the surface winds around them: "winding_number": at least once, the union of all parts; "even_odd": an odd number of times, so a part within another is a cavity; "non_zero": at least once, in either direction. All three are the same for a closed mesh whose parts do not overlap. (`"winding_number"`, `"even_odd"`, `"non_zero"`; default "winding_number")
    thickness: Thickness of a wall along the surface, half of it on either side. Use it for an open sheet, or for a closed surface that is to be hollow. The mesh is used as it is, without repairs, and `rule` is ignored. Open edges and convex edges of the wall are rounded, with a radius of half of the thickness. 0: the solid inside the surface. (number in m; zero or more; default 0)
    """

def volume(file: str | PathLike[str], grid: str | None = ...) -> Field:
    r"""The solid of a level set in an OpenVDB file, in the position stored there. Beyond the file's narrow band, the field's values are constant.

        max(b, f/λ),  f the trilinear interpolation of the voxels, λ = max(1, sup |∇f|), b the grid's box

    file: OpenVDB file. Its grid must be a level set of floats or doubles whose axes are aligned with those of space, in any order and direction. Its lengths are taken as lengths in the scene's unit. (name of a file)
    grid: Name of the grid; required if the file has several level sets. If several have the same name, append the index: "name[0]", "name[1]". (text; default "")
    """

def circle(radius: float) -> Field:
    r"""A disk about the origin, for extruding and revolving; the same at every z, exact.

        |pxy| − r

    radius: Radius. (number in m; positive)
    """

def rectangle(width: float, height: float, radius: float | None = ...) -> Field:
    r"""A rectangle about the origin, for extruding and revolving; the same at every z, exact.

        q = |pxy| − s/2 + r;  |max(q, 0)| + min(max(qx, qy), 0) − r

    width: Whole length along x. (number in m; positive)
    height: Whole length along y. (number in m; positive)
    radius: Radius of the corners, at most half the shorter side. (number in m; zero or more; default 0)
    """

def star(points: float, radius: float, inner_radius: float) -> Field:
    r"""A star about the origin with a tip on the x axis, for extruding; the same at every z, exact.

        fold to one sector;  ± distance to its edge

    points: Number of tips. (number; at least 3 and at most 64)
    radius: Distance of the tips from the centre. (number in m; positive)
    inner_radius: Distance of the notches from the centre, less than that of the tips. (number in m; positive)
    """

def slab(thickness: float, normal: Sequence[float] | np.ndarray | None = ..., offset: float | None = ...) -> Field:
    r"""The space between two parallel planes; exact.

        |p·n − d| − t/2

    thickness: Distance between the two planes. (number in m; positive)
    normal: Normal of the slab; any length but zero. ([x, y, z]; default [0, 0, 1])
    offset: Distance of the slab's middle from the origin along the normal. (number in m; default 0)
    """

def box_frame(size: Sequence[float] | np.ndarray, thickness: float) -> Field:
    r"""The twelve edges of a box as bars of square cross-section; exact.

        min over the bars of the distance to the bar, − depth within the union

    size: Edge lengths along x, y and z. ([x, y, z] in m; positive)
    thickness: Width of the bars, less than half of the shortest edge. (number in m; positive)
    """

def bowl(radius: float, thickness: float, cut: float | None = ...) -> Field:
    r"""A hollow ball about the origin, cut open at a height, with a rounded rim; exact unless the rim closes the opening.

        (R pz ≤ c |p| ? ||p| − R| : |(|pxy| − w, pz − c)|) − t/2

    radius: Radius of the middle of the wall. (number in m; positive)
    thickness: Thickness of the wall, less than twice the radius. (number in m; positive)
    cut: Height z of the rim; 0 leaves a hemisphere. (number in m; default 0)
    """

def dodecahedron(radius: float) -> Field:
    r"""A regular dodecahedron about the origin. Each coordinate axis passes through the middles of two opposite edges: on x these edges are parallel to z, on y to x, on z to y. Exact.

        fold to one chamber;  |max((a, b, c), 0)| + min(a, 0),  a the height above the face's plane, b the distance beyond its edge, c beyond its corner

    radius: Radius of the sphere through the corners. (number in m; positive)
    """

def icosahedron(radius: float) -> Field:
    r"""A regular icosahedron about the origin. Each coordinate axis passes through the middles of two opposite edges: on x these edges are parallel to y, on y to z, on z to x. Exact.

        fold to one chamber;  |max((a, b, c), 0)| + min(a, 0),  a the height above the face's plane, b the distance beyond its edge, c beyond its corner

    radius: Radius of the sphere through the corners. (number in m; positive)
    """

def helix(radius: float, pitch: float, turns: float, wire_radius: float) -> Field:
    r"""A coil of round wire about the z axis with round ends, centred at half its height. It rises counter-clockwise as seen from above (right-handed) from its lower end, at y = 0 and x > 0. A left-handed coil is its mirror image across y = 0 and starts there, too. Exact where turns do not touch.

        √((ρ − R)² + 4ρR sin²(x/2) + k²(x − M)²) − r,  x + (ρR/k²) sin x = M,  or from an end

    radius: Distance of the wire's centre line from the axis. (number in m; positive)
    pitch: Height of one turn; negative for a left-handed coil; not zero. (number in m)
    turns: Number of turns, at least 1. (number; at least 1 and at most 10000)
    wire_radius: Radius of the wire. (number in m; positive)
    """

def heightfield(size: float, amplitude: float, octaves: float | None = ..., ridged: float | None = ..., seed: float | None = ...) -> Field:
    r"""Terrain: the ground below a surface of fractal noise, infinite in x and y.

        min(max((z − h)/√(1 + L²), z − a), z + a),  L = 15 a (1 + r) octaves/(4 size Σ 2⁻ⁱ)

    size: Size of the largest hills. (number in m; positive)
    amplitude: Largest height above and depth below z = 0, a. (number in m; zero or more)
    octaves: Number of octaves of hills, each with half the size of the one before. (number; at least 1 and at most 6; default 4)
    ridged: From rolling hills, 0, to mountains with sharp ridges, 1. (number; at least 0 and at most 1; default 0)
    seed: Seed of the landscape. (number; at least -100000 and at most 100000; default 0)
    """

def polygon(points: Sequence[Sequence[float]] | np.ndarray) -> Field:
    r"""A polygon with straight edges, for extruding and revolving; the same at every z, exact.

        ± min over the edges of |p − a − clamp((p − a)·e/e², 0, 1) e|

    points: The corners [x, y] in order, in either direction, at most 4096. The last is joined to the first, and edges must not cross. (list of [x, y] in m)
    """

def bezier(points: Sequence[Sequence[float]] | np.ndarray, thickness: float | None = ...) -> Field:
    r"""A shape with an outline of quadratic Bézier curves, or a line along them, for extruding and revolving; the same at every z, exact.

        ± min over the curves of |p − B(t)|, t from the cubic (p − B)·B′ = 0;  for a line, less half of its thickness

    points: [x, y] of a point on the curve, then of a control point, and so on; at most 2048 points. An even number makes a closed curve. An odd number makes an open one, which needs a thickness and ends at its last point. (list of [x, y] in m)
    thickness: Width of a line along the curve; 0 fills a closed curve by the even-odd rule. (number in m; zero or more; default 0)
    """

def text(text: str, file: str | PathLike[str], size: float | None = ..., align: float | None = ..., spacing: float | None = ..., line_height: float | None = ...) -> Field:
    r"""Text in a font, for extruding; the same at every z, exact where no two letters overlap. The baseline of the first line is at y = 0, and further lines follow below.

        min over the letters of ± min over their curves of |p − B(t)|

    text: The text; \n begins a new line. (text)
    file: Font file: TrueType or OpenType (.ttf, .otf). (name of a file)
    size: Em size of the font; capitals are about 0.7 em high. (number in m; positive; default 1)
    align: Alignment of each line: 0 puts its beginning at x = 0, 0.5 its middle, 1 its end. (number; at least 0 and at most 1; default 0)
    spacing: Additional space after each letter; may be negative. (number in em; at least -1 and at most 100; default 0)
    line_height: Distance between lines. (number in em; positive; default 1.2)
    """

def formula(text: str | Expression, bounds: Sequence[Sequence[float]] | np.ndarray | None = ...) -> Field:
    r"""The solid where a formula of x, y and z is negative. Formulas may use + − * / ^ with whole exponents, sqrt, abs, min, max, sin, cos, tan, exp, tanh, length, clamp, smooth_min, smooth_max, pi, and named values: "r = sqrt(x^2 + y^2); r - 1".

        f(x, y, z)/λ;  with bounds B: max(b(p), f(nearest point of B)/λ),  λ ≥ sup |∇f|

    text: The formula. (text)
    bounds: Lowest and highest corner of a box to which the solid is cut. Without it, the slope of the formula must be bounded everywhere. (list of [x, y, z] in m; default [])
    """

def polyhedron(normals: Sequence[Sequence[float]] | np.ndarray, offsets: float | Sequence[float]) -> Field:
    r"""A convex polyhedron: the intersection of half-spaces.

        max over i of nᵢ·p − hᵢ

    normals: Outward normals of the planes, of any length but 0. (list of [x, y, z])
    offsets: Distance h of each plane from the origin along its normal; one number for all, or one per plane. (number or list of numbers in m)
    """

def balls(centres: Sequence[Sequence[float]] | np.ndarray | None = ..., radii: float | Sequence[float] | None = ..., file: str | PathLike[str] | None = ...) -> Field:
    r"""The union of up to sixteen million balls: grains, drops, atoms. Exact outside.

        min over i of |p − cᵢ| − rᵢ

    centres: Centres of the balls, unless they are in a file. (list of [x, y, z] in m; default [])
    radii: Radii of the balls: one number for all, or one per centre. A file may have its own. (number or list of numbers in m; positive; default [])
    file: File of balls: PLY, whose element `vertex` has x, y, z and optionally radius and phase, or CSV with these names in its first line. Coordinates and radii are lengths in the scene's unit. Give either this or the centres. (name of a file; default none)
    """

def union(*of: Field | Expression | Sequence[Field | Expression]) -> Field:
    r"""The points that are inside any field.

        min fᵢ

    of: The fields, at least one. (list of fields)
    """

def intersection(*of: Field | Expression | Sequence[Field | Expression]) -> Field:
    r"""The points that are inside all fields.

        max fᵢ

    of: The fields, at least one. (list of fields)
    """

def difference(from_: Field | Expression, *subtract: Field | Expression | Sequence[Field | Expression]) -> Field:
    r"""Subtracts fields from a field.

        max(f, −min gᵢ)

    from_: The field to cut. (field)
    subtract: The fields to cut away, at least one. (list of fields)
    """

def smooth_union(*of: Field | Expression | Sequence[Field | Expression], radius: float) -> Field:
    r"""Union with filleted seams; applied pairwise, from the first field to the last.

        smin(a, b) = min(a, b) − r/6 · max(1 − |b − a|/r, 0)³

    Section 9.3 of Galin et al. (2026).

    of: The fields, at least one. (list of fields)
    radius: Blending radius: surfaces blend where they are closer to each other than this. (number in m; positive)
    """

def smooth_intersection(*of: Field | Expression | Sequence[Field | Expression], radius: float) -> Field:
    r"""Intersection with rounded edges; applied pairwise, from the first field to the last.

        −smin(−a, −b)

    Section 9.3 of Galin et al. (2026).

    of: The fields, at least one. (list of fields)
    radius: Blending radius: surfaces blend where they are closer to each other than this. (number in m; positive)
    """

def smooth_difference(from_: Field | Expression, *subtract: Field | Expression | Sequence[Field | Expression], radius: float) -> Field:
    r"""Subtracts fields from a field and rounds the new edges.

        −smin(−f, smin gᵢ)

    Section 9.3 of Galin et al. (2026).

    from_: The field to cut. (field)
    subtract: The fields to cut away, at least one. (list of fields)
    radius: Blending radius: surfaces blend where they are closer to each other than this. (number in m; positive)
    """

def offset(of: Field | Expression, distance: float) -> Field:
    r"""Inflates a field by t, or deflates it if t is negative.

        f − t

    Section 4.1 of Galin et al. (2026).

    of: The field. (field)
    distance: Distance by which the surface moves outwards. (number in m)
    """

def shell(of: Field | Expression, half_thickness: float) -> Field:
    r"""A wall of thickness 2t about a field's surface.

        |f| − t

    Section 4.1 of Galin et al. (2026).

    of: The field. (field)
    half_thickness: Half of the wall's thickness, t. (number in m; positive)
    """

def merge(of: Object, phases: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
    r"""Phases of an object as a plain field; it is zero on the interfaces between them.

        min over k of φₖ

    Section 4.2 of Galin et al. (2026).

    of: The object. (object)
    phases: The phases to merge; by default all but the vacuum. (phase or list of phases; default none)
    """

def displace(of: Field | Expression, amplitude: float, scale: float, octaves: float | None = ...) -> Field:
    r"""Displaces the surface of a field by fractal noise.

        min(max((f + a n)/λ, f − a), f + a),  λ = 1 + a L,  L = 15 octaves/(4 scale Σ 2⁻ⁱ)

    of: The field. (field)
    amplitude: Largest displacement, a. (number in m; zero or more)
    scale: Size of the largest bumps. (number in m; positive)
    octaves: Number of octaves of noise, each with half the size of the one before. (number; at least 1 and at most 6; default 1)
    """

@overload
def instances(of: Field, positions: Sequence[Sequence[float]] | np.ndarray, turns: float | Sequence[float] | None = ..., scales: float | Sequence[float] | None = ...) -> Field:
    r"""Copies at the given positions, optionally rotated about the z axis and scaled.

        min over i of sᵢ φ(R(−aᵢ)(p − vᵢ)/sᵢ); for objects, later copies replace earlier ones

    of: The field or object to copy. (object)
    positions: Positions of the copies' origins. (list of [x, y, z] in m)
    turns: Rotation of each copy about its own z axis; one number applies to all. (number or list of numbers in degrees; default [])
    scales: Scale factor of each copy; one number applies to all. (number or list of numbers; positive; default [])
    """
@overload
def instances(of: Object, positions: Sequence[Sequence[float]] | np.ndarray, turns: float | Sequence[float] | None = ..., scales: float | Sequence[float] | None = ...) -> Object:
    r"""Copies at the given positions, optionally rotated about the z axis and scaled.

        min over i of sᵢ φ(R(−aᵢ)(p − vᵢ)/sᵢ); for objects, later copies replace earlier ones

    of: The field or object to copy. (object)
    positions: Positions of the copies' origins. (list of [x, y, z] in m)
    turns: Rotation of each copy about its own z axis; one number applies to all. (number or list of numbers in degrees; default [])
    scales: Scale factor of each copy; one number applies to all. (number or list of numbers; positive; default [])
    """

@overload
def polar_array(of: Field, count: int, angle: float | None = ...) -> Field:
    r"""Copies rotated about the z axis by equal angles.

        min over i < n of φ(R(−i a/n) p); for objects, later copies replace earlier ones

    of: The field or object to copy. (object)
    count: Number of copies. (whole number; at least 1 and at most 10000)
    angle: Total angle: copy i is rotated by i/count of it. Default: a full turn. (number in degrees; default 360)
    """
@overload
def polar_array(of: Object, count: int, angle: float | None = ...) -> Object:
    r"""Copies rotated about the z axis by equal angles.

        min over i < n of φ(R(−i a/n) p); for objects, later copies replace earlier ones

    of: The field or object to copy. (object)
    count: Number of copies. (whole number; at least 1 and at most 10000)
    angle: Total angle: copy i is rotated by i/count of it. Default: a full turn. (number in degrees; default 360)
    """

@overload
def grid(of: Field, spacing: Sequence[float] | np.ndarray, count_x: int | None = ..., count_y: int | None = ..., count_z: int | None = ...) -> Field:
    r"""Copies in rows along x, y and z; the first stays in place. They may overlap. They are ordered by k, then j, then i.

        min over i, j, k of φ(p − (i dx, j dy, k dz)); for objects, later copies replace earlier ones

    of: The field or object to copy. (object)
    spacing: Distance between copies along x, y and z. ([x, y, z] in m)
    count_x: Number of copies along x. (whole number; at least 1 and at most 10000; default 1)
    count_y: Number of copies along y. (whole number; at least 1 and at most 10000; default 1)
    count_z: Number of copies along z. (whole number; at least 1 and at most 10000; default 1)
    """
@overload
def grid(of: Object, spacing: Sequence[float] | np.ndarray, count_x: int | None = ..., count_y: int | None = ..., count_z: int | None = ...) -> Object:
    r"""Copies in rows along x, y and z; the first stays in place. They may overlap. They are ordered by k, then j, then i.

        min over i, j, k of φ(p − (i dx, j dy, k dz)); for objects, later copies replace earlier ones

    of: The field or object to copy. (object)
    spacing: Distance between copies along x, y and z. ([x, y, z] in m)
    count_x: Number of copies along x. (whole number; at least 1 and at most 10000; default 1)
    count_y: Number of copies along y. (whole number; at least 1 and at most 10000; default 1)
    count_z: Number of copies along z. (whole number; at least 1 and at most 10000; default 1)
    """

@overload
def endless_grid(of: Field, spacing: Sequence[float] | np.ndarray) -> Field:
    r"""Copies repeated endlessly along the axes; their bounding boxes must not touch.

        max(b, min(φ(q), 2g − b)),  q = p − s ⌊(p − c)/s + ½⌋,  b = distance to the copies' boxes,  g = half the smallest gap between boxes

    of: The field or object to copy. (object)
    spacing: Distance between copies along x, y and z; 0 for no repetition along that axis. ([x, y, z] in m; zero or more)
    """
@overload
def endless_grid(of: Object, spacing: Sequence[float] | np.ndarray) -> Object:
    r"""Copies repeated endlessly along the axes; their bounding boxes must not touch.

        max(b, min(φ(q), 2g − b)),  q = p − s ⌊(p − c)/s + ½⌋,  b = distance to the copies' boxes,  g = half the smallest gap between boxes

    of: The field or object to copy. (object)
    spacing: Distance between copies along x, y and z; 0 for no repetition along that axis. ([x, y, z] in m; zero or more)
    """

def blob(radii: float | Sequence[float], points: Sequence[Sequence[float]] | np.ndarray | None = ..., polyline: Sequence[Sequence[float]] | np.ndarray | None = ..., of: Field | Expression | Sequence[Field | Expression] | None = ..., weights: float | Sequence[float] | None = ..., threshold: float | None = ...) -> Field:
    r"""A BlobTree: the skeletons are points, a chain of segments and other fields. Their contributions have compact support, add up, and blend into each other.

        max((T − Σ wᵢ (1 − (dᵢ/Rᵢ)²)³)/λ, min dᵢ − rᵢ),  rᵢ = Rᵢ √(1 − ∛(T/Σw)),  λ ≥ sup ‖∇Σ‖

    Sections 7.5 and 9.2 of Galin et al. (2026).

    radii: Radius of influence of each skeleton: one number for all, or one for each of the points, then the polyline, then the fields. (number or list of numbers in m; positive)
    points: Point skeletons. (list of [x, y, z] in m; default [])
    polyline: A chain of segments, which is a single skeleton. (list of [x, y, z] in m; default [])
    of: Fields that serve as skeletons. The distance is 0 inside them. (list of fields; default [])
    weights: Weights of the skeletons, in the same order; default 1. (number or list of numbers; positive; default [])
    threshold: Threshold T; a larger one makes the solid smaller. (number; positive; default 0.5)
    """

@overload
def fibonacci_disk(of: Field, count: int, radius: float, turned: int | None = ...) -> Field:
    r"""Copies spread evenly over a disk about the z axis, on a Fibonacci spiral.

        copies at ρᵢ = R √((i + ½)/n), θᵢ = i π(3 − √5); for objects, later copies replace earlier ones

    Section 7.7 of Galin et al. (2026).

    of: The field or object to copy. (object)
    count: Number of copies. (whole number; at least 1 and at most 100000)
    radius: Radius of the disk of the copies' origins. (number in m; positive)
    turned: 1: each copy is rotated so that its x axis points away from the centre; 0: all copies have the same orientation. (whole number; at least 0 and at most 1; default 0)
    """
@overload
def fibonacci_disk(of: Object, count: int, radius: float, turned: int | None = ...) -> Object:
    r"""Copies spread evenly over a disk about the z axis, on a Fibonacci spiral.

        copies at ρᵢ = R √((i + ½)/n), θᵢ = i π(3 − √5); for objects, later copies replace earlier ones

    Section 7.7 of Galin et al. (2026).

    of: The field or object to copy. (object)
    count: Number of copies. (whole number; at least 1 and at most 100000)
    radius: Radius of the disk of the copies' origins. (number in m; positive)
    turned: 1: each copy is rotated so that its x axis points away from the centre; 0: all copies have the same orientation. (whole number; at least 0 and at most 1; default 0)
    """

@overload
def fibonacci_sphere(of: Field, count: int, radius: float) -> Field:
    r"""Copies spread evenly over a sphere along a Fibonacci spiral, each with its z axis pointing outward.

        copies at R nᵢ, nᵢ of height 1 − (2i + 1)/n and longitude i π(3 − √5), their z axis along nᵢ; for objects, later copies replace earlier ones

    Section 7.7 of Galin et al. (2026).

    of: The field or object to copy. (object)
    count: Number of copies. (whole number; at least 1 and at most 100000)
    radius: Radius of the sphere of the copies' origins. (number in m; positive)
    """
@overload
def fibonacci_sphere(of: Object, count: int, radius: float) -> Object:
    r"""Copies spread evenly over a sphere along a Fibonacci spiral, each with its z axis pointing outward.

        copies at R nᵢ, nᵢ of height 1 − (2i + 1)/n and longitude i π(3 − √5), their z axis along nᵢ; for objects, later copies replace earlier ones

    Section 7.7 of Galin et al. (2026).

    of: The field or object to copy. (object)
    count: Number of copies. (whole number; at least 1 and at most 100000)
    radius: Radius of the sphere of the copies' origins. (number in m; positive)
    """

@overload
def scatter(of: Field, on: Field | Expression, count: int, spacing: float | None = ..., smallest: float | None = ..., seed: int | None = ...) -> Field:
    r"""Copies scattered over the surface of a field, each with its z axis pointing outward, and with random rotations.

        copies at random points of the surface f = 0, their z axis along ∇f; for objects, later copies replace earlier ones

    of: The field or object to copy. (object)
    on: The field whose surface the copies stand on; it must be bounded. (field)
    count: Number of copies; fewer if there is not enough space. (whole number; at least 1 and at most 100000)
    spacing: Minimum distance between the copies' origins. (number in m; zero or more; default 0)
    smallest: Minimum size: sizes are random between this factor and 1. (number; at least 0.01 and at most 1; default 1)
    seed: Seed of the random positions. (whole number; at least 0 and at most 1000000; default 1)
    """
@overload
def scatter(of: Object, on: Field | Expression, count: int, spacing: float | None = ..., smallest: float | None = ..., seed: int | None = ...) -> Object:
    r"""Copies scattered over the surface of a field, each with its z axis pointing outward, and with random rotations.

        copies at random points of the surface f = 0, their z axis along ∇f; for objects, later copies replace earlier ones

    of: The field or object to copy. (object)
    on: The field whose surface the copies stand on; it must be bounded. (field)
    count: Number of copies; fewer if there is not enough space. (whole number; at least 1 and at most 100000)
    spacing: Minimum distance between the copies' origins. (number in m; zero or more; default 0)
    smallest: Minimum size: sizes are random between this factor and 1. (number; at least 0.01 and at most 1; default 1)
    seed: Seed of the random positions. (whole number; at least 0 and at most 1000000; default 1)
    """

def extrude(of: Field | Expression, height: float) -> Field:
    r"""Extrudes a field's cross-section at z = 0 along z; exact where the field is the exact distance to its cross-section.

        a = f(x, y, 0),  b = |z| − h/2;  |(max(a, 0), max(b, 0))| + min(max(a, b), 0)

    of: The field, for example a circle, a rectangle or a star. (field)
    height: Whole height, centred at z = 0. (number in m; positive)
    """

def revolve(of: Field | Expression, offset: float | None = ...) -> Field:
    r"""Revolves a field's cross-section at z = 0 about its y axis, which becomes the z axis; exact if the field is the exact distance to its cross-section, and the section is on one side of the axis or symmetric about it.

        f(|pxy| − o, z, 0)

    of: The field; the part of its section beyond the axis is cut off. (field)
    offset: Distance by which the section is first moved away from the axis. (number in m; default 0)
    """

@overload
def bounding_volume(of: Field, margin: float, volume: Field | Expression | None = ...) -> Field:
    r"""A field or an object with a bounding volume, whose distance replaces it far away. Parts outside the volume are cut off.

        max(b, min(f, 2m − b));  φᵢ likewise,  φ₀ = min(−b, max(a₀, b − 2m))

    Sections 4.1 and 7.3 of Galin et al. (2026).

    of: The field or object to bound. (object)
    margin: Distance from the volume, or from the proxy's surface, beyond which its distance replaces that of the child. (number in m; positive)
    volume: The bounding volume, a field. Default: the bounding box. (field; default none)
    """
@overload
def bounding_volume(of: Object, margin: float, volume: Field | Expression | None = ...) -> Object:
    r"""A field or an object with a bounding volume, whose distance replaces it far away. Parts outside the volume are cut off.

        max(b, min(f, 2m − b));  φᵢ likewise,  φ₀ = min(−b, max(a₀, b − 2m))

    Sections 4.1 and 7.3 of Galin et al. (2026).

    of: The field or object to bound. (object)
    margin: Distance from the volume, or from the proxy's surface, beyond which its distance replaces that of the child. (number in m; positive)
    volume: The bounding volume, a field. Default: the bounding box. (field; default none)
    """

@overload
def proxy(of: Field, proxy: Field | Expression, error: float, margin: float, inside: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
    r"""A field or an object with a proxy, a simpler field g near it, which replaces it away from the surface, outside and inside. Parts more than e outside the proxy are cut off, and gaps more than e inside it are filled.

        min(c, max(h, −2m − c)),  h = max(b, min(f, 2m − b)),  b = g − e,  c = g + e

    Sections 4.1 and 7.3 of Galin et al. (2026).

    of: The field or object to replace. (object)
    proxy: The simpler field, g. (field)
    error: Maximum distance e between the two surfaces. (number in m; zero or more)
    margin: Distance from the volume, or from the proxy's surface, beyond which its distance replaces that of the child. (number in m; positive)
    inside: For an object: the phase that fills the part of the proxy deeper than e. By default, the proxy is used only outside. (phase or list of phases; default none)
    """
@overload
def proxy(of: Object, proxy: Field | Expression, error: float, margin: float, inside: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
    r"""A field or an object with a proxy, a simpler field g near it, which replaces it away from the surface, outside and inside. Parts more than e outside the proxy are cut off, and gaps more than e inside it are filled.

        min(c, max(h, −2m − c)),  h = max(b, min(f, 2m − b)),  b = g − e,  c = g + e

    Sections 4.1 and 7.3 of Galin et al. (2026).

    of: The field or object to replace. (object)
    proxy: The simpler field, g. (field)
    error: Maximum distance e between the two surfaces. (number in m; zero or more)
    margin: Distance from the volume, or from the proxy's surface, beyond which its distance replaces that of the child. (number in m; positive)
    inside: For an object: the phase that fills the part of the proxy deeper than e. By default, the proxy is used only outside. (phase or list of phases; default none)
    """

@overload
def level_of_detail(*of: Field | Sequence[Object], viewpoint: Sequence[float] | np.ndarray | None = ..., distances: Sequence[float] | np.ndarray | None = ..., errors: Sequence[float] | np.ndarray | None = ...) -> Field:
    r"""Levels of detail of a field or an object, from fine to coarse, each used within a range of distances from a viewpoint. Without distances, the finest level is used everywhere, unless distances are chosen for a view (`phasetree render --detail`; in C++, with_levels_of_detail()).

        min(max(a, n), max(b, −n), max(a, b)),  n = |p − v| − d;  φᵢ and φ₀ alike

    Sections 4.1 and 7.3 of Galin et al. (2026).

    of: The levels, fields or objects, the finest first. (list of objects)
    viewpoint: The viewpoint from which distances are measured. ([x, y, z] in m; default [0, 0, 0])
    distances: Increasing distances at which each level is replaced by the next; one less than there are levels. (list of numbers in m; positive; default [])
    errors: For each coarser level, the distance of its surface from that of the finest level, in increasing order. --detail compares these with the size of a pixel. They are trusted, not checked. (list of numbers in m; positive; default [])
    """
@overload
def level_of_detail(*of: Object | Sequence[Object], viewpoint: Sequence[float] | np.ndarray | None = ..., distances: Sequence[float] | np.ndarray | None = ..., errors: Sequence[float] | np.ndarray | None = ...) -> Object:
    r"""Levels of detail of a field or an object, from fine to coarse, each used within a range of distances from a viewpoint. Without distances, the finest level is used everywhere, unless distances are chosen for a view (`phasetree render --detail`; in C++, with_levels_of_detail()).

        min(max(a, n), max(b, −n), max(a, b)),  n = |p − v| − d;  φᵢ and φ₀ alike

    Sections 4.1 and 7.3 of Galin et al. (2026).

    of: The levels, fields or objects, the finest first. (list of objects)
    viewpoint: The viewpoint from which distances are measured. ([x, y, z] in m; default [0, 0, 0])
    distances: Increasing distances at which each level is replaced by the next; one less than there are levels. (list of numbers in m; positive; default [])
    errors: For each coarser level, the distance of its surface from that of the finest level, in increasing order. --detail compares these with the size of a pixel. They are trusted, not checked. (list of numbers in m; positive; default [])
    """

def set(of: Field | Expression, phase: Phase | str) -> Object:
    r"""Fills a field with one phase.

        φₖ = f,  φ₀ = −f

    Section 4.1 of Galin et al. (2026).

    of: The field. (field)
    phase: The phase inside. (phase)
    """

def thin_shell(of: Field | Expression, shell: Phase | str, inside: Phase | str, half_thickness: float) -> Object:
    r"""A wall of thickness 2t about the surface of a field, and its interior.

        φᵢ = |f| − t,  φⱼ = f + t,  φ₀ = t − f

    Section 4.1 of Galin et al. (2026).

    of: The field, whose surface is the middle of the wall. (field)
    shell: The phase of the wall. (phase)
    inside: The phase within. (phase)
    half_thickness: Half of the wall's thickness, t. (number in m; positive)
    """

def under(*of: Object | Sequence[Object]) -> Object:
    r"""Combines objects; where they overlap, later ones replace earlier ones. Applied pairwise, from the first object to the last.

        φᵢ = max(min(aᵢ, bᵢ), −min over j ≠ i of bⱼ),  φ₀ = max(a₀, b₀)

    Section 4.3 of Galin et al. (2026).

    of: The objects, at least one. (list of objects)
    """

def over(*of: Object | Sequence[Object]) -> Object:
    r"""Combines objects; where they overlap, earlier ones replace later ones. Applied pairwise, from the last object to the first.

        A ∪₊ B = B ∪₋ A;  A ∪₊ (B ∪₊ (C ∪₊ …))

    Section 4.3 of Galin et al. (2026).

    of: The objects, at least one. (list of objects)
    """

def layered(of: Object, phase: Phase | str, thickness: float) -> Object:
    r"""Embeds an object in a layer of another phase.

        φₖ = max(−a₀ − t, a₀),  φ₀ = a₀ + t

    Section 4.5 of Galin et al. (2026).

    of: The object. (object)
    phase: The phase of the layer. (phase)
    thickness: Thickness of the layer. (number in m; positive)
    """

def intersect_shape(of: Object, shape: Field | Expression, phases: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
    r"""Cuts all phases of an object, or only some of them, to the inside of a shape.

        φₖ = max(aₖ, f),  φ₀ = min(a₀, −f) if all phases are cut, else min(a₀, min over the cut k of max(aₖ, −f))

    Section 5.1 of Galin et al. (2026).

    of: The object. (object)
    shape: The field to keep within. (field)
    phases: The phases to cut; by default all. (phase or list of phases; default none)
    """

def subtract_shape(of: Object, shape: Field | Expression, phases: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
    r"""Cuts a shape out of all phases of an object, or out of only some of them.

        φₖ = max(aₖ, −f),  φ₀ = min(a₀, f) if all phases are cut, else min(a₀, min over the cut k of max(aₖ, f))

    Section 5.1 of Galin et al. (2026).

    of: The object. (object)
    shape: The field to cut away. (field)
    phases: The phases to cut; by default all. (phase or list of phases; default none)
    """

def change(of: Object, from_: Phase | str, to: Phase | str, shape: Field | Expression | None = ...) -> Object:
    r"""Turns one phase into another inside a shape, or everywhere if no shape is given.

        φᵢ = max(aᵢ, −f),  φₖ = min(aₖ, max(aᵢ, f)),  φ₀ = a₀

    Section 5.2 of Galin et al. (2026).

    of: The object. (object)
    from_: The phase to change. (phase)
    to: The phase that it becomes. (phase)
    shape: The field inside which to change it; by default everywhere. (field; default none)
    """

def remove(of: Object, phases: Phase | str | Sequence[Phase | str]) -> Object:
    r"""Replaces phases by vacuum.

        φₖ absent,  φ₀ = min(a₀, aₖ)

    Section 5.2 of Galin et al. (2026).

    of: The object. (object)
    phases: The phases to remove. (phase or list of phases)
    """

def contact(a: Object, b: Object, phase_a: Phase | str, phase_b: Phase | str, alpha: float) -> Object:
    r"""Two phases pressed against each other: they share the overlap.

        f = α aᵢ − (1 − α) bⱼ,  φᵢ = max(aᵢ, f),  φⱼ = max(bⱼ, −f),  φ₀ = max(a₀, b₀)

    Section 4.4 of Galin et al. (2026).

    a: The object A. (object)
    b: The object B, which replaces A where they overlap without being in contact. (object)
    phase_a: The phase of A that is in contact. (phase)
    phase_b: The phase of B that is in contact. (phase)
    alpha: Where in the overlap they meet: 0 gives it all to B, 1 to A; at 1/2 both are equally deep in it. (number; at least 0 and at most 1)
    """

def contacts(a: Object, b: Object, alpha: float, phases_a: Phase | str | Sequence[Phase | str] | None = ..., phases_b: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
    r"""Contact between sets of phases: objects that press against each other and keep their phases.

        f = α a_K − (1 − α) b_L,  a_K = −min over k ∉ K of aₖ,  b_L likewise,  bⱼ ← max(bⱼ, −f) for j ∈ L,  then A ∪₋ B

    Section 4.4 of Galin et al. (2026).

    a: The object A. (object)
    b: The object B, which replaces A where they overlap without being in contact. (object)
    alpha: Where in the overlap they meet: 0 gives it all to B, 1 to A; at 1/2 both are equally deep in it. (number; at least 0 and at most 1)
    phases_a: The phases of A in contact; by default all. (phase or list of phases; default none)
    phases_b: The phases of B in contact; by default all. (phase or list of phases; default none)
    """

def close_gaps(of: Object, phases: Sequence[Phase | str], gap: float) -> Object:
    r"""Fills thin gaps between phases, such as those between a glass and a liquid that was modelled a little too small. Vacuum becomes part of a phase where its distances to two phases add up to less than the gap. Combine the phases with over or under first, so that they no longer overlap.

        dₖ = (aₖ + min over l after k of aₗ − g)/2;  for each k in order, φₖ ← max(min(φₖ, dₖ), −min over j ≠ 0, k of φⱼ),  φ₀ ← max(φ₀, −dₖ)

    of: The object. (object)
    phases: The phases between which gaps are closed, at least two. A gap becomes part of the phase listed first. (list of phases)
    gap: Gaps narrower than this are closed. Make it at least twice as wide as the gaps, because those in corners are wider. (number in m; positive)
    """

def layered_sequence(of: Object, phases: Sequence[Phase | str], thicknesses: Sequence[float] | np.ndarray) -> Object:
    r"""Embeds an object in layers, the innermost first.

        φₖ = max(−a₀ − Tₖ, a₀ + Tₖ₋₁),  Tₖ = t₁ + … + tₖ,  φ₀ = a₀ + Tₙ

    Section 4.5 of Galin et al. (2026).

    of: The object. (object)
    phases: The phase of each layer, from the inside out. (list of phases)
    thicknesses: The thickness of each layer, from the inside out. (list of numbers in m; positive)
    """

def smooth_layered(of: Object, phase: Phase | str, thickness: float, radius: float) -> Object:
    r"""Embeds an object in a layer that fills the grooves between its phases, which are blended in the order of their indices.

        m = smin over i of aᵢ, less t;  φₖ = max(m, a₀),  φ₀ = max(a₀, −m)

    Section 4.5 of Galin et al. (2026).

    of: The object. (object)
    phase: The phase of the layer. (phase)
    thickness: Thickness of the layer away from the grooves. (number in m; positive)
    radius: Blending radius: surfaces blend where they are closer to each other than this. (number in m; positive)
    """

def unite_shape_below(of: Object, shape: Field | Expression, phase: Phase | str) -> Object:
    r"""Adds a shape to one phase, below the other phases.

        φₖ = max(min(aₖ, f), −min over j ≠ k of aⱼ),  φ₀ = max(a₀, −f)

    Section 5.1 of Galin et al. (2026).

    of: The object. (object)
    shape: The field to add. (field)
    phase: The phase that grows. (phase)
    """

def smooth_unite_shape(of: Object, shape: Field | Expression, phase: Phase | str, radius: float) -> Object:
    r"""Blends a shape into one phase, over the other phases.

        s = smin(aₖ, f),  φₖ = s,  φᵢ = max(aᵢ, −s),  φ₀ = max(a₀, −s)

    Section 5.3 of Galin et al. (2026).

    of: The object. (object)
    shape: The field to add. (field)
    phase: The phase that grows. (phase)
    radius: Blending radius: surfaces blend where they are closer to each other than this. (number in m; positive)
    """

def smooth_unite_shape_below(of: Object, shape: Field | Expression, phase: Phase | str, radius: float) -> Object:
    r"""Blends a shape into one phase, below the other phases.

        s = smin(aₖ, f),  φₖ = max(s, −min over j ≠ k of aⱼ),  φ₀ = max(a₀, −s)

    Section 5.3 of Galin et al. (2026).

    of: The object. (object)
    shape: The field to add. (field)
    phase: The phase that grows. (phase)
    radius: Blending radius: surfaces blend where they are closer to each other than this. (number in m; positive)
    """

def smooth_intersect_shape(of: Object, shape: Field | Expression, phase: Phase | str, radius: float) -> Object:
    r"""Keeps only the part of one phase inside a shape, and rounds the new edges.

        s = −smin(−aₖ, −f),  φₖ = s,  φ₀ = min(a₀, max(aₖ, −s, −f − r))

    Section 5.3 of Galin et al. (2026).

    of: The object. (object)
    shape: The field to keep within. (field)
    phase: The phase to cut. (phase)
    radius: Blending radius: surfaces blend where they are closer to each other than this. (number in m; positive)
    """

def smooth_subtract_shape(of: Object, shape: Field | Expression, phase: Phase | str, radius: float) -> Object:
    r"""Cuts a shape away from one phase, and rounds the new edges.

        s = −smin(−aₖ, f),  φₖ = s,  φ₀ = min(a₀, max(aₖ, −s, f − r))

    Section 5.3 of Galin et al. (2026).

    of: The object. (object)
    shape: The field to cut away. (field)
    phase: The phase to cut. (phase)
    radius: Blending radius: surfaces blend where they are closer to each other than this. (number in m; positive)
    """

def interface(of: Object, phase_a: Phase | str, phase_b: Phase | str, half_thickness: float) -> Object:
    r"""A thin volume about the interface between two phases, equally deep in both.

        S = max(aᵢ, aⱼ) − ε,  φᵢ = max(aᵢ, S),  φⱼ = max(aⱼ, S),  φ₀ = min(a₀, −S, min over k ≠ i, j of aₖ)

    Section 7.4 of Galin et al. (2026).

    of: The object. (object)
    phase_a: The phase on one side. (phase)
    phase_b: The phase on the other side. (phase)
    half_thickness: Depth ε in each phase. (number in m; positive)
    """

def interfaces(of: Object, half_thickness: float) -> Object:
    r"""Thin volumes about all interfaces between phases.

        S = (second smallest of a₁ … aₙ) − ε,  φᵢ = max(aᵢ, S),  φ₀ = min(a₀, −S)

    Section 7.4 of Galin et al. (2026).

    of: The object, with at least two phases. (object)
    half_thickness: Depth ε in each phase. (number in m; positive)
    """

def checker(even: Phase | str, odd: Phase | str, size: float, origin: Sequence[float] | np.ndarray | None = ...) -> Object:
    r"""Cubes of two alternating phases, filling space.

        φⱼ = s · a · min(q, 1 − q),  φᵢ = −φⱼ,  u = (p − o)/a,  q = u − ⌊u⌋,  s = +1 if ⌊ux⌋ + ⌊uy⌋ + ⌊uz⌋ is even, else −1

    Section 9.1 of Galin et al. (2026).

    even: The phase of the cube at the origin, towards +x, +y, +z. (phase)
    odd: The phase of the neighbouring cubes. (phase)
    size: Edge length of a cube. (number in m; positive)
    origin: A point where corners of cubes meet. ([x, y, z] in m; default [0, 0, 0])
    """

def layers(phases: Sequence[Phase | str], thicknesses: float | Sequence[float], direction: Sequence[float] | np.ndarray | None = ..., offset: float | None = ...) -> Object:
    r"""Parallel layers of several phases, repeated endlessly, filling space.

        φₖ = |m| − tₖ/2,  m = u − P⌊u/P + 1/2⌋,  u = p·n − cₖ,  P = Σ t,  cₖ the middle of layer k

    Section 9.1 of Galin et al. (2026).

    phases: The phases of one period in order, at least two. (list of phases)
    thicknesses: Thicknesses of the layers; one number applies to all. (number or list of numbers in m; positive)
    direction: Direction in which the layers follow each other; any length but zero. ([x, y, z]; default [0, 0, 1])
    offset: Position along this direction, from the origin, where the first layer begins. (number in m; default 0)
    """

def strata(phases: Sequence[Phase | str], thicknesses: float | Sequence[float], direction: Sequence[float] | np.ndarray | None = ..., offset: float | None = ...) -> Object:
    r"""Parallel layers of several phases, filling space: the first and the last are unbounded.

        φₖ = max(hₖ₋₁ − u, u − hₖ),  u = p·n − o,  hₖ = t₁ + … + tₖ

    Section 9.1 of Galin et al. (2026).

    phases: The phases in order, at least two. (list of phases)
    thicknesses: Thicknesses of all layers but the last; one number applies to all. (number or list of numbers in m; positive)
    direction: Direction in which the layers follow each other; any length but zero. ([x, y, z]; default [0, 0, 1])
    offset: Position along this direction, from the origin, from which the first layer is measured. (number in m; default 0)
    """

def voronoi(phases: Sequence[Phase | str], size: float, jitter: float | None = ..., seed: float | None = ...) -> Object:
    r"""Blocks of several phases, filling space: the cells of an irregular lattice of sites, each with one of the phases. With the same size, jitter and seed, the cells are those of voronoi_cells.

        φₖ = (Dₖ − min over m ≠ k of Dₘ)/2,  Dₖ = distance to the nearest site of phase k

    Sections 4.3 and 9.1 of Galin et al. (2026).

    phases: The phases, at least two. All are equally likely; list one twice to make it more likely. (list of phases)
    size: Edge length of the cubes, each of which has one site. (number in m; positive)
    jitter: Irregularity: 0 puts the sites on a cubic lattice, 1 anywhere in their cubes. (number; at least 0 and at most 1; default 0.9)
    seed: Seed of the pattern. (number; at least 0 and at most 288; default 0)
    """

def labels(file: str | PathLike[str], phases: Sequence[Phase | str], values: Sequence[float] | np.ndarray | None = ..., empty: Sequence[float] | np.ndarray | None = ..., spacing: Sequence[float] | np.ndarray | None = ..., smoothing: float | None = ..., grid: str | None = ...) -> Object:
    r"""A segmented scan as an object of many phases: whole numbers at voxels, from images or OpenVDB. The centre of each voxel has the phase of its number, and interfaces in between are smooth. Distances are clamped to about two voxels.

        φₖ = (Dₖ − min over m ≠ k of Dₘ)/2,  Dₖ = −σ N⁻¹(blurred share of phase k)/λ,  N the cumulative normal distribution, within the box of the voxels

    file: OpenVDB file with a grid of whole numbers. Or images, one per layer from the lowest z to the highest: a name in which each # stands for a digit of the layer's number, such as "layer_###.png". Images are grey, with integers of up to 32 bits, and seen from above, like those of height_map. The object is centred at the origin. (name of a file)
    phases: The phases of the object. (list of phases)
    values: The voxel value of each phase; by default 1, 2, 3 … (list of numbers; at least -16777216 and at most 16777216; default [])
    empty: Voxel values that are vacuum, unless they are listed for a phase; by default 0. (list of numbers; at least -16777216 and at most 16777216; default [])
    spacing: Distance between voxels along x, y and z, for images. OpenVDB grids have their own. ([x, y, z] in m; zero or more; default [0, 0, 0])
    smoothing: Standard deviation σ of the blur; at 0, interfaces show the steps of the voxels. (number in voxels; at least 0 and at most 4; default 1)
    grid: Name of the grid in an OpenVDB file; required if the file has several grids of whole numbers. If several have the same name, append the index: "name[0]", "name[1]". (text; default "")
    """

def particles(phases: Sequence[Phase | str], centres: Sequence[Sequence[float]] | np.ndarray | None = ..., radii: float | Sequence[float] | None = ..., file: str | PathLike[str] | None = ...) -> Object:
    r"""Up to sixteen million balls of several phases: a packing, a molecule, a foam. Where balls of different phases overlap, a point belongs to the one with the least |p − c| − r.

        φₖ = max(Dₖ, (Dₖ − min over m ≠ k of Dₘ)/2),  φ₀ = −min Dₖ,  Dₖ = min over its balls of |p − c| − r

    phases: With centres: one phase for all balls, or one per ball. With a file: the phases that its column `phase` refers to, counted from 0, or one for all. (list of phases)
    centres: Centres of the balls, unless they are in a file. (list of [x, y, z] in m; default [])
    radii: Radii of the balls: one number for all, or one per centre. A file may have its own. (number or list of numbers in m; positive; default [])
    file: File of balls: PLY, whose element `vertex` has x, y, z and optionally radius and phase, or CSV with these names in its first line. Coordinates and radii are lengths in the scene's unit. Give either this or the centres. (name of a file; default none)
    """

@overload
def translate(of: Field, by: Sequence[float] | np.ndarray, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
    r"""Translates.

        φ(p − v)

    Section 6 of Galin et al. (2026).

    of: The field or object to warp. (object)
    by: Image of the origin. ([x, y, z] in m)
    over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
    under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
    """
@overload
def translate(of: Object, by: Sequence[float] | np.ndarray, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
    r"""Translates.

        φ(p − v)

    Section 6 of Galin et al. (2026).

    of: The field or object to warp. (object)
    by: Image of the origin. ([x, y, z] in m)
    over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
    under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
    """

@overload
def rotate(of: Field, angle: float, axis: Sequence[float] | np.ndarray | None = ..., over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
    r"""Rotates about an axis through the origin, by the right-hand rule.

        φ(Rᵀ p)

    Section 6 of Galin et al. (2026).

    of: The field or object to warp. (object)
    angle: Angle. (number in degrees)
    axis: Direction of the axis; any length but zero. ([x, y, z]; default [0, 0, 1])
    over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
    under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
    """
@overload
def rotate(of: Object, angle: float, axis: Sequence[float] | np.ndarray | None = ..., over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
    r"""Rotates about an axis through the origin, by the right-hand rule.

        φ(Rᵀ p)

    Section 6 of Galin et al. (2026).

    of: The field or object to warp. (object)
    angle: Angle. (number in degrees)
    axis: Direction of the axis; any length but zero. ([x, y, z]; default [0, 0, 1])
    over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
    under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
    """

@overload
def scale(of: Field, factor: float, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
    r"""Scales by the same factor along all axes.

        s · φ(p / s)

    Section 6 of Galin et al. (2026).

    of: The field or object to warp. (object)
    factor: The factor. (number; positive)
    over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
    under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
    """
@overload
def scale(of: Object, factor: float, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
    r"""Scales by the same factor along all axes.

        s · φ(p / s)

    Section 6 of Galin et al. (2026).

    of: The field or object to warp. (object)
    factor: The factor. (number; positive)
    over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
    under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
    """

@overload
def twist(of: Field, rate: float, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
    r"""Twists about the z axis.

        φ(R(−k z) p) / λ,  λ = (kρ + √(k²ρ² + 4))/2,  ρ the largest within the bounds

    Section 6 of Galin et al. (2026).

    of: The field or object to warp. (object)
    rate: Angle per unit of height. (number in degrees/m)
    over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
    under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
    """
@overload
def twist(of: Object, rate: float, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
    r"""Twists about the z axis.

        φ(R(−k z) p) / λ,  λ = (kρ + √(k²ρ² + 4))/2,  ρ the largest within the bounds

    Section 6 of Galin et al. (2026).

    of: The field or object to warp. (object)
    rate: Angle per unit of height. (number in degrees/m)
    over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
    under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
    """

@overload
def stretch(of: Field, factors: Sequence[float] | np.ndarray, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
    r"""Scales by a different factor along each axis.

        φ(x/sx, y/sy, z/sz) · min(sx, sy, sz)

    Section 6 of Galin et al. (2026).

    of: The field or object to warp. (object)
    factors: The factors along x, y and z. ([x, y, z]; positive)
    over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
    under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
    """
@overload
def stretch(of: Object, factors: Sequence[float] | np.ndarray, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
    r"""Scales by a different factor along each axis.

        φ(x/sx, y/sy, z/sz) · min(sx, sy, sz)

    Section 6 of Galin et al. (2026).

    of: The field or object to warp. (object)
    factors: The factors along x, y and z. ([x, y, z]; positive)
    over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
    under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
    """

@overload
def mirror(of: Field, normal: Sequence[float] | np.ndarray | None = ..., over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
    r"""Mirrors at a plane through the origin: keeps the half to which the normal points, and adds its mirror image.

        φ(p − 2 min(p·n, 0) n)

    Section 6 of Galin et al. (2026).

    of: The field or object to warp. (object)
    normal: Direction that points into the half that is kept; any length but zero. ([x, y, z]; default [1, 0, 0])
    over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
    under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
    """
@overload
def mirror(of: Object, normal: Sequence[float] | np.ndarray | None = ..., over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
    r"""Mirrors at a plane through the origin: keeps the half to which the normal points, and adds its mirror image.

        φ(p − 2 min(p·n, 0) n)

    Section 6 of Galin et al. (2026).

    of: The field or object to warp. (object)
    normal: Direction that points into the half that is kept; any length but zero. ([x, y, z]; default [1, 0, 0])
    over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
    under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
    """

@overload
def taper(of: Field, rate: float, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
    r"""Narrows or widens along the z axis.

        φ(x/s, y/s, z) / λ,  s = 1 + c z

    Section 6 of Galin et al. (2026).

    of: The field or object to warp. (object)
    rate: Change of size per unit of height; the size at z = 0 is unchanged. (number in 1/m)
    over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
    under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
    """
@overload
def taper(of: Object, rate: float, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
    r"""Narrows or widens along the z axis.

        φ(x/s, y/s, z) / λ,  s = 1 + c z

    Section 6 of Galin et al. (2026).

    of: The field or object to warp. (object)
    rate: Change of size per unit of height; the size at z = 0 is unchanged. (number in 1/m)
    over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
    under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
    """

@overload
def bend(of: Field, rate: float, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
    r"""Bends the x axis into an arc towards +z.

        φ(θ/k, y, (1 − r)/k) / λ,  (r, θ) polar: r sin θ = k x, r cos θ = 1 − k z

    Section 6 of Galin et al. (2026).

    of: The field or object to warp. (object)
    rate: Angle per unit of length along x; negative to bend towards −z. (number in degrees/m)
    over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
    under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
    """
@overload
def bend(of: Object, rate: float, over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
    r"""Bends the x axis into an arc towards +z.

        φ(θ/k, y, (1 − r)/k) / λ,  (r, θ) polar: r sin θ = k x, r cos θ = 1 − k z

    Section 6 of Galin et al. (2026).

    of: The field or object to warp. (object)
    rate: Angle per unit of length along x; negative to bend towards −z. (number in degrees/m)
    over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
    under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
    """

@overload
def affine(of: Field, x: Sequence[float] | np.ndarray | None = ..., y: Sequence[float] | np.ndarray | None = ..., z: Sequence[float] | np.ndarray | None = ..., by: Sequence[float] | np.ndarray | None = ..., over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
    r"""Maps the unit vectors to any three vectors that span space, and the origin to a point: shears, stretches, rotates and mirrors.

        φ(M⁻¹(p − v))/λ,  M = (x y z),  λ = ‖M⁻¹‖₂

    Section 6 of Galin et al. (2026).

    of: The field or object to warp. (object)
    x: Image of the vector [1, 0, 0]. ([x, y, z]; default [1, 0, 0])
    y: Image of the vector [0, 1, 0]. ([x, y, z]; default [0, 1, 0])
    z: Image of the vector [0, 0, 1]. ([x, y, z]; default [0, 0, 1])
    by: Image of the origin. ([x, y, z] in m; default [0, 0, 0])
    over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
    under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
    """
@overload
def affine(of: Object, x: Sequence[float] | np.ndarray | None = ..., y: Sequence[float] | np.ndarray | None = ..., z: Sequence[float] | np.ndarray | None = ..., by: Sequence[float] | np.ndarray | None = ..., over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
    r"""Maps the unit vectors to any three vectors that span space, and the origin to a point: shears, stretches, rotates and mirrors.

        φ(M⁻¹(p − v))/λ,  M = (x y z),  λ = ‖M⁻¹‖₂

    Section 6 of Galin et al. (2026).

    of: The field or object to warp. (object)
    x: Image of the vector [1, 0, 0]. ([x, y, z]; default [1, 0, 0])
    y: Image of the vector [0, 1, 0]. ([x, y, z]; default [0, 1, 0])
    z: Image of the vector [0, 0, 1]. ([x, y, z]; default [0, 0, 1])
    by: Image of the origin. ([x, y, z] in m; default [0, 0, 0])
    over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
    under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
    """

@overload
def distort(of: Field, amplitude: float, scale: float, octaves: float | None = ..., over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Field:
    r"""Distorts space by fractal noise, as in rock or smoke.

        φ(p + a (n(p), n(p + u), n(p + v)))/λ,  λ = 1 + √3 a L,  L = 15 octaves/(4 scale Σ 2⁻ⁱ)

    Section 6 of Galin et al. (2026).

    of: The field or object to warp. (object)
    amplitude: Largest displacement along each axis, a. (number in m; zero or more)
    scale: Size of the largest swirls. (number in m; positive)
    octaves: Number of octaves of swirls, each with half the size of the one before. (number; at least 1 and at most 6; default 1)
    over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
    under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
    """
@overload
def distort(of: Object, amplitude: float, scale: float, octaves: float | None = ..., over: Phase | str | Sequence[Phase | str] | None = ..., under: Phase | str | Sequence[Phase | str] | None = ...) -> Object:
    r"""Distorts space by fractal noise, as in rock or smoke.

        φ(p + a (n(p), n(p + u), n(p + v)))/λ,  λ = 1 + √3 a L,  L = 15 octaves/(4 scale Σ 2⁻ⁱ)

    Section 6 of Galin et al. (2026).

    of: The field or object to warp. (object)
    amplitude: Largest displacement along each axis, a. (number in m; zero or more)
    scale: Size of the largest swirls. (number in m; positive)
    octaves: Number of octaves of swirls, each with half the size of the one before. (number; at least 1 and at most 6; default 1)
    over: For an object: warp only these phases, and let them replace the others. By default, all phases are warped. (phase or list of phases; default none)
    under: For an object: warp only these phases, and let the others replace them. By default, all phases are warped. (phase or list of phases; default none)
    """

class materials:
    @staticmethod
    def clear(ior: float | None = ..., glass: Literal["bk7", "diamond", "f2", "fused_silica", "sapphire", "sf11", "water"] | None = ..., abbe_number: float | None = ..., absorption: Sequence[float] | np.ndarray | None = ..., absorption_spectrum: Sequence[Sequence[float]] | np.ndarray | None = ..., color: Sequence[float] | str | None = ..., color_distance: float | None = ..., roughness: float | Number | None = ..., scattering: Sequence[float] | np.ndarray | None = ..., albedo: Sequence[float] | np.ndarray | None = ..., mean_free_path: Sequence[float] | np.ndarray | None = ..., medium: Literal["apple", "chicken1", "chicken2", "cream", "ketchup", "marble", "potato", "skim_milk", "skin1", "skin2", "spectralon", "whole_milk"] | None = ..., scale: float | None = ..., anisotropy: float | None = ..., phase_function: PhaseFunction | None = ..., emission: Sequence[float] | np.ndarray | None = ..., emission_spectrum: Sequence[Sequence[float]] | np.ndarray | None = ..., density: Field | Expression | None = ..., density_depth: float | None = ..., density_grid: Voxels | None = ..., temperature_grid: Voxels | None = ..., emission_temperature: float | None = ..., film_thickness: float | Number | None = ..., film_ior: float | None = ..., bump: Sequence[float] | str | Texture | None = ..., bump_height: float | None = ...) -> Material:
        r"""Vacuum, air, water, glass, milk, wax, fog: light travels inside, where it may be absorbed and scattered.

            exp(−(a + s) d)

        ior: Refractive index relative to vacuum; required unless a glass is named. (number; at least 0.1 and at most 10; default none)
        glass: Instead of the index: a measured substance whose index depends on the wavelength, which causes dispersion. (`"bk7"`, `"diamond"`, `"f2"`, `"fused_silica"`, `"sapphire"`, `"sf11"`, `"water"`; default none)
        abbe_number: Abbe number; the smaller, the stronger the dispersion: crown glass has 60, flint glass 30. Without it, the index is the same for all colours. (number; at least 10 and at most 1000; default none)
        absorption: Absorption coefficients a of red, green and blue; 0 by default. ([r, g, b] in 1/m; zero or more; default none)
        absorption_spectrum: Instead of the absorption: wavelengths and the absorption coefficient at each. Unless the scene is "spectral", it is converted to red, green and blue. Layers that transmit at least a third of white light keep their colour; thicker ones may differ. (list of [nm, number] in nm, 1/m; zero or more; default none)
        color: Instead of the absorption: the colour of white light after a distance. (colour; more than 0 and at most 1; default none)
        color_distance: The distance after which white light has this colour. (number in m; positive; default 1)
        roughness: Roughness α of GGX: 0 is polished, 0.1 satin, 0.5 matt. (number or field; at least 0 and at most 1; default 0)
        scattering: Scattering coefficients s of red, green and blue; 0 by default. ([r, g, b] in 1/m; zero or more; default none)
        albedo: Instead of absorption and scattering: the single-scattering albedo, s/(a + s). ([r, g, b]; at least 0 and at most 1; default none)
        mean_free_path: With the albedo: the mean free path, 1/(a + s). ([r, g, b] in m; positive; default none)
        medium: Instead of absorption and scattering: a measured medium (Jensen et al. 2001). (`"apple"`, `"chicken1"`, `"chicken2"`, `"cream"`, `"ketchup"`, `"marble"`, `"potato"`, `"skim_milk"`, `"skin1"`, `"skin2"`, `"spectralon"`, `"whole_milk"`; default none)
        scale: With a measured medium: how many millimetres one scene unit is. (number in mm; positive; default none)
        anisotropy: Mean cosine g of the Henyey-Greenstein phase function; positive values scatter forwards. Measured media keep their reduced scattering, (1 − g) s, for any g. Default 0. (number; at least -0.99 and at most 0.99; default none)
        phase_function: Directions into which the medium scatters light, if not those of "anisotropy". (phase function; default none)
        emission: Radiance emitted per unit of length along a ray. Requires absorption or scattering in the same channels. ([r, g, b] in 1/m; zero or more; default none)
        emission_spectrum: Spectrum of the emission, as "spectrum" of lights. With it, only the brightness of the emission is used. (list of [nm, number], or {"blackbody": kelvin}; default none)
        density: Density as a field: 0 at its surface and outside, rising linearly to 1 inside. Absorption, scattering and emission are multiplied by the density. (field; default none)
        density_depth: With a density: the depth inside the field at which it reaches 1. (number in m; positive; default none)
        density_grid: Instead of a density: a voxel grid by which absorption, scattering and emission are multiplied. (voxels; default none)
        temperature_grid: Voxel grid of temperatures: the medium emits as a black body, in proportion to its density. Requires a density and an emission, of which it uses only the brightness. The grid's "factor" converts its numbers to kelvin. (voxels in K; default none)
        emission_temperature: With a temperature grid: the temperature at which the medium has the given emission. Hotter parts emit more. (number in K; at least 500 and at most 100000; default 2000)
        film_thickness: Thickness of a thin film on the surface, which shows interference colours as soap and oil do; by default there is none. Where two clear materials with films meet, the thicker one is used. (number or field in nm; at least 0 and at most 5000; default none)
        film_ior: Refractive index of the film. (number; at least 1 and at most 4; default 1.33)
        bump: Bump map: a texture whose bright parts look raised. It changes the normals only, not the surface. A discontinuity of the texture counts as a slope of 45° to 55°. Where two clear materials with bumps meet, the higher one is used. (colour or texture; default none)
        bump_height: With a bump map: height of white above black; may be negative. (number in m; at least -1e15 and at most 1e15; default none)
        """
    @staticmethod
    def diffuse(color: Sequence[float] | str | Texture, roughness: float | Number | None = ..., bump: Sequence[float] | str | Texture | None = ..., bump_height: float | None = ..., normal_map: NormalMap | None = ...) -> Material:
        r"""Paper, plaster, clay: reflects equally in all directions.

        color: Reflectance. (colour or texture)
        roughness: Roughness: 0 is Lambert's law, 1 is clay or the moon, whose limb is as bright as its centre. (number or field; at least 0 and at most 1; default 0)
        bump: Bump map: a texture whose bright parts look raised. It changes the normals only, not the surface. A discontinuity of the texture counts as a slope of 45° to 55°. Where two clear materials with bumps meet, the higher one is used. (colour or texture; default none)
        bump_height: With a bump map: height of white above black; may be negative. (number in m; at least -1e15 and at most 1e15; default none)
        normal_map: Instead of a bump map: a normal map, on a mesh that has texture coordinates. (normal map; default none)
        """
    @staticmethod
    def conductor(metal: Literal["aluminium", "brass", "chromium", "copper", "gold", "iron", "nickel", "silver", "titanium", "tungsten", "aluminum"] | None = ..., eta: Sequence[float] | np.ndarray | None = ..., k: Sequence[float] | np.ndarray | None = ..., reflectance: Sequence[float] | str | Texture | None = ..., roughness: float | Number | None = ..., grain_along: Sequence[float] | np.ndarray | None = ..., grain_around: Sequence[float] | np.ndarray | None = ..., grain_through: Sequence[float] | np.ndarray | None = ..., grain_aspect: float | None = ..., film_thickness: float | Number | None = ..., film_ior: float | None = ..., bump: Sequence[float] | str | Texture | None = ..., bump_height: float | None = ..., normal_map: NormalMap | None = ...) -> Material:
        r"""Metal: a measured one, one with a given complex index η + ik, or one with a given reflectance, which may be a texture.

        metal: A measured metal. (`"aluminium"`, `"brass"`, `"chromium"`, `"copper"`, `"gold"`, `"iron"`, `"nickel"`, `"silver"`, `"titanium"`, `"tungsten"`, `"aluminum"`; default none)
        eta: η for red, green and blue, instead of a measured metal. ([r, g, b]; positive; default none)
        k: k for red, green and blue; required with η. ([r, g, b]; zero or more; default none)
        reflectance: Instead of both: reflectance at normal incidence; it increases towards grazing angles. Such a metal cannot have a film. (colour or texture; default none)
        roughness: Roughness α of GGX: 0 is polished, 0.1 satin, 0.5 matt. (number or field; at least 0 and at most 1; default 0)
        grain_along: Brushed metal: direction of the grain, in the space of the object, or of the scene for a mesh; transforms within a tree do not rotate it. It is projected onto the surface; where the surface is perpendicular to it, the grain is arbitrary. The roughness applies across the grain and must not be 0. ([x, y, z], not all zero; default none)
        grain_around: Instead of a direction, for metal turned on a lathe: direction of the axis around which the grain runs. ([x, y, z], not all zero; default none)
        grain_through: With an axis: a point on it, in the space of the object, or of the scene for a mesh; by default the origin. ([x, y, z] in m; at least -1e15 and at most 1e15; default none)
        grain_aspect: With a grain: ratio of the roughness along the grain to that across it; default 0.2. (number; at least 0.1 and at most 1; default none)
        film_thickness: Thickness of a thin film on the surface, which shows interference colours as soap and oil do; by default there is none. Where two clear materials with films meet, the thicker one is used. (number or field in nm; at least 0 and at most 5000; default none)
        film_ior: Refractive index of the film. (number; at least 1 and at most 4; default 1.33)
        bump: Bump map: a texture whose bright parts look raised. It changes the normals only, not the surface. A discontinuity of the texture counts as a slope of 45° to 55°. Where two clear materials with bumps meet, the higher one is used. (colour or texture; default none)
        bump_height: With a bump map: height of white above black; may be negative. (number in m; at least -1e15 and at most 1e15; default none)
        normal_map: Instead of a bump map: a normal map, on a mesh that has texture coordinates. (normal map; default none)
        """
    @staticmethod
    def coated(color: Sequence[float] | str | Texture, ior: float | None = ..., roughness: float | Number | None = ..., film_thickness: float | Number | None = ..., film_ior: float | None = ..., bump: Sequence[float] | str | Texture | None = ..., bump_height: float | None = ..., normal_map: NormalMap | None = ...) -> Material:
        r"""Varnished or glazed: a clear coat over a diffuse base.

        color: Reflectance of the base. (colour or texture)
        ior: Refractive index of the coat. (number; at least 1 and at most 4; default 1.5)
        roughness: Roughness α of GGX: 0 is polished, 0.1 satin, 0.5 matt. (number or field; at least 0 and at most 1; default 0)
        film_thickness: Thickness of a thin film on the surface, which shows interference colours as soap and oil do; by default there is none. Where two clear materials with films meet, the thicker one is used. (number or field in nm; at least 0 and at most 5000; default none)
        film_ior: Refractive index of the film. (number; at least 1 and at most 4; default 1.33)
        bump: Bump map: a texture whose bright parts look raised. It changes the normals only, not the surface. A discontinuity of the texture counts as a slope of 45° to 55°. Where two clear materials with bumps meet, the higher one is used. (colour or texture; default none)
        bump_height: With a bump map: height of white above black; may be negative. (number in m; at least -1e15 and at most 1e15; default none)
        normal_map: Instead of a bump map: a normal map, on a mesh that has texture coordinates. (normal map; default none)
        """
    @staticmethod
    def principled(base_color: Sequence[float] | str | Texture | None = ..., base_weight: float | Number | None = ..., base_diffuse_roughness: float | Number | None = ..., base_metalness: float | Number | None = ..., specular_weight: float | Number | None = ..., specular_color: Sequence[float] | str | Texture | None = ..., specular_roughness: float | Number | None = ..., specular_ior: float | None = ..., grain_along: Sequence[float] | np.ndarray | None = ..., grain_around: Sequence[float] | np.ndarray | None = ..., grain_through: Sequence[float] | np.ndarray | None = ..., grain_aspect: float | None = ..., coat_weight: float | Number | None = ..., coat_color: Sequence[float] | str | Texture | None = ..., coat_roughness: float | Number | None = ..., coat_ior: float | None = ..., coat_darkening: float | Number | None = ..., fuzz_weight: float | Number | None = ..., fuzz_color: Sequence[float] | str | Texture | None = ..., fuzz_roughness: float | Number | None = ..., film_thickness: float | Number | None = ..., film_ior: float | None = ..., film_weight: float | Number | None = ..., emission_radiance: float | None = ..., emission_color: Sequence[float] | str | Texture | None = ..., emission_spectrum: Sequence[Sequence[float]] | np.ndarray | None = ..., group: str | None = ..., bump: Sequence[float] | str | Texture | None = ..., bump_height: float | None = ..., normal_map: NormalMap | None = ...) -> Material:
        r"""Car paint, velvet, dusty plastic: layers with the parameters of OpenPBR Surface 1.1. The base is metal, or a gloss over a diffuse material; a coat and fuzz may cover it. Its roughness parameters are the square root of the α that other materials take. It is opaque; for transmission and subsurface scattering, use a phase of "clear".

        base_color: Colour of the diffuse base as seen through the gloss, or reflectance of the metal at normal incidence; default 0.8. (colour or texture; default none)
        base_weight: Multiplies the base colour. (number or field; at least 0 and at most 1; default 1)
        base_diffuse_roughness: Roughness of the diffuse base: 0 is Lambert's law, 1 is clay. (number or field; at least 0 and at most 1; default 0)
        base_metalness: 0 is a gloss over a diffuse base, 1 is metal. (number or field; at least 0 and at most 1; default 0)
        specular_weight: Multiplies the reflectance of the gloss and of the metal. (number or field; at least 0 and at most 1; default 1)
        specular_color: Tint of the gloss, and of the metal at 82° ("F82-tint"); default white. (colour or texture; default none)
        specular_roughness: Roughness of the gloss and of the metal; its square is the α of GGX. With a grain, it applies across the grain. (number or field; at least 0 and at most 1; default 0.3)
        specular_ior: Refractive index of the gloss. (number; at least 1 and at most 4; default 1.5)
        grain_along: Brushed metal: direction of the grain, in the space of the object, or of the scene for a mesh; transforms within a tree do not rotate it. It is projected onto the surface; where the surface is perpendicular to it, the grain is arbitrary. The roughness applies across the grain and must not be 0. ([x, y, z], not all zero; default none)
        grain_around: Instead of a direction, for metal turned on a lathe: direction of the axis around which the grain runs. ([x, y, z], not all zero; default none)
        grain_through: With an axis: a point on it, in the space of the object, or of the scene for a mesh; by default the origin. ([x, y, z] in m; at least -1e15 and at most 1e15; default none)
        grain_aspect: With a grain: ratio of the roughness along the grain to that across it; default 0.2. (number; at least 0.1 and at most 1; default none)
        coat_weight: Share of the surface that has a clear coat. (number or field; at least 0 and at most 1; default 0)
        coat_color: Tint of light that crosses the coat twice at normal incidence; default white. (colour or texture; default none)
        coat_roughness: Roughness of the coat. (number or field; at least 0 and at most 1; default 0)
        coat_ior: Refractive index of the coat. (number; at least 1 and at most 4; default 1.6)
        coat_darkening: How much the coat darkens the base by reflecting light back to it: 1 is physical, 0 keeps the base's colour. (number or field; at least 0 and at most 1; default 1)
        fuzz_weight: Share of the surface that has fuzz: velvet, dust. (number or field; at least 0 and at most 1; default 0)
        fuzz_color: Colour of the fuzz; default white. (colour or texture; default none)
        fuzz_roughness: Roughness of the fuzz: low for velvet, high for dust. Values below 0.26 are treated as 0.26. (number or field; at least 0 and at most 1; default 0.5)
        film_thickness: Thickness of a thin film on the surface, which shows interference colours as soap and oil do; by default there is none. Where two clear materials with films meet, the thicker one is used. (number or field in nm; at least 0 and at most 5000; default none)
        film_ior: Refractive index of the film. (number; at least 1 and at most 4; default 1.33)
        film_weight: With a film: share of the surface that has it. (number or field; at least 0 and at most 1; default 1)
        emission_radiance: Radiance, equal in all directions, where the emission colour is 1. Inside a material of index n, the radiance is n² times this value. (number; at least 0 and at most 1e12; default 0)
        emission_color: Colour of the emitted light; default white. (colour or texture; default none)
        emission_spectrum: Spectrum of the emission, as "spectrum" of lights. With it, only the brightness of the emission is used. (list of [nm, number], or {"blackbody": kelvin}; default none)
        group: Light group, of letters, digits, - and _. The light of each group is written to a plane of its own. (text; default "default")
        bump: Bump map: a texture whose bright parts look raised. It changes the normals only, not the surface. A discontinuity of the texture counts as a slope of 45° to 55°. Where two clear materials with bumps meet, the higher one is used. (colour or texture; default none)
        bump_height: With a bump map: height of white above black; may be negative. (number in m; at least -1e15 and at most 1e15; default none)
        normal_map: Instead of a bump map: a normal map, on a mesh that has texture coordinates. (normal map; default none)
        """
    @staticmethod
    def glowing(light: Sequence[float] | str | Texture | None = ..., radiance: float | None = ..., color: Sequence[float] | str | Texture | None = ..., spectrum: Sequence[Sequence[float]] | np.ndarray | None = ..., group: str | None = ...) -> Material:
        r"""Embers, lava, a filament, a screen: emits equally in all directions.

        light: Colour of the emitted light; default white. (colour or texture; default none)
        radiance: Radiance of the surface where the colour is 1; n² times that inside a material of index n. (number; more than 0 and at most 1e12; default 1)
        color: Reflectance; default black. (colour or texture; default none)
        spectrum: Spectrum of the light: relative power at given wavelengths, or the temperature of a black body. With it, only the brightness of the light's colour is used. Without "spectral", the light has the colour of this spectrum. (list of [nm, number], or {"blackbody": kelvin}; default none)
        group: Light group, of letters, digits, - and _. The light of each group is written to a plane of its own. (text; default "default")
        """
    @staticmethod
    def thin_glass(ior: float | None = ..., color: Sequence[float] | str | Texture | None = ..., thickness: float | None = ..., color_distance: float | None = ..., roughness: float | Number | None = ..., bump: Sequence[float] | str | Texture | None = ..., bump_height: float | None = ..., normal_map: NormalMap | None = ...) -> Material:
        r"""Window pane, foil: glass so thin that light goes straight through. All reflections between its two faces count. Only meshes can have it; a pane is a single layer of triangles, not a closed box.

            R = 2 r/(1 + r)

        ior: Refractive index relative to vacuum. What counts is its ratio to that around it. (number; at least 0.1 and at most 10; default 1.5)
        color: Colour of white light that crosses the glass once, perpendicularly and without reflections; default white. Slanted light crosses more glass. (colour or texture; default none)
        thickness: Thickness of the pane, for its colour: the colour is then that after "color_distance", as in "clear". The pane remains a surface. (number in m; positive; default none)
        color_distance: With a thickness: the distance after which white light has the colour; default 1. (number in m; positive; default none)
        roughness: Roughness α of GGX: 0 is clear, 0.2 frosted. Light is then blurred as much in transmission as in reflection, which is more than two rough faces do. (number or field; at least 0 and at most 1; default 0)
        bump: Bump map: a texture whose bright parts look raised. It changes the normals only, not the surface. A discontinuity of the texture counts as a slope of 45° to 55°. Where two clear materials with bumps meet, the higher one is used. (colour or texture; default none)
        bump_height: With a bump map: height of white above black; may be negative. (number in m; at least -1e15 and at most 1e15; default none)
        normal_map: Instead of a bump map: a normal map, on a mesh that has texture coordinates. (normal map; default none)
        """
    @staticmethod
    def thin_diffuse(color: Sequence[float] | str | Texture, transmission: Sequence[float] | str | Texture, bump: Sequence[float] | str | Texture | None = ..., bump_height: float | None = ..., normal_map: NormalMap | None = ...) -> Material:
        r"""Leaf, paper, lampshade: a sheet that reflects light diffusely, and transmits some of it diffusely to the other side. It is the same from both sides. Only meshes can have it.

        color: Reflectance. (colour or texture)
        transmission: Transmittance. Where the sum with the reflectance exceeds 1 in a channel, both are divided by the sum. (colour or texture)
        bump: Bump map: a texture whose bright parts look raised. It changes the normals only, not the surface. A discontinuity of the texture counts as a slope of 45° to 55°. Where two clear materials with bumps meet, the higher one is used. (colour or texture; default none)
        bump_height: With a bump map: height of white above black; may be negative. (number in m; at least -1e15 and at most 1e15; default none)
        normal_map: Instead of a bump map: a normal map, on a mesh that has texture coordinates. (normal map; default none)
        """
    @staticmethod
    def two_sided(front: Material, back: Material) -> Material:
        r"""Playing card, lined fabric, banknote: an opaque mesh with different materials on its sides. The front is the side of the mesh's normals; without normals, that from which the corners of a triangle are in counter-clockwise order. Neither material may be clear, thin or emit light.

        front: Material of the front. (opaque material)
        back: Material of the back. (opaque material)
        """
    @staticmethod
    def mix(first: Material, second: Material, amount: float | Number | None = ...) -> Material:
        r"""A mix of two materials: iron and rust, paint and the metal under it. Neither may be clear or emit light.

        first: Material where the amount is 0. (opaque material)
        second: Material where the amount is 1. (opaque material)
        amount: Fraction of the second material; between 0 and 1 the two are blended. (number or field; at least 0 and at most 1; default 0.5)
        """

def clear(ior: float | None = ..., glass: Literal["bk7", "diamond", "f2", "fused_silica", "sapphire", "sf11", "water"] | None = ..., abbe_number: float | None = ..., absorption: Sequence[float] | np.ndarray | None = ..., absorption_spectrum: Sequence[Sequence[float]] | np.ndarray | None = ..., color: Sequence[float] | str | None = ..., color_distance: float | None = ..., roughness: float | Number | None = ..., scattering: Sequence[float] | np.ndarray | None = ..., albedo: Sequence[float] | np.ndarray | None = ..., mean_free_path: Sequence[float] | np.ndarray | None = ..., medium: Literal["apple", "chicken1", "chicken2", "cream", "ketchup", "marble", "potato", "skim_milk", "skin1", "skin2", "spectralon", "whole_milk"] | None = ..., scale: float | None = ..., anisotropy: float | None = ..., phase_function: PhaseFunction | None = ..., emission: Sequence[float] | np.ndarray | None = ..., emission_spectrum: Sequence[Sequence[float]] | np.ndarray | None = ..., density: Field | Expression | None = ..., density_depth: float | None = ..., density_grid: Voxels | None = ..., temperature_grid: Voxels | None = ..., emission_temperature: float | None = ..., film_thickness: float | Number | None = ..., film_ior: float | None = ..., bump: Sequence[float] | str | Texture | None = ..., bump_height: float | None = ...) -> Material:
    r"""Vacuum, air, water, glass, milk, wax, fog: light travels inside, where it may be absorbed and scattered.

        exp(−(a + s) d)

    ior: Refractive index relative to vacuum; required unless a glass is named. (number; at least 0.1 and at most 10; default none)
    glass: Instead of the index: a measured substance whose index depends on the wavelength, which causes dispersion. (`"bk7"`, `"diamond"`, `"f2"`, `"fused_silica"`, `"sapphire"`, `"sf11"`, `"water"`; default none)
    abbe_number: Abbe number; the smaller, the stronger the dispersion: crown glass has 60, flint glass 30. Without it, the index is the same for all colours. (number; at least 10 and at most 1000; default none)
    absorption: Absorption coefficients a of red, green and blue; 0 by default. ([r, g, b] in 1/m; zero or more; default none)
    absorption_spectrum: Instead of the absorption: wavelengths and the absorption coefficient at each. Unless the scene is "spectral", it is converted to red, green and blue. Layers that transmit at least a third of white light keep their colour; thicker ones may differ. (list of [nm, number] in nm, 1/m; zero or more; default none)
    color: Instead of the absorption: the colour of white light after a distance. (colour; more than 0 and at most 1; default none)
    color_distance: The distance after which white light has this colour. (number in m; positive; default 1)
    roughness: Roughness α of GGX: 0 is polished, 0.1 satin, 0.5 matt. (number or field; at least 0 and at most 1; default 0)
    scattering: Scattering coefficients s of red, green and blue; 0 by default. ([r, g, b] in 1/m; zero or more; default none)
    albedo: Instead of absorption and scattering: the single-scattering albedo, s/(a + s). ([r, g, b]; at least 0 and at most 1; default none)
    mean_free_path: With the albedo: the mean free path, 1/(a + s). ([r, g, b] in m; positive; default none)
    medium: Instead of absorption and scattering: a measured medium (Jensen et al. 2001). (`"apple"`, `"chicken1"`, `"chicken2"`, `"cream"`, `"ketchup"`, `"marble"`, `"potato"`, `"skim_milk"`, `"skin1"`, `"skin2"`, `"spectralon"`, `"whole_milk"`; default none)
    scale: With a measured medium: how many millimetres one scene unit is. (number in mm; positive; default none)
    anisotropy: Mean cosine g of the Henyey-Greenstein phase function; positive values scatter forwards. Measured media keep their reduced scattering, (1 − g) s, for any g. Default 0. (number; at least -0.99 and at most 0.99; default none)
    phase_function: Directions into which the medium scatters light, if not those of "anisotropy". (phase function; default none)
    emission: Radiance emitted per unit of length along a ray. Requires absorption or scattering in the same channels. ([r, g, b] in 1/m; zero or more; default none)
    emission_spectrum: Spectrum of the emission, as "spectrum" of lights. With it, only the brightness of the emission is used. (list of [nm, number], or {"blackbody": kelvin}; default none)
    density: Density as a field: 0 at its surface and outside, rising linearly to 1 inside. Absorption, scattering and emission are multiplied by the density. (field; default none)
    density_depth: With a density: the depth inside the field at which it reaches 1. (number in m; positive; default none)
    density_grid: Instead of a density: a voxel grid by which absorption, scattering and emission are multiplied. (voxels; default none)
    temperature_grid: Voxel grid of temperatures: the medium emits as a black body, in proportion to its density. Requires a density and an emission, of which it uses only the brightness. The grid's "factor" converts its numbers to kelvin. (voxels in K; default none)
    emission_temperature: With a temperature grid: the temperature at which the medium has the given emission. Hotter parts emit more. (number in K; at least 500 and at most 100000; default 2000)
    film_thickness: Thickness of a thin film on the surface, which shows interference colours as soap and oil do; by default there is none. Where two clear materials with films meet, the thicker one is used. (number or field in nm; at least 0 and at most 5000; default none)
    film_ior: Refractive index of the film. (number; at least 1 and at most 4; default 1.33)
    bump: Bump map: a texture whose bright parts look raised. It changes the normals only, not the surface. A discontinuity of the texture counts as a slope of 45° to 55°. Where two clear materials with bumps meet, the higher one is used. (colour or texture; default none)
    bump_height: With a bump map: height of white above black; may be negative. (number in m; at least -1e15 and at most 1e15; default none)
    """

def diffuse(color: Sequence[float] | str | Texture, roughness: float | Number | None = ..., bump: Sequence[float] | str | Texture | None = ..., bump_height: float | None = ..., normal_map: NormalMap | None = ...) -> Material:
    r"""Paper, plaster, clay: reflects equally in all directions.

    color: Reflectance. (colour or texture)
    roughness: Roughness: 0 is Lambert's law, 1 is clay or the moon, whose limb is as bright as its centre. (number or field; at least 0 and at most 1; default 0)
    bump: Bump map: a texture whose bright parts look raised. It changes the normals only, not the surface. A discontinuity of the texture counts as a slope of 45° to 55°. Where two clear materials with bumps meet, the higher one is used. (colour or texture; default none)
    bump_height: With a bump map: height of white above black; may be negative. (number in m; at least -1e15 and at most 1e15; default none)
    normal_map: Instead of a bump map: a normal map, on a mesh that has texture coordinates. (normal map; default none)
    """

def conductor(metal: Literal["aluminium", "brass", "chromium", "copper", "gold", "iron", "nickel", "silver", "titanium", "tungsten", "aluminum"] | None = ..., eta: Sequence[float] | np.ndarray | None = ..., k: Sequence[float] | np.ndarray | None = ..., reflectance: Sequence[float] | str | Texture | None = ..., roughness: float | Number | None = ..., grain_along: Sequence[float] | np.ndarray | None = ..., grain_around: Sequence[float] | np.ndarray | None = ..., grain_through: Sequence[float] | np.ndarray | None = ..., grain_aspect: float | None = ..., film_thickness: float | Number | None = ..., film_ior: float | None = ..., bump: Sequence[float] | str | Texture | None = ..., bump_height: float | None = ..., normal_map: NormalMap | None = ...) -> Material:
    r"""Metal: a measured one, one with a given complex index η + ik, or one with a given reflectance, which may be a texture.

    metal: A measured metal. (`"aluminium"`, `"brass"`, `"chromium"`, `"copper"`, `"gold"`, `"iron"`, `"nickel"`, `"silver"`, `"titanium"`, `"tungsten"`, `"aluminum"`; default none)
    eta: η for red, green and blue, instead of a measured metal. ([r, g, b]; positive; default none)
    k: k for red, green and blue; required with η. ([r, g, b]; zero or more; default none)
    reflectance: Instead of both: reflectance at normal incidence; it increases towards grazing angles. Such a metal cannot have a film. (colour or texture; default none)
    roughness: Roughness α of GGX: 0 is polished, 0.1 satin, 0.5 matt. (number or field; at least 0 and at most 1; default 0)
    grain_along: Brushed metal: direction of the grain, in the space of the object, or of the scene for a mesh; transforms within a tree do not rotate it. It is projected onto the surface; where the surface is perpendicular to it, the grain is arbitrary. The roughness applies across the grain and must not be 0. ([x, y, z], not all zero; default none)
    grain_around: Instead of a direction, for metal turned on a lathe: direction of the axis around which the grain runs. ([x, y, z], not all zero; default none)
    grain_through: With an axis: a point on it, in the space of the object, or of the scene for a mesh; by default the origin. ([x, y, z] in m; at least -1e15 and at most 1e15; default none)
    grain_aspect: With a grain: ratio of the roughness along the grain to that across it; default 0.2. (number; at least 0.1 and at most 1; default none)
    film_thickness: Thickness of a thin film on the surface, which shows interference colours as soap and oil do; by default there is none. Where two clear materials with films meet, the thicker one is used. (number or field in nm; at least 0 and at most 5000; default none)
    film_ior: Refractive index of the film. (number; at least 1 and at most 4; default 1.33)
    bump: Bump map: a texture whose bright parts look raised. It changes the normals only, not the surface. A discontinuity of the texture counts as a slope of 45° to 55°. Where two clear materials with bumps meet, the higher one is used. (colour or texture; default none)
    bump_height: With a bump map: height of white above black; may be negative. (number in m; at least -1e15 and at most 1e15; default none)
    normal_map: Instead of a bump map: a normal map, on a mesh that has texture coordinates. (normal map; default none)
    """

def coated(color: Sequence[float] | str | Texture, ior: float | None = ..., roughness: float | Number | None = ..., film_thickness: float | Number | None = ..., film_ior: float | None = ..., bump: Sequence[float] | str | Texture | None = ..., bump_height: float | None = ..., normal_map: NormalMap | None = ...) -> Material:
    r"""Varnished or glazed: a clear coat over a diffuse base.

    color: Reflectance of the base. (colour or texture)
    ior: Refractive index of the coat. (number; at least 1 and at most 4; default 1.5)
    roughness: Roughness α of GGX: 0 is polished, 0.1 satin, 0.5 matt. (number or field; at least 0 and at most 1; default 0)
    film_thickness: Thickness of a thin film on the surface, which shows interference colours as soap and oil do; by default there is none. Where two clear materials with films meet, the thicker one is used. (number or field in nm; at least 0 and at most 5000; default none)
    film_ior: Refractive index of the film. (number; at least 1 and at most 4; default 1.33)
    bump: Bump map: a texture whose bright parts look raised. It changes the normals only, not the surface. A discontinuity of the texture counts as a slope of 45° to 55°. Where two clear materials with bumps meet, the higher one is used. (colour or texture; default none)
    bump_height: With a bump map: height of white above black; may be negative. (number in m; at least -1e15 and at most 1e15; default none)
    normal_map: Instead of a bump map: a normal map, on a mesh that has texture coordinates. (normal map; default none)
    """

def principled(base_color: Sequence[float] | str | Texture | None = ..., base_weight: float | Number | None = ..., base_diffuse_roughness: float | Number | None = ..., base_metalness: float | Number | None = ..., specular_weight: float | Number | None = ..., specular_color: Sequence[float] | str | Texture | None = ..., specular_roughness: float | Number | None = ..., specular_ior: float | None = ..., grain_along: Sequence[float] | np.ndarray | None = ..., grain_around: Sequence[float] | np.ndarray | None = ..., grain_through: Sequence[float] | np.ndarray | None = ..., grain_aspect: float | None = ..., coat_weight: float | Number | None = ..., coat_color: Sequence[float] | str | Texture | None = ..., coat_roughness: float | Number | None = ..., coat_ior: float | None = ..., coat_darkening: float | Number | None = ..., fuzz_weight: float | Number | None = ..., fuzz_color: Sequence[float] | str | Texture | None = ..., fuzz_roughness: float | Number | None = ..., film_thickness: float | Number | None = ..., film_ior: float | None = ..., film_weight: float | Number | None = ..., emission_radiance: float | None = ..., emission_color: Sequence[float] | str | Texture | None = ..., emission_spectrum: Sequence[Sequence[float]] | np.ndarray | None = ..., group: str | None = ..., bump: Sequence[float] | str | Texture | None = ..., bump_height: float | None = ..., normal_map: NormalMap | None = ...) -> Material:
    r"""Car paint, velvet, dusty plastic: layers with the parameters of OpenPBR Surface 1.1. The base is metal, or a gloss over a diffuse material; a coat and fuzz may cover it. Its roughness parameters are the square root of the α that other materials take. It is opaque; for transmission and subsurface scattering, use a phase of "clear".

    base_color: Colour of the diffuse base as seen through the gloss, or reflectance of the metal at normal incidence; default 0.8. (colour or texture; default none)
    base_weight: Multiplies the base colour. (number or field; at least 0 and at most 1; default 1)
    base_diffuse_roughness: Roughness of the diffuse base: 0 is Lambert's law, 1 is clay. (number or field; at least 0 and at most 1; default 0)
    base_metalness: 0 is a gloss over a diffuse base, 1 is metal. (number or field; at least 0 and at most 1; default 0)
    specular_weight: Multiplies the reflectance of the gloss and of the metal. (number or field; at least 0 and at most 1; default 1)
    specular_color: Tint of the gloss, and of the metal at 82° ("F82-tint"); default white. (colour or texture; default none)
    specular_roughness: Roughness of the gloss and of the metal; its square is the α of GGX. With a grain, it applies across the grain. (number or field; at least 0 and at most 1; default 0.3)
    specular_ior: Refractive index of the gloss. (number; at least 1 and at most 4; default 1.5)
    grain_along: Brushed metal: direction of the grain, in the space of the object, or of the scene for a mesh; transforms within a tree do not rotate it. It is projected onto the surface; where the surface is perpendicular to it, the grain is arbitrary. The roughness applies across the grain and must not be 0. ([x, y, z], not all zero; default none)
    grain_around: Instead of a direction, for metal turned on a lathe: direction of the axis around which the grain runs. ([x, y, z], not all zero; default none)
    grain_through: With an axis: a point on it, in the space of the object, or of the scene for a mesh; by default the origin. ([x, y, z] in m; at least -1e15 and at most 1e15; default none)
    grain_aspect: With a grain: ratio of the roughness along the grain to that across it; default 0.2. (number; at least 0.1 and at most 1; default none)
    coat_weight: Share of the surface that has a clear coat. (number or field; at least 0 and at most 1; default 0)
    coat_color: Tint of light that crosses the coat twice at normal incidence; default white. (colour or texture; default none)
    coat_roughness: Roughness of the coat. (number or field; at least 0 and at most 1; default 0)
    coat_ior: Refractive index of the coat. (number; at least 1 and at most 4; default 1.6)
    coat_darkening: How much the coat darkens the base by reflecting light back to it: 1 is physical, 0 keeps the base's colour. (number or field; at least 0 and at most 1; default 1)
    fuzz_weight: Share of the surface that has fuzz: velvet, dust. (number or field; at least 0 and at most 1; default 0)
    fuzz_color: Colour of the fuzz; default white. (colour or texture; default none)
    fuzz_roughness: Roughness of the fuzz: low for velvet, high for dust. Values below 0.26 are treated as 0.26. (number or field; at least 0 and at most 1; default 0.5)
    film_thickness: Thickness of a thin film on the surface, which shows interference colours as soap and oil do; by default there is none. Where two clear materials with films meet, the thicker one is used. (number or field in nm; at least 0 and at most 5000; default none)
    film_ior: Refractive index of the film. (number; at least 1 and at most 4; default 1.33)
    film_weight: With a film: share of the surface that has it. (number or field; at least 0 and at most 1; default 1)
    emission_radiance: Radiance, equal in all directions, where the emission colour is 1. Inside a material of index n, the radiance is n² times this value. (number; at least 0 and at most 1e12; default 0)
    emission_color: Colour of the emitted light; default white. (colour or texture; default none)
    emission_spectrum: Spectrum of the emission, as "spectrum" of lights. With it, only the brightness of the emission is used. (list of [nm, number], or {"blackbody": kelvin}; default none)
    group: Light group, of letters, digits, - and _. The light of each group is written to a plane of its own. (text; default "default")
    bump: Bump map: a texture whose bright parts look raised. It changes the normals only, not the surface. A discontinuity of the texture counts as a slope of 45° to 55°. Where two clear materials with bumps meet, the higher one is used. (colour or texture; default none)
    bump_height: With a bump map: height of white above black; may be negative. (number in m; at least -1e15 and at most 1e15; default none)
    normal_map: Instead of a bump map: a normal map, on a mesh that has texture coordinates. (normal map; default none)
    """

def glowing(light: Sequence[float] | str | Texture | None = ..., radiance: float | None = ..., color: Sequence[float] | str | Texture | None = ..., spectrum: Sequence[Sequence[float]] | np.ndarray | None = ..., group: str | None = ...) -> Material:
    r"""Embers, lava, a filament, a screen: emits equally in all directions.

    light: Colour of the emitted light; default white. (colour or texture; default none)
    radiance: Radiance of the surface where the colour is 1; n² times that inside a material of index n. (number; more than 0 and at most 1e12; default 1)
    color: Reflectance; default black. (colour or texture; default none)
    spectrum: Spectrum of the light: relative power at given wavelengths, or the temperature of a black body. With it, only the brightness of the light's colour is used. Without "spectral", the light has the colour of this spectrum. (list of [nm, number], or {"blackbody": kelvin}; default none)
    group: Light group, of letters, digits, - and _. The light of each group is written to a plane of its own. (text; default "default")
    """

def thin_glass(ior: float | None = ..., color: Sequence[float] | str | Texture | None = ..., thickness: float | None = ..., color_distance: float | None = ..., roughness: float | Number | None = ..., bump: Sequence[float] | str | Texture | None = ..., bump_height: float | None = ..., normal_map: NormalMap | None = ...) -> Material:
    r"""Window pane, foil: glass so thin that light goes straight through. All reflections between its two faces count. Only meshes can have it; a pane is a single layer of triangles, not a closed box.

        R = 2 r/(1 + r)

    ior: Refractive index relative to vacuum. What counts is its ratio to that around it. (number; at least 0.1 and at most 10; default 1.5)
    color: Colour of white light that crosses the glass once, perpendicularly and without reflections; default white. Slanted light crosses more glass. (colour or texture; default none)
    thickness: Thickness of the pane, for its colour: the colour is then that after "color_distance", as in "clear". The pane remains a surface. (number in m; positive; default none)
    color_distance: With a thickness: the distance after which white light has the colour; default 1. (number in m; positive; default none)
    roughness: Roughness α of GGX: 0 is clear, 0.2 frosted. Light is then blurred as much in transmission as in reflection, which is more than two rough faces do. (number or field; at least 0 and at most 1; default 0)
    bump: Bump map: a texture whose bright parts look raised. It changes the normals only, not the surface. A discontinuity of the texture counts as a slope of 45° to 55°. Where two clear materials with bumps meet, the higher one is used. (colour or texture; default none)
    bump_height: With a bump map: height of white above black; may be negative. (number in m; at least -1e15 and at most 1e15; default none)
    normal_map: Instead of a bump map: a normal map, on a mesh that has texture coordinates. (normal map; default none)
    """

def thin_diffuse(color: Sequence[float] | str | Texture, transmission: Sequence[float] | str | Texture, bump: Sequence[float] | str | Texture | None = ..., bump_height: float | None = ..., normal_map: NormalMap | None = ...) -> Material:
    r"""Leaf, paper, lampshade: a sheet that reflects light diffusely, and transmits some of it diffusely to the other side. It is the same from both sides. Only meshes can have it.

    color: Reflectance. (colour or texture)
    transmission: Transmittance. Where the sum with the reflectance exceeds 1 in a channel, both are divided by the sum. (colour or texture)
    bump: Bump map: a texture whose bright parts look raised. It changes the normals only, not the surface. A discontinuity of the texture counts as a slope of 45° to 55°. Where two clear materials with bumps meet, the higher one is used. (colour or texture; default none)
    bump_height: With a bump map: height of white above black; may be negative. (number in m; at least -1e15 and at most 1e15; default none)
    normal_map: Instead of a bump map: a normal map, on a mesh that has texture coordinates. (normal map; default none)
    """

def two_sided(front: Material, back: Material) -> Material:
    r"""Playing card, lined fabric, banknote: an opaque mesh with different materials on its sides. The front is the side of the mesh's normals; without normals, that from which the corners of a triangle are in counter-clockwise order. Neither material may be clear, thin or emit light.

    front: Material of the front. (opaque material)
    back: Material of the back. (opaque material)
    """

def mix(first: Material, second: Material, amount: float | Number | None = ...) -> Material:
    r"""A mix of two materials: iron and rust, paint and the metal under it. Neither may be clear or emit light.

    first: Material where the amount is 0. (opaque material)
    second: Material where the amount is 1. (opaque material)
    amount: Fraction of the second material; between 0 and 1 the two are blended. (number or field; at least 0 and at most 1; default 0.5)
    """

class textures:
    @staticmethod
    def wood(light: Sequence[float] | str | None = ..., dark: Sequence[float] | str | None = ..., ring_spacing: float | None = ..., axis: Sequence[float] | np.ndarray | None = ..., pith: Sequence[float] | np.ndarray | None = ..., seed: int | None = ...) -> Texture:
        r"""Solid wood: annual rings around an axis, with fibres and pores along it.

        light: Colour of the early wood. (colour; at least 0 and at most 1; default [0.42, 0.24, 0.115])
        dark: Colour of the late wood. (colour; at least 0 and at most 1; default [0.15, 0.068, 0.03])
        ring_spacing: Mean width of a ring. (number in m; positive; default 0.1)
        axis: Direction of the trunk, of any length. ([x, y, z], not all zero; default [0, 0, 1])
        pith: A point on the axis of the trunk. ([x, y, z] in m; default [0, 0, 0])
        seed: Seed of the pattern. (whole number; zero or more; default 0)
        """
    @staticmethod
    def speckle(color: Sequence[float] | str | None = ..., other: Sequence[float] | str | None = ..., grain: float | None = ..., contrast: float | None = ..., seed: int | None = ...) -> Texture:
        r"""Grains, as of sand, each with its own colour and brightness.

        color: One colour of the grains. (colour; at least 0 and at most 1; default [0.58, 0.42, 0.24])
        other: The other colour; each grain is a mixture of both. (colour; at least 0 and at most 1; default [0.7, 0.57, 0.39])
        grain: Mean distance between grains. (number in m; positive; default 0.01)
        contrast: Variation of the grains, from none at 0 to strong at 1. (number; at least 0 and at most 1; default 0.5)
        seed: Seed of the pattern. (whole number; zero or more; default 0)
        """
    @staticmethod
    def marble(color: Sequence[float] | str | None = ..., vein: Sequence[float] | str | None = ..., scale: float | None = ..., seed: int | None = ...) -> Texture:
        r"""A ground colour crossed by veins.

        color: Colour of the ground. (colour; at least 0 and at most 1; default [0.82, 0.8, 0.77])
        vein: Colour of the veins. (colour; at least 0 and at most 1; default [0.2, 0.21, 0.24])
        scale: Mean distance between veins. (number in m; positive; default 1)
        seed: Seed of the pattern. (whole number; zero or more; default 0)
        """
    @staticmethod
    def checker(even: Sequence[float] | str | None = ..., odd: Sequence[float] | str | None = ..., size: float | None = ..., origin: Sequence[float] | np.ndarray | None = ...) -> Texture:
        r"""Cubes of two alternating colours, which appear as squares on planes along the axes.

        even: Colour of the even cubes. (colour; at least 0 and at most 1; default [0.8, 0.8, 0.8])
        odd: Colour of the odd cubes. (colour; at least 0 and at most 1; default [0.2, 0.2, 0.2])
        size: Length of the edge of a cube. (number in m; positive; default 1)
        origin: A corner of an even cube. Axis-aligned surfaces should not pass through corners. ([x, y, z] in m; default [0, 0, 0])
        """
    @staticmethod
    def field(of: Field | Expression, ramp: Sequence[Sequence[float | str | Sequence[float] | Texture]]) -> Texture:
        r"""A colour or texture that depends on a field, such as the distance to other phases: sand that is dark where it is wet.

        of: The field, or the name of a shape. (field)
        ramp: Values of the field and the colour or texture at each, with interpolation in between. (list of [number, colour or texture] in m; at least 0 and at most 1)
        """
    @staticmethod
    def image(file: str | PathLike[str], size: float | None = ..., origin: Sequence[float] | np.ndarray | None = ..., blend: float | None = ...) -> Texture:
        r"""An image on all sides (triplanar mapping), projected along the axes and repeated endlessly.

        file: Image file in any format that OpenImageIO reads, at most 4096 × 4096 pixels. (name of a file)
        size: Width of the image; the height follows from its proportions. (number in m; positive; default 1)
        origin: Position of the lower left corner. ([x, y, z] in m; default [0, 0, 0])
        blend: How widely the three projections are blended on slanted surfaces: not at all at 0, everywhere at 1. (number; at least 0 and at most 1; default 0.3)
        """
    @staticmethod
    def mesh_image(file: str | PathLike[str], repeat: Sequence[float] | np.ndarray | None = ...) -> Texture:
        r"""An image on a mesh, by the texture coordinates in the mesh file.

        file: Image file in any format that OpenImageIO reads, at most 4096 × 4096 pixels. (name of a file)
        repeat: Number of repetitions of the image, horizontally and vertically. ([x, y]; default [1, 1])
        """
    @staticmethod
    def vertex_color() -> Texture:
        r"""The vertex colours in the mesh file, as scans have them.


        """
    @staticmethod
    def measured(reflectance: Sequence[Sequence[float]] | np.ndarray) -> Texture:
        r"""A colour given by a measured reflectance spectrum.

        reflectance: Wavelengths and the reflectance at each. (list of [nm, number] in nm; at least 0 and at most 1)
        """
    @staticmethod
    def per_copy(ramp: Sequence[Sequence[float | str | Sequence[float] | Texture]], seed: int | None = ...) -> Texture:
        r"""A random colour or texture for each copy made by "instances", so that leaves or pebbles differ.

        ramp: Random numbers from 0 to 1 and the colour or texture of a copy with that number, with interpolation in between. (list of [number, colour or texture]; at least 0 and at most 1)
        seed: Seed of the random numbers; parameters with the same seed vary together. (whole number; zero or more; default 0)
        """

class numbers:
    @staticmethod
    def field(of: Field | Expression, ramp: Sequence[Sequence[float]] | np.ndarray) -> Number:
        r"""A number that depends on a field, such as the distance to other phases.

        of: The field, or the name of a shape. (field)
        ramp: Values of the field and the number at each, with interpolation in between. (list of [number, number] in m)
        """
    @staticmethod
    def mesh_image(file: str | PathLike[str], channel: Literal["red", "green", "blue", "alpha"] | None = ..., repeat: Sequence[float] | np.ndarray | None = ..., range: Sequence[float] | np.ndarray | None = ...) -> Number:
        r"""A number from an image on a mesh, by the texture coordinates in the mesh file.

        file: Image, of which one channel is used as stored: integers are not decoded from sRGB. (name of a file)
        channel: Channel to use; in grey images all three are the same. (`"red"`, `"green"`, `"blue"`, `"alpha"`; default "red")
        repeat: Number of repetitions of the image, horizontally and vertically. ([x, y]; default [1, 1])
        range: Numbers for black and white. ([x, y]; default [0, 1])
        """
    @staticmethod
    def per_copy(ramp: Sequence[Sequence[float]] | np.ndarray, seed: int | None = ...) -> Number:
        r"""A random number for each copy made by "instances".

        ramp: Random numbers from 0 to 1 and the value of a copy with that number, with interpolation in between. (list of [number, number])
        seed: Seed of the random numbers; parameters with the same seed vary together. (whole number; zero or more; default 0)
        """

def normal_map(file: str | PathLike[str], repeat: Sequence[float] | np.ndarray | None = ..., strength: float | None = ..., green_down: bool | None = ...) -> NormalMap:
    r"""A normal map on a mesh, by the texture coordinates in the mesh file: red points to the right of the image, green up, and blue out of the surface.

    file: Image of at most 4096 × 4096 pixels. Its numbers are used as stored: 0 stands for −1, and 1 (255 of 255) for 1. (name of a file)
    repeat: Number of repetitions of the image, horizontally and vertically. ([x, y]; default [1, 1])
    strength: Factor applied to red and green: 0 is smooth, and 2 twice as steep. (number; at least 0 and at most 100; default 1)
    green_down: Whether green points down in the image, as in DirectX, and not up, as in OpenGL. (true or false; default false)
    """

class phase_functions:
    @staticmethod
    def henyey_greenstein(g: float | None = ...) -> PhaseFunction:
        r"""A single lobe, forwards or backwards: milk, wax, smoke. `"anisotropy": g` is short for it.

            p(μ) = (1 − g²)/(4π (1 + g² − 2gμ)^(3/2))

        g: Mean cosine; positive values scatter forwards. (number; at least -0.99 and at most 0.99; default 0)
        """
    @staticmethod
    def rayleigh() -> PhaseFunction:
        r"""Particles much smaller than the wavelength, such as molecules of air or the finest smoke. They scatter as much backwards as forwards, and half as much to the side.

            p(μ) = 3 (1 + μ²)/(16π)


        """
    @staticmethod
    def draine(g: float | None = ..., alpha: float | None = ...) -> PhaseFunction:
        r"""Draine's phase function for dust: a lobe that scatters more light forwards and backwards than `henyey_greenstein`, and less to the side.

            p(μ) = 1/(4π) (1 − g²)/(1 + g² − 2gμ)^(3/2) (1 + α μ²)/(1 + α (1 + 2g²)/3)

        g: Shape of the lobe, as in `henyey_greenstein`; the mean cosine also depends on α. Values within 0.001 of 0 count as 0. (number; at least -0.99 and at most 0.99; default 0.5)
        alpha: α. With 0, it is `henyey_greenstein`; with 1 and g = 0, `rayleigh`. (number; at least 0 and at most 1000; default 1)
        """
    @staticmethod
    def droplets(diameter: float | None = ...) -> PhaseFunction:
        r"""Water droplets of one size, in fog and clouds: Jendersie and d'Eon's fit to Mie's theory (2023), a mixture of `henyey_greenstein` and `draine`. It has neither glory nor fogbow.

        diameter: Diameter of the droplets: 5 to 15 in fog, 10 to 50 in clouds. (number in µm; at least 5 and at most 50; default 15)
        """
    @staticmethod
    def mix(first: PhaseFunction, second: PhaseFunction, amount: float | None = ...) -> PhaseFunction:
        r"""A mix of two phase functions, such as one lobe forwards and one backwards. Either may be a mix itself.

            p(μ) = (1 − a) p₁(μ) + a p₂(μ)

        first: Phase function where the amount is 0. (phase function)
        second: Phase function where the amount is 1. (phase function)
        amount: a, the fraction of the scattered light that the second distributes. (number; at least 0 and at most 1; default 0.5)
        """

def voxels(file: str | PathLike[str], grid: str | None = ..., spacing: Sequence[float] | np.ndarray | None = ..., factor: float | None = ..., scale: float | None = ..., rotate_z: float | None = ..., translate: Sequence[float] | np.ndarray | None = ..., y_up: bool | None = ...) -> Voxels:
    r"""A voxel grid, from OpenVDB or a stack of images: smoke, clouds, ink, scans. Values are interpolated between the voxels' centres; negative ones count as 0. Outside the grid's box, which ends half a voxel beyond the outermost centres, they are 0. The grid is scaled first, then rotated, then translated.

    file: An OpenVDB file (.vdb) with a grid of floats or doubles whose background is 0. Or grey images, one per layer from the lowest z to the highest: a name in which each # stands for a digit of the layer's number, such as "layer_###.png". Integer grey values are scaled to 0 … 1. The top row of an image has the greatest y and the left column the least x; the stack is centred on the origin. (name of a file)
    grid: Name of the grid in an OpenVDB file; required if the file has several grids of numbers. If several have the same name, append the index: "density[0]", "density[1]". (text; default "")
    spacing: Distance between voxels along x, y and z. Required for images; OpenVDB files have their own. ([x, y, z] in m; positive; default none)
    factor: Factor applied to the numbers. (number; zero or more; default 1)
    scale: Scale factor. (number; positive; default 1)
    rotate_z: Rotation about the z axis, anticlockwise as seen from above. (number in degrees; default 0)
    translate: Translation: the image of the origin. ([x, y, z] in m; default [0, 0, 0])
    y_up: Whether y, and not z, is up in the file. This is converted first. (true or false; default false)
    """

class lights:
    @staticmethod
    def constant(radiance: Sequence[float] | str | None = ..., intensity: float | None = ..., group: str | None = ..., spectrum: Sequence[Sequence[float]] | np.ndarray | None = ...) -> Light:
        r"""The same radiance from every direction.

        radiance: Radiance from every direction. (colour; zero or more; default [1, 1, 1])
        intensity: Factor applied to the radiance. (number; zero or more; default 1)
        group: Light group, of letters, digits, - and _. The light of each group is written to a plane of its own. (text; default "default")
        spectrum: Spectrum of the light: relative power at given wavelengths, or the temperature of a black body. With it, only the brightness of the light's colour is used. Without "spectral", the light has the colour of this spectrum. (list of [nm, number], or {"blackbody": kelvin}; default none)
        """
    @staticmethod
    def gradient(zenith: Sequence[float] | str, horizon: Sequence[float] | str, ground: Sequence[float] | str, intensity: float | None = ..., softness: float | None = ..., group: str | None = ..., spectrum: Sequence[Sequence[float]] | np.ndarray | None = ...) -> Light:
        r"""A smooth gradient of three colours by elevation.

            mix(horizon, zenith or ground, S(min(|z|/softness, 1))),  S(t) = t² (3 − 2t)

        zenith: Radiance from straight above. (colour; zero or more)
        horizon: Radiance from the horizon. (colour; zero or more)
        ground: Radiance from straight below. (colour; zero or more)
        intensity: Factor applied to all three radiances. (number; zero or more; default 1)
        softness: Sine of the elevation at which the zenith's or the ground's colour is reached. (number; more than 0 and at most 1; default 1)
        group: Light group, of letters, digits, - and _. The light of each group is written to a plane of its own. (text; default "default")
        spectrum: Spectrum of the light: relative power at given wavelengths, or the temperature of a black body. With it, only the brightness of the light's colour is used. Without "spectral", the light has the colour of this spectrum. (list of [nm, number], or {"blackbody": kelvin}; default none)
        """
    @staticmethod
    def image(file: str | PathLike[str], rotation: float | None = ..., intensity: float | None = ..., group: str | None = ..., spectrum: Sequence[Sequence[float]] | np.ndarray | None = ...) -> Light:
        r"""An environment map in latitude-longitude format, twice as wide as high.

        file: Image file that OpenImageIO reads row by row (OpenEXR, Radiance, TIFF, PNG, JPEG …), at most 16384 × 8192 pixels. (name of a file)
        rotation: Rotation about the z axis, clockwise as seen from above. (number in degrees; default 0)
        intensity: Factor applied to the image. (number; zero or more; default 1)
        group: Light group, of letters, digits, - and _. The light of each group is written to a plane of its own. (text; default "default")
        spectrum: Spectrum of the light: relative power at given wavelengths, or the temperature of a black body. With it, only the brightness of the light's colour is used. Without "spectral", the light has the colour of this spectrum. (list of [nm, number], or {"blackbody": kelvin}; default none)
        """
    @staticmethod
    def sky(sun_elevation: float | None = ..., sun_azimuth: float | None = ..., sun_diameter: float | None = ..., turbidity: float | None = ..., ground: Sequence[float] | str | None = ..., intensity: float | None = ..., sun: bool | None = ..., group: str | None = ..., spectrum: Sequence[Sequence[float]] | np.ndarray | None = ...) -> Light:
        r"""A clear sky with its sun and the ground below, from a model of the atmosphere. White level ground has luminance 1 with the sun 45° high and turbidity 3.

        sun_elevation: Elevation of the sun above the horizon; there is twilight down to −8. (number in degrees; at least -90 and at most 90; default 45)
        sun_azimuth: Direction of the sun, clockwise from +y. (number in degrees; at least -1000000 and at most 1000000; default 0)
        sun_diameter: Angular diameter of the sun. (number in degrees; more than 0 and at most 90; default 0.53)
        turbidity: Haze: 2 is very clear, 3 clear, 6 hazy. (number; at least 1 and at most 10; default 3)
        ground: Reflectance of the ground, which is diffuse. (colour; at least 0 and at most 1; default [0.3, 0.3, 0.3])
        intensity: Factor applied to sky, sun and ground. (number; at least 0 and at most 1e30; default 1)
        sun: Whether to include the sun itself. (true or false; default true)
        group: Light group, of letters, digits, - and _. The light of each group is written to a plane of its own. (text; default "default")
        spectrum: Spectrum of the light: relative power at given wavelengths, or the temperature of a black body. With it, only the brightness of the light's colour is used. Without "spectral", the light has the colour of this spectrum. (list of [nm, number], or {"blackbody": kelvin}; default none)
        """
    @staticmethod
    def sun(direction: Sequence[float] | np.ndarray, irradiance: Sequence[float] | str | None = ..., diameter: float | None = ..., group: str | None = ..., spectrum: Sequence[Sequence[float]] | np.ndarray | None = ...) -> Light:
        r"""A disk of constant radiance infinitely far away.

            L = E/(π sin²(δ/2))

        direction: Direction towards the sun, of any length. ([x, y, z], not all zero)
        irradiance: Irradiance E of a surface that faces the sun. (colour; zero or more; default [1, 1, 1])
        diameter: Angular diameter δ. A larger sun casts softer shadows of the same brightness. (number in degrees; more than 0 and at most 90; default 0.53)
        group: Light group, of letters, digits, - and _. The light of each group is written to a plane of its own. (text; default "default")
        spectrum: Spectrum of the light: relative power at given wavelengths, or the temperature of a black body. With it, only the brightness of the light's colour is used. Without "spectral", the light has the colour of this spectrum. (list of [nm, number], or {"blackbody": kelvin}; default none)
        """
    @staticmethod
    def rectangle(centre: Sequence[float] | np.ndarray, target: Sequence[float] | np.ndarray, width: float, height: float, radiance: Sequence[float] | str | None = ..., intensity: float | None = ..., visible_to_camera: bool | None = ..., group: str | None = ..., spectrum: Sequence[Sequence[float]] | np.ndarray | None = ...) -> Light:
        r"""A rectangle that emits on one side and is invisible from behind.

        centre: Its centre. ([x, y, z] in m; at least -1e15 and at most 1e15)
        target: Point that the light faces. ([x, y, z] in m; at least -1e15 and at most 1e15)
        width: Length of the horizontal edge; along x if the light faces up or down. (number in m; more than 0 and at most 1e15)
        height: Length of the other edge. (number in m; more than 0 and at most 1e15)
        radiance: Radiance of the emitting side. (colour; zero or more; default [1, 1, 1])
        intensity: Factor applied to the radiance. (number; zero or more; default 1)
        visible_to_camera: Whether the camera sees the light directly. (true or false; default true)
        group: Light group, of letters, digits, - and _. The light of each group is written to a plane of its own. (text; default "default")
        spectrum: Spectrum of the light: relative power at given wavelengths, or the temperature of a black body. With it, only the brightness of the light's colour is used. Without "spectral", the light has the colour of this spectrum. (list of [nm, number], or {"blackbody": kelvin}; default none)
        """
    @staticmethod
    def sphere(centre: Sequence[float] | np.ndarray, radius: float, radiance: Sequence[float] | str | None = ..., intensity: float | None = ..., visible_to_camera: bool | None = ..., group: str | None = ..., spectrum: Sequence[Sequence[float]] | np.ndarray | None = ...) -> Light:
        r"""A sphere that emits light.

        centre: Its centre. ([x, y, z] in m; at least -1e15 and at most 1e15)
        radius: Radius of a sphere. (number in m; more than 0 and at most 1e15)
        radiance: Radiance of the surface. (colour; zero or more; default [1, 1, 1])
        intensity: Factor applied to the radiance. (number; zero or more; default 1)
        visible_to_camera: Whether the camera sees the light directly. (true or false; default true)
        group: Light group, of letters, digits, - and _. The light of each group is written to a plane of its own. (text; default "default")
        spectrum: Spectrum of the light: relative power at given wavelengths, or the temperature of a black body. With it, only the brightness of the light's colour is used. Without "spectral", the light has the colour of this spectrum. (list of [nm, number], or {"blackbody": kelvin}; default none)
        """
    @staticmethod
    def spheres(centres: Sequence[Sequence[float]] | np.ndarray, radius: float, radiance: Sequence[float] | str | None = ..., intensity: float | None = ..., visible_to_camera: bool | None = ..., group: str | None = ..., spectrum: Sequence[Sequence[float]] | np.ndarray | None = ...) -> Light:
        r"""Many equal sphere lights.

        centres: Centres of the spheres. (list of [x, y, z] in m; at least -1e15 and at most 1e15)
        radius: Radius of a sphere. (number in m; more than 0 and at most 1e15)
        radiance: Radiance of the surface. (colour; zero or more; default [1, 1, 1])
        intensity: Factor applied to the radiance. (number; zero or more; default 1)
        visible_to_camera: Whether the camera sees the light directly. (true or false; default true)
        group: Light group, of letters, digits, - and _. The light of each group is written to a plane of its own. (text; default "default")
        spectrum: Spectrum of the light: relative power at given wavelengths, or the temperature of a black body. With it, only the brightness of the light's colour is used. Without "spectral", the light has the colour of this spectrum. (list of [nm, number], or {"blackbody": kelvin}; default none)
        """
    @staticmethod
    def point(position: Sequence[float] | np.ndarray, color: Sequence[float] | str | None = ..., intensity: float | None = ..., group: str | None = ..., spectrum: Sequence[Sequence[float]] | np.ndarray | None = ...) -> Light:
        r"""A point that emits equally in all directions. It is never visible, and its light passes through glass or water only with "caustics", which use photons; without them, objects behind stay dark. A small sphere light has neither limitation.

        position: Position of the light. ([x, y, z] in m; at least -1e15 and at most 1e15)
        color: Factor applied to the intensity. (colour; zero or more; default [1, 1, 1])
        intensity: Radiant intensity, in the unit of radiance times m²: a surface that faces the light at distance d receives the irradiance intensity/d². (number; zero or more; default 1)
        group: Light group, of letters, digits, - and _. The light of each group is written to a plane of its own. (text; default "default")
        spectrum: Spectrum of the light: relative power at given wavelengths, or the temperature of a black body. With it, only the brightness of the light's colour is used. Without "spectral", the light has the colour of this spectrum. (list of [nm, number], or {"blackbody": kelvin}; default none)
        """
    @staticmethod
    def spot(position: Sequence[float] | np.ndarray, target: Sequence[float] | np.ndarray, cone: float | None = ..., edge: float | None = ..., color: Sequence[float] | str | None = ..., intensity: float | None = ..., group: str | None = ..., spectrum: Sequence[Sequence[float]] | np.ndarray | None = ...) -> Light:
        r"""A point light that emits only within a cone with a smooth edge.

        position: Position of the light. ([x, y, z] in m; at least -1e15 and at most 1e15)
        target: Point on the axis of the cone. ([x, y, z] in m; at least -1e15 and at most 1e15)
        cone: Full angle of the cone, outside which it is dark. (number in degrees; more than 0 and at most 360; default 60)
        edge: Width of the soft edge inside the cone; at most half of the cone's angle is used. (number in degrees; at least 0 and at most 180; default 5)
        color: Factor applied to the intensity. (colour; zero or more; default [1, 1, 1])
        intensity: Radiant intensity, in the unit of radiance times m²: a surface that faces the light at distance d receives the irradiance intensity/d². (number; zero or more; default 1)
        group: Light group, of letters, digits, - and _. The light of each group is written to a plane of its own. (text; default "default")
        spectrum: Spectrum of the light: relative power at given wavelengths, or the temperature of a black body. With it, only the brightness of the light's colour is used. Without "spectral", the light has the colour of this spectrum. (list of [nm, number], or {"blackbody": kelvin}; default none)
        """
    @staticmethod
    def ies(file: str | PathLike[str], position: Sequence[float] | np.ndarray, target: Sequence[float] | np.ndarray, turn: float | None = ..., color: Sequence[float] | str | None = ..., intensity: float | None = ..., group: str | None = ..., spectrum: Sequence[Sequence[float]] | np.ndarray | None = ...) -> Light:
        r"""A point light with the angular distribution of an IES photometric file (LM-63, type C).

        file: Photometric file of at most 1 MiB. (name of a file)
        position: Position of the light. ([x, y, z] in m; at least -1e15 and at most 1e15)
        target: Point towards which the file's downward direction points. ([x, y, z] in m; at least -1e15 and at most 1e15)
        turn: Rotation about the direction towards `target`, anticlockwise as seen from behind the light. At 0, the 0° plane of a light that points down faces +x. (number in degrees; default 0)
        color: Factor applied to the intensity. (colour; zero or more; default [1, 1, 1])
        intensity: Radiant intensity in the direction where the file has the most candelas; see the point light. (number; zero or more; default 1)
        group: Light group, of letters, digits, - and _. The light of each group is written to a plane of its own. (text; default "default")
        spectrum: Spectrum of the light: relative power at given wavelengths, or the temperature of a black body. With it, only the brightness of the light's colour is used. Without "spectral", the light has the colour of this spectrum. (list of [nm, number], or {"blackbody": kelvin}; default none)
        """
    @staticmethod
    def portal(centre: Sequence[float] | np.ndarray, target: Sequence[float] | np.ndarray, width: float, height: float) -> Light:
        r"""An opening, such as a window of a room, through which lights at infinity are sampled. It reduces noise and emits no light.

        centre: Its centre. ([x, y, z] in m; at least -1e15 and at most 1e15)
        target: A point inside the room, straight in front of the portal. ([x, y, z] in m; at least -1e15 and at most 1e15)
        width: Length of the horizontal edge; along x if the portal faces up or down. (number in m; more than 0 and at most 1e15)
        height: Length of the other edge. (number in m; more than 0 and at most 1e15)
        """

class meshes:
    @staticmethod
    def obj(material: Material, file: str | PathLike[str], scale: float | None = ..., rotate_z: float | None = ..., translate: Sequence[float] | np.ndarray | None = ..., opacity: float | Number | None = ..., opacity_cutoff: float | None = ..., y_up: bool | None = ..., smooth: bool | None = ...) -> Mesh:
        r"""The faces of a Wavefront OBJ file of at most 1 GiB, with normals, texture coordinates and vertex colours; its materials are ignored. The mesh is scaled first, then rotated, then translated.

        material: Material of the mesh. (opaque material)
        file: The file. (name of a file)
        scale: Scale factor. (number; positive; default 1)
        rotate_z: Rotation about the z axis, anticlockwise as seen from above. (number in degrees; default 0)
        translate: Translation: the image of the origin. ([x, y, z] in m; default [0, 0, 0])
        opacity: Opacity: 0 is a hole, 1 is opaque. For values in between, the rest of the light passes straight through, as through a fine net. (number or field; at least 0 and at most 1; default none)
        opacity_cutoff: With an opacity: values below this are holes and all others opaque, so edges are sharp. (number; at least 0 and at most 1; default none)
        y_up: Whether y, and not z, is up in the file. This is converted first. (true or false; default false)
        smooth: Whether to shade the mesh smoothly. Normals come from the file; if it has none, they are the mean normals of the faces around each vertex. (true or false; default true)
        """
    @staticmethod
    def ply(material: Material, file: str | PathLike[str], scale: float | None = ..., rotate_z: float | None = ..., translate: Sequence[float] | np.ndarray | None = ..., opacity: float | Number | None = ..., opacity_cutoff: float | None = ..., y_up: bool | None = ..., smooth: bool | None = ...) -> Mesh:
        r"""The faces of a PLY file of at most 1 GiB, such as a scan, with normals, texture coordinates and vertex colours. Placed as for obj.

        material: Material of the mesh. (opaque material)
        file: The file. (name of a file)
        scale: Scale factor. (number; positive; default 1)
        rotate_z: Rotation about the z axis, anticlockwise as seen from above. (number in degrees; default 0)
        translate: Translation: the image of the origin. ([x, y, z] in m; default [0, 0, 0])
        opacity: Opacity: 0 is a hole, 1 is opaque. For values in between, the rest of the light passes straight through, as through a fine net. (number or field; at least 0 and at most 1; default none)
        opacity_cutoff: With an opacity: values below this are holes and all others opaque, so edges are sharp. (number; at least 0 and at most 1; default none)
        y_up: Whether y, and not z, is up in the file. This is converted first. (true or false; default false)
        smooth: Whether to shade the mesh smoothly. Normals come from the file; if it has none, they are the mean normals of the faces around each vertex. (true or false; default true)
        """
    @staticmethod
    def stl(material: Material, file: str | PathLike[str], scale: float | None = ..., rotate_z: float | None = ..., translate: Sequence[float] | np.ndarray | None = ..., opacity: float | Number | None = ..., opacity_cutoff: float | None = ..., y_up: bool | None = ..., smooth: bool | None = ...) -> Mesh:
        r"""The triangles of an STL file of at most 1 GiB. Placed as for obj.

        material: Material of the mesh. (opaque material)
        file: The file. (name of a file)
        scale: Scale factor. (number; positive; default 1)
        rotate_z: Rotation about the z axis, anticlockwise as seen from above. (number in degrees; default 0)
        translate: Translation: the image of the origin. ([x, y, z] in m; default [0, 0, 0])
        opacity: Opacity: 0 is a hole, 1 is opaque. For values in between, the rest of the light passes straight through, as through a fine net. (number or field; at least 0 and at most 1; default none)
        opacity_cutoff: With an opacity: values below this are holes and all others opaque, so edges are sharp. (number; at least 0 and at most 1; default none)
        y_up: Whether y, and not z, is up in the file. This is converted first. (true or false; default false)
        smooth: Whether to shade the mesh smoothly. Normals come from the file; if it has none, they are the mean normals of the faces around each vertex. (true or false; default true)
        """
    @staticmethod
    def gltf(file: str | PathLike[str], material: Material | None = ..., scale: float | None = ..., rotate_z: float | None = ..., translate: Sequence[float] | np.ndarray | None = ..., imported: bool | None = ..., panes: bool | None = ...) -> Mesh:
        r"""The triangles of a glTF 2.0 file (.glb, or .gltf with files in its folder and its subfolders), with materials, images, normal maps, opacity and vertex colours. The y axis of glTF becomes z. Skins are deformed by their joints, and morph targets are applied with the weights of their node or mesh; animations are ignored. The alpha of images and vertices is used in the modes MASK and BLEND. Images may use two sets of texture coordinates per material, with any transforms. Materials with KHR_materials_transmission become "thin_glass" if they have no volume; those with a KHR_materials_volume are ignored, because meshes have no interior, and `phasetree import` makes them phases. Other supported extensions: KHR_texture_transform, KHR_mesh_quantization, KHR_node_visibility, EXT_mesh_gpu_instancing, KHR_materials_ior and KHR_materials_emissive_strength. KHR_draco_mesh_compression and EXT_meshopt_compression are supported if phasetree was built with their libraries. A file that requires another extension is rejected if the picture would be affected; otherwise a warning lists what is missing. Limits: 20 million triangles, counted once per instance; 2,000 materials; images in PNG or JPEG of at most 4096 × 4096 pixels each and 256 million in total; 1 GiB per file.

        file: The file. (name of a file)
        material: Material for the whole mesh, including clear parts and holes, instead of the materials in the file. (opaque material; default none)
        scale: Scale factor. (number; positive; default 1)
        rotate_z: Rotation about the z axis, anticlockwise as seen from above. (number in degrees; default 0)
        translate: Translation: the image of the origin. ([x, y, z] in m; default [0, 0, 0])
        imported: Set by `phasetree import`: this scene has the file's clear materials as phases and its lights in "lights", so no warning reports that the mesh ignores them. (true or false; default false)
        panes: With "imported": whether clear materials without a volume are not phases, but "thin_glass" in this mesh. (true or false; default false)
        """
    @staticmethod
    def floor(material: Material, height: float | None = ..., size: float | None = ..., opacity: float | Number | None = ..., opacity_cutoff: float | None = ...) -> Mesh:
        r"""A horizontal square about the z axis.

        material: Material of the mesh. (opaque material)
        height: Height of the floor: its z coordinate. (number in m; at least -1e15 and at most 1e15; default 0)
        size: Length of the edges. (number in m; more than 0 and at most 1e15; default 1000)
        opacity: Opacity: 0 is a hole, 1 is opaque. For values in between, the rest of the light passes straight through, as through a fine net. (number or field; at least 0 and at most 1; default none)
        opacity_cutoff: With an opacity: values below this are holes and all others opaque, so edges are sharp. (number; at least 0 and at most 1; default none)
        """
    @staticmethod
    def backdrop(material: Material, height: float | None = ..., distance: float | None = ..., radius: float | None = ..., width: float | None = ..., front: float | None = ..., wall: float | None = ..., opacity: float | Number | None = ..., opacity_cutoff: float | None = ...) -> Mesh:
        r"""A photographer's sweep: a floor that curves smoothly up into a back wall.

        material: Material of the mesh. (opaque material)
        height: z of the floor. (number in m; at least -1e15 and at most 1e15; default 0)
        distance: y of the wall. (number in m; more than 0 and at most 1e15; default 5)
        radius: Radius of the curve between floor and wall. (number in m; more than 0 and at most 1e15; default 2)
        width: Length along x. (number in m; more than 0 and at most 1e15; default 100)
        front: The floor begins at y = −front. (number in m; more than 0 and at most 1e15; default 50)
        wall: Height of the straight part of the wall, which begins `radius` above the floor. (number in m; more than 0 and at most 1e15; default 50)
        opacity: Opacity: 0 is a hole, 1 is opaque. For values in between, the rest of the light passes straight through, as through a fine net. (number or field; at least 0 and at most 1; default none)
        opacity_cutoff: With an opacity: values below this are holes and all others opaque, so edges are sharp. (number; at least 0 and at most 1; default none)
        """

class cameras:
    @staticmethod
    def thin_lens(position: Sequence[float] | np.ndarray, look_at: Sequence[float] | np.ndarray, up: Sequence[float] | np.ndarray | None = ..., turn: float | None = ..., filter: Literal["blackman_harris", "box"] | None = ..., fov: float | None = ..., lens_radius: float | None = ..., blades: int | None = ..., blade_rotation: float | None = ..., focus_distance: float | None = ..., focus_at: Sequence[float] | np.ndarray | None = ...) -> Camera:
        r"""A thin lens with a plane of focus, or a pinhole if its radius is 0. This is the default kind, whose name may be omitted.

        position: Position of the camera. ([x, y, z] in m; at least -1e15 and at most 1e15)
        look_at: Point at the centre of the image. ([x, y, z] in m; at least -1e15 and at most 1e15)
        up: Direction that points up in the image. If the camera looks along it, +y is used instead, or +x if it looks along +y. ([x, y, z]; default [0, 0, 1])
        turn: Rotates the camera's position about the axis through `look_at` in the direction `up`; positive angles move the camera to its right. Animate it for a turntable. (number in degrees; default 0)
        filter: Distribution of samples around the centre of a pixel. (`"blackman_harris"`, `"box"`; default "blackman_harris")
        fov: Vertical field of view. (number in degrees; more than 0 and less than 180; default 40)
        lens_radius: Radius of the lens, which blurs objects that are out of focus. (number in m; at least 0 and at most 1e15; default 0)
        blades: Number of aperture blades, and of corners of the aperture: 3 or more; 0 for a circular aperture. (whole number; at least 0 and at most 64; default 0)
        blade_rotation: Rotation of the aperture; at 0 a corner points right. (number in degrees; default 0)
        focus_distance: Distance of the plane of focus; by default that of look_at. (number in m; positive; default none)
        focus_at: Instead of the distance: a point on the plane of focus. ([x, y, z] in m; at least -1e15 and at most 1e15; default none)
        """
    @staticmethod
    def orthographic(position: Sequence[float] | np.ndarray, look_at: Sequence[float] | np.ndarray, height: float, up: Sequence[float] | np.ndarray | None = ..., turn: float | None = ..., filter: Literal["blackman_harris", "box"] | None = ...) -> Camera:
        r"""An orthographic camera: all rays are parallel, so objects have the same size at any distance.

        position: Position of the camera. ([x, y, z] in m; at least -1e15 and at most 1e15)
        look_at: Point at the centre of the image. ([x, y, z] in m; at least -1e15 and at most 1e15)
        height: Height of the visible area. (number in m; more than 0 and at most 1e10)
        up: Direction that points up in the image. If the camera looks along it, +y is used instead, or +x if it looks along +y. ([x, y, z]; default [0, 0, 1])
        turn: Rotates the camera's position about the axis through `look_at` in the direction `up`; positive angles move the camera to its right. Animate it for a turntable. (number in degrees; default 0)
        filter: Distribution of samples around the centre of a pixel. (`"blackman_harris"`, `"box"`; default "blackman_harris")
        """
    @staticmethod
    def tilt_shift(position: Sequence[float] | np.ndarray, look_at: Sequence[float] | np.ndarray, up: Sequence[float] | np.ndarray | None = ..., turn: float | None = ..., filter: Literal["blackman_harris", "box"] | None = ..., fov: float | None = ..., lens_radius: float | None = ..., blades: int | None = ..., blade_rotation: float | None = ..., focus_distance: float | None = ..., focus_at: Sequence[float] | np.ndarray | None = ..., shift: Sequence[float] | np.ndarray | None = ..., tilt: Sequence[float] | np.ndarray | None = ...) -> Camera:
        r"""A lens that can be shifted, so that verticals stay parallel, and whose plane of focus can be tilted.

        position: Position of the camera. ([x, y, z] in m; at least -1e15 and at most 1e15)
        look_at: Point at the centre of the image. ([x, y, z] in m; at least -1e15 and at most 1e15)
        up: Direction that points up in the image. If the camera looks along it, +y is used instead, or +x if it looks along +y. ([x, y, z]; default [0, 0, 1])
        turn: Rotates the camera's position about the axis through `look_at` in the direction `up`; positive angles move the camera to its right. Animate it for a turntable. (number in degrees; default 0)
        filter: Distribution of samples around the centre of a pixel. (`"blackman_harris"`, `"box"`; default "blackman_harris")
        fov: Vertical field of view. (number in degrees; more than 0 and less than 180; default 40)
        lens_radius: Radius of the lens, which blurs objects that are out of focus. (number in m; at least 0 and at most 1e15; default 0)
        blades: Number of aperture blades, and of corners of the aperture: 3 or more; 0 for a circular aperture. (whole number; at least 0 and at most 64; default 0)
        blade_rotation: Rotation of the aperture; at 0 a corner points right. (number in degrees; default 0)
        focus_distance: Distance of the plane of focus; by default that of look_at. (number in m; positive; default none)
        focus_at: Instead of the distance: a point on the plane of focus. ([x, y, z] in m; at least -1e15 and at most 1e15; default none)
        shift: Shift of the view to the right and up, in heights of the image: with [0, 0.5] the lower edge is where the centre was. ([x, y]; at least -100 and at most 100; default [0, 0])
        tilt: Tilt of the plane of focus: the angles by which its top and its right side turn away from the camera. ([x, y] in degrees; more than -90 and less than 90; default [0, 0])
        """
    @staticmethod
    def panorama(position: Sequence[float] | np.ndarray, look_at: Sequence[float] | np.ndarray, up: Sequence[float] | np.ndarray | None = ..., turn: float | None = ..., filter: Literal["blackman_harris", "box"] | None = ...) -> Camera:
        r"""A panorama of all directions in latitude-longitude format. The image should be twice as wide as high.

        position: Position of the camera. ([x, y, z] in m; at least -1e15 and at most 1e15)
        look_at: Point at the centre of the image. ([x, y, z] in m; at least -1e15 and at most 1e15)
        up: Direction that points up in the image. If the camera looks along it, +y is used instead, or +x if it looks along +y. ([x, y, z]; default [0, 0, 1])
        turn: Rotates the camera's position about the axis through `look_at` in the direction `up`; positive angles move the camera to its right. Animate it for a turntable. (number in degrees; default 0)
        filter: Distribution of samples around the centre of a pixel. (`"blackman_harris"`, `"box"`; default "blackman_harris")
        """
    @staticmethod
    def dome(position: Sequence[float] | np.ndarray, look_at: Sequence[float] | np.ndarray, up: Sequence[float] | np.ndarray | None = ..., turn: float | None = ..., filter: Literal["blackman_harris", "box"] | None = ..., fov: float | None = ...) -> Camera:
        r"""An equidistant fisheye for domes: the angle from the centre is proportional to the radius, and the largest circle in the image has the field of view.

        position: Position of the camera. ([x, y, z] in m; at least -1e15 and at most 1e15)
        look_at: Point at the centre of the image. ([x, y, z] in m; at least -1e15 and at most 1e15)
        up: Direction that points up in the image. If the camera looks along it, +y is used instead, or +x if it looks along +y. ([x, y, z]; default [0, 0, 1])
        turn: Rotates the camera's position about the axis through `look_at` in the direction `up`; positive angles move the camera to its right. Animate it for a turntable. (number in degrees; default 0)
        filter: Distribution of samples around the centre of a pixel. (`"blackman_harris"`, `"box"`; default "blackman_harris")
        fov: Angle across the whole circle. (number in degrees; more than 0 and at most 360; default 180)
        """

def camera(position: Sequence[float] | np.ndarray, look_at: Sequence[float] | np.ndarray, up: Sequence[float] | np.ndarray | None = ..., turn: float | None = ..., filter: Literal["blackman_harris", "box"] | None = ..., fov: float | None = ..., lens_radius: float | None = ..., blades: int | None = ..., blade_rotation: float | None = ..., focus_distance: float | None = ..., focus_at: Sequence[float] | np.ndarray | None = ...) -> Camera:
    r"""A thin lens with a plane of focus, or a pinhole if its radius is 0. This is the default kind, whose name may be omitted.

    position: Position of the camera. ([x, y, z] in m; at least -1e15 and at most 1e15)
    look_at: Point at the centre of the image. ([x, y, z] in m; at least -1e15 and at most 1e15)
    up: Direction that points up in the image. If the camera looks along it, +y is used instead, or +x if it looks along +y. ([x, y, z]; default [0, 0, 1])
    turn: Rotates the camera's position about the axis through `look_at` in the direction `up`; positive angles move the camera to its right. Animate it for a turntable. (number in degrees; default 0)
    filter: Distribution of samples around the centre of a pixel. (`"blackman_harris"`, `"box"`; default "blackman_harris")
    fov: Vertical field of view. (number in degrees; more than 0 and less than 180; default 40)
    lens_radius: Radius of the lens, which blurs objects that are out of focus. (number in m; at least 0 and at most 1e15; default 0)
    blades: Number of aperture blades, and of corners of the aperture: 3 or more; 0 for a circular aperture. (whole number; at least 0 and at most 64; default 0)
    blade_rotation: Rotation of the aperture; at 0 a corner points right. (number in degrees; default 0)
    focus_distance: Distance of the plane of focus; by default that of look_at. (number in m; positive; default none)
    focus_at: Instead of the distance: a point on the plane of focus. ([x, y, z] in m; at least -1e15 and at most 1e15; default none)
    """

def image(width: int | None = ..., height: int | None = ..., frames_per_second: float | None = ..., shutter: Sequence[float] | np.ndarray | None = ..., samples: int | None = ..., noise: float | None = ..., seed: int | None = ..., max_depth: int | None = ..., spectral: bool | None = ..., guiding: bool | None = ..., caustics: bool | None = ..., photons: float | None = ..., photon_radius: float | None = ..., exposure: float | None = ..., view: str | None = ...) -> ImageSettings:
    r"""Size of the image and settings of the renderer.

    width: Width of the image. (whole number in pixels; at least 1 and at most 32768; default 1024)
    height: Height of the image. (whole number in pixels; at least 1 and at most 32768; default 768)
    frames_per_second: Frame rate of an animation: frame n, counted from 0, shows the time n / frames_per_second. (number in 1/s; at least 0.001 and at most 100000; default 24)
    shutter: Times at which the shutter opens and closes, relative to the time of the picture. Motion in between is blurred: transforms of objects and instances, the placements of meshes, and the camera. ([x, y] in s; at least -1000000 and at most 1000000; default [0, 0])
    samples: Samples per pixel. (whole number; at least 1 and at most 16777216; default 64)
    noise: Noise limit: blocks of 8×8 pixels stop early, after at least 32 samples per pixel, once their estimated relative error is at most this; 0 turns this off. (number; at least 0 and at most 1; default 0)
    seed: Seed of the random numbers; a different seed gives different noise. (whole number; zero or more; default 0)
    max_depth: Maximum number of interactions per path: surfaces, including interfaces between equal refractive indices, and scattering events in media. (whole number; at least 1 and at most 1048576; default 65536)
    spectral: Whether to render with wavelengths, three per path, instead of red, green and blue. Metals, films on smooth surfaces, absorption and light then have their values at each wavelength; colours are replaced by spectra that look the same. (true or false; default false)
    guiding: Path guiding: whether to learn, before the first sample, where light comes from, and to send half of the paths from diffuse surfaces there. It pays off where most light is indirect, as in a room lit through the door of the next one. (true or false; default false)
    caustics: Whether to use photons for caustics: light from lamps, glowing surfaces, the sun and bright parts of environment maps that reaches surfaces and scattering media through clear materials or by reflection from metal. Photons blur caustics by a pixel or two, less with more samples. (true or false; default false)
    photons: For caustics: photons per pixel and sample. (number; at least 0 and at most 64; default 1)
    photon_radius: For caustics: radius within which photons count for a point, in the first pass. (number in pixels; at least 0.01 and at most 100; default 2)
    exposure: Exposure of display images; one stop more is twice as bright. (number in EV; at least -50 and at most 50; default 0)
    view: OpenColorIO view of display images; by default that of the configuration. (text; default none)
    """

