// What a scene says of a phase or a mesh: plain values, no behaviour.
//
// Clear materials carry light inside; the others are opaque and show a surface only. `roughness` is the α of GGX: 0 is
// polished, 0.1 satin, 0.5 matt. Below 0.001 a surface is treated as perfectly smooth, which no eye tells apart.
#pragma once

#include <glm/vec3.hpp>
#include <variant>

#include "shading/texture/texture.hpp"

namespace phasetree::tracer {

// Vacuum, air, water, glass.
struct Clear {
    float ior = 1.0f;            // refractive index against vacuum, greater than 0
    glm::vec3 absorption{0.0f};  // a in the transmittance exp(−a d), per unit length of the scene
    float roughness = 0.0f;
};

struct Diffuse {
    Texture color = ConstantTexture{};
};

// Metal, with the complex index against vacuum; metals.hpp has measured ones.
struct Conductor {
    glm::vec3 eta{1.0f};
    glm::vec3 k{0.0f};
    float roughness = 0.0f;
};

// Varnished or glazed: a clear coat over a diffuse base.
struct Coated {
    Texture color = ConstantTexture{};
    float ior = 1.5f;  // of the coat, against vacuum
    float roughness = 0.0f;
};

using Material = std::variant<Clear, Diffuse, Conductor, Coated>;

inline Material vacuum() {
    return Clear{};
}

inline bool is_clear(const Material& material) {
    return std::holds_alternative<Clear>(material);
}

}  // namespace phasetree::tracer
