// Where clear objects overlap, lie within each other, or leave a thin gap, found from points on their surfaces.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "gltf_import/solids.hpp"

namespace phasetree::tracer::gltf_import {

/// A gap between two surfaces that face each other, with nothing in it.
struct Gap {
    float least = 0, greatest = 0;  ///< its width
    std::size_t of = 0;             ///< the object on whose surface `share` is measured
    double share = 0;  ///< the fraction of that surface that borders the gap: the larger of the two objects' fractions
};

/// Two objects that overlap, or are separated by a gap of at most 2 % of the smaller one's size.
struct Contact {
    std::size_t first = 0, second = 0;  ///< in ascending order
    float depth = 0;                    ///< how deep a surface is within the other object; 0 if they do not overlap
    bool is_first_inside = false, is_second_inside = false;  ///< whether one lies in the other; never both
    std::optional<Gap> gap{};

    bool overlap() const { return depth > 0; }
};

/// The contacts of objects, sorted by their numbers. Examines up to 8192 points per pair, and fewer if there are many
/// pairs. Deterministic.
std::vector<Contact> contacts_of(const std::vector<Solid>& solids);

}  // namespace phasetree::tracer::gltf_import
