// Chains with rough interfaces: how the densities of photons compare with those of a path's own techniques.
//
// Elsewhere a chain (world/chain.hpp) ends at a rough interface because a path is scattered there. Photons continue, so
// here a chain leads from a point x that gathers photons through all interfaces, smooth and rough, to a light. x is on
// an opaque surface or in a medium. If a path reaches a rough interface before any such point, for example because the
// camera sees frosted glass directly, x is on that interface. Let one of the interfaces be rough, at a point y. ω is
// the direction at y on the side of x, and ω' that on the side of the light; n and n' are the indices there, θ and θ'
// the angles to the normal. ω_x, n_x and θ_x belong to x, and n_l is the index around the light. Three techniques find
// the chain, with these densities of (ω_x, ω') in 1/sr²:
//   directions:   ω_x by the BSDF at x, ω' by that at y,         p_x(ω_x) p_y(ω' | ω)
//   shadow rays:  ω_x by the BSDF at x, ω' by a shadow ray at y, p_x(ω_x) p_lights(ω' | y)
//   photons:      a line at the light, ω by the BSDF at y as it is seen from the light,
//                 N π r² n_x² cos θ_x · (p(line)/n_l²) · R,   R = p_y*(ω | ω') n'² cos θ' / (n² cos θ).
// p_y* is the pdf with which the interface, met from the light's side, scatters to ω. The factors before R are those of
// path.hpp for chains without y. R follows from the étendue, n² dA cos θ dω: it is the same all along the way from x to
// y, and n'² dA cos θ' dω' is the same all along that from y to the light. Each further rough interface multiplies the
// first two densities by its p_y, and that of photons by its R.
//
// A point light has the density of directions cᵢ q (emission.hpp) instead of p(line)/n_l². If a photon of it reaches
// its first rough interface without refraction, at the distance d from the light, cᵢ q/(n'² d²) replaces that term,
// because area across the line is d² times solid angle at the light. If it was refracted before, no other technique
// finds its light.
#pragma once

#include <cmath>
#include <optional>

namespace phasetree::tracer {

/// The density with which a camera path that has chosen its direction at x finds the rest of the chain, divided by the
/// product of the photon's factors R. (The photon's other factors are not included.) If BSDFs choose all directions,
/// the quotient is therefore the product of all p_y/R. Quotients are stored because products of many densities
/// overflow.
struct DensityQuotients {
    /// If BSDFs choose all directions: 1 without rough interfaces, and 0 for a point light, which no direction meets.
    float by_directions = 1;
    /// If a shadow ray chooses the direction at the rough interface nearest the light: p_lights/R there, and p_y/R of
    /// the others. nullopt without rough interfaces, when shadow rays start at x. It is 0 for a point light whose
    /// photon was refracted before any rough interface scattered it.
    std::optional<float> by_shadow_rays{};
};

/// Returns R. The photon is scattered to the path's side with `pdf`, per steradian. The indices and cosines are those
/// on the light's side and on the path's; for a reflection, both indices are the same.
inline float rough_factor(float pdf, float light_ior, float light_cosine, float path_ior, float path_cosine) {
    return pdf * (light_ior * light_ior * std::abs(light_cosine)) / (path_ior * path_ior * std::abs(path_cosine));
}

/// Returns n'² d², by which the density of directions cᵢ q of a point light is divided (see above) at the distance d,
/// up to which its light was not refracted.
inline float squared_optical_distance(float ior, float distance) {
    return (ior * distance) * (ior * distance);
}

}  // namespace phasetree::tracer
