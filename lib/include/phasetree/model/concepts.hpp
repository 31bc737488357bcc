#pragma once

#include <concepts>
#include <span>
#include <type_traits>
#include <vector>

#include "phasetree/math/affine_map.hpp"
#include "phasetree/math/point_range.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree {

/// A list of types. The nodes are enumerated in this form.
template <class... Ts>
struct TypeList {
    static constexpr std::size_t size = sizeof...(Ts);
};

/// A primitive is a plain struct of floats with a distance template; the program evaluates it as one instruction.
template <class N>
concept Primitive = std::is_trivially_copyable_v<N> && requires(const N& n, const Vec3<float>& p) {
    { n.distance(p) } -> std::same_as<float>;
};

/// A primitive with as many floats as it needs (a polygon's corners, a network's weights). It is one instruction too,
/// and its static distance() sees only the floats that data() gave.
template <class N>
concept DataPrimitive = requires(const N& n, const float* data, const Vec3<float>& p) {
    { n.data() } -> std::same_as<std::span<const float>>;
    { N::distance(data, p) } -> std::same_as<float>;
};

/// A primitive whose equation is long. It counts for many instructions, and where its slope is enough to bound it in a
/// box its equation is not enclosed.
template <class N>
concept LongPrimitive = DataPrimitive<N> || requires {
    N::is_long;
};

/// A primitive whose features are about as large as period(), a length in the primitive's own space. In larger boxes
/// little can be known of its values.
template <class N>
concept PatternPrimitive = requires(const N& n) {
    { n.period() } -> std::same_as<float>;
};

/// A primitive whose data may come from a file of cells, which can be forged: is_sound() says whether these floats are
/// complete data of this primitive, so that evaluating it reads no further. The floats may go on behind the data.
template <class N>
concept CheckedData = DataPrimitive<N> && requires(std::span<const float> floats) {
    { N::is_sound(floats) } -> std::same_as<bool>;
};

/// A long primitive of which little matters in a small box. There N::Specialised, a primitive with data, gives the same
/// values to the last bit: specialise() appends its floats for the points of `range`, or appends nothing and returns
/// false if that would be no gain. `of` is empty, or holds the floats that it gave for a box around this one.
template <class N>
concept LocalPrimitive = PatternPrimitive<N> &&
    requires(const N& n, const PointRange& range, std::span<const float> of, std::vector<float>& floats) {
    requires CheckedData<typename N::Specialised>;
    { n.specialise(range, of, floats) } -> std::same_as<bool>;
    { N::Specialised::floats(floats.data()) } -> std::same_as<std::size_t>;  // the number of floats
    // The cost, in halves of that of a simple instruction.
    { N::Specialised::half_instructions(floats.data()) } -> std::same_as<unsigned>;
};

/// A primitive whose distance is a convex function, as that to a convex solid is if it is exact inside and outside.
template <class N>
concept ConvexPrimitive = requires {
    N::is_convex;
};

/// A convex solid with rounded edges whose distance is exact inside and outside. At every point of its surface that is
/// nearest to some point within `reach` of p, a ball of at least rolling_radius(p, reach) touches the surface from
/// inside; the radius is infinite for a half-space.
template <class N>
concept RoundedPrimitive = ConvexPrimitive<N> && requires(const N& n, const glm::dvec3& p, double reach) {
    { n.rolling_radius(p, reach) } -> std::same_as<double>;
};

/// A map of space: a plain struct of floats, p ↦ ω⁻¹(p), one instruction.
template <class M>
concept PointMap = std::is_trivially_copyable_v<M> && requires(const M& m, const Vec3<float>& p) {
    { m(p) } -> std::same_as<Vec3<float>>;
};

/// A map that is affine, and equal to affine() to the last bit, so that it can be composed with what follows it.
template <class M>
concept AffinePointMap = PointMap<M> && requires(const M& m) {
    { m.affine() } -> std::same_as<AffineMap>;
};

/// Calls `n.prepare()` if the node has something to derive from its parameters.
template <class N>
void prepare(N& n) {
    if constexpr (requires { n.prepare(); }) n.prepare();
}

}  // namespace phasetree
