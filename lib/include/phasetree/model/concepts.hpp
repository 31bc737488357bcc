#pragma once

#include <concepts>
#include <span>
#include <type_traits>
#include <vector>

#include "phasetree/math/affine_map.hpp"
#include "phasetree/math/point_range.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree {

/// A list of types, the form in which the nodes are enumerated.
template <class... Ts>
struct TypeList {
    static constexpr std::size_t size = sizeof...(Ts);
};

/// A primitive is a plain struct of floats with a distance template; the program evaluates it as one instruction.
template <class N>
concept Primitive = std::is_trivially_copyable_v<N> && requires(const N& n, const Vec3<float>& p) {
    { n.distance(p) } -> std::same_as<float>;
};

/// A primitive with as many floats as it needs (a polygon's corners, a network's weights): one instruction too. A
/// node's static distance() sees only what data() gave.
template <class N>
concept DataPrimitive = requires(const N& n, const float* data, const Vec3<float>& p) {
    { n.data() } -> std::same_as<std::span<const float>>;
    { N::distance(data, p) } -> std::same_as<float>;
};

/// A primitive whose equation is long, so that its slope is used where that is enough and it counts for many.
template <class N>
concept LongPrimitive = DataPrimitive<N> || requires {
    N::is_long;
};

/// A primitive whose features are of about this size: in larger boxes little can be known of it.
template <class N>
concept PatternPrimitive = requires(const N& n) {
    { n.period() } -> std::same_as<float>;
};

/// A long primitive of which little matters in a small box: near() appends what P::Specialised, a primitive with data,
/// wants to give the same values there to the last bit; false, and nothing appended, if that would be no gain. `of` is
/// empty, or what it gave for a box around this one.
template <class N>
concept LocalPrimitive = PatternPrimitive<N> &&
    requires(const N& n, const PointRange& range, std::span<const float> of, std::vector<float>& floats) {
    requires DataPrimitive<typename N::Specialised>;
    { n.specialise(range, of, floats) } -> std::same_as<bool>;
    { N::Specialised::floats(floats.data()) } -> std::same_as<std::size_t>;  // how many they are
    {
        N::Specialised::half_works(floats.data())
        } -> std::same_as<unsigned>;  // how much work, in halves of a simple one
};

/// A primitive whose distance is a convex function: that to a convex solid, if it is exact inside and out.
template <class N>
concept ConvexPrimitive = requires {
    N::is_convex;
};

/// A convex solid, its distance exact inside and out, which is rounded: in its surface lies a ball of this radius at
/// least wherever a point within `reach` of p is nearest to it. An infinite ball lies in a half-space.
template <class N>
concept RoundedPrimitive = ConvexPrimitive<N> && requires(const N& n, const glm::dvec3& p, double reach) {
    { n.rolling_radius(p, reach) } -> std::same_as<double>;
};

/// A map of space: a plain struct of floats, p ↦ ω⁻¹(p), one instruction.
template <class M>
concept PointMap = std::is_trivially_copyable_v<M> && requires(const M& m, const Vec3<float>& p) {
    { m(p) } -> std::same_as<Vec3<float>>;
};

/// One that is affine, and equal to affine() to the last bit: such are composed with what follows.
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
