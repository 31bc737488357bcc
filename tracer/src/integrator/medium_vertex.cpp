#include "integrator/medium_vertex.hpp"

#include "world/chain.hpp"

namespace phasetree::tracer {

MediumVertex::MediumVertex(const PathContext& context, const PathState& path, float distance)
    : medium_(clear_at(context.scene, path.ray.phase).interior),
      point_{path.ray.origin + distance * path.ray.direction, path.ray.phase, *tracer::phase_function(medium_),
             path.ray.in},
      arriving_(path.ray.direction),
      proposal_(
          LightProposal::at(point_, path.last_boundary_normal, context.world, context.scene, path.wavelengths.all())),
      placement_(context.photons ? PhotonPlacement::in(medium_, context.photons.map->half_length()) : std::nullopt),
      per_line_density_without_cosine_(
          placement_ ? per_line_density_without_cosine(context.photons, context.scene, point_.phase) : 0.0f) {}

std::optional<Scattering> MediumVertex::scattering(const glm::vec3& direction) const {
    const float f = phase_function(direction);
    return Scattering{glm::vec3(f), f, {per_line_density_without_cosine_, placement_}, point_.leaving(direction)};
}

std::optional<PhotonScattering> MediumVertex::scattering_of(const Photon& photon, float depth,
                                                            const PathContext& context,
                                                            const PathWavelengths& wavelengths) const {
    const float coverage = placement_->coverage(depth);
    const float by_photons = per_line_density_without_cosine_ * photon.line_density * coverage;
    if (!(by_photons > 0.0f)) return std::nullopt;
    // The transmittance along the photon's line from the boundary to the point. It is 1 if the line passes the point
    // before it enters the medium (`depth` is then negative).
    const Wavelengths* of_photon = photon.of_one_wavelength ? wavelengths.all() : wavelengths.now();
    const glm::vec3 left = transmittance(
        medium_,
        context.world.geometry().way_through_medium(point_.leaving(photon.direction), std::max(depth, 0.0f), of_photon),
        context.sampler);
    const float f = phase_function(photon.direction);
    return PhotonScattering{photon.power * left / coverage, glm::vec3(f), f, by_photons};
}

glm::vec3 MediumVertex::sample_direction(const glm::vec2& u) const {
    return glm::normalize(Frame(arriving_).to_world(point_.phase_function.get().sample(u)));
}

PathChain MediumVertex::chain_from(const glm::vec3& direction) const {
    return {.pdf = phase_function(direction),
            .proposal = proposal_,
            .direction = direction,
            .by_photons = {per_line_density_without_cosine_, placement_}};
}

}  // namespace phasetree::tracer
