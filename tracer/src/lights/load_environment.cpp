#include "lights/load_environment.hpp"

#include <OpenImageIO/imageio.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <utility>
#include <vector>

namespace phasetree::tracer {

namespace {

// sRGB's electro-optical transfer function (IEC 61966-2-1).
float linear_from_srgb(float value) {
    return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

std::runtime_error problem(const std::string& path, const std::string& what) {
    return std::runtime_error("cannot use the environment image \"" + path + "\": " + what.substr(0, what.find('\n')));
}

}  // namespace

ImageEnvironment load_environment(const std::string& path, float rotation_degrees, float intensity) {
    // The library's own messages for these two are long and speak of formats and plug-ins.
    std::error_code ignored;
    if (!std::filesystem::exists(path, ignored)) throw problem(path, "there is no such file");
    if (!std::filesystem::is_regular_file(path, ignored)) throw problem(path, "it is not a file");

    const auto input = OIIO::ImageInput::open(path);
    if (!input) throw problem(path, OIIO::geterror());
    const OIIO::ImageSpec spec = input->spec();
    constexpr std::int64_t most_pixels = std::int64_t{1} << 27;  // 16,384 × 8,192
    const auto pixels_in_file = static_cast<std::int64_t>(spec.width) * spec.height;
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1) throw problem(path, "it is empty");
    if (spec.depth > 1) throw problem(path, "it is a volume, not an image");
    // A pixel either way is what resizing leaves; more is another projection, such as a cube map or an angular map.
    if (std::abs(spec.width / 2 - spec.height) > 1) {
        throw problem(path, "a lat-long image is twice as wide as high, this one is " + std::to_string(spec.width) +
                                " × " + std::to_string(spec.height));
    }
    if (pixels_in_file > most_pixels) throw problem(path, "it is larger than 16384 × 8192");
    std::vector<glm::vec3> pixels(static_cast<std::size_t>(pixels_in_file));
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    const bool grey = spec.nchannels < 3;
    if (!input->read_image(0, 0, 0, grey ? 1 : 3, OIIO::TypeDesc::FLOAT, pixels.data(), sizeof(glm::vec3))) {
        throw problem(path, input->geterror());
    }
    const bool encoded = !spec.format.is_floating_point();
    for (glm::vec3& pixel : pixels) {
        if (grey) pixel = glm::vec3(pixel.r);
        if (encoded) pixel = {linear_from_srgb(pixel.r), linear_from_srgb(pixel.g), linear_from_srgb(pixel.b)};
    }
    return {spec.width, spec.height, std::move(pixels), rotation_degrees, intensity};
}

}  // namespace phasetree::tracer
