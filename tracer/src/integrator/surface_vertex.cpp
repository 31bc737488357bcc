#include "integrator/surface_vertex.hpp"

#include "world/chain.hpp"

namespace phasetree::tracer {

SurfaceVertex::SurfaceVertex(const PathContext& context, const PathState& path, const PathGuiding& guiding,
                             const Surface& surface, const Bsdf& bsdf)
    : scene_(context.scene),
      photons_(context.photons),
      surface_(surface),
      frame_(surface.frame()),
      bsdf_(bsdf, frame_, frame_.to_local(-path.ray.direction), guiding.at(surface, bsdf)) {
    if (continues_photons(bsdf, surface) && path.chain.photons_count_earlier()) {
        per_line_density_before_ = path.chain.by_photons.per_line_density / *path.chain.pdf;
        interfaces_before_ = path.chain.interfaces() + 1;
    }
    if (!receives_light()) return;
    // Photons that continue from this surface to an earlier vertex use the pdf of this proposal in their MIS weights,
    // too, so it must not depend on refraction.
    proposal_ = surface.far_side || is_passed_by_photons()
                    ? LightProposal(receiver_of_passed_light(surface, surface.near_side))
                    : LightProposal::at(surface, context.world, scene_, context.counters, path.wavelengths.all());
}

float SurfaceVertex::per_line_density(const glm::vec3& wi) const {
    return is_passed_by_photons() ? per_line_density_beyond(*per_line_density_before_, scene_, surface_, bsdf_, wi)
                                  : per_line_density_at(photons_, scene_, surface_, bsdf_, wi);
}

std::optional<Scattering> SurfaceVertex::scattering(const glm::vec3& direction) const {
    const glm::vec3 wi = frame_.to_local(direction);
    const glm::vec3 f = bsdf_.evaluate(wi);
    if (f == glm::vec3(0.0f)) return std::nullopt;
    return Scattering{f,
                      bsdf_.pdf(wi, direction),
                      {per_line_density(wi)},
                      wi.z < 0 ? surface_.transmitted(direction) : surface_.reflected(direction)};
}

std::optional<PhotonScattering> SurfaceVertex::scattering_of(const Photon& photon) const {
    const glm::vec3 wi = frame_.to_local(photon.direction);
    // A photon on another surface nearby may come from the wrong side.
    const bool is_from_near = wi.z > 0.0f;
    if (!is_from_near && !surface_.far_side) return std::nullopt;
    if (photon.phase != (is_from_near ? surface_.near_side : *surface_.far_side).phase) return std::nullopt;
    const float by_photons = per_line_density_at(photons_, scene_, surface_, bsdf_, wi) * photon.line_density;
    if (!(by_photons > 0.0f)) return std::nullopt;
    // Photons are counted per area of the surface, which already includes the surface's cosine.
    const glm::vec3 f = bsdf_.evaluate(wi) / photon_cosine(surface_, frame_, wi);
    return PhotonScattering{photon.power, f, bsdf_.pdf(wi, photon.direction), by_photons};
}

PathChain SurfaceVertex::chain_from(const GuidedBsdf::Sample& next, const glm::vec3& direction) const {
    return {.pdf = next.pdf,
            .proposal = proposal_,
            .direction = direction,
            .by_photons = {per_line_density(next.wi)},
            .interfaces_before = interfaces_before_};
}

}  // namespace phasetree::tracer
