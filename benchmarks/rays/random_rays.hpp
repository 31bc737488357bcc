#pragma once

#include "trace/field_scene.hpp"

namespace phasetree::bench {

// From points spread evenly over all that is not vacuum, in all directions; each carries the phase that it starts in.
Rays rays_from_inside(const FieldScene&, std::size_t count, std::uint64_t seed);

// Along the normal, to the side that the ray came from; it knows where it starts, as a path tracer's does.
Ray back_from(const FieldScene::HitWithNormal&);
// As many as there are camera rays, from what those hit back to the side that they came from, in all directions.
Rays rays_from_hits(const FieldScene&, std::span<const Ray> camera, std::uint64_t seed);

}  // namespace phasetree::bench
