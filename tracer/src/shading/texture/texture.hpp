// The list of all textures, and a texture of any kind by value.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <variant>

#include "phasetree/model/concepts.hpp"
#include "shading/texture/checker.hpp"
#include "shading/texture/constant.hpp"
#include "shading/texture/contract.hpp"
#include "shading/texture/marble.hpp"
#include "shading/texture/speckle.hpp"
#include "shading/texture/wood.hpp"

namespace phasetree::tracer {

// Those that a scene file names, with their parameters: one list, from which the reader, the reference and the schema
// follow. A colour by itself is the constant one.
using SolidTextures = TypeList<WoodTexture, SpeckleTexture, MarbleTexture, CheckerTexture>;

/// A kind of texture, once its contract has been asked of it. If it does not meet that, the message names the kind and
/// the member.
template <class Kind>
struct CheckedTexture {
    static_assert(TextureKind<Kind>);
    using Type = Kind;
};

template <class... Kinds>
using TextureOf = std::variant<typename CheckedTexture<Kinds>::Type...>;

template <class... Solids>
TextureOf<ConstantTexture, Solids...> variant_of_textures(TypeList<Solids...>);

/// Every kind of texture.
using Texture = decltype(variant_of_textures(SolidTextures()));

/// The texture's colour at a point, for any point whatever: TextureKind's at() is asked within its limits only.
inline glm::vec3 color_at(const Texture& texture, const glm::vec3& position) {
    // Where floats resolve no texture any more, and for what is no position, it is the colour of the origin.
    const bool near = std::abs(position.x) < 1e9f && std::abs(position.y) < 1e9f && std::abs(position.z) < 1e9f;
    return std::visit([&](const auto& kind) { return kind.at(near ? position : glm::vec3{0.0f}); }, texture);
}

}  // namespace phasetree::tracer
