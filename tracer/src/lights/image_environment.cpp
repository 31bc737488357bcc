#include "lights/image_environment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "image/luminance.hpp"
#include "lights/bright_parts.hpp"
#include "lights/check.hpp"
#include "lights/lat_long.hpp"

namespace phasetree::tracer {

namespace {

constexpr int widest_distribution = 2048;

float usable(float value) {
    constexpr float largest_half = 65504.0f;
    if (!(value > 0.0f)) return 0.0f;
    return std::isinf(value) ? largest_half : value;
}

std::vector<glm::vec3> usable(std::vector<glm::vec3> pixels, int width, int height) {
    if (width < 1 || height < 1 ||
        pixels.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
        throw std::invalid_argument("an environment image needs width × height pixels");
    }
    for (glm::vec3& pixel : pixels) pixel = {usable(pixel.r), usable(pixel.g), usable(pixel.b)};
    return pixels;
}

// The largest block of texels that divides the image evenly, up to the size needed; 1 if there is none.
int block_size(int width, int height) {
    const int wanted = (width + widest_distribution - 1) / widest_distribution;
    for (int block = wanted; block > 1; --block) {
        if (width % block == 0 && height % block == 0) return block;
    }
    return 1;
}

LatLongDistribution importance(int width, int height, const std::vector<glm::vec3>& pixels) {
    const auto luminance_at = [&](int column, int row) {
        const auto wrapped = static_cast<std::size_t>((column + width) % width);
        const auto clamped = static_cast<std::size_t>(std::clamp(row, 0, height - 1));
        return luminance(pixels[clamped * static_cast<std::size_t>(width) + wrapped]);
    };
    const auto line_mean = [&](int column, int row) {
        return (luminance_at(column - 1, row) + 6.0f * luminance_at(column, row) + luminance_at(column + 1, row)) /
               8.0f;
    };
    const int block = block_size(width, height);
    const int columns = width / block;
    const int rows = height / block;
    std::vector<float> means(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), 0.0f);
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            const float mean =
                (line_mean(column, row - 1) + 6.0f * line_mean(column, row) + line_mean(column, row + 1)) / 8.0f;
            const auto cell = static_cast<std::size_t>(row / block) * static_cast<std::size_t>(columns) +
                              static_cast<std::size_t>(column / block);
            means[cell] += mean / static_cast<float>(block * block);
        }
    }
    return {columns, rows, means};
}

}  // namespace

EnvironmentImage::EnvironmentImage(int given_width, int given_height, std::vector<glm::vec3> given_pixels)
    : width(given_width),
      height(given_height),
      pixels(usable(std::move(given_pixels), width, height)),
      distribution(importance(width, height, pixels)),
      bright_parts(tracer::bright_parts(distribution)) {}

ImageEnvironment::ImageEnvironment(std::shared_ptr<const EnvironmentImage> image, float rotation_degrees,
                                   float intensity)
    : image_(std::move(image)), intensity_(intensity) {
    if (!std::isfinite(rotation_degrees)) throw std::invalid_argument("the environment's rotation must be finite");
    if (!std::isfinite(intensity) || intensity < 0.0f) {
        throw std::invalid_argument("the environment's intensity must be a finite number and not negative");
    }
    const double rotation = std::remainder(static_cast<double>(rotation_degrees), 360.0) * std::numbers::pi / 180.0;
    cos_rotation_ = static_cast<float>(std::cos(rotation));
    sin_rotation_ = static_cast<float>(std::sin(rotation));
}

glm::vec3 ImageEnvironment::to_image(const glm::vec3& d) const {
    return {cos_rotation_ * d.x - sin_rotation_ * d.y, cos_rotation_ * d.y + sin_rotation_ * d.x, d.z};
}

glm::vec3 ImageEnvironment::from_image(const glm::vec3& d) const {
    return {cos_rotation_ * d.x + sin_rotation_ * d.y, cos_rotation_ * d.y - sin_rotation_ * d.x, d.z};
}

glm::vec3 ImageEnvironment::radiance(const glm::vec3& direction) const {
    const EnvironmentImage& image = *image_;
    const glm::vec2 uv = lat_long_of(to_image(direction));
    const float x = uv.x * static_cast<float>(image.width) - 0.5f;
    const float y = uv.y * static_cast<float>(image.height) - 0.5f;
    const float left = std::floor(x);
    const float top = std::floor(y);
    const auto texel = [&](int column, int row) {
        const auto wrapped = static_cast<std::size_t>((column + image.width) % image.width);
        const auto clamped = static_cast<std::size_t>(std::clamp(row, 0, image.height - 1));
        return image.pixels[clamped * static_cast<std::size_t>(image.width) + wrapped];
    };
    const int column = static_cast<int>(left);
    const int row = static_cast<int>(top);
    const glm::vec3 above = glm::mix(texel(column, row), texel(column + 1, row), x - left);
    const glm::vec3 below = glm::mix(texel(column, row + 1), texel(column + 1, row + 1), x - left);
    return intensity_ * glm::mix(above, below, y - top);
}

std::vector<Cap> ImageEnvironment::bright_parts() const {
    std::vector<Cap> parts = image_->bright_parts;
    for (Cap& part : parts) part = part.about(from_image(part.axis()));
    return parts;
}

std::optional<DirectionSample> ImageEnvironment::sample(const glm::vec2& u) const {
    auto sampled = image_->distribution.sample(u);
    if (sampled) sampled->direction = from_image(sampled->direction);
    return sampled;
}

float ImageEnvironment::pdf(const glm::vec3& direction) const {
    return image_->distribution.pdf(to_image(direction));
}

}  // namespace phasetree::tracer
