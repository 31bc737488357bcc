// The list of all textures, and a texture of any kind by value.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>
#include <variant>

#include "phasetree/model/concepts.hpp"
#include "shading/texture/checker.hpp"
#include "shading/texture/constant.hpp"
#include "shading/texture/contract.hpp"
#include "shading/texture/field.hpp"
#include "shading/texture/image.hpp"
#include "shading/texture/marble.hpp"
#include "shading/texture/measured.hpp"
#include "shading/texture/mesh_image.hpp"
#include "shading/texture/per_copy.hpp"
#include "shading/texture/speckle.hpp"
#include "shading/texture/tinted_mesh_image.hpp"
#include "shading/texture/vertex_color.hpp"
#include "shading/texture/wood.hpp"

namespace phasetree::tracer {

// Textures in scene files, with their parameters: the list from which the reader, the reference and the schema are
// generated. A bare colour is the constant texture.
using NamedTextures = TypeList<WoodTexture, SpeckleTexture, MarbleTexture, CheckerTexture, FieldTexture, ImageTexture,
                               MeshImageTexture, VertexColorTexture, MeasuredTexture, PerCopyTexture>;

template <TextureKind... Kinds>
using TextureOf = std::variant<Kinds...>;

template <class... Named>
TextureOf<ConstantTexture, TintedMeshImage, Named...> variant_of_textures(TypeList<Named...>);

/// Every kind of texture.
using Texture = decltype(variant_of_textures(NamedTextures()));

struct TextureStop {
    float at;
    Texture texture;
};

/// The texture's colour at any point, in the components of a path. Calls TextureKind's at() only within its limits.
inline glm::vec3 color_at(const Texture& texture, TexturePoint point, const Wavelengths* wavelengths = nullptr) {
    // Positions beyond the resolution of floats, and NaN, have the colour of the origin.
    const glm::vec3& p = point.position;
    if (!(std::abs(p.x) < 1e9f && std::abs(p.y) < 1e9f && std::abs(p.z) < 1e9f)) point.position = glm::vec3(0.0f);
    return std::visit(
        [&]<class Kind>(const Kind& kind) {
            constexpr bool is_solid = requires {
                kind.at(point.position);
            }
            &&!requires {
                kind.at(point);
            };
            const auto& place = [&]() -> const auto& {
                if constexpr (is_solid)
                    return point.position;
                else
                    return point;
            }
            ();
            if constexpr (requires { kind.at(place, *wavelengths); }) {
                if (wavelengths) return kind.at(place, *wavelengths);
                return kind.at(place);
            } else {
                return for_light(kind.at(place), wavelengths);
            }
        },
        texture);
}

/// Whether a texture is of a kind, or contains one. A MeshImageTexture requires a mesh whose file has texture
/// coordinates, a VertexColorTexture one whose file has colours.
template <class Wanted>
bool has_kind(const Texture& texture) {
    return std::visit(
        []<class Kind>(const Kind& kind) {
            if constexpr (requires { kind.ramp; })
                return std::ranges::any_of(*kind.ramp,
                                           [](const TextureStop& stop) { return has_kind<Wanted>(stop.texture); });
            else
                return std::is_same_v<Kind, Wanted>;
        },
        texture);
}

}  // namespace phasetree::tracer
