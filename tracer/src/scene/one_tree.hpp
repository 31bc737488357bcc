// The objects of a scene as one tree, for all that works on one: values at points, rays through opaque phases, shaders.
#pragma once

#include "scene/placed.hpp"

namespace phasetree::tracer {

/// A tree of more objects would be slow, since each point asks all of them.
inline constexpr std::uint64_t most_in_one_tree = 4096;

/// One tree that has the same phases everywhere, at a share of the time in which the shutter is open. Throws ModelError
/// if there are more than most_in_one_tree copies.
Phased as_one_tree(const PlacedObjects&, double time = 0);

}  // namespace phasetree::tracer
