// Chains of smooth interfaces between clear phases, which shadow rays and photons follow by Fresnel's odds (path.hpp).
#pragma once

#include <glm/geometric.hpp>

#include "scene/scene.hpp"
#include "shading/frame.hpp"
#include "world/hit.hpp"

namespace phasetree::tracer {

/// No chain has more interfaces than this. Light at the end of a longer one is left to the directions that BSDFs
/// sample, which then have the weight 1.
inline constexpr int longest_chain = 128;

/// The material of a phase in which a ray travels, which is a clear one.
inline const Clear& clear_at(const Scene& scene, Phase phase) {
    return std::get<Clear>(scene.materials[phase.index]);
}

/// Whether a surface is a link of a chain: smooth, and clear on both sides. A mirror is none: shadow rays end there.
inline bool is_link(const Bsdf& bsdf, const Surface& surface) {
    return bsdf.is_delta() && surface.far_side;
}

/// The ray on which a sampled direction goes on.
inline Ray continued(const Surface& surface, const Frame& frame, const BsdfSample& sample) {
    const glm::vec3 direction = glm::normalize(frame.to_world(sample.wi));
    return sample.transmitted ? surface.transmitted(direction) : surface.reflected(direction);
}

}  // namespace phasetree::tracer
