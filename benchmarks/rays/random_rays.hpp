#pragma once

#include "trace/field_scene.hpp"

namespace phasetree::bench {

// From points spread evenly over all that is not vacuum, in all directions; each carries the phase that it starts in.
Rays rays_from_inside(const FieldScene&, std::size_t count, std::uint64_t seed);

}  // namespace phasetree::bench
