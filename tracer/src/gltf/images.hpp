// The images of a glTF file, each read only once, and how they are mapped onto meshes.
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

/// The texture coordinates by which an image is mapped onto a mesh, and their transform to ours, in which (0, 0) is the
/// image's lower left corner.
struct Coordinates {
    std::size_t set = 0;
    glm::mat3 transform = from_upper_left();

    /// glTF's (0, 0) is the upper left corner.
    static glm::mat3 from_upper_left() { return {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0, 1, 1)}; }
    bool operator==(const Coordinates&) const = default;
};

/// The coordinates of a material's reference to a texture (KHR_texture_transform).
Coordinates coordinates_of(const Item& texture);

struct ReadImage {
    std::shared_ptr<const TextureImage> image;
    glm::vec3 mean{0};   ///< of all pixels
    glm::vec2 green{0};  ///< the minimum and the maximum of the second channel
    glm::vec2 blue{0};   ///< the same for the third channel
    /// The range of the second channel, enlarged to multiples of a quarter, so that images can share the tables made
    /// for a range.
    glm::vec2 green_in_quarters() const { return {std::floor(4 * green.x) / 4, std::ceil(4 * green.y) / 4}; }
    float lit_share = 0;      ///< the fraction of pixels in which a channel is at least 0.01, linear
    bool is_missing = false;  ///< alpha was requested, but the image has none; the other members are not set
    bool repeats = true;      ///< whether the file repeats it beyond its edges, as phasetree does
};

class Images {
  public:
    /// Refers to the document. `most_pixels` is the maximum number of pixels of all images together.
    Images(const Document& document, std::size_t most_pixels)
        : document_(document), most_pixels_(most_pixels), pixels_left_(most_pixels) {}

    /// The image of a material's reference to a texture; nullopt if the texture has no image that can be read, or none
    /// with alpha if that is requested. Throws GltfError. An image that is requested with two meanings is read twice,
    /// and counts twice.
    std::optional<ReadImage> read(const Item& texture, ImageMeaning meaning);

  private:
    const Document& document_;
    std::size_t most_pixels_, pixels_left_;
    std::map<std::pair<std::size_t, ImageMeaning>, ReadImage> images_;
};

}  // namespace phasetree::tracer::gltf
