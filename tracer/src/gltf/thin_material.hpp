// Thin materials of a glTF file: panes (KHR_materials_transmission without KHR_materials_volume) and sheets that
// transmit light diffusely (KHR_materials_diffuse_transmission).
//
// glTF's pane reflects at one face and multiplies transmitted light by its base colour. A `thin_glass` of that colour
// also has the reflections of the other face and between both.
//
// Reference: https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Khronos
#pragma once

#include "gltf/document.hpp"
#include "shading/material.hpp"

namespace phasetree::tracer::gltf {

/// What becomes of materials that transmit light but have no volume.
enum class ReadPanes { as_thin_glass, as_clear };

/// Whether a material with KHR_materials_transmission has a volume inside; otherwise its surfaces are panes.
bool has_volume(const Item& material);

/// The material, of which this share is a pane instead: all of it, or a mixture.
Material with_pane(Material opaque, ThinGlass pane, const Number& share);

/// A diffuse material of this colour, of which a share transmits light in another colour instead.
Material with_diffuse_transmission(const Diffuse& opaque, const TintedMeshImage& color, const Texture& transmitted,
                                   const Number& share);

}  // namespace phasetree::tracer::gltf
