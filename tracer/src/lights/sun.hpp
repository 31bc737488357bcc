// The sun: a disk of constant radiance L at infinity, of angular diameter δ.
//
// It is specified by the irradiance E⊥ on a surface that faces it; L = E⊥/(π sin²(δ/2)). So a larger sun softens
// shadows and caustics without changing the exposure. Sampled uniformly in its cone, p = 1/(2π(1 − cos(δ/2))). A
// surface whose upper half-space contains the whole disk receives E = Lπ sin²(δ/2) cos θ.
//
// Suns smaller than 0.01 degrees are enlarged to that size, with the same irradiance: rounding errors of directions
// (cap.hpp) would be as large as the sun, and the difference is invisible.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "lights/cap.hpp"
#include "lights/direction_sample.hpp"
#include "phasetree/io/kind.hpp"

namespace phasetree::tracer {

class Sun {
  public:
    static constexpr float real_angular_diameter_degrees = 0.53f;
    static constexpr float least_angular_diameter_degrees = 0.01f;

    // `direction` points towards the sun, with any length; `irradiance` is E⊥. The diameter is in (0, 90] degrees.
    Sun(const glm::vec3& direction, const glm::vec3& irradiance,
        float angular_diameter_degrees = real_angular_diameter_degrees);

    glm::vec3 radiance(const glm::vec3& direction) const;
    std::optional<DirectionSample> sample(const glm::vec2& u) const;
    float pdf(const glm::vec3& direction) const;
    // Luminance of the radiance integrated over all directions.
    float fluence() const;

    const glm::vec3& direction() const { return disk_.axis(); }
    std::optional<glm::vec3> centre_direction() const { return disk_.axis(); }
    std::vector<Cap> bright_parts() const { return {disk_}; }

  private:
    Cap disk_;
    glm::vec3 radiance_;
};

// Parameters in a scene file.
struct SunParameters {
    static constexpr KindInfo info{"sun", "A disk of constant radiance infinitely far away.", "L = E/(π sin²(δ/2))"};

    glm::vec3 direction{0.0f, 0.0f, 1.0f};
    glm::vec3 irradiance{1.0f};
    float angular_diameter_degrees = Sun::real_angular_diameter_degrees;

    template <class V>
    static void parameters(V&& v) {
        using P = SunParameters;
        v(&P::direction, DirectionParameter{{"direction", "", "Direction towards the sun, of any length."}});
        v(&P::irradiance, ColourParameter{{"irradiance", "", "Irradiance E of a surface that faces the sun.",
                                           limits::non_negative, true}});
        v(&P::angular_diameter_degrees,
          Parameter{"diameter", "degrees",
                    "Angular diameter δ. A larger sun casts softer shadows of the same brightness.",
                    Limits{.low = 0, .high = 90, .low_open = true}, true});
    }
    Sun made() const { return Sun(direction, irradiance, angular_diameter_degrees); }
};

}  // namespace phasetree::tracer
