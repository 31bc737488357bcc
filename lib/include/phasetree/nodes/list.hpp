// The list of all nodes. To add a node, write its file, #include it here and add it to a list below. The evaluators,
// the program, the scene format, the node reference and the tests over all nodes are derived from these lists. A node
// with operands has a template evaluate(domain, p), or components of it; model/concepts.hpp says what a domain is.
#pragma once

#include <variant>

#include "phasetree/nodes/copies/endless_grid.hpp"
#include "phasetree/nodes/copies/fibonacci_disk.hpp"
#include "phasetree/nodes/copies/fibonacci_sphere.hpp"
#include "phasetree/nodes/copies/grid.hpp"
#include "phasetree/nodes/copies/instances.hpp"
#include "phasetree/nodes/copies/polar_array.hpp"
#include "phasetree/nodes/copies/scatter.hpp"
#include "phasetree/nodes/fields/balls.hpp"
#include "phasetree/nodes/fields/blob.hpp"
#include "phasetree/nodes/fields/bowl.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/box_frame.hpp"
#include "phasetree/nodes/fields/capped_cone.hpp"
#include "phasetree/nodes/fields/capped_torus.hpp"
#include "phasetree/nodes/fields/capsule.hpp"
#include "phasetree/nodes/fields/cylinder.hpp"
#include "phasetree/nodes/fields/difference.hpp"
#include "phasetree/nodes/fields/displace.hpp"
#include "phasetree/nodes/fields/dodecahedron.hpp"
#include "phasetree/nodes/fields/ellipsoid.hpp"
#include "phasetree/nodes/fields/formula.hpp"
#include "phasetree/nodes/fields/gyroid.hpp"
#include "phasetree/nodes/fields/height_map.hpp"
#include "phasetree/nodes/fields/heightfield.hpp"
#include "phasetree/nodes/fields/helix.hpp"
#include "phasetree/nodes/fields/icosahedron.hpp"
#include "phasetree/nodes/fields/intersection.hpp"
#include "phasetree/nodes/fields/link.hpp"
#include "phasetree/nodes/fields/merge.hpp"
#include "phasetree/nodes/fields/mesh.hpp"
#include "phasetree/nodes/fields/mesh_traits.hpp"
#include "phasetree/nodes/fields/octahedron.hpp"
#include "phasetree/nodes/fields/offset.hpp"
#include "phasetree/nodes/fields/plane.hpp"
#include "phasetree/nodes/fields/polyhedron.hpp"
#include "phasetree/nodes/fields/polyline.hpp"
#include "phasetree/nodes/fields/prism.hpp"
#include "phasetree/nodes/fields/pyramid.hpp"
#include "phasetree/nodes/fields/round_cone.hpp"
#include "phasetree/nodes/fields/rounded_box.hpp"
#include "phasetree/nodes/fields/rounded_cylinder.hpp"
#include "phasetree/nodes/fields/schwarz_d.hpp"
#include "phasetree/nodes/fields/schwarz_p.hpp"
#include "phasetree/nodes/fields/shell.hpp"
#include "phasetree/nodes/fields/siren.hpp"
#include "phasetree/nodes/fields/slab.hpp"
#include "phasetree/nodes/fields/smooth_difference.hpp"
#include "phasetree/nodes/fields/smooth_intersection.hpp"
#include "phasetree/nodes/fields/smooth_union.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/fields/spherical_cap.hpp"
#include "phasetree/nodes/fields/tetrahedron.hpp"
#include "phasetree/nodes/fields/torus.hpp"
#include "phasetree/nodes/fields/tube.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/fields/volume.hpp"
#include "phasetree/nodes/fields/voronoi_cells.hpp"
#include "phasetree/nodes/fields/wedge.hpp"
#include "phasetree/nodes/phased/change.hpp"
#include "phasetree/nodes/phased/checker.hpp"
#include "phasetree/nodes/phased/close_gaps.hpp"
#include "phasetree/nodes/phased/contact.hpp"
#include "phasetree/nodes/phased/contacts.hpp"
#include "phasetree/nodes/phased/interface.hpp"
#include "phasetree/nodes/phased/interfaces.hpp"
#include "phasetree/nodes/phased/intersect_shape.hpp"
#include "phasetree/nodes/phased/labels.hpp"
#include "phasetree/nodes/phased/layered.hpp"
#include "phasetree/nodes/phased/layered_sequence.hpp"
#include "phasetree/nodes/phased/layers.hpp"
#include "phasetree/nodes/phased/over.hpp"
#include "phasetree/nodes/phased/particles.hpp"
#include "phasetree/nodes/phased/remove.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/smooth_intersect_shape.hpp"
#include "phasetree/nodes/phased/smooth_layered.hpp"
#include "phasetree/nodes/phased/smooth_subtract_shape.hpp"
#include "phasetree/nodes/phased/smooth_unite_shape.hpp"
#include "phasetree/nodes/phased/smooth_unite_shape_below.hpp"
#include "phasetree/nodes/phased/strata.hpp"
#include "phasetree/nodes/phased/subtract_shape.hpp"
#include "phasetree/nodes/phased/thin_shell.hpp"
#include "phasetree/nodes/phased/under.hpp"
#include "phasetree/nodes/phased/unite_shape_below.hpp"
#include "phasetree/nodes/phased/voronoi.hpp"
#include "phasetree/nodes/profiles/bezier.hpp"
#include "phasetree/nodes/profiles/circle.hpp"
#include "phasetree/nodes/profiles/extrude.hpp"
#include "phasetree/nodes/profiles/polygon.hpp"
#include "phasetree/nodes/profiles/rectangle.hpp"
#include "phasetree/nodes/profiles/revolve.hpp"
#include "phasetree/nodes/profiles/star.hpp"
#include "phasetree/nodes/profiles/text.hpp"
#include "phasetree/nodes/proxies/bounding_volume.hpp"
#include "phasetree/nodes/proxies/level_of_detail.hpp"
#include "phasetree/nodes/proxies/proxy.hpp"
#include "phasetree/nodes/warps/affine.hpp"
#include "phasetree/nodes/warps/bend.hpp"
#include "phasetree/nodes/warps/distort.hpp"
#include "phasetree/nodes/warps/mirror.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/scale.hpp"
#include "phasetree/nodes/warps/stretch.hpp"
#include "phasetree/nodes/warps/taper.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/twist.hpp"

