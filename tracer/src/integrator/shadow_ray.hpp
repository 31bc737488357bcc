// Shadow rays, which go on through smooth clear interfaces.
#pragma once

#include <optional>

#include "integrator/path.hpp"
#include "lights/lights.hpp"
#include "spectrum/wavelength.hpp"

namespace phasetree::tracer {

/// What a shadow ray is traced in and counted with.
struct ShadowRayContext {
    const World& world;
    const Scene& scene;
    const Photons& photons;
    Sampler& sampler;
    PathCounters& counters;
};

/// The wavelength of the path that a shadow ray belongs to.
struct PathWavelength {
    const Wavelength& hero;  ///< the wavelength that is taken where the shadow ray is dispersed
    const Wavelength* only;  ///< that of the path; null as long as it is of all wavelengths
};

/// What a shadow ray finds: the radiance that arrives, and of which emission, in which direction in the end, it is.
struct Arrival {
    glm::vec3 radiance;
    Lights::Emission emission;
    glm::vec3 direction;
    float line_density;  ///< as the function of that name, of the chain's last line; 0 for a chain of no interface
    float to_boundary;   ///< the length of the first part of the way, in the phase in which the ray started
};

/// One random sample of E (path.hpp) along a shadow ray: the emission at the end of a chain of smooth clear interfaces,
/// each of which reflects or refracts the ray at random, times the transmittance of the media and the weights of the
/// interfaces; none if there is no light. Up to its first interface the ray goes straight to the light that was
/// sampled, which is known; after that it is asked what light it sees. A point light is seen by the straight ray alone:
/// what it sends through an interface that bends light is left to photons, because no direction that is sampled here
/// leads through the interface to a point.
std::optional<Arrival> trace_shadow_ray(const ShadowRayContext&, Ray ray, const LightSample& sampled,
                                        const PathWavelength&);

/// With which density photons start on the line on which a ray leads to a light; 0 if there are none.
float line_density(const Photons&, const Ray&);

}  // namespace phasetree::tracer
