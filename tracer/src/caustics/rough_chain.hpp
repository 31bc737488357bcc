// Chains with rough interfaces: how the densities of photons and of a path's own techniques compare.
//
// A path from a place x that photons light goes through a chain to a lamp, and at one place y of it is scattered by a
// rough interface; elsewhere interfaces are smooth. Let ω be its direction at y on the side of x, ω' that on the side
// of the lamp, n and n' the indices there, θ and θ' the angles to the normal. Three techniques find such a path:
//   directions:   ω by the BSDF at x, ω' by that at y,         p_x(ω) p_y(ω' | ω)
//   shadow rays:  ω by the BSDF at x, ω' by a shadow ray at y, p_x(ω) p_lights(ω' | y)
//   photons:      a line at the lamp, ω by the BSDF at y as it is seen from the lamp.
// The étendue n² dA cos θ dω is the same all along the way from x to y, and n'² dA cos θ' dω' along that from y to the
// lamp, so photons find (ω, ω') with the density
//     N π r² n² cos θ_x · (p(line)/m²) · R,   R = p_y*(ω | ω') n'² cos θ' / (n² cos θ),
// where p_y* is the density with which the interface, met from the lamp's side, scatters to ω, and the rest is what
// path.hpp has for chains without y. So R is a factor of the line density, and each further rough interface brings
// another one: its density has one direction more, as those of the other techniques have. Of a point light p(line) is
// per steradian, and the first rough interface that its photon meets without being bent, at a distance d, also divides
// by n'² d²: area there is n'² d² times solid angle at the light over n'² cos θ'.
#pragma once

#include <cmath>
#include <optional>

namespace phasetree::tracer {

/// With which densities a path that comes from where a photon fell finds the chain beyond the photon's own direction,
/// per steradian for each rough interface.
struct RoughChain {
    /// All directions by BSDFs. 1 of a chain that is smooth, and 0 of a point light's, which no direction meets.
    float by_directions = 1;
    /// The last direction by a shadow ray instead. None of a chain that is smooth: shadow rays start where the photon
    /// fell, if they find the light at all.
    std::optional<float> by_shadow_rays{};
};

/// R. Scattering by the interface, met from the lamp's side, has the density `pdf`; indices and cosines are those of
/// the lamp's side and of the other one.
inline float rough_factor(float pdf, float lamp_ior, float lamp_cosine, float ior, float cosine) {
    return pdf * (lamp_ior * lamp_ior * std::abs(lamp_cosine)) / (ior * ior * std::abs(cosine));
}

}  // namespace phasetree::tracer
