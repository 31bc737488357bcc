// Light sampling at a surface or a point in a medium: the pdf of the directions in which shadow rays start.
//
// Light that reaches a surface inside a clear medium was refracted on its way in, so the straight direction to the lamp
// is wrong. Where the medium ends in a plane of normal n (water over the ground of a lake, with any parallel layers in
// between), light that comes from ω' outside arrives from
//     ω = (ω' − n cos θ')/η + n cos θ,   sin θ' = η sin θ,   dω'/dω = η² cos θ / cos θ'.
// A share of the directions is therefore refracted in this way, with the normal of the point where light from the
// brightest lamp would enter. To estimate that point, the straight direction to the lamp is refracted once, as if by a
// plane parallel to the surface. The resulting line is followed, without further refraction, to the first boundary
// beyond which the index is 1. For lamps that are not small, the tangent plane is a good enough approximation of a
// curved boundary. Light can enter through several sides, so further shares are refracted by the flat boundaries that
// lamps shine on (flat_boundaries.hpp). Bad guesses cause no bias because the pdf includes all shares: with k planes,
//     p(ω) = (p(ω | lights) + Σ p(ω'(ω) | lights) η² cos θ / cos θ') / (1 + k).
//
// Manifold walks (Hanika, Droske & Fascione: Manifold Next Event Estimation, EGSR 2015) find the exact path to one
// point of a lamp, but have no pdf for weighting them against other techniques.
#pragma once

#include <array>

#include "lights/lights.hpp"
#include "world/world.hpp"

namespace phasetree::tracer {

class LightProposal {
  public:
    LightProposal() = default;
    /// All directions go straight towards the lights.
    explicit LightProposal(const LightReceiver& at) : at_(at) {}
    /// For a point that light reaches through a plane with this outward unit normal. eta is the refractive index at the
    /// point divided by that beyond the plane; if it is 1, all directions go straight towards the lights.
    LightProposal(const LightReceiver& at, const glm::vec3& outward, float eta)
        : at_(at), outward_{outward}, planes_(eta == 1.0f ? 0 : 1), eta_(eta) {}
    /// Adds another plane through which light enters.
    void add_plane(const glm::vec3& outward);
    /// For a surface without a far side. Assumes that lights are in vacuum. In a dispersive medium, directions are
    /// refracted with the index at the hero of the path's `wavelengths`, even before the path is dispersed. Shadow rays
    /// that are dispersed on their way therefore reach the light, whatever their hero is. All techniques of a path have
    /// the same hero and use the same pdfs in their weights.
    static LightProposal at(const Surface& surface, const World& world, const Scene& scene, PathCounters& counters,
                            const Wavelengths* wavelengths);
    /// For a point in a medium. `last_boundary_normal` is the outward normal of the last boundary that the path met in
    /// this medium, if any. One boundary is enough: a point near it gets most of its light through it, and a point far
    /// away gets hardly any light.
    static LightProposal at(const MediumPoint& point, const std::optional<glm::vec3>& last_boundary_normal,
                            const World& world, const Scene& scene, const Wavelengths* wavelengths);

    /// Samples a direction and returns the light seen in it; `u` is in [0, 1)².
    std::optional<LightSample> sample(const Lights& lights, glm::vec2 u,
                                      const Wavelengths* wavelengths = nullptr) const;
    /// The pdf of sample() per steradian.
    float pdf(const Lights& lights, const glm::vec3& direction) const;
    /// The pdf that sample() would have at a nearby point, with the same planes.
    float pdf_from(const Lights& lights, const glm::vec3& place, const glm::vec3& direction) const;

  private:
    /// Adds the flat boundaries through which a light above them reaches the point. `lamp_above(normal)` returns the
    /// direction to the brightest light above a boundary with this outward normal; nullopt if there is none.
    template <class LampAbove>
    void add_flat_boundaries(const World& world, LampAbove&& lamp_above);
    /// As pdf() above, for a direction whose pdf straight to the lights is known.
    float pdf(const Lights& lights, const glm::vec3& direction, float straight) const;

    LightReceiver at_;
    std::array<glm::vec3, 1 + max_flat_boundaries> outward_{};
    int planes_ = 0;
    float eta_ = 1;
};

}  // namespace phasetree::tracer
