// Where a surface looks for light: the density of the directions that its shadow rays start in.
//
// A surface that lies in a clear medium gets light that was bent on its way in, and straight towards the lamp is the
// wrong direction. Where the medium ends in a plane of normal n (water over the ground of a lake, and whatever lies
// between in parallel layers), light that comes from ω' outside arrives from
//     ω = (ω' − n cos θ')/η + n cos θ,   sin θ' = η sin θ,   dω'/dω = η² cos θ / cos θ'.
// So half of the directions are bent by that, with the normal of the place where light from the brightest lamp would
// come in, as near as two straight lines find it; a curved boundary is near enough to that plane for lamps that are not
// small. Where it is a bad guess the density knows, and nothing is biased:
//     p(ω) = ½ p(ω | lights) + ½ p(ω'(ω) | lights) η² cos θ / cos θ'.
//
// Manifold walks (Hanika, Droske & Fascione: Manifold Next Event Estimation, EGSR 2015) find the way to one point of a
// lamp exactly, but have no density that other techniques could be weighted against.
#pragma once

#include "integrator/world.hpp"
#include "lights/lights.hpp"

namespace phasetree::tracer {

class LightProposal {
  public:
    LightProposal() = default;
    // At p, where light comes in through a plane of this unit normal, pointing outward, from a medium whose index is
    // 1/eta of that around p. If that is 1, straight towards the lights.
    LightProposal(const glm::vec3& p, const glm::vec3& outward, float eta) : p_(p), outward_(outward), eta_(eta) {}
    // For a surface that is not clear. Lamps are taken to be in vacuum.
    static LightProposal at(const Surface& surface, const World& world, const Scene& scene, PathCounters& counters);

    std::optional<LightSample> sample(const Lights& lights, glm::vec2 u) const;
    // Of sample(), per steradian.
    float pdf(const Lights& lights, const glm::vec3& direction) const;

  private:
    float bent_pdf(const Lights& lights, const glm::vec3& direction) const;

    glm::vec3 p_{0}, outward_{0};
    float eta_ = 1;
};

}  // namespace phasetree::tracer
