#pragma once

#include <initializer_list>
#include <string>

#include "phasetree/model/concepts.hpp"

/// What primitives share that are made from a plane profile.
namespace phasetree::detail {

/// Two signed distances a and b along orthogonal directions, each exact, give that of the intersection: for a profile
/// and the slab of an extrusion, or for the two sides of a rectangle.
template <class T>
T corner_distance(const T& a, const T& b) {
    const T zero(0.f);
    return length(max(a, zero), max(b, zero)) + min(max(a, b), zero);
}

/// Squares and reciprocals of such sizes stay far from the ends of the floats' range.
inline void require_usable(std::string_view node, std::initializer_list<float> sizes) {
    for (const float s : sizes)
        if (!(std::abs(s) >= 1e-9f && std::abs(s) <= 1e9f))
            throw ModelError(std::string(node) + ": its sizes must be between 1e-9 and 1e9 m");
}

}  // namespace phasetree::detail
