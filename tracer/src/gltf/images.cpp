#include "gltf/images.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "image/kept_images.hpp"

namespace phasetree::tracer::gltf {

namespace {

constexpr std::size_t repeat = 10497;  // the number that glTF has for it, from OpenGL
constexpr float faintest = 0.01f;

bool repeats(const Document& document, const Item& source) {
    const auto number = source.index("sampler");
    if (!number) return true;
    const Item sampler = document.element("samplers", *number, source);
    return sampler.index("wrapS").value_or(repeat) == repeat && sampler.index("wrapT").value_or(repeat) == repeat;
}

}  // namespace

// glTF's texture coordinates have (0, 0) at the upper left corner of an image, and v points down. KHR_texture_transform
// scales them, then rotates them counter-clockwise as seen in these axes, then moves them. (The matrix in its
// specification rotates the other way. Issue 1563 of KhronosGroup/glTF confirms that this is a mistake, and other
// programs rotate as here.)
Coordinates coordinates_of(const Item& texture) {
    Coordinates c;
    c.set = texture.index("texCoord").value_or(0);
    const auto t = texture.extension("KHR_texture_transform");
    if (!t) return c;
    c.set = t->index("texCoord").value_or(c.set);
    const auto offset = t->numbers("offset", 2), scale = t->numbers("scale", 2);
    const float angle = t->number("rotation", 0), cosine = std::cos(angle), sine = std::sin(angle);
    glm::mat3 transform(1);
    if (scale) transform = glm::mat3(glm::vec3((*scale)[0], 0, 0), glm::vec3(0, (*scale)[1], 0), glm::vec3(0, 0, 1));
    transform = glm::mat3(glm::vec3(cosine, -sine, 0), glm::vec3(sine, cosine, 0), glm::vec3(0, 0, 1)) * transform;
    if (offset) transform[2] += glm::vec3((*offset)[0], (*offset)[1], 0);
    c.transform = Coordinates::from_upper_left() * transform;
    return c;
}

std::optional<ReadImage> Images::read(const Item& texture, ImageMeaning meaning) {
    const Item source = document_.element("textures", texture.needed_index("index"), texture);
    const auto number = source.index("source");
    if (!number) return std::nullopt;
    ReadImage& read = images_[{*number, meaning}];
    if (read.is_missing) return std::nullopt;
    if (!read.image) {
        const Item item = document_.element("images", *number, source);
        const std::string bytes = document_.image(item);
        const auto load = [&] {
            return std::make_shared<const TextureImage>(
                texture_image_in_memory(bytes, fmt::format("images[{}]", *number), meaning));
        };
        try {
            KeptImages* kept = KeptImages::of_thread();
            read.image = kept ? kept->get_embedded(bytes, meaning, load) : load();
        } catch (const std::runtime_error& e) {
            if (meaning == ImageMeaning::alpha) {
                read.is_missing = true;
                return std::nullopt;
            }
            throw GltfError(e.what());
        }
        if (read.image->pixels() > pixels_left_)
            throw GltfError(
                fmt::format("its images have more than {} million pixels in total", most_pixels_ / 1'000'000));
        pixels_left_ -= read.image->pixels();
        read.mean = read.image->mean();
        read.green = read.image->range(1);
        read.blue = read.image->range(2);
        read.lit_share = read.image->share_above(faintest);
    }
    ReadImage found = read;
    found.repeats = repeats(document_, source);
    return found;
}

}  // namespace phasetree::tracer::gltf
