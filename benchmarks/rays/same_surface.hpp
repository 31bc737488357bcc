// Whether two objects have the same outer surface, the boundary of the vacuum: by points, and by rays.
#pragma once

#include "trace/field_scene.hpp"

namespace phasetree::bench {

struct Sameness {
    std::size_t points = 0;
    // Points that are in the vacuum of one and not of the other, and no nearer to an interface than rounding explains.
    std::size_t points_apart = 0;
    std::size_t rays = 0;
    std::size_t hits = 0;
    // Rays that hit only one, or the two at distances that their resolutions do not explain.
    std::size_t rays_apart = 0;
};

// Half of the points are anywhere in the bounds, half are near where rays hit, half of those within a thousandth of the
// object's diagonal.
Sameness same_surface(const FieldScene& a, const FieldScene& b, const Rays& camera, std::size_t points,
                      std::uint64_t seed);

}  // namespace phasetree::bench
