// Where a surface looks for light: the density of the directions that its shadow rays start in.
//
// A surface that lies in a clear medium gets light that was bent on its way in, and straight towards the lamp is the
// wrong direction. Where the medium ends in a plane of normal n (water over the ground of a lake, and whatever lies
// between in parallel layers), light that comes from ω' outside arrives from
//     ω = (ω' − n cos θ')/η + n cos θ,   sin θ' = η sin θ,   dω'/dω = η² cos θ / cos θ'.
// So a part of the directions is bent by that, with the normal of the place where light from the brightest lamp would
// come in. Two straight lines find that place nearly: the direction straight to the lamp is bent as by a plane parallel
// to the surface, and followed, without being bent again, to where the index is 1 for the first time. A curved boundary
// is near enough to that plane for lamps that are not small. And light can come in by several sides: more parts are
// bent by the flat ones that lamps shine on (flat_boundaries.hpp). Where they are bad guesses the density knows, and
// nothing is biased: with n planes
//     p(ω) = (p(ω | lights) + Σ p(ω'(ω) | lights) η² cos θ / cos θ') / (1 + n).
//
// Manifold walks (Hanika, Droske & Fascione: Manifold Next Event Estimation, EGSR 2015) find the way to one point of a
// lamp exactly, but have no density that other techniques could be weighted against.
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
    /// For a place to which light comes in through a plane of this unit normal, which points outward. eta is the
    /// refractive index there divided by that beyond the plane. If it is 1, all directions go straight towards the
    /// lights.
    LightProposal(const LightReceiver& at, const glm::vec3& outward, float eta)
        : at_(at), outward_{outward}, planes_(eta == 1.0f ? 0 : 1), eta_(eta) {}
    /// Adds another plane through which light comes in.
    void add_plane(const glm::vec3& outward);
    /// For a surface without a far side. Lights are taken to be in vacuum. Where a medium disperses, directions are
    /// bent as its index at the hero of the path's `wavelengths` bends them, even if the path is not dispersed yet: so
    /// shadow rays that are dispersed on their way reach the light, whatever their hero is. All techniques of a path
    /// have the same hero, and weigh by the same densities.
    static LightProposal at(const Surface& surface, const World& world, const Scene& scene, PathCounters& counters,
                            const Wavelengths* wavelengths);
    /// For a point in a medium. `entered` is the outward normal of the boundary that the path met last in this medium,
    /// if any: near it light comes in where the path did, and far from it next to none comes in at all.
    static LightProposal at(const MediumPoint& point, const std::optional<glm::vec3>& entered, const World& world,
                            const Scene& scene, const Wavelengths* wavelengths);

    /// A direction from p, and the light that is seen in it; `u` is in [0, 1)².
    std::optional<LightSample> sample(const Lights& lights, glm::vec2 u,
                                      const Wavelengths* wavelengths = nullptr) const;
    /// The density of sample(), per steradian.
    float pdf(const Lights& lights, const glm::vec3& direction) const;
    /// The density that sample() would have at another place nearby, through the same planes.
    float pdf_from(const Lights& lights, const glm::vec3& place, const glm::vec3& direction) const;

  private:
    /// Adds the flat boundaries that a light above them shines through onto the place.
    template <class LampAbove>
    void add_flat_boundaries(const World& world, LampAbove&& lamp_above);
    /// The same of a direction whose density straight to the lights is known.
    float pdf(const Lights& lights, const glm::vec3& direction, float straight) const;

    LightReceiver at_;
    std::array<glm::vec3, 1 + max_flat_boundaries> outward_{};
    int planes_ = 0;
    float eta_ = 1;
};

}  // namespace phasetree::tracer
