// Where a ray meets a mesh, with the same bits on every processor.
#pragma once

#include <memory>
#include <span>

#include "embree_core/embree.hpp"
#include "scene/mesh.hpp"
#include "world/moving_mesh.hpp"

namespace phasetree::tracer {

/// Recompute the barycentric coordinates, the normal and the distance of a hit on a mesh from the triangle's corners,
/// in double precision. The coordinates are clamped to the triangle. The ray must be in the space in which the mesh is
/// stored.
///
/// Embree computes them from approximate reciprocals, and with fused multiplications where the processor has them. So
/// their last bits differ between SSE, AVX2, AVX-512 and NEON.
///
/// Reference: Möller and Trumbore, Fast, Minimum Storage Ray–Triangle Intersection, 1997.
void recompute_hit(const Mesh&, const RTCRay&, RTCHit&, float& distance);

/// A scene in Embree in which meshes have consecutive IDs from `first_id` on.
struct MeshesInEmbree {
    RTCScene scene;
    std::span<const Mesh> meshes;
    std::span<const std::unique_ptr<const MovingMesh>> moving;  ///< of each mesh; null if it stands still
    unsigned first_id;
};

/// The same for a hit found in such a scene, at the time of the ray. If the ray passes
/// through an edge within rounding, several triangles meet there, and Embree's choice depends on the processor, too.
/// The hit is then on the closest of those that contain the ray; if there are several, on the one with the lowest IDs.
void recompute_hit(const MeshesInEmbree&, const RTCRay&, RTCHit&, float& distance);

}  // namespace phasetree::tracer
