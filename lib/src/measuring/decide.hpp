#pragma once

#include <algorithm>
#include <optional>

#include "measuring/phase_octree.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/measuring/prove.hpp"

namespace phasetree::measuring {

/// The numbers of levels of the first and of the finest octree in which statements are decided.
inline constexpr int first_levels = 5;
inline int last_levels(const TraceableObject& object, const ProveOptions& options) {
    constexpr double boxes_along_longest_side = 256;
    const glm::dvec3 extent(object.bounds.extent());
    const double longest = std::max({extent.x, extent.y, extent.z});
    return levels_for(object, options.resolution > 0 ? options.resolution : longest / boxes_along_longest_side);
}

/// What is known of the object when a statement is decided.
struct Evidence {
    const PhaseOctree& octree;
    const Evaluator& evaluator;
    const std::function<bool()>& is_stopped;

    /// Whether the phase is certainly in no box.
    bool is_absent(Phase) const;
    /// A point of each of these phases; nullopt if one of them has no known point.
    std::optional<std::vector<Witness>> points_of(PhaseSet) const;
    /// The point in the middle of a box that is certainly in one phase.
    Witness middle_of(const OctreeLeaf&) const;
};

/// Decide a statement; the verdict is "undecided" if these boxes do not suffice. Throws DivisionStopped.
Proof decide(const Evidence&, const IsPresent&);
Proof decide(const Evidence&, const IsConnected&);
Proof decide(const Evidence&, const IsClosed&);
Proof decide(const Evidence&, const AreApart&);
Proof decide(const Evidence&, const AreTouching&);
Proof decide(const Evidence&, const IsThick&);

/// The indices of the leaves for which `is_wanted` holds.
template <class IsWanted>
std::vector<std::uint32_t> leaves_where(const PhaseOctree& octree, IsWanted&& is_wanted) {
    std::vector<std::uint32_t> found;
    for (std::size_t i = 0; i < octree.leaves.size(); ++i)
        if (is_wanted(octree.leaves[i])) found.push_back(static_cast<std::uint32_t>(i));
    return found;
}

/// The smallest box of the octree around a range of leaves in ascending order.
inline Cube cube_of(const PhaseOctree& octree, std::span<const std::uint32_t> leaves) {
    const OctreeLeaf &first = octree.leaves[leaves.front()], &last = octree.leaves[leaves.back()];
    return octree.around(first.key, last.key, octree.size_of(last));
}

}  // namespace phasetree::measuring
