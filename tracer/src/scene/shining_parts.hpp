// Balls around parts of what shines by itself. Together they cover it, but for what rounding leaves out.
//
// *Of a phase:* its component φ of the tree's distances is 1-Lipschitz and negative inside of the phase. So a box whose
// points are all within r of its centre has nothing of the phase if φ(centre) > r, and none of its surface if
// |φ(centre)| > r. Starting with the object's bounds, boxes are divided into eight while few enough are kept; each of
// the last becomes a ball. Of a phase whose medium shines the inside counts, too.
//
// *Of a mesh:* the largest of its sets of triangles is divided, again and again: in halves, or, if it is one triangle,
// at the middle of its longest edge.
#pragma once

#include <span>
#include <vector>

#include "lights/bounding_sphere.hpp"
#include "lights/glowing_part.hpp"
#include "phasetree/math/bounds.hpp"
#include "phasetree/model/handle.hpp"
#include "shading/material.hpp"

namespace phasetree::tracer {

struct Mesh;

struct ShiningPart {
    BoundingSphere ball;
    float luminance;  ///< roughly that of the radiance which comes from there
    GlowingPart::Of of = GlowingPart::Of::surface;
};

/// A part is never rated below this share of the most that it could send, however little shines at the places that are
/// looked at.
inline constexpr float least_brightness = 1.0f / 32;

/// A ball around a box, of something with this luminance.
inline ShiningPart part_in(const Bounds& box, float luminance, GlowingPart::Of of = GlowingPart::Of::surface) {
    constexpr float most = 1e30f;  // products with it stay within single precision
    return {{box.centre(), 0.5f * box.diagonal()}, luminance < most ? luminance : most, of};
}

/// Of the phases whose materials, by phase, shine. Throws ModelError for a tree that cannot be traced.
std::vector<ShiningPart> parts_of_phases(const Phased& tree, std::span<const Material> materials);
/// Of a mesh whose material shines.
std::vector<ShiningPart> parts_of_mesh(const Mesh& mesh);

}  // namespace phasetree::tracer