namespace phasetree {

using Warps = TypeList<Translate, Rotate, Scale, Twist, Stretch, Mirror, Taper, Bend, Affine, Distort>;

using PlainFields =
    TypeList<Sphere, Box, RoundedBox, Cylinder, CappedCone, Capsule, Torus, Plane, Union, Intersection, Difference,
             SmoothUnion, SmoothIntersection, SmoothDifference, Offset, Shell, Merge, Ellipsoid, CappedTorus, Link,
             Tube, RoundedCylinder, RoundCone, SphericalCap, Prism, Wedge, Pyramid, Octahedron, Tetrahedron, Gyroid,
             SchwarzP, SchwarzD, Displace, FieldInstances, FieldPolarArray, FieldGrid, Polyline, FieldEndlessGrid, Blob,
             VoronoiCells, Siren, HeightMap, Mesh, Volume, FieldFibonacciDisk, FieldFibonacciSphere, FieldScatter,
             Extrude, Revolve, Circle, Rectangle, Star, Slab, BoxFrame, Bowl, Dodecahedron, Icosahedron, Helix,
             Heightfield, Polygon, Bezier, Text, Formula, Polyhedron, Balls, FieldBoundingVolume, FieldProxy,
             FieldLevelOfDetail>;

using Objects =
    TypeList<Set, ThinShell, Under, Over, Layered, IntersectShape, SubtractShape, Change, Remove, Contact, Contacts,
             CloseGaps, LayeredSequence, SmoothLayered, UniteShapeBelow, SmoothUniteShape, SmoothUniteShapeBelow,
             SmoothIntersectShape, SmoothSubtractShape, Interface, Interfaces, Checker, Layers, Strata, PhasedInstances,
             PhasedPolarArray, PhasedGrid, PhasedEndlessGrid, Voronoi, Labels, PhasedFibonacciDisk,
             PhasedFibonacciSphere, PhasedScatter, Particles, PhasedBoundingVolume, PhasedProxy, PhasedLevelOfDetail>;

// Everything below is derived.

namespace detail {
template <class... Lists>
struct Concat;
template <class... As>
struct Concat<TypeList<As...>> {
    using type = TypeList<As...>;
};
template <class... As, class... Bs, class... Rest>
struct Concat<TypeList<As...>, TypeList<Bs...>, Rest...> : Concat<TypeList<As..., Bs...>, Rest...> {};

template <template <class> class Wrap, class List>
struct Map;
template <template <class> class Wrap, class... Ts>
struct Map<Wrap, TypeList<Ts...>> {
    using type = TypeList<Wrap<Ts>...>;
};

template <class List>
struct OnlyPrimitives;
template <class... Ts>
struct OnlyPrimitives<TypeList<Ts...>>
    : Concat<TypeList<>, std::conditional_t<Primitive<Ts>, TypeList<Ts>, TypeList<>>...> {};

template <class List>
struct OnlyDataPrimitives;
template <class... Ts>
struct OnlyDataPrimitives<TypeList<Ts...>>
    : Concat<TypeList<>, std::conditional_t<DataPrimitive<Ts>, TypeList<Ts>, TypeList<>>...> {};

template <class List>
struct OnlyPointMaps;
template <class... Ts>
struct OnlyPointMaps<TypeList<Ts...>>
    : Concat<TypeList<>, std::conditional_t<PointMap<Ts>, TypeList<Ts>, TypeList<>>...> {};

/// The additional instructions that a node defines: `using Parts = TypeList<…>` of primitives and maps of space.
template <class N>
struct PartsOf {
    using type = TypeList<>;
};
template <class N>
requires requires {
    typename N::Parts;
}
struct PartsOf<N> {
    using type = typename N::Parts;
};
template <class List>
struct AllParts;
template <class... Ts>
struct AllParts<TypeList<Ts...>> : Concat<TypeList<>, typename PartsOf<Ts>::type...> {};

template <class List>
struct Variant;
template <class... Ts>
struct Variant<TypeList<Ts...>> {
    using type = std::variant<Ts...>;
};

template <class W>
using MapOf = typename W::Map;
}  // namespace detail

using FieldNodes = detail::Concat<PlainFields, detail::Map<WarpedField, Warps>::type>::type;
using PhasedNodes = detail::Concat<Objects, detail::Map<WarpedPhased, Warps>::type>::type;

/// The primitives; each is one instruction of the program. They include a local warp's bound, the noise of
/// displacements, and the nodes' parts.
using Primitives = detail::Concat<TypeList<BoundingBox, FractalNoise>, detail::OnlyPrimitives<PlainFields>::type,
                                  detail::OnlyPrimitives<detail::AllParts<FieldNodes>::type>::type,
                                  detail::OnlyPrimitives<detail::AllParts<PhasedNodes>::type>::type>::type;
/// Primitives with data of their own; each is one instruction.
using DataPrimitives = detail::Concat<detail::OnlyDataPrimitives<PlainFields>::type,
                                      detail::OnlyDataPrimitives<detail::AllParts<FieldNodes>::type>::type,
                                      detail::OnlyDataPrimitives<detail::AllParts<PhasedNodes>::type>::type>::type;
/// The maps of space; each is one instruction.
using PointMaps = detail::Concat<TypeList<ClampToBox>, detail::Map<detail::MapOf, Warps>::type,
                                 detail::OnlyPointMaps<detail::AllParts<FieldNodes>::type>::type,
                                 detail::OnlyPointMaps<detail::AllParts<PhasedNodes>::type>::type>::type;

/// Call f.template operator()<T>() for each type of a list.
template <class... Ts, class F>
void for_each_type(TypeList<Ts...>, F&& f) {
    (f.template operator()<Ts>(), ...);
}

template <class T, class... Ts>
constexpr std::size_t index_in(TypeList<Ts...>) {
    std::size_t i = 0;
    (void)((std::is_same_v<T, Ts> ? true : (++i, false)) || ...);
    return i;
}

}  // namespace phasetree
