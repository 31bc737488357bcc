// A ball around a part of a surface that shines by itself (Glowing, in shading/material.hpp). Shadow rays are sent
// towards it, so that such a surface is found as lamps are. The ball emits nothing: what a shadow ray brings is what
// the surface sends that it meets, inside of the ball or anywhere else.
//
// Directions are uniform in the cone that the ball fills, as towards a ball light. Where the surface fills little of
// the ball many of them miss it, which makes noise and nothing else. Surfaces outside all balls are found by the paths'
// directions, and by shadow rays that something else proposed.
#pragma once

#include <glm/glm.hpp>

#include "lights/bounding_sphere.hpp"
#include "lights/direction_sample.hpp"
#include "lights/emission_bounds.hpp"
#include "lights/sphere_light.hpp"

namespace phasetree::tracer {

class GlowingPart {
  public:
    /// `luminance` is roughly that of the surface's radiance. Both numbers are positive.
    GlowingPart(const BoundingSphere& ball, float luminance) : ball_(ball.centre, ball.radius, glm::vec3(luminance)) {}

    BoundingSphere bounding_sphere() const { return ball_.bounding_sphere(); }
    EmissionBounds emission_bounds() const { return ball_.emission_bounds(); }
    glm::vec3 centre() const { return ball_.centre(); }
    /// An estimate of its luminance: the whole ball counts as shining.
    float luminance() const { return ball_.radiance().x; }
    /// Steradians that the ball fills as seen from p.
    double solid_angle(const glm::vec3& p) const { return ball_.solid_angle(p); }
    DirectionSample sample(const glm::vec3& p, const glm::vec2& u) const { return ball_.sample(p, u); }
    /// The density of sample() per steradian; 0 in a direction that misses the ball.
    float pdf(const glm::vec3& p, const glm::vec3& direction) const {
        const std::optional<float> distance = ball_.intersect(p, direction);
        return distance ? ball_.pdf_at(p, direction, *distance) : 0.0f;
    }

  private:
    SphereLight ball_;
};

}  // namespace phasetree::tracer
