// An environment with the same radiance L in all directions, sampled uniformly: p = 1/4π. A horizontal surface under it
// receives the irradiance πL.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "lights/cap.hpp"
#include "lights/direction_sample.hpp"
#include "phasetree/io/kind.hpp"

namespace phasetree::tracer {

class ConstantEnvironment {
  public:
    explicit ConstantEnvironment(const glm::vec3& radiance);

    glm::vec3 radiance(const glm::vec3& direction) const;
    std::optional<DirectionSample> sample(const glm::vec2& u) const;
    float pdf(const glm::vec3& direction) const;
    // Luminance of the radiance integrated over all directions.
    float fluence() const;
    /// nullopt: the light surrounds the scene.
    std::optional<glm::vec3> centre_direction() const { return std::nullopt; }
    std::vector<Cap> bright_parts() const { return {}; }

  private:
    glm::vec3 radiance_;
};

// Parameters in a scene file.
struct ConstantEnvironmentParameters {
    static constexpr KindInfo info{"constant", "The same radiance from every direction."};

    glm::vec3 radiance{1.0f};
    float intensity = 1.0f;

    template <class V>
    static void parameters(V&& v) {
        using P = ConstantEnvironmentParameters;
        v(&P::radiance,
          ColourParameter{{"radiance", "", "Radiance from every direction.", limits::non_negative, true}});
        v(&P::intensity, Parameter{"intensity", "", "Factor applied to the radiance.", limits::non_negative, true});
    }
    ConstantEnvironment made() const { return ConstantEnvironment(radiance * intensity); }
};

}  // namespace phasetree::tracer
