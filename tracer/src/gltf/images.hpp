// The images of a glTF file, each read once, and how they lie on meshes.
#pragma once

#include <cmath>
#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "gltf/document.hpp"
#include "image/texture_image.hpp"

namespace phasetree::tracer::gltf {

/// By which texture coordinates of a mesh an image is laid on it, and how these become ours, of which (0, 0) is the
/// image's lower left corner.
struct Coordinates {
    std::size_t set = 0;
    glm::mat3 transform = from_upper_left();

    /// glTF's (0, 0) is the upper left corner.
    static glm::mat3 from_upper_left() { return {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0, 1, 1)}; }
    bool operator==(const Coordinates&) const = default;
};

/// Those of a material's reference to a texture (KHR_texture_transform).
Coordinates coordinates_of(const Item& texture);

struct ReadImage {
    std::shared_ptr<const TextureImage> image;
    glm::vec3 mean{0};   ///< of all pixels
    glm::vec2 green{0};  ///< the least and the greatest value of the second channel
    glm::vec2 blue{0};   ///< and of the third
    /// The range of the second channel, widened to quarters, so that images share the tables that are made for a range.
    glm::vec2 green_in_quarters() const { return {std::floor(4 * green.x) / 4, std::ceil(4 * green.y) / 4}; }
    float lit_share = 0;      ///< the part of the pixels of which a channel is at least 0.01, linear
    bool is_missing = false;  ///< then there is nothing else: alpha was wanted, and there is none
    bool repeats = true;      ///< whether the file, too, repeats it beyond its edges
};

class Images {
  public:
    /// Refers to the document. `most_pixels` is how many all images may have.
    Images(const Document& document, std::size_t most_pixels)
        : document_(document), most_pixels_(most_pixels), pixels_left_(most_pixels) {}

    /// The image of a material's reference to a texture; nothing if the texture has none that can be read, or none with
    /// alpha where that is wanted. Throws GltfError. An image that is wanted with two meanings is read twice, and
    /// counts twice.
    std::optional<ReadImage> read(const Item& texture, ImageMeaning meaning);

  private:
    const Document& document_;
    std::size_t most_pixels_, pixels_left_;
    std::map<std::pair<std::size_t, ImageMeaning>, ReadImage> images_;
};

}  // namespace phasetree::tracer::gltf
