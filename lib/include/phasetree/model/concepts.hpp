#pragma once

#include <concepts>
#include <span>
#include <type_traits>
#include <vector>

#include "phasetree/math/affine_map.hpp"
#include "phasetree/math/point_range.hpp"
#include "phasetree/model/enclosing.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree {

// An operator is a node with operands. It has a template evaluate(domain, p), or components of it. The domain defines
// what evaluating means: computing values, recording instructions, or finding the primitive that a value comes from.
// src/tree/domain.hpp lists its functions (field, phases, primitive, map, one_lipschitz).

/// A list of types. The nodes are enumerated in this form.
template <class... Ts>
struct TypeList {
    static constexpr std::size_t size = sizeof...(Ts);
};

/// A primitive: a plain struct of floats with a distance template. Programs evaluate it as one instruction.
template <class N>
concept Primitive = std::is_trivially_copyable_v<N> && requires(const N& n, const Vec3<float>& p) {
    { n.distance(p) } -> std::same_as<float>;
};

/// A primitive with any number of floats (a polygon's corners, a network's weights). It is one instruction too, and its
/// static distance() receives only the floats of data().
template <class N>
concept DataPrimitive = requires(const N& n, const float* data, const Vec3<float>& p) {
    { n.data() } -> std::same_as<std::span<const float>>;
    { N::distance(data, p) } -> std::same_as<float>;
};

/// A primitive that is expensive to evaluate. It must state its cost (StatesCost) and, unless it is local
/// (LocalPrimitive), how it is enclosed in a box (StatesEnclosing). Otherwise the library does not compile.
template <class N>
concept LongPrimitive = DataPrimitive<N> || requires {
    N::is_long;
};

/// A primitive that states what evaluating it for a batch of eight points costs. A simple instruction, such as an
/// addition, has the cost 2 in `half_instructions`. A rough estimate is enough.
template <class N>
concept HasConstantCost = requires {
    { N::half_instructions } -> std::convertible_to<unsigned>;
};
template <class N>
concept HasCostInData = requires(const float* data) {
    { N::half_instructions(data) } -> std::same_as<unsigned>;
};
template <class N>
concept StatesCost = HasConstantCost<N> || HasCostInData<N>;

/// A primitive whose features are about as large as period(), a length in the primitive's own space. In larger boxes
/// its values cannot be bounded well.
template <class N>
concept PatternPrimitive = requires(const N& n) {
    { n.period() } -> std::same_as<float>;
};

/// A primitive whose data may come from a cell file, which can be forged. is_sound() returns whether these floats
/// contain complete data of this primitive, so that evaluating it reads nothing beyond. More floats may follow the
/// data.
template <class N>
concept CheckedData = DataPrimitive<N> && requires(std::span<const float> floats) {
    { N::is_sound(floats) } -> std::same_as<bool>;
};

/// A long primitive that can be specialised to a small box. N::Specialised, a primitive with data, has the same values
/// there, to the last bit. specialise() appends its floats for the points of `range`; if there is nothing to gain, it
/// appends nothing and returns false. `of` holds the floats of an earlier specialisation, if the primitive was already
/// specialised to an enclosing box; otherwise it is empty.
template <class N>
concept LocalPrimitive = PatternPrimitive<N> &&
    requires(const N& n, const PointRange& range, std::span<const float> of, std::vector<float>& floats) {
    requires CheckedData<typename N::Specialised>;
    { n.specialise(range, of, floats) } -> std::same_as<bool>;
    { N::Specialised::floats(floats.data()) } -> std::same_as<std::size_t>;  // the number of floats
    // The cost in half instructions: 2 stands for one simple instruction.
    { N::Specialised::half_instructions(floats.data()) } -> std::same_as<unsigned>;
};

/// A primitive whose distance is a convex function. This holds for a convex solid whose distance is exact inside and
/// outside.
template <class N>
concept ConvexPrimitive = requires {
    N::is_convex;
};

/// A convex solid with rounded edges whose distance is exact inside and outside. Consider all points within `reach` of
/// p and, for each, the nearest point of the surface. rolling_radius(p, reach) is a lower bound on the radius of
/// curvature there: at each of these surface points, a ball of this radius inside the solid touches the surface. It is
/// infinite for a half-space.
template <class N>
concept RoundedPrimitive = ConvexPrimitive<N> && requires(const N& n, const glm::dvec3& p, double reach) {
    { n.rolling_radius(p, reach) } -> std::same_as<double>;
};

/// A map of space: a plain struct of floats that returns ω⁻¹(p) for a warp ω, the point at which the child is
/// evaluated. It is one instruction.
template <class M>
concept PointMap = std::is_trivially_copyable_v<M> && requires(const M& m, const Vec3<float>& p) {
    { m(p) } -> std::same_as<Vec3<float>>;
};

/// A map that repeats space, and therefore jumps. The number of jumps along an axis is unlimited.
template <class M>
concept FoldingMap = PointMap<M> && requires(const M& m, int axis, double low, double high) {
    { m.finest_spacing() } -> std::same_as<float>;  // the smallest distance between two jumps along an axis
    // Whether the map jumps between two values of a point's coordinate.
    { m.jumps_between(axis, low, high) } -> std::same_as<bool>;
};

/// An affine map that equals affine() to the last bit, so that it can be composed with the map that follows it.
template <class M>
concept AffinePointMap = PointMap<M> && requires(const M& m) {
    { m.affine() } -> std::same_as<AffineMap>;
};

/// Call `n.prepare()` if the node derives something from its parameters.
template <class N>
void prepare(N& n) {
    if constexpr (requires { n.prepare(); }) n.prepare();
}

}  // namespace phasetree
