// What a path remembers of the last place where lights were sampled, and of the chain of smooth interfaces since. The
// weight of emission at the end of the chain depends on it (path.hpp).
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "integrator/light_proposal.hpp"
#include "integrator/photon_density.hpp"
#include "integrator/shadow_ray.hpp"
#include "integrator/technique_weight.hpp"
#include "world/chain.hpp"

namespace phasetree::tracer {

struct PathChain {
    /// The density with which the path chose the chain's first direction: by the BSDF, a guide, or the phase function.
    /// None if lights were not sampled there.
    std::optional<float> pdf;
    LightProposal proposal{};  ///< how lights were sampled there
    glm::vec3 direction{0};    ///< the chain's first direction
    PhotonDensity by_photons{};
    /// How many interfaces lead from the place that photons light to the rough one where this chain starts, that one
    /// included; 0 if photons light the start itself. Where no photons count it means nothing.
    int interfaces_before = 0;
    int length = 0;           ///< how many smooth clear interfaces and mirrors it has
    bool has_mirror = false;  ///< then shadow rays do not follow it

    /// How many interfaces are between what photons light and the lamp.
    int interfaces() const { return interfaces_before + length; }
    /// Whether photons that pass a rough interface at the chain's end count at an earlier place of the path. If they do
    /// not, they count at the rough interface.
    bool photons_count_earlier() const {
        return pdf && by_photons.per_line_density > 0.0f && photons_follow(interfaces() + 1);
    }

    /// The weight of light that is seen along the ray. Light at the end of a chain that shadow rays and photons do not
    /// follow to its end is found by the path alone, whichever techniques are asked for.
    float weight(const Scene& scene, const Photons& photons, const Ray& ray) const {
        return weight_with(scene, [&] { return line_density(photons, ray); });
    }
    /// The same of what a surface sends that the ray met.
    float weight(const Scene& scene, const Photons& photons, const Ray& ray, const Surface& glowing) const {
        return weight_with(scene, [&] { return line_density(photons, ray, glowing); });
    }
    /// The same of what the medium sends that the ray is in, from its origin to a distance.
    float weight_of_medium(const Scene& scene, const Photons& photons, const Ray& ray, float distance) const {
        return weight_with(scene, [&] { return line_density_in_medium(photons, ray, distance); });
    }

  private:
    /// The line density is asked for only if photons bring the light.
    template <class LineDensity>
    float weight_with(const Scene& scene, LineDensity&& line_density_at_end) const {
        const float per_line = by_photons.per_line_density;
        const bool is_found = per_line > 0.0f && photons_follow(interfaces());
        return weight(scene, is_found ? per_line * line_density_at_end() : 0.0f);
    }
    float weight(const Scene& scene, float density_of_photons) const {
        if (!pdf || length > longest_chain || (has_mirror && density_of_photons == 0.0f)) return 1;
        return technique_weight(scene.settings.techniques, Technique::directions, *pdf,
                                has_mirror ? 0.0f : proposal.pdf(scene.lights, direction), density_of_photons);
    }
};

}  // namespace phasetree::tracer
