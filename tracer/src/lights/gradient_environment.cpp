#include "lights/gradient_environment.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "image/luminance.hpp"
#include "lights/check.hpp"

namespace phasetree::tracer {

namespace {

glm::vec3 gradient(const glm::vec3& zenith, const glm::vec3& horizon, const glm::vec3& ground, float softness,
                   float z) {
    const float t = std::min(std::abs(z) / softness, 1.0f);
    return glm::mix(horizon, z > 0.0f ? zenith : ground, t * t * (3.0f - 2.0f * t));
}

// The mean luminance of each zone, by Simpson's rule. The luminance is monotone on either side of the horizon, and the
// horizon is between two zones. So a zone that emits anywhere emits at one of its ends, and is sampled.
ZonalDistribution importance(const glm::vec3& zenith, const glm::vec3& horizon, const glm::vec3& ground,
                             float softness) {
    check_colour(zenith, "the zenith's radiance");
    check_colour(horizon, "the horizon's radiance");
    check_colour(ground, "the ground's radiance");
    check_positive(softness, "the gradient's softness");
    check_range(softness, 0.0f, 1.0f, "the gradient's softness");
    constexpr int zones = 256;
    std::vector<double> means(zones);
    for (int zone = 0; zone < zones; ++zone) {
        const auto at = [&](double place) {
            const auto z = static_cast<float>(2.0 * (zone + place) / zones - 1.0);
            return static_cast<double>(luminance(gradient(zenith, horizon, ground, softness, z)));
        };
        means[static_cast<std::size_t>(zone)] = (at(0.0) + 4.0 * at(0.5) + at(1.0)) / 6.0;
    }
    return ZonalDistribution(means);
}

}  // namespace

GradientEnvironment::GradientEnvironment(const glm::vec3& zenith, const glm::vec3& horizon, const glm::vec3& ground,
                                         float softness)
    : zenith_(zenith),
      horizon_(horizon),
      ground_(ground),
      softness_(softness),
      distribution_(importance(zenith, horizon, ground, softness)) {}

glm::vec3 GradientEnvironment::radiance(const glm::vec3& direction) const {
    return gradient(zenith_, horizon_, ground_, softness_, direction.z);
}

std::optional<DirectionSample> GradientEnvironment::sample(const glm::vec2& u) const {
    return distribution_.sample(u);
}

float GradientEnvironment::pdf(const glm::vec3& direction) const {
    return distribution_.pdf(direction);
}

}  // namespace phasetree::tracer
