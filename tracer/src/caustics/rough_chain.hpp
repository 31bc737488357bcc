// Chains with rough interfaces: how the densities of photons and of a path's own techniques compare.
//
// A path from a place x that photons light goes through a chain to a lamp, and at one place y of it is scattered by a
// rough interface; elsewhere interfaces are smooth. Let ω be its direction at y on the side of x, ω' that on the side
// of the lamp, n and n' the indices there, θ and θ' the angles to the normal. n_x and θ_x belong to x, and n_l is the
// index around the lamp. Three techniques find such a path:
//   directions:   ω by the BSDF at x, ω' by that at y,         p_x(ω) p_y(ω' | ω)
//   shadow rays:  ω by the BSDF at x, ω' by a shadow ray at y, p_x(ω) p_lights(ω' | y)
//   photons:      a line at the lamp, ω by the BSDF at y as it is seen from the lamp.
// The étendue n² dA cos θ dω is the same all along the way from x to y, and n'² dA cos θ' dω' along that from y to the
// lamp, so photons find (ω, ω') with the density
//     N π r² n_x² cos θ_x · (p(line)/n_l²) · R,   R = p_y*(ω | ω') n'² cos θ' / (n² cos θ),
// where p_y* is the density with which the interface, met from the lamp's side, scatters to ω, and the rest is what
// path.hpp has for chains without y. Each further rough interface adds one direction, by which every density gains
// 1/sr, and a factor of its own.
//
// A point light has a density q of directions in place of p(line)/n_l². If a photon of it reaches its first rough
// interface unbent, after the distance d, q/(n'² d²) stands for that, because dA cos θ' = d² dΩ. Otherwise no other
// technique finds its light.
#pragma once

#include <cmath>
#include <optional>

namespace phasetree::tracer {

/// How densely a camera path finds the rest of a photon's chain, from where it fell to the light but without the
/// direction there, over how densely the photon found it: the product of p_y/R over its rough interfaces. So quotients
/// stay near 1 where densities would overflow. It is 1 of a chain of smooth interfaces.
struct PathDensities {
    /// If BSDFs choose all directions. 0 of a point light, which no direction meets.
    float by_directions = 1;
    /// If a shadow ray chooses the direction at the rough interface nearest the light. None of a chain of smooth
    /// interfaces, whose shadow rays start where the photon fell; 0 of a point light's photon that was bent before.
    std::optional<float> by_shadow_rays{};
};

/// R. The photon is scattered to the path's side with the density `pdf`, per steradian. The indices and cosines are
/// those on the lamp's side and on the path's; for a reflection both indices are the same.
inline float rough_factor(float pdf, float lamp_ior, float lamp_cosine, float path_ior, float path_cosine) {
    return pdf * (lamp_ior * lamp_ior * std::abs(lamp_cosine)) / (path_ior * path_ior * std::abs(path_cosine));
}

}  // namespace phasetree::tracer
