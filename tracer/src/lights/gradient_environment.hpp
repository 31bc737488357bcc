// A studio backdrop: three colours with smooth transitions by the height z of the direction,
//     L(ω) = mix(horizon, z > 0 ? zenith : ground, S(min(|z|/softness, 1))),   S(t) = t²(3 − 2t),
// so that the radiance and its slope are continuous everywhere. Both the radiance and its importance depend on z only.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "lights/cap.hpp"
#include "lights/direction_sample.hpp"
#include "lights/zonal_distribution.hpp"
#include "phasetree/io/kind.hpp"

namespace phasetree::tracer {

class GradientEnvironment {
  public:
    // Radiances. `softness` in (0, 1] is the sine of the elevation at which zenith or ground is reached; 1 spreads the
    // transition over the whole hemisphere.
    GradientEnvironment(const glm::vec3& zenith, const glm::vec3& horizon, const glm::vec3& ground,
                        float softness = 1.0f);

    glm::vec3 radiance(const glm::vec3& direction) const;
    std::optional<DirectionSample> sample(const glm::vec2& u) const;
    float pdf(const glm::vec3& direction) const;
    // Luminance of the radiance integrated over all directions.
    float fluence() const { return distribution_.integral(); }
    /// nullopt: the light surrounds the scene.
    std::optional<glm::vec3> centre_direction() const { return std::nullopt; }
    std::vector<Cap> bright_parts() const { return {}; }

  private:
    glm::vec3 zenith_;
    glm::vec3 horizon_;
    glm::vec3 ground_;
    float softness_;
    ZonalDistribution distribution_;
};

// Parameters in a scene file.
struct GradientEnvironmentParameters {
    static constexpr KindInfo info{"gradient", "A smooth gradient of three colours by elevation.",
                                   "mix(horizon, zenith or ground, S(min(|z|/softness, 1))),  S(t) = t² (3 − 2t)"};

    float intensity = 1.0f;
    glm::vec3 zenith{0.0f};
    glm::vec3 horizon{0.0f};
    glm::vec3 ground{0.0f};
    float softness = 1.0f;

    template <class V>
    static void parameters(V&& v) {
        using P = GradientEnvironmentParameters;
        v(&P::intensity,
          Parameter{"intensity", "", "Factor applied to all three radiances.", limits::non_negative, true});
        v(&P::zenith, ColourParameter{{"zenith", "", "Radiance from straight above.", limits::non_negative}});
        v(&P::horizon, ColourParameter{{"horizon", "", "Radiance from the horizon.", limits::non_negative}});
        v(&P::ground, ColourParameter{{"ground", "", "Radiance from straight below.", limits::non_negative}});
        v(&P::softness,
          Parameter{"softness", "", "Sine of the elevation at which the zenith's or the ground's colour is reached.",
                    Limits{.low = 0, .high = 1, .low_open = true}, true});
    }
    GradientEnvironment made() const {
        return GradientEnvironment(zenith * intensity, horizon * intensity, ground * intensity, softness);
    }
};

}  // namespace phasetree::tracer
