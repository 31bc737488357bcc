// A photon: light that came from a lamp, or what glows or shines, through at least one interface of clear phases,
// smooth or rough, and fell on an opaque surface that is not a mirror, on a rough interface, or into a medium that
// scatters. It stands for the whole chain of interfaces behind it.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "caustics/rough_chain.hpp"
#include "lights/lights.hpp"
#include "phasetree/model/phase.hpp"
#include "sampling/heuristic.hpp"

namespace phasetree::tracer {

struct Photon {
    glm::vec3 position;   ///< where it fell
    glm::vec3 direction;  ///< of unit length, from there to where it came from
    /// The radiance of the light over p(line), or of a point light its intensity over the density of directions
    /// (emission.hpp), times what the media and interfaces on the way left of it.
    glm::vec3 power;
    /// p(line)/m²: how densely the photon's line was sampled at the light, p(line), per area perpendicular to it and
    /// steradian, over the square of the refractive index m around the light. Of a point light, per steradian alone.
    float line_density;
    Phase phase;                   ///< in which it travelled when it fell
    LightSource source;            ///< the light that is seen from where the photon started
    glm::vec3 towards_light;       ///< the direction in which it is seen from there
    DensityQuotients quotients{};  ///< of a chain in which rough interfaces are
    /// It was dispersed: every component of `power` is that at the hero of the wavelengths of the photon's map.
    bool of_one_wavelength = false;

    /// The weight of what the photon brings, by the power heuristic: photons find its direction with the density
    /// `by_photons`, and the path itself would go on in it with the density `pdf`. shadow_rays() is the density with
    /// which shadow rays start in it; it is asked for only if they would get to the light.
    template <class ShadowRays>
    float weight(float by_photons, float pdf, ShadowRays&& shadow_rays) const {
        return power_heuristic(by_photons, pdf * quotients.by_directions,
                               quotients.by_shadow_rays ? pdf * *quotients.by_shadow_rays : shadow_rays());
    }
};

/// A photon in a medium: a place that stands for all of the photon's line through it (photon_placement.hpp).
struct MediumPhoton {
    Photon photon;  ///< its power is that with which it came into the medium
    float depth;    ///< how far the place is behind the boundary, along the line; down to −h before it
};

/// What becomes of photons: one falls on an opaque surface, and is kept at each rough interface, and at one place in
/// each scattering medium, that it meets on its way there, after its first interface.
struct TracedPhotons {
    std::vector<Photon> on_surfaces{};
    std::vector<Photon> on_interfaces{};
    std::vector<MediumPhoton> in_media{};
};

}  // namespace phasetree::tracer
