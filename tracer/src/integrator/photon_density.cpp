#include "integrator/photon_density.hpp"

#include <cmath>

#include "caustics/photon_map.hpp"
#include "caustics/rough_chain.hpp"
#include "world/chain.hpp"

namespace phasetree::tracer {

float photon_cosine(const Surface& surface, const Frame& frame, const glm::vec3& wi) {
    if (surface.normal == surface.geometric_normal) return surface.far_side ? std::abs(wi.z) : wi.z;
    const float cosine = glm::dot(frame.to_world(wi), surface.geometric_normal);
    if (surface.far_side) return wi.z * cosine > 0.0f ? std::abs(cosine) : 0.0f;
    return wi.z > 0.0f ? cosine : 0.0f;
}

float per_line_density_without_cosine(const Photons& photons, const Scene& scene, Phase phase) {
    const float ior = clear_at(scene, phase).ior;
    return photons.map->expected() * ior * ior;  // expected() is N π r²
}

float per_line_density_at(const Photons& photons, const Scene& scene, const Surface& surface, const GuidedBsdf& bsdf,
                          const glm::vec3& wi) {
    // Photons with a smaller cosine are dropped, because their contribution is divided by the cosine and one of them
    // would count a thousand times. The other techniques find such light instead, except for that of point lights.
    constexpr float least_photon_cosine = 1e-3f;
    if (!photons || bsdf.bsdf().is_delta()) return 0.0f;
    const float cosine = photon_cosine(surface, bsdf.frame(), wi);
    if (!(cosine > least_photon_cosine)) return 0.0f;
    return per_line_density_without_cosine(photons, scene,
                                           wi.z < 0.0f ? surface.far_side->phase : surface.near_side.phase) *
           cosine;
}

float per_line_density_beyond(float before, const Scene& scene, const Surface& surface, const GuidedBsdf& bsdf,
                              const glm::vec3& wi) {
    // A bump may send the path into the surface again, where no photon comes from.
    if (!(surface.far_side && surface.normal == surface.geometric_normal) &&
        !(photon_cosine(surface, bsdf.frame(), wi) > 0.0f))
        return 0.0f;
    const Surface::Side& left_to = wi.z < 0 ? *surface.far_side : surface.near_side;
    return before * rough_factor(bsdf.bsdf().reverse_pdf(bsdf.wo(), wi), clear_at(scene, left_to.phase).ior, wi.z,
                                 clear_at(scene, surface.near_side.phase).ior, bsdf.wo().z);
}

}  // namespace phasetree::tracer
