// The strokes of brushed metal: a direction on the surface along which it is smoother than across. Highlights are
// elongated across the strokes because the microfacets slope in that direction.
//
// Strokes run along one direction, projected onto the surface, like those of a brush; or around an axis, like those of
// a lathe: at p along axis × (p − through). On a mesh from a glTF file, they may run at an angle to the tangents of its
// texture coordinates. Where none of these gives a direction on the surface (because the strokes are perpendicular to
// it, or on the axis), the direction is arbitrary.
//
// References: Ward, Measuring and Modeling Anisotropic Reflection, SIGGRAPH 1992; Heitz 2014 (sampling/ggx.hpp) for
// stretched microfacets.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "shading/texture/texture_point.hpp"

namespace phasetree::tracer {

struct Grain {
    glm::vec3 axis{1.0f, 0.0f, 0.0f};    ///< direction of the strokes, or axis around which they run; in object space,
                                         ///< or in scene space for a mesh
    std::optional<glm::vec3> through{};  ///< a point of the axis around which strokes run
    float aspect = 0.2f;                 ///< roughness along the strokes over that across, at most 1
    /// The components along a mesh's tangent and bitangent, instead of the axis; scene files cannot set it.
    std::optional<glm::vec2> in_tangents{};

    /// The direction of the strokes, which may point out of the surface and has any length.
    glm::vec3 direction_at(const TexturePoint& place) const {
        if (in_tangents)
            return place.mesh ? in_tangents->x * place.mesh->tangent + in_tangents->y * place.mesh->bitangent
                              : glm::vec3(0.0f);
        return through ? glm::cross(axis, place.position - *through) : axis;
    }
};

}  // namespace phasetree::tracer
