#pragma once

#include <array>
#include <concepts>
#include <optional>

#include "phasetree/math/vec3.hpp"

namespace phasetree {

namespace enclosure {
struct Enclosure;
}

/// How a long primitive is enclosed in a box.
enum class EnclosedBy : unsigned char {
    value_at_centre,  ///< its value at the centre of the box, and its Lipschitz bound of 1
    equation,         ///< interval arithmetic, with distance() over the number type Enclosure
};

/// A primitive with a function of its own that encloses it, given its data, its point q as a function of the points of
/// a box, and half the box's extents. Without a result, its value at the centre is used. The function is usually
/// defined in src/bounding/NAME_in_box.cpp.
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

/// The type that states how the long primitive P is enclosed: P itself, unless this is specialised. A local primitive
/// is enclosed as P::Specialised is.
template <class P>
struct EnclosingOf {
    using Stated = P;
};

}  // namespace phasetree
