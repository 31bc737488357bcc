// Shadow rays, which go on through smooth clear interfaces.
#pragma once

#include <optional>
#include <vector>

#include "integrator/path.hpp"
#include "lights/lights.hpp"
#include "spectrum/wavelengths.hpp"

namespace phasetree::tracer {

/// What a shadow ray is traced in and counted with.
struct ShadowRayContext {
    const World& world;
    const Scene& scene;
    const Photons& photons;
    Sampler& sampler;
    PathCounters& counters;
};

/// The wavelengths of the path that a shadow ray belongs to.
struct PathWavelengths {
    /// Those of a spectral path, or those that a path of colours has from where it is dispersed. They are null only in
    /// scenes that are not spectral and in which nothing disperses.
    const Wavelengths* wavelengths = nullptr;
    bool is_dispersed = false;  ///< whether the path has been dispersed already
    /// What the path's numbers are of; null if they are red, green and blue.
    const Wavelengths* now() const {
        return wavelengths && (is_dispersed || wavelengths->is_spectral) ? wavelengths : nullptr;
    }
};

/// What a shadow ray finds.
struct Arrival {
    /// The radiance that arrives, the light that it is of, and the direction of the last ray.
    struct FromLight {
        glm::vec3 radiance;
        LightSource source;
        glm::vec3 direction;
        /// line_density() of the chain's last ray; 0 if photons come by no interface, or by too many. Of a point light
        /// it is EmittedPhoton::line_density / (n² d²), with the index n at the start and the distance d
        /// (rough_chain.hpp).
        float line_density;
    };
    std::optional<FromLight> light{};
    /// The radiance that a medium on the way sends by itself, also if there is no light behind.
    struct FromMedium {
        glm::vec3 radiance;
        float line_density;  ///< as that of a light
    };
    /// One for each piece of the way that is in a medium that shines. A shadow ray to a point light brings none: it has
    /// no density of directions.
    std::vector<FromMedium> from_media{};
    float to_boundary = 0;  ///< how far the first boundary is from the start; infinity if the light is before it
};

/// One random sample of E (path.hpp) along a shadow ray: the emission at the end of a chain of smooth clear interfaces,
/// each of which reflects or refracts the ray at random, times the transmittance of the media and the weights of the
/// interfaces. Up to the first boundary that it meets the ray goes straight to the light that was sampled, which is
/// known; after that it is asked what light it sees. Of a shadow ray that is dispersed on its way the radiance includes
/// Wavelengths::hero_to_all, so that it is of the same light as the path's other numbers. A point light is seen by
/// the straight ray alone, through boundaries that bend nothing: what it sends through an interface that bends light is
/// left to photons, because no direction that is sampled here leads through the interface to a point. The ray may start
/// at a rough interface that photons pass on their way to a lit place: `interfaces_before` counts that interface and
/// those from there to the lit place.
Arrival trace_shadow_ray(const ShadowRayContext&, Ray ray, const LightSample& sampled, const PathWavelengths&,
                         int interfaces_before);

/// With which density photons start on the line on which a ray leads to a light (EmittedPhoton::line_density); 0 if
/// there are none.
float line_density(const Photons&, const Ray&);
/// The same of a ray that leads to a surface that glows.
float line_density(const Photons&, const Ray&, const Surface& glowing);
/// The same of the piece of a ray, from its origin to a distance, that is in a medium that shines.
float line_density_in_medium(const Photons&, const Ray&, float distance);

}  // namespace phasetree::tracer
