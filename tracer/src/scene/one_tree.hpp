// Combines the objects of a scene into one tree, for code that works on a single tree: values at points, rays through
// opaque phases, shaders.
#pragma once

#include "scene/placed.hpp"

namespace phasetree::tracer {

/// A tree of more objects would be slow, because every point evaluates all of them.
inline constexpr std::uint64_t most_in_one_tree = 4096;

/// A single tree with the same phases everywhere, at a moment given as a fraction of the time in which the shutter is
/// open. Throws ModelError if there are more than most_in_one_tree copies.
Phased as_one_tree(const PlacedObjects&, double time = 0);

}  // namespace phasetree::tracer
