// The strokes of brushed metal: a direction on the surface along which it is smoother than across. Highlights are drawn
// out across the strokes, because the slopes of the microfacets lie across them.
//
// Strokes run along one direction, projected onto the surface, as those of a brush; or around an axis, as those of a
// lathe: at p along axis × (p − through). Where that has no direction on the surface (where the surface is
// perpendicular to the strokes, or on the axis) any direction is taken.
//
// References: Ward, Measuring and Modeling Anisotropic Reflection, SIGGRAPH 1992; Heitz 2014 (sampling/ggx.hpp) for
// microfacets that are stretched.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "shading/texture/texture_point.hpp"

namespace phasetree::tracer {

struct Grain {
    glm::vec3 axis{1.0f, 0.0f, 0.0f};    ///< along which the strokes run, or around which; in the object's own space,
                                         ///< or in the scene's, of a mesh
    std::optional<glm::vec3> through{};  ///< a point of the axis around which they run
    float aspect = 0.2f;                 ///< the roughness along the strokes over that across, at most 1

    /// The direction of the strokes, which may point out of the surface and has any length.
    glm::vec3 direction_at(const TexturePoint& place) const {
        return through ? glm::cross(axis, place.position - *through) : axis;
    }
};

}  // namespace phasetree::tracer
