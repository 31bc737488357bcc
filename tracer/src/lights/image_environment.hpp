// An environment from a lat-long image: L(ω) = intensity · image(u, v), (u, v) as in lat_long.hpp.
//
// The image is interpolated bilinearly between texel centres. It wraps around in azimuth and is clamped at the poles.
// The importance is the mean of the *interpolated* luminance over each texel. Along one axis, that mean is (1, 6, 1)/8
// of the texel and its two neighbours (the integral of the two hat functions). So a texel is sampled whenever any
// direction in it emits, including a black texel next to a bright one, and the estimator is unbiased. Images wider than
// 2,048 texels are sampled by blocks of texels.
//
// NaN and negative texels count as black, infinite ones as the largest half-float number, 65,504.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "lights/cap.hpp"
#include "lights/direction_sample.hpp"
#include "lights/lat_long_distribution.hpp"
#include "phasetree/io/kind.hpp"

namespace phasetree::tracer {

// The texels, and their sampling distribution. Environments with the same image share it.
struct EnvironmentImage {
    // `pixels` row by row, the zenith's row first.
    EnvironmentImage(int width, int height, std::vector<glm::vec3> pixels);

    int width;
    int height;
    std::vector<glm::vec3> pixels;
    LatLongDistribution distribution;
    std::vector<Cap> bright_parts;
};

class ImageEnvironment {
  public:
    // `rotation_degrees` turns the environment clockwise as seen from above: what the image shows at azimuth a is seen
    // at a + rotation.
    ImageEnvironment(std::shared_ptr<const EnvironmentImage> image, float rotation_degrees = 0.0f,
                     float intensity = 1.0f);
    ImageEnvironment(int width, int height, std::vector<glm::vec3> pixels, float rotation_degrees = 0.0f,
                     float intensity = 1.0f)
        : ImageEnvironment(std::make_shared<const EnvironmentImage>(width, height, std::move(pixels)), rotation_degrees,
                           intensity) {}

    glm::vec3 radiance(const glm::vec3& direction) const;
    std::optional<DirectionSample> sample(const glm::vec2& u) const;
    float pdf(const glm::vec3& direction) const;
    // Luminance of the radiance integrated over all directions.
    float fluence() const { return intensity_ * image_->distribution.integral(); }
    /// nullopt: the light surrounds the scene.
    std::optional<glm::vec3> centre_direction() const { return std::nullopt; }
    std::vector<Cap> bright_parts() const;

  private:
    glm::vec3 to_image(const glm::vec3& direction) const;
    glm::vec3 from_image(const glm::vec3& direction) const;

    std::shared_ptr<const EnvironmentImage> image_;
    float cos_rotation_;
    float sin_rotation_;
    float intensity_;
};

class EnvironmentImages;

// Parameters in a scene file.
struct ImageEnvironmentParameters {
    static constexpr KindInfo info{"image", "An environment map in latitude-longitude format, twice as wide as high."};

    std::filesystem::path file{};
    float rotation_degrees = 0.0f;
    float intensity = 1.0f;

    template <class V>
    static void parameters(V&& v) {
        using P = ImageEnvironmentParameters;
        v(&P::file, Parameter{"file", "",
                              "Image file that OpenImageIO reads row by row (OpenEXR, Radiance, TIFF, PNG, JPEG …), at "
                              "most 16384 × 8192 pixels."});
        v(&P::rotation_degrees,
          Parameter{"rotation", "degrees", "Rotation about the z axis, clockwise as seen from above.", limits::any,
                    true});
        v(&P::intensity, Parameter{"intensity", "", "Factor applied to the image.", limits::non_negative, true});
    }
    ImageEnvironment made(EnvironmentImages& images) const;
};

}  // namespace phasetree::tracer
