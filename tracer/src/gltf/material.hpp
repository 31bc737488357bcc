// The materials of a glTF file as ours.
//
// glTF mixes two surfaces by a number, `metallic`: a diffuse one under a clear coat, and a metal. Ours are one of the
// two, by which there is more of in the mean.
//   * The dielectric is a `coated` material, whose coat has the index 1.5, or that of KHR_materials_ior, and whose base
//     is as bright as makes it look as glTF's colour under the coat (texture/tinted_mesh_image.hpp). α of GGX is the
//     square of glTF's roughness, as glTF has it, too.
//   * The metal is a conductor of the complex index 1 + ik, with k² = 4 r / (1 − r) for the reflectance r at normal
//     incidence, which glTF's colour is (Pharr, Jakob & Humphreys, *Physically Based Rendering*, 4th edition, has this
//     for conductors of a given reflectance). It has one colour, the mean of its image.
//   * What emits light is `glowing`, and reflects the rest diffusely.
// Clear materials (KHR_materials_transmission, or blended with an opacity below a half) have no counterpart: meshes are
// opaque, and what is clear belongs into the tree. Their triangles are left out.
#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gltf/document.hpp"
#include "image/texture_image.hpp"
#include "shading/material.hpp"

namespace phasetree::tracer::gltf {

/// Which texture coordinates of a mesh the images of a material are laid by, and how those become ours, of which (0, 0)
/// is an image's lower left corner.
struct Coordinates {
    std::size_t set = 0;
    glm::mat3 transform = from_upper_left();

    /// glTF's (0, 0) is the upper left corner.
    static glm::mat3 from_upper_left() { return {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0, 1, 1)}; }
};

struct NamedMaterial {
    std::string name;
    bool is_clear = false;  ///< then there is nothing else
    Material material{};
    std::optional<Coordinates> coordinates{};  ///< there are none without images
    std::vector<std::string> not_shown{};      ///< sentences about what is lost
};

/// Makes materials, with the images that several of them share.
class Materials {
  public:
    /// Refers to the document. `most_pixels` is how many all images may have.
    Materials(const Document& document, std::size_t most_pixels) : document_(document), pixels_left_(most_pixels) {}

    /// The material of that number, or glTF's own if there is none. `by_vertices` tells whether the mesh has colours of
    /// vertices. Throws GltfError.
    NamedMaterial make(const std::optional<std::size_t>& index, bool by_vertices, const Item& from);

  private:
    std::shared_ptr<const TextureImage> image(const Item& texture, ImageMeaning meaning, NamedMaterial& of);

    const Document& document_;
    std::size_t pixels_left_;
    std::map<std::pair<std::size_t, ImageMeaning>, std::shared_ptr<const TextureImage>> images_;
};

}  // namespace phasetree::tracer::gltf
