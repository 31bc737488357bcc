#include "view/layer.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <string_view>

#include "film/film.hpp"

namespace phasetree::tracer::view {

namespace {

std::string_view layer_of(std::string_view channel) {
    return channel.substr(0, channel.rfind('.'));
}

std::vector<const Channel*> channels_of(const Image& image, std::string_view layer) {
    std::vector<const Channel*> found;
    for (const Channel& channel : image.extra_channels)
        if (layer_of(channel.name) == layer) found.push_back(&channel);
    return found;
}

glm::vec3 three_of(const std::vector<const Channel*>& channels, std::size_t pixel) {
    return {channels[0]->values[pixel], channels[1]->values[pixel], channels[2]->values[pixel]};
}

// A distinct colour per number: hues spaced by the golden ratio.
glm::vec3 colour_of_number(std::uint32_t number) {
    const double turns = number * 0.6180339887498949;
    const auto hue = static_cast<float>(turns - std::floor(turns));
    glm::vec3 colour;
    for (int i = 0; i < 3; ++i) {
        const float from = hue + static_cast<float>(i) / 3.0f;
        colour[i] = glm::clamp(std::fabs(6 * (from - std::floor(from)) - 3) - 1, 0.0f, 1.0f);
    }
    return 0.25f + 0.7f * colour;
}

// Excludes the depth of pixels that hit nothing, which is so large that everything else would be black.
bool is_something(float value) {
    return std::isfinite(value) && value < no_depth;
}

std::vector<glm::vec3> grey(const std::vector<float>& values) {
    float most = 0;
    for (const float v : values)
        if (is_something(v)) most = std::max(most, v);
    std::vector<glm::vec3> pixels;
    for (const float v : values)
        pixels.emplace_back(is_something(v) && most > 0 ? glm::clamp(v / most, 0.0f, 1.0f) : 0.0f);
    return pixels;
}

std::vector<glm::vec3> depths(const std::vector<float>& values) {
    constexpr float farthest = 0.1f;  // so that the farthest surface differs from pixels that hit nothing
    float least = no_depth, most = 0;
    for (const float v : values)
        if (is_something(v)) {
            least = std::min(least, v);
            most = std::max(most, v);
        }
    std::vector<glm::vec3> pixels;
    for (const float v : values) {
        const float share = most > least ? (most - v) / (most - least) : 1.0f;
        pixels.emplace_back(is_something(v) ? farthest + (1 - farthest) * share : 0.0f);
    }
    return pixels;
}

std::vector<glm::vec3> numbers(const std::vector<float>& values) {
    std::vector<glm::vec3> pixels;
    for (const float v : values)
        pixels.push_back(v >= 0 ? colour_of_number(static_cast<std::uint32_t>(v)) : glm::vec3(0));
    return pixels;
}

bool holds_numbers(std::string_view layer) {
    return layer == PhaseLeftPlane::name || layer == PhaseEnteredPlane::name || layer == ObjectPlane::name ||
           layer == InstancePlane::name;
}

}  // namespace

std::vector<FilmLayer> layers_of_film(const SceneNames& scene_names) {
    std::vector<FilmLayer> layers;
    for (std::size_t plane = 1; plane < Planes::size; ++plane) {
        Planes::Choice choice;
        choice[0] = choice[plane] = true;
        const FilmTile tile({0, 0, 1, 1}, choice, scene_names);
        const std::vector<std::string> channels = tile.channels();
        for (std::size_t i = 3; i < channels.size(); ++i) {
            const std::string name(layer_of(channels[i]));
            const bool is_further_rank = Planes::names[plane].starts_with("crypto_") && !name.ends_with("00");
            if (!is_further_rank && (layers.empty() || layers.back().name != name)) layers.push_back({name, plane});
        }
    }
    return layers;
}

std::vector<glm::vec3> layer_on_display(const Image& image, const std::string& layer, const DisplayTransform& display,
                                        const glm::vec3& centre, float radius) {
    const std::vector<const Channel*> channels = channels_of(image, layer);
    if (channels.empty()) return std::vector<glm::vec3>(image.pixels.size(), glm::vec3(0));
    if (holds_numbers(layer)) return numbers(channels[0]->values);
    if (layer == DepthPlane::name || layer == DepthBehindPlane::name) return depths(channels[0]->values);
    if (channels.size() < 3) return grey(channels[0]->values);

    std::vector<glm::vec3> pixels;
    const bool is_cryptomatte = channels.size() == 4;
    const bool is_colour = channels[0]->name.ends_with(".R");
    const bool is_position = layer.starts_with(PositionPlane::name);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const glm::vec3 v = three_of(channels, i);
        if (is_cryptomatte)
            // The first channel holds the bits of a number as a float, the second its coverage of the pixel.
            pixels.push_back(v.y * colour_of_number(std::bit_cast<std::uint32_t>(v.x)));
        else if (is_colour)
            pixels.push_back(v);
        else
            pixels.push_back(glm::clamp(0.5f + 0.5f * (is_position ? (v - centre) / radius : v), 0.0f, 1.0f));
    }
    if (is_colour && !is_cryptomatte) display.apply(pixels);
    return pixels;
}

}  // namespace phasetree::tracer::view
