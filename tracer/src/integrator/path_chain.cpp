#include "integrator/path_chain.hpp"

#include "integrator/line_density.hpp"
#include "integrator/technique_weight.hpp"

namespace phasetree::tracer {

float PathChain::weight(const Scene& scene, const Photons& photons, const Ray& ray) const {
    return weight_with(scene, [&] { return line_density(photons, ray); });
}

float PathChain::weight(const Scene& scene, const Photons& photons, const Ray& ray, const Surface& emissive) const {
    return weight_with(scene, [&] { return line_density(photons, ray, emissive); });
}

float PathChain::weight_of_medium(const Scene& scene, const Photons& photons, const Ray& ray, float distance) const {
    return weight_with(scene, [&] { return line_density_in_medium(photons, ray, distance); });
}

template <class LineDensity>
float PathChain::weight_with(const Scene& scene, LineDensity&& line_density_at_end) const {
    const float per_line = by_photons.per_line_density;
    const bool is_found = per_line > 0.0f && is_photon_chain(interfaces());
    return weight(scene, is_found ? per_line * line_density_at_end() : 0.0f);
}

float PathChain::weight(const Scene& scene, float density_of_photons) const {
    if (!pdf || length > longest_chain || (has_mirror && density_of_photons == 0.0f)) return 1;
    return technique_weight(scene.settings.techniques, Technique::directions, *pdf,
                            has_mirror ? 0.0f : proposal.pdf(scene.lights, direction), density_of_photons);
}

}  // namespace phasetree::tracer
