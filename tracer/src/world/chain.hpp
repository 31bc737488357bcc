// Chains of smooth interfaces between clear phases, which shadow rays and photons follow with the probabilities of
// Fresnel's equations (path.hpp). Photons also follow them through mirrors, rough metal and rough interfaces
// (caustics/rough_chain.hpp). This is what other renderers call specular chains, except for the rough interfaces.
#pragma once

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "lights/light_receiver.hpp"
#include "sampling/sobol.hpp"
#include "scene/scene.hpp"
#include "shading/frame.hpp"
#include "world/hit.hpp"

namespace phasetree::tracer {

/// Maximum number of interfaces in a chain. Light at the end of a longer one is left to directions sampled from BSDFs,
/// which then have the weight 1.
inline constexpr int longest_chain = 128;

/// Whether photons are stored at the end of a chain with this many interfaces, smooth and rough, including metals.
/// Light that is neither refracted nor reflected is left to the other techniques.
inline bool is_photon_chain(int interfaces) {
    return interfaces > 0 && interfaces <= longest_chain;
}

/// The clear material of a phase in which a ray travels.
inline const Clear& clear_at(const Scene& scene, Phase phase) {
    return std::get<Clear>(scene.materials[phase.index]);
}

/// Whether a surface is a link of a chain: smooth, and clear on both sides. Mirrors are not: shadow rays end there. A
/// thin pane is one, too, but light goes straight through it, so that counts as no interface; and its reflection counts
/// as that of a mirror.
inline bool is_link(const Bsdf& bsdf, const Surface& surface) {
    return bsdf.is_delta() && surface.far_side;
}

/// Whether a surface is a mirror, which photons follow but shadow rays do not.
inline bool is_mirror(const Bsdf& bsdf) {
    return bsdf.is_delta() && bsdf.is_metal();
}

/// The share of the light along a direction that goes straight through a surface that is a smooth pane.
inline glm::vec3 straight_through(const ThinPane& pane, const Surface& surface, const glm::vec3& direction) {
    return pane.at(glm::clamp(-glm::dot(direction, surface.normal), 0.0f, 1.0f)).transmitted;
}

/// Whether photons continue from a surface, wherever they land on it: one that is clear on both sides, or metal.
inline bool continues_photons(const Bsdf& bsdf, const Surface& surface) {
    return surface.is_transparent() || bsdf.is_metal();
}

/// Whether photons that land on a surface are stored, and gathered, apart from those on opaque surfaces. A mesh that is
/// thin in places alone has one kind of photons.
inline bool has_photons_of_interfaces(const Surface& surface) {
    return surface.far_side && !surface.is_partly_rough;
}

/// The receiver of shadow rays on a surface from which photons continue; `of_path` is the side from which the path
/// comes. Paths and photons both use it, because their weights add up to 1 only if both compute the same probability
/// for each lamp. A surface that is clear on both sides receives light from both, so it has no normal; metal has one.
inline LightReceiver receiver_of_passed_light(const Surface& surface, const Surface::Side& of_path) {
    return surface.far_side ? LightReceiver(of_path.origin) : LightReceiver(of_path.origin, surface.normal);
}

/// Deep in a scattering medium, little of a shadow ray or a photon is left at the boundary, and the rest of its chain
/// is rarely worth a ray. Below this share, it continues with a probability proportional to what is left.
inline constexpr float least_share_of_chain = 0.1f;

/// Russian roulette by the greatest component of the share. For a photon, the share is the transmittance of the last
/// medium; for a shadow ray, it is the throughput of its whole way. Survivors are scaled up accordingly.
inline bool chain_survives(glm::vec3& share, Sampler& sampler) {
    const float survival = std::max({share.x, share.y, share.z}) / least_share_of_chain;
    if (survival >= 1.0f) return true;
    if (!(sampler.next() < survival)) return false;
    share /= survival;
    return true;
}

/// The ray that continues in a sampled direction.
inline Ray continued(const Surface& surface, const Frame& frame, const BsdfSample& sample) {
    const glm::vec3 direction = glm::normalize(frame.to_world(sample.wi));
    return sample.transmitted ? surface.transmitted(direction) : surface.reflected(direction);
}

/// Whether a ray that has left a surface moves away from it, on the side where it starts. Bumps may send a ray towards
/// the surface that it has just left. A path then meets the surface again; shadow rays and photons end there, so that
/// directions sampled by paths find such light alone.
inline bool moves_away(const Surface& surface, const glm::vec3& direction, bool transmitted) {
    // Without a bump, only rounding could contradict the sample.
    return surface.normal == surface.geometric_normal ||
           (transmitted ? -1.0f : 1.0f) * glm::dot(direction, surface.geometric_normal) > 0.0f;
}

}  // namespace phasetree::tracer
