// Converts the materials of a glTF file.
//
// glTF mixes two surfaces by a number, `metallic`: a diffuse one under a clear coat, and a metal. If the number is not
// 0 everywhere or 1 everywhere, the material becomes a `mix` of the two by that number.
//   * The dielectric is a `coated` material, whose coat has the index 1.5, or that of KHR_materials_ior, and whose base
//     is chosen so that it looks like glTF's colour under the coat (texture/tinted_mesh_image.hpp). As in glTF, α of
//     GGX is the square of the roughness.
//   * The metal is a conductor whose reflectance at normal incidence is glTF's colour.
//   * A material with a clear coat, sheen, specular factors, anisotropy or iridescence is `principled`
//     (shading/bsdf/principled.hpp), and may emit light, too. Other materials avoid the cost of its tables.
//   * Any other material that emits light is `glowing`. It reflects the rest diffusely, whatever its roughness. If an
//     image makes most of it dark, such as the lamps of a machine, it does not emit.
//   * Where the alpha of its colour counts, meshes have holes, or let the fraction 1 − alpha of the light through
//   (shading/opacity.hpp).
//   * What transmits light without a volume is, or is mixed with, thin_glass or thin_diffuse (thin_material.hpp).
// Clear materials (a KHR_materials_transmission of a half and more, with a volume) have no counterpart: meshes do not
// refract. They become phases of a tree instead (clear_material.hpp).
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "gltf/clear_material.hpp"
#include "gltf/document.hpp"
#include "gltf/images.hpp"
#include "gltf/thin_material.hpp"
#include "shading/material.hpp"
#include "shading/opacity.hpp"

namespace phasetree::tracer::gltf {

struct NamedMaterial {
    std::string name;
    bool is_clear = false;                 ///< if so, only the name, `clear` and not_shown are set
    bool is_pane = false;                  ///< in part at least
    std::optional<ClearMaterial> clear{};  ///< of a clear material, if these are requested
    Material material{};
    std::optional<Opacity> opacity{};          ///< nullopt is opaque everywhere
    std::optional<Coordinates> coordinates{};  ///< nullopt without images
    /// The number in the file of a second set of texture coordinates, for images that cannot be mapped by the first.
    std::optional<std::size_t> second_set{};
    std::vector<std::string> not_shown{};   ///< sentences about what is lost
    std::vector<std::string> extensions{};  ///< the names of its extensions
};

class Materials {
  public:
    /// Refers to the document. `most_pixels` is the maximum number of pixels of all images together. `wants_clear`:
    /// whether to read clear materials; otherwise they are only recognised.
    Materials(const Document& document, std::size_t most_pixels, ReadPanes panes, bool wants_clear = false)
        : document_(document), images_(document, most_pixels), panes_(panes), wants_clear_(wants_clear) {}

    /// The material with this index, or glTF's default material if there is none. `by_vertices`: whether the mesh has
    /// vertex colours. If so, there is an opacity wherever alpha counts, even if only the vertices' alpha differs from
    /// 1. Throws GltfError.
    NamedMaterial make(const std::optional<std::size_t>& index, bool by_vertices, const Item& from);

  private:
    class Maker;

    const Document& document_;
    Images images_;
    ReadPanes panes_;
    bool wants_clear_;
};

}  // namespace phasetree::tracer::gltf
