#include "image/texture_image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <stdexcept>

#include "image/kept_images.hpp"
#include "image/read_image.hpp"
#include "image/srgb.hpp"

namespace phasetree::tracer {

namespace {

constexpr float most = 65535.0f;

std::uint16_t stored(float value) {
    // NaN becomes black.
    return static_cast<std::uint16_t>(value > 0.0f ? std::min(value, 1.0f) * most + 0.5f : 0.0f);
}

int wrapped(int i, int count) {
    const int rest = i % count;
    return rest < 0 ? rest + count : rest;
}

}  // namespace

glm::vec3 TextureImage::pixel(int column, int row) const {
    const auto index = static_cast<std::size_t>(wrapped(row, height_)) * static_cast<std::size_t>(width_) +
                       static_cast<std::size_t>(wrapped(column, width_));
    return decoded(pixels_[index]);
}

glm::vec3 TextureImage::decoded(const Pixel& p) {
    return glm::vec3(p[0], p[1], p[2]) / most;
}

glm::vec2 TextureImage::range(int channel) const {
    const auto at = [&](const Pixel& p) { return p[static_cast<std::size_t>(channel)]; };
    const auto [low, high] = std::ranges::minmax_element(pixels_, {}, at);
    return {decoded(*low)[channel], decoded(*high)[channel]};
}

float TextureImage::share_above(float value) const {
    const auto is_above = [&](const Pixel& p) {
        return static_cast<float>(std::max({p[0], p[1], p[2]})) / most >= value;
    };
    return static_cast<float>(std::ranges::count_if(pixels_, is_above)) / static_cast<float>(pixels_.size());
}

glm::vec3 TextureImage::mean() const {
    glm::dvec3 sum(0);
    for (const Pixel& p : pixels_) sum += glm::dvec3(decoded(p));
    return glm::vec3(sum / static_cast<double>(pixels_.size()));
}

glm::vec3 TextureImage::at(const glm::vec2& uv) const {
    // Reduce to one repeat first, so that the pixel index stays small however often the image repeats.
    const float x = (uv.x - std::floor(uv.x)) * static_cast<float>(width_) - 0.5f;
    const float y = (std::ceil(uv.y) - uv.y) * static_cast<float>(height_) - 0.5f;
    if (!std::isfinite(x) || !std::isfinite(y)) return pixel(0, 0);
    const float left = std::floor(x), top = std::floor(y);
    const int column = static_cast<int>(left), row = static_cast<int>(top);
    const glm::vec3 above = glm::mix(pixel(column, row), pixel(column + 1, row), x - left);
    const glm::vec3 below = glm::mix(pixel(column, row + 1), pixel(column + 1, row + 1), x - left);
    return glm::mix(above, below, y - top);
}

namespace {

// Collects the rows of an image while it is read.
class TakenImage {
  public:
    explicit TakenImage(ImageMeaning meaning) : meaning_(meaning) {}

    ChannelRange begin(const ImageHeader& read) {
        if (read.width > largest_texture_image || read.height > largest_texture_image)
            throw std::runtime_error(fmt::format("it is larger than {0} × {0}", largest_texture_image));
        header_ = read;
        if (meaning_ != ImageMeaning::alpha) return static_cast<int>(channels());
        if (read.channels % 2 != 0) throw std::runtime_error("it has no alpha channel");
        return {read.channels < 4 ? 1 : 3, 1};
    }
    void add(std::span<const float> values) {
        for (std::size_t i = 0; i + channels() <= values.size(); i += channels()) {
            const std::uint16_t first = linear(values[i]);
            if (channels() == 1)
                pixels_.push_back({first, first, first});
            else
                pixels_.push_back({first, linear(values[i + 1]), linear(values[i + 2])});
        }
    }
    TextureImage image() && { return {header_.width, header_.height, std::move(pixels_)}; }

  private:
    std::size_t channels() const { return meaning_ == ImageMeaning::alpha || header_.channels < 3 ? 1 : 3; }
    std::uint16_t linear(float v) const {
        const bool is_encoded = meaning_ == ImageMeaning::colors && !header_.is_floating_point;
        return stored(is_encoded ? linear_from_srgb(v) : v);
    }

    ImageMeaning meaning_;
    ImageHeader header_;
    std::vector<std::array<std::uint16_t, 3>> pixels_;
};

std::shared_ptr<const TextureImage> loaded(const std::filesystem::path& file, ImageMeaning meaning) {
    TakenImage taken(meaning);
    try {
        read_image(
            file, "texture image", [&](const ImageHeader& header) { return taken.begin(header); },
            [&](std::span<const float> values) { taken.add(values); });
    } catch (const std::runtime_error& e) {
        throw ParameterError("file", e.what());
    }
    return std::make_shared<const TextureImage>(std::move(taken).image());
}

}  // namespace

std::shared_ptr<const TextureImage> load_texture_image(const std::filesystem::path& file, ImageMeaning meaning) {
    KeptImages* kept = KeptImages::of_thread();
    return kept ? kept->get(file, meaning, [&] { return loaded(file, meaning); }) : loaded(file, meaning);
}

TextureImage texture_image_in_memory(std::string_view bytes, const std::string& name, ImageMeaning meaning) {
    TakenImage taken(meaning);
    read_image_in_memory(
        bytes, name, "texture image", [&](const ImageHeader& header) { return taken.begin(header); },
        [&](std::span<const float> values) { taken.add(values); });
    return std::move(taken).image();
}

}  // namespace phasetree::tracer
