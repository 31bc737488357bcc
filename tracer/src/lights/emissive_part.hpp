// A ball around a part of an emissive surface (Glowing, in shading/material.hpp) or of an emissive medium. Next-event
// estimation samples directions towards it as it does for lamps. The ball itself emits nothing: a shadow ray collects
// the emission of the media on its way and of the surface that it meets, inside the ball or anywhere else.
//
// Directions are uniform in the cone that the ball subtends, as for a sphere light. If the part fills little of the
// ball, many of them miss it, which adds noise but no bias. Emission outside all balls is found by sampled BSDF
// directions, and by shadow rays that another light proposed. The balls emit photons, too (caustics/emission.hpp).
#pragma once

#include <glm/glm.hpp>

#include "lights/bounding_sphere.hpp"
#include "lights/direction_sample.hpp"
#include "lights/emission_bounds.hpp"
#include "lights/sphere_light.hpp"

namespace phasetree::tracer {

class EmissivePart {
  public:
    /// What emits in the ball.
    enum class Of { surface, medium };
    /// `luminance` is approximately that of the radiance from there. Both numbers are positive.
    EmissivePart(const BoundingSphere& ball, float luminance, Of of = Of::surface)
        : ball_(ball.centre, ball.radius, glm::vec3(luminance)), of_(of) {}

    bool is_of_surface() const { return of_ == Of::surface; }

    BoundingSphere bounding_sphere() const { return ball_.bounding_sphere(); }
    EmissionBounds emission_bounds() const { return ball_.emission_bounds(); }
    glm::vec3 centre() const { return ball_.centre(); }
    /// An estimate of its luminance, as if the whole ball emitted.
    float luminance() const { return ball_.radiance().x; }
    /// Whether a ray meets the ball.
    bool is_met(const glm::vec3& origin, const glm::vec3& direction) const {
        return ball_.intersect(origin, direction).has_value();
    }
    /// The solid angle in steradians that the ball subtends at p.
    double solid_angle(const glm::vec3& p) const { return ball_.solid_angle(p); }
    DirectionSample sample(const glm::vec3& p, const glm::vec2& u) const { return ball_.sample(p, u); }
    /// The pdf of sample() per steradian; 0 in a direction that misses the ball.
    float pdf(const glm::vec3& p, const glm::vec3& direction) const {
        const std::optional<float> distance = ball_.intersect(p, direction);
        return distance ? ball_.pdf_at(p, direction, *distance) : 0.0f;
    }

  private:
    SphereLight ball_;
    Of of_;
};

}  // namespace phasetree::tracer
