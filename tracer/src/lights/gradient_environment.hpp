// A studio's surround: three colours that run smoothly into each other with the height z of the direction,
//     L(ω) = mix(horizon, z > 0 ? zenith : ground, S(min(|z|/softness, 1))),   S(t) = t²(3 − 2t),
// so that the radiance and its slope are continuous everywhere. It depends on z alone; so does its importance.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "lights/direction_sample.hpp"
#include "lights/zonal_distribution.hpp"

namespace phasetree::tracer {

class GradientEnvironment {
  public:
    // Radiances. `softness` in (0, 1] is the sine of the elevation at which zenith or ground is reached; 1 spreads the
    // change over the whole half-sphere.
    GradientEnvironment(const glm::vec3& zenith, const glm::vec3& horizon, const glm::vec3& ground,
                        float softness = 1.0f);

    glm::vec3 radiance(const glm::vec3& direction) const;
    std::optional<DirectionSample> sample(const glm::vec2& u) const;
    float pdf(const glm::vec3& direction) const;
    // Luminance of the radiance integrated over all directions.
    float fluence() const { return distribution_.integral(); }
    /// None: it is all around.
    std::optional<glm::vec3> centre_direction() const { return std::nullopt; }

  private:
    glm::vec3 zenith_;
    glm::vec3 horizon_;
    glm::vec3 ground_;
    float softness_;
    ZonalDistribution distribution_;
};

}  // namespace phasetree::tracer
