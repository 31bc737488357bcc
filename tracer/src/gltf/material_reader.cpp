#include "gltf/material_reader.hpp"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

namespace phasetree::tracer::gltf {

namespace {

bool is_invertible(const glm::mat3& m) {
    constexpr float smallest = 1e-12f;
    return std::abs(glm::determinant(m)) > smallest;
}

}  // namespace

glm::vec3 fraction(const glm::vec3& v) {
    return glm::clamp(v, glm::vec3(0), glm::vec3(1));
}

float largest(const glm::vec3& v) {
    return std::max({v.x, v.y, v.z});
}

float fraction_of(const Item& owner, std::string_view key, float otherwise) {
    return std::clamp(owner.number(key, otherwise), 0.0f, 1.0f);
}

float share_of(const std::optional<Item>& owner, std::string_view key) {
    return owner ? fraction_of(*owner, key, 0) : 0.0f;
}

std::optional<ReadImage> MaterialReader::image(const std::optional<Item>& texture, ImageMeaning meaning) {
    if (!texture) return std::nullopt;
    const auto read = images_.read(*texture, meaning);
    if (!read && meaning != ImageMeaning::alpha)
        note_loss("has an image in an unsupported format, which is ignored; use PNG or JPEG");
    return read;
}

ImageCoordinates MaterialReader::lay(const Item& texture, const ReadImage& image) {
    if (!image.repeats) note_loss("has an image that must not repeat; it is rendered as repeating");
    const Coordinates wanted = coordinates_of(texture);
    if (!made_.coordinates) made_.coordinates = wanted;
    const Coordinates& first = *made_.coordinates;
    if (first == wanted) return {};
    if (first.set == wanted.set && is_invertible(first.transform))
        return {.is_second = false, .transform = glm::mat3x2(wanted.transform * glm::inverse(first.transform))};
    if (!made_.second_set) made_.second_set = wanted.set;
    if (*made_.second_set != wanted.set) {
        note_loss("uses more than two sets of texture coordinates; one image is mapped by another set");
        return {};
    }
    ImageCoordinates second{.is_second = true};
    if (wanted.transform != Coordinates::from_upper_left())
        second.transform = glm::mat3x2(wanted.transform * glm::inverse(Coordinates::from_upper_left()));
    return second;
}

Number MaterialReader::factor(const Item& owner, std::string_view texture_key, float value, int channel,
                              ImageMeaning meaning, float at_0) {
    const auto texture = owner.item(texture_key);
    const auto read = image(texture, meaning);
    if (!read) return value;
    const glm::vec2 range = read->image->range(channel);
    // Ranges are rounded to quarters, so that images share tables.
    return MeshImageNumber{.range = {at_0, value},
                           .image = read->image,
                           .of_image = {std::floor(4 * range.x) / 4, std::ceil(4 * range.y) / 4},
                           .channel = channel,
                           .coordinates = lay(*texture, *read)};
}

Texture MaterialReader::color_factor(const Item& owner, std::string_view texture_key, const glm::vec3& value) {
    const auto texture = owner.item(texture_key);
    const auto read = image(texture, ImageMeaning::colors);
    if (!read) return ConstantTexture{fraction(value)};
    return TintedMeshImage{.factor = fraction(value), .image = read->image, .coordinates = lay(*texture, *read)};
}

float MaterialReader::index() const {
    const auto ior_extension = extension("KHR_materials_ior");
    // In glTF, 0 means that other extensions determine the reflection.
    const float wanted = ior_extension ? ior_extension->number("ior", 1.5f) : 1.5f;
    return wanted > 0 ? std::clamp(wanted, 1.01f, 4.0f) : 1.5f;
}

}  // namespace phasetree::tracer::gltf
