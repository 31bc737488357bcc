// The density of photons at the light's end of a chain (EmittedPhoton::line_density), per area across the line and
// solid angle, divided by n² there (path.hpp). It enters the MIS weights of the other techniques. All are 0 without
// photons.
#pragma once

#include "integrator/path_context.hpp"
#include "world/hit.hpp"
#include "world/ray.hpp"

namespace phasetree::tracer {

/// The density with which photons start on the line along which a ray reaches a light.
float line_density(const Photons&, const Ray&);
/// As above, for a ray that reaches an emissive surface.
float line_density(const Photons&, const Ray&, const Surface& emissive);
/// As above, for the segment of a ray, from its origin up to a distance, in an emissive medium.
float line_density_in_medium(const Photons&, const Ray&, float distance);

}  // namespace phasetree::tracer
