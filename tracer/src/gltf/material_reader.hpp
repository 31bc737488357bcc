// Reads the numbers and images of one glTF material, and lays the images on its mesh.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "gltf/images.hpp"
#include "gltf/material.hpp"

namespace phasetree::tracer::gltf {

glm::vec3 fraction(const glm::vec3& v);
float largest(const glm::vec3& v);
/// A number of an item, from 0 to 1.
float fraction_of(const Item& owner, std::string_view key, float otherwise);
/// 0 without the item.
float share_of(const std::optional<Item>& owner, std::string_view key);

class MaterialReader {
  public:
    /// Adds what is lost to `made`, and the texture coordinates that images use.
    MaterialReader(Images& images, const Item& item, NamedMaterial& made) : images_(images), item_(item), made_(made) {}

    const Item& item() const { return item_; }
    NamedMaterial& made() { return made_; }
    std::optional<Item> extension(std::string_view name) const { return item_.extension(name); }
    void note_loss(std::string sentence) { made_.not_shown.push_back(std::move(sentence)); }

    /// Reads the image of a texture. Reports an image in a format that is not read.
    std::optional<ReadImage> image(const std::optional<Item>& texture, ImageMeaning meaning);
    /// How an image is mapped onto meshes. The first image of a material determines the meshes' texture coordinates.
    /// The others use these, too, or a second set.
    ImageCoordinates lay(const Item& texture, const ReadImage& image);
    /// A factor times a channel of an image, if there is one: `at_0` where the channel is 0, `value` where it is 1.
    Number factor(const Item& owner, std::string_view texture_key, float value, int channel, ImageMeaning meaning,
                  float at_0 = 0);
    Texture color_factor(const Item& owner, std::string_view texture_key, const glm::vec3& value);
    /// The refractive index of a dielectric.
    float index() const;

  private:
    Images& images_;
    const Item& item_;
    NamedMaterial& made_;
};

}  // namespace phasetree::tracer::gltf
