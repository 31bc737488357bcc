// A point light that emits into a cone with a smooth edge.
//
// With γ the angle from the axis, the cone's half-angle γ₁ and the edge's width w, the radiant intensity is
//
//     I s(t),   s(t) = t² (3 − 2t),   t = (cos γ − cos γ₁) / (cos(γ₁ − w) − cos γ₁), clamped to [0, 1]
//
// so that it is I from the axis to γ₁ − w, and 0 from γ₁ on. The whole flux with w = 0 is 2π I (1 − cos γ₁). The edge
// emits half of what a sharp ring between its two cosines would.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "lights/point_light.hpp"
#include "phasetree/math/portable.hpp"

namespace phasetree::tracer {

class SpotLight {
  public:
    /// Angles are in degrees: the full angle of the cone, in (0, 360], and the width of its edge, inside the cone.
    SpotLight(const glm::vec3& position, const glm::vec3& target, float cone_degrees, float edge_degrees,
              const glm::vec3& intensity)
        : position_(position), intensity_(intensity) {
        check_point(position, "the spot light's position");
        check_point(target, "the spot light's target");
        check_colour(intensity, "the spot light's intensity");
        check_range(cone_degrees, 0.0f, 360.0f, "the spot light's cone");
        check_range(edge_degrees, 0.0f, 0.5f * cone_degrees, "the spot light's edge");
        axis_ = glm::normalize(glm::dvec3(target) - glm::dvec3(position));
        const auto cosine = [](float degrees) {
            return std::cos(static_cast<double>(degrees) * std::numbers::pi / 180.0);
        };
        outer_ = cosine(0.5f * cone_degrees);
        inner_ = cosine(0.5f * cone_degrees - edge_degrees);
    }

    /// See PointLightKind.
    const glm::vec3& position() const { return position_; }
    glm::vec3 intensity(const glm::vec3& away) const {
        const double cosine = glm::dot(glm::dvec3(away), axis_);
        if (!(cosine > outer_)) return glm::vec3(0.0f);
        const double t = inner_ > outer_ ? std::min((cosine - outer_) / (inner_ - outer_), 1.0) : 1.0;
        return intensity_ * static_cast<float>(t * t * (3.0 - 2.0 * t));
    }
    EmissionBounds emission_bounds() const {
        return {{position_, 0.0f},
                static_cast<double>(luminance(intensity_)),
                EmissionCone::of_point(axis_, portable::acos(std::clamp(outer_, -1.0, 1.0)))};
    }

  private:
    glm::vec3 position_;
    glm::vec3 intensity_;
    glm::dvec3 axis_;
    double outer_, inner_;  ///< cosines at the ends of the edge
};

// Parameters in a scene file.
struct SpotLightParameters {
    static constexpr KindInfo info{"spot", "A point light that emits only within a cone with a smooth edge."};

    glm::vec3 position{0.0f};
    glm::vec3 target{0.0f};
    float cone_degrees = 60.0f;
    float edge_degrees = 5.0f;
    glm::vec3 color{1.0f};
    float intensity = 1.0f;

    template <class V>
    static void parameters(V&& v) {
        using P = SpotLightParameters;
        v(&P::position, Parameter{"position", "m", "Position of the light.", coordinate});
        v(&P::target, Parameter{"target", "m", "Point on the axis of the cone.", coordinate});
        v(&P::cone_degrees, Parameter{"cone", "degrees", "Full angle of the cone, outside which it is dark.",
                                      Limits{.low = 0, .high = 360, .low_open = true}, true});
        v(&P::edge_degrees,
          Parameter{"edge", "degrees",
                    "Width of the soft edge inside the cone; at most half of the cone's angle is used.",
                    Limits{.low = 0, .high = 180}, true});
        v(&P::color, colour_of_a_point);
        v(&P::intensity, intensity_of_a_point);
    }
    SpotLight made() const {
        if (!(glm::length(target - position) > 0))
            throw ParameterError("target", "\"target\" must differ from the light's position");
        return SpotLight(position, target, cone_degrees, std::min(edge_degrees, 0.5f * cone_degrees),
                         color * intensity);
    }
};

}  // namespace phasetree::tracer
