// The glTF materials that become `principled`: those with a clear coat, sheen, specular factors, anisotropy or
// iridescence.
#pragma once

#include <optional>

#include "gltf/material_reader.hpp"
#include "shading/material.hpp"

namespace phasetree::tracer::gltf {

/// The surface that all glTF materials have: a mixture of a dielectric and a metal.
struct BaseSurface {
    TintedMeshImage color;
    Number metallic = 1.0f;
    Number roughness = 1.0f, alpha = 1.0f;  ///< alpha is that of GGX, the square
    float mean_roughness = 1.0f;
};

/// A surface whose metallic factor exceeds this everywhere counts as metal.
inline constexpr float nearly_all_metal = 0.99f;

/// Whether one of its extensions needs `principled`. `pbr` is its base, pbrMetallicRoughness.
bool has_layers(const Item& material, const Item& pbr);

/// The base with all layers. Mixed if the dielectric has specular factors.
Material layered_material(MaterialReader& reader, const BaseSurface& base, const std::optional<NormalMap>& normals,
                          std::optional<Glowing> glowing);

}  // namespace phasetree::tracer::gltf
