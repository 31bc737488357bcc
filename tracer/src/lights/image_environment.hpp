// An environment from a lat-long image: L(ω) = intensity · image(u, v), (u, v) as in lat_long.hpp.
//
// The image is interpolated bilinearly between texel centres, wrapping around in azimuth and clamped at the poles.
// Importance: the mean of the *interpolated* luminance over each texel. Along one axis that mean is (1, 6, 1)/8 of the
// texel and its two neighbours (the integral of the two hat functions), so a texel is sampled whenever any direction in
// it emits, a black one beside a bright one too, and the estimator stays unbiased. Images wider than 2,048 texels are
// sampled by blocks of texels.
//
// Texels that are not a number or negative count as black, infinite ones as the largest half-float number, 65,504.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "lights/direction_sample.hpp"
#include "lights/lat_long_distribution.hpp"

namespace phasetree::tracer {

class ImageEnvironment {
  public:
    // `pixels` row by row, the zenith's row first. `rotation_degrees` turns the environment clockwise seen from above:
    // what the image shows at azimuth a is seen at a + rotation.
    ImageEnvironment(int width, int height, std::vector<glm::vec3> pixels, float rotation_degrees = 0.0f,
                     float intensity = 1.0f);

    glm::vec3 radiance(const glm::vec3& direction) const;
    std::optional<DirectionSample> sample(const glm::vec2& u) const;
    float pdf(const glm::vec3& direction) const;
    // Luminance of the radiance integrated over all directions.
    float fluence() const { return intensity_ * distribution_.integral(); }

  private:
    glm::vec3 to_image(const glm::vec3& direction) const;
    glm::vec3 from_image(const glm::vec3& direction) const;

    int width_;
    int height_;
    std::vector<glm::vec3> pixels_;
    LatLongDistribution distribution_;
    float cos_rotation_;
    float sin_rotation_;
    float intensity_;
};

}  // namespace phasetree::tracer
