// Chains of smooth interfaces between clear phases, which shadow rays and photons follow by Fresnel's odds (path.hpp).
// Photons follow them by mirrors, rough metal and rough interfaces as well (caustics/rough_chain.hpp).
#pragma once

#include <algorithm>
#include <glm/geometric.hpp>

#include "lights/light_receiver.hpp"
#include "sampling/sobol.hpp"
#include "scene/scene.hpp"
#include "shading/frame.hpp"
#include "world/hit.hpp"

namespace phasetree::tracer {

/// No chain has more interfaces than this. Light at the end of a longer one is left to the directions that BSDFs
/// sample, which then have the weight 1.
inline constexpr int longest_chain = 128;

/// Whether photons light what is at the end of so many interfaces, smooth and rough, and metals, which count as such.
/// What nothing bends or mirrors is left to the other techniques.
inline bool photons_follow(int interfaces) {
    return interfaces > 0 && interfaces <= longest_chain;
}

/// The material of a phase in which a ray travels, which is a clear one.
inline const Clear& clear_at(const Scene& scene, Phase phase) {
    return std::get<Clear>(scene.materials[phase.index]);
}

/// Whether a surface is a link of a chain: smooth, and clear on both sides. A mirror is none: shadow rays end there.
inline bool is_link(const Bsdf& bsdf, const Surface& surface) {
    return bsdf.is_delta() && surface.far_side;
}

/// Whether a surface is a mirror, by which photons go on, but no shadow rays.
inline bool is_mirror(const Bsdf& bsdf) {
    return bsdf.is_delta() && bsdf.is_metal();
}

/// Whether photons go on from a surface, wherever they fall on it: what is clear on both sides, and metal.
inline bool sends_photons_on(const Bsdf& bsdf, const Surface& surface) {
    return surface.far_side || bsdf.is_metal();
}

/// The point to which shadow rays bring light on a surface that photons go on from; `of_path` is the side from which
/// the path comes. Paths and photons both take it from here, because their weights add up to 1 only if both reckon with
/// the same odds of each lamp. What is clear on both sides gets light from both, so it has no normal; metal has one.
inline LightReceiver receiver_of_passed_light(const Surface& surface, const Surface::Side& of_path) {
    return surface.far_side ? LightReceiver(of_path.origin) : LightReceiver(of_path.origin, surface.normal);
}

/// Deep in a medium that scatters next to nothing of a shadow ray or a photon is left when it gets to the boundary, and
/// where the chain goes from there is rarely worth a ray. Below this share it goes on in proportion to what is left.
inline constexpr float least_share_of_chain = 0.1f;

/// Russian roulette by the greatest component of the share, which is what the last medium left of a photon, or all of
/// its way of a shadow ray; the share of what goes on is scaled up for what does not.
inline bool chain_survives(glm::vec3& share, Sampler& sampler) {
    const float survival = std::max({share.x, share.y, share.z}) / least_share_of_chain;
    if (survival >= 1.0f) return true;
    if (!(sampler.next() < survival)) return false;
    share /= survival;
    return true;
}

/// The ray on which a sampled direction goes on.
inline Ray continued(const Surface& surface, const Frame& frame, const BsdfSample& sample) {
    const glm::vec3 direction = glm::normalize(frame.to_world(sample.wi));
    return sample.transmitted ? surface.transmitted(direction) : surface.reflected(direction);
}

}  // namespace phasetree::tracer
