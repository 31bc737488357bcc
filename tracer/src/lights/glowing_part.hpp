// A ball around a part of what shines by itself: of a surface (Glowing, in shading/material.hpp), or of a medium with
// emission. Shadow rays are sent towards it, so that it is found as lamps are. The ball emits nothing: what a shadow
// ray brings is what the media on its way send, and the surface that it meets, inside of the ball or anywhere else.
//
// Directions are uniform in the cone that the ball fills, as towards a ball light. Where little of the
// ball is filled many of them miss it, which makes noise and nothing else. What shines outside all balls is found by
// the paths' directions, and by shadow rays that something else proposed. The balls send
// photons, too (caustics/emission.hpp).
#pragma once

#include <glm/glm.hpp>

#include "lights/bounding_sphere.hpp"
#include "lights/direction_sample.hpp"
#include "lights/emission_bounds.hpp"
#include "lights/sphere_light.hpp"

namespace phasetree::tracer {

class GlowingPart {
  public:
    /// What shines in the ball.
    enum class Of { surface, medium };
    /// `luminance` is roughly that of the radiance which comes from there. Both numbers are positive.
    GlowingPart(const BoundingSphere& ball, float luminance, Of of = Of::surface)
        : ball_(ball.centre, ball.radius, glm::vec3(luminance)), of_(of) {}

    bool is_of_surface() const { return of_ == Of::surface; }

    BoundingSphere bounding_sphere() const { return ball_.bounding_sphere(); }
    EmissionBounds emission_bounds() const { return ball_.emission_bounds(); }
    glm::vec3 centre() const { return ball_.centre(); }
    /// An estimate of its luminance: the whole ball counts as shining.
    float luminance() const { return ball_.radiance().x; }
    /// Whether a ray meets the ball.
    bool is_met(const glm::vec3& origin, const glm::vec3& direction) const {
        return ball_.intersect(origin, direction).has_value();
    }
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
    Of of_;
};

}  // namespace phasetree::tracer
