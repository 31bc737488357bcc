#pragma once

#include <array>
#include <concepts>
#include <optional>

#include "phasetree/math/vec3.hpp"

namespace phasetree {

namespace enclosure {
struct Enclosure;
}

/// How the values of a long primitive are enclosed in a box, that is, bounded from below and above at all of its
/// points.
enum class EnclosedBy : unsigned char {
    value_at_centre,  ///< its value at the centre of the box, and its Lipschitz bound of 1
    equation,         ///< interval arithmetic, with distance() over the number type Enclosure
};

/// A primitive with a function of its own that encloses its values in a box. `data` are the floats of the primitive, q
/// is an enclosure of the point at which it is evaluated, and `half` are the box's half extents. If the function
/// returns nullopt, the value at the centre is used. It is usually defined in src/bounding/NAME_in_box.cpp.
template <class N>
concept EnclosesItself = requires(const float* data, const Vec3<enclosure::Enclosure>& q,
                                  const std::array<double, 3>& half) {
    { N::enclosed(data, q, half) } -> std::same_as<std::optional<enclosure::Enclosure>>;
};

/// A type that states how a primitive is enclosed.
template <class N>
concept StatesEnclosing = EnclosesItself<N> || requires {
    { N::enclosed_by } -> std::convertible_to<EnclosedBy>;
};

/// The type whose members state how the long primitive P is enclosed (StatesEnclosing): P itself, unless this template
/// is specialised. A local primitive is enclosed as P::Specialised is.
template <class P>
struct EnclosingOf {
    using Stated = P;
};

}  // namespace phasetree
