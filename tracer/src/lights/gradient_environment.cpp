#include "lights/gradient_environment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "lights/check.hpp"
#include "lights/luminance.hpp"

namespace phasetree::tracer {

namespace {

glm::vec3 gradient(const glm::vec3& zenith, const glm::vec3& horizon, const glm::vec3& ground, float softness,
                   float z) {
    const float t = std::min(std::abs(z) / softness, 1.0f);
    return glm::mix(horizon, z > 0.0f ? zenith : ground, t * t * (3.0f - 2.0f * t));
}

// One cell a row, with the mean of the luminance over it by Simpson's rule. The luminance is monotone on either side of
// the horizon and the horizon is a row boundary, so a row that emits anywhere emits at one of its ends and is sampled.
LatLongDistribution importance(const glm::vec3& zenith, const glm::vec3& horizon, const glm::vec3& ground,
                               float softness) {
    check_colour(zenith, "the zenith's radiance");
    check_colour(horizon, "the horizon's radiance");
    check_colour(ground, "the ground's radiance");
    check_positive(softness, "the gradient's softness");
    check_range(softness, 0.0f, 1.0f, "the gradient's softness");
    constexpr int rows = 256;
    std::vector<float> means(rows);
    for (int row = 0; row < rows; ++row) {
        const double top = std::cos(std::numbers::pi * row / rows);
        const double bottom = std::cos(std::numbers::pi * (row + 1) / rows);
        const auto at = [&](double z) {
            return luminance(gradient(zenith, horizon, ground, softness, static_cast<float>(z)));
        };
        means[static_cast<std::size_t>(row)] = (at(top) + 4.0f * at(0.5 * (top + bottom)) + at(bottom)) / 6.0f;
    }
    return {1, rows, means};
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
