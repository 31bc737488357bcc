// Shadow rays, which continue through smooth clear interfaces.
#pragma once

#include <optional>
#include <vector>

#include "integrator/path_context.hpp"
#include "integrator/path_wavelengths.hpp"
#include "lights/lights.hpp"

namespace phasetree::tracer {

/// What a shadow ray found.
struct Arrival {
    /// The radiance that arrives, the light that it comes from, and the direction of the last ray.
    struct FromLight {
        glm::vec3 radiance;
        LightSource source;
        glm::vec3 direction;
        /// line_density() of the chain's last ray; 0 if the chain has no interfaces, or too many for photons. For a
        /// point light it is EmittedPhoton::line_density / (n² d²), with the index n at the start and the distance d
        /// (rough_chain.hpp).
        float line_density;
    };
    std::optional<FromLight> light{};
    /// Emission of a medium on the way, even if there is no light behind.
    struct FromMedium {
        glm::vec3 radiance;
        float line_density;  ///< as for a light
    };
    /// One for each segment in an emissive medium. Empty for a shadow ray to a point light, which has no pdf of
    /// directions.
    std::vector<FromMedium> from_media{};
    float to_boundary = 0;  ///< distance of the first boundary from the start; infinity if the light is in front of it
};

/// Returns one random sample of E (path.hpp) along a shadow ray: the emission at the end of a chain of smooth clear
/// interfaces, times the transmittance of the media and the weights of the interfaces. Each interface reflects or
/// refracts the ray at random.
///
/// Up to the first boundary, the ray goes straight to the sampled light, so nothing has to be looked up. After that,
/// the lights are queried for what the ray sees. If the ray is dispersed on its way, the radiance includes
/// Wavelengths::hero_to_all, so that it stands for the same light as the path's other numbers.
///
/// The ray goes straight through smooth thin panes, and their transmittance multiplies its light; it never takes their
/// reflection.
///
/// A point light is reached only by the straight ray, through panes and boundaries that do not refract. Its light
/// through refracting interfaces is left to photons, because no direction sampled here leads through an interface to a
/// point.
///
/// The ray may start at a rough interface that photons pass before they reach the point that gathers them.
/// `interfaces_before` counts that interface and those from there to the gathering point.
Arrival trace_shadow_ray(const PathContext&, Ray ray, const LightSample& sampled, const PathWavelengths&,
                         int interfaces_before);

}  // namespace phasetree::tracer
