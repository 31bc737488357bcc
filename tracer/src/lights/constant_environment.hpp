// An environment of the same radiance L from everywhere: sampled uniformly, p = 1/4π. A horizontal surface under it
// receives the irradiance πL.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "lights/direction_sample.hpp"

namespace phasetree::tracer {

class ConstantEnvironment {
  public:
    explicit ConstantEnvironment(const glm::vec3& radiance);

    glm::vec3 radiance(const glm::vec3& direction) const;
    std::optional<DirectionSample> sample(const glm::vec2& u) const;
    float pdf(const glm::vec3& direction) const;
    // Luminance of the radiance integrated over all directions.
    float fluence() const;
    /// None: it is all around.
    std::optional<glm::vec3> centre_direction() const { return std::nullopt; }

  private:
    glm::vec3 radiance_;
};

}  // namespace phasetree::tracer
