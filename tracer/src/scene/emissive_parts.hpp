// Balls that cover the emitting parts of a scene, up to rounding.
//
// *Phases:* the phase's component φ of the tree's distances is 1-Lipschitz and negative inside the phase. A box whose
// points are all within r of its centre therefore contains nothing of the phase if φ(centre) > r, and none of its
// surface if |φ(centre)| > r. Starting with the object's bounds, boxes are divided into octants as long as the number
// of boxes kept is small enough. Each of the final boxes becomes a ball. For a phase whose medium emits, the interior
// counts too.
//
// *Meshes:* the largest set of triangles is divided repeatedly: into halves, or, if it is a single triangle, at the
// middle of its longest edge.
#pragma once

#include <span>
#include <vector>

#include "lights/bounding_sphere.hpp"
#include "lights/emissive_part.hpp"
#include "phasetree/math/bounds.hpp"
#include "phasetree/model/handle.hpp"
#include "shading/material.hpp"

namespace phasetree::tracer {

struct Mesh;

/// A ball around an emissive part, in the space of its object or mesh.
struct EmissiveBall {
    BoundingSphere ball;
    float luminance;  ///< rough luminance of the radiance that it emits
    EmissivePart::Of of = EmissivePart::Of::surface;
};

/// A part is never rated below this fraction of the maximum that it could emit, however little is emitted at the
/// sampled points.
inline constexpr float least_brightness = 1.0f / 32;

/// The ball around a box, with this luminance.
inline EmissiveBall part_in(const Bounds& box, float luminance, EmissivePart::Of of = EmissivePart::Of::surface) {
    constexpr float most = 1e30f;  // keeps products within single precision
    return {{box.centre(), 0.5f * box.diagonal()}, luminance < most ? luminance : most, of};
}

/// Parts of the phases that emit, given the materials by phase. Throws ModelError for a tree that cannot be traced.
std::vector<EmissiveBall> parts_of_phases(const Phased& tree, std::span<const Material> materials);
/// Parts of a mesh with an emissive material.
std::vector<EmissiveBall> parts_of_mesh(const Mesh& mesh);

}  // namespace phasetree::tracer
