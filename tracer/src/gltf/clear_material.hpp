// The clear materials of a glTF file: those that transmit light (KHR_materials_transmission).
//
// Reference: https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Khronos
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "gltf/document.hpp"
#include "gltf/images.hpp"
#include "shading/material.hpp"

namespace phasetree::tracer::gltf {

/// A clear material, in the numbers of glTF. Images are replaced by their mean.
struct ClearMaterial {
    float ior = 1.5f;
    float dispersion = 0;  ///< 20 divided by the Abbe number
    float roughness = 0;   ///< α of GGX is its square
    glm::vec3 tint{1};     ///< the base colour, by which light is multiplied at each crossing of the surface
    glm::vec3 attenuation_color{1};
    /// The distance after which white light has the attenuation colour; without it, light stays white.
    std::optional<float> attenuation_distance{};
    std::optional<SurfaceFilm> film{};
    std::optional<float> priority{};  ///< extras.phasetree_priority
    std::string matter{};             ///< extras.phasetree_matter; empty if there is none
};

/// Reads the material. Sentences about what is lost, or read approximately, are added to `not_shown`; each follows the
/// material's name. Throws GltfError.
ClearMaterial clear_material(const Item& material, Images& images, std::vector<std::string>& not_shown);

/// The number `phasetree_priority` in the extras of a node or a material.
std::optional<float> priority_of(const Item&);

/// The text `phasetree_matter` in the extras of a node or a material; empty if there is none.
std::string matter_of(const Item&);

}  // namespace phasetree::tracer::gltf
