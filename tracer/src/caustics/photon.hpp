// A photon: light of a lamp, an infinite light, or an emissive surface or medium, after at least one refraction or
// reflection by an interface of clear phases, smooth or rough, or by metal. It landed on an opaque surface that is not
// a mirror, on a rough interface, or in a scattering medium. It represents the whole chain of interfaces behind it
// (world/chain.hpp).
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "caustics/rough_chain.hpp"
#include "lights/lights.hpp"
#include "phasetree/model/phase.hpp"
#include "sampling/heuristic.hpp"

namespace phasetree::tracer {

struct Photon {
    glm::vec3 position;   ///< where it landed
    glm::vec3 direction;  ///< unit length, from there back along its last segment
    /// The radiance of the light divided by p(line), times the attenuation by media and interfaces on the way. For a
    /// point light, it starts from the intensity divided by the density of directions (emission.hpp).
    glm::vec3 power;
    /// p(line)/n_l²: the density p(line) of the photon's line at the light, per area perpendicular to it and per
    /// steradian, divided by the square of the refractive index n_l around the light. For a point light, the density of
    /// directions (emission.hpp), per steradian.
    float line_density;
    Phase phase;                   ///< of the last segment
    LightSource source;            ///< the light seen from where the photon started
    glm::vec3 towards_light;       ///< direction of that light from there
    DensityQuotients quotients{};  ///< of a chain with rough interfaces
    /// Whether it was dispersed. If so, every component of `power` is that at the hero wavelength of the photon's map.
    bool of_one_wavelength = false;

    /// The MIS weight of the photon's contribution, by the power heuristic. `by_photons` is the density with which
    /// photons find its direction, and `pdf` that with which the path itself would continue in it. shadow_rays()
    /// returns the pdf with which shadow rays start in that direction. It is called only if `quotients` has no value
    /// for shadow rays, because they start where the photon landed.
    template <class ShadowRays>
    float weight(float by_photons, float pdf, ShadowRays&& shadow_rays) const {
        return power_heuristic(by_photons, pdf * quotients.by_directions,
                               quotients.by_shadow_rays ? pdf * *quotients.by_shadow_rays : shadow_rays());
    }
};

/// A photon in a medium: one point that represents the photon's whole line through it (photon_placement.hpp).
struct MediumPhoton {
    Photon photon;  ///< its power is that on entering the medium
    /// Distance from the boundary to the point, along the line. In front of the boundary it is negative, at least −h.
    float depth;
};

/// The results of tracing photons. After its first interface, a photon is stored where it lands on an opaque surface,
/// at each rough interface on its way there, and at one point in each scattering medium.
struct TracedPhotons {
    std::vector<Photon> on_surfaces{};
    std::vector<Photon> on_interfaces{};
    std::vector<MediumPhoton> in_media{};
};

}  // namespace phasetree::tracer
