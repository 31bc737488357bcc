#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <stdexcept>
#include <vector>

#include "phasetree/math/convex_polyhedron.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree {

/// Thrown if CarveOptions::cancelled returned true.
class CarvingCancelled : public std::runtime_error {
  public:
    CarvingCancelled() : std::runtime_error("carving was cancelled") {}
};

/// Options for carving.
struct CarveOptions {
    /// Outward normals of the planes to use in addition to the six sides of the box (a k-DOP), of any nonzero length.
    /// If empty, carve() chooses the directions and their number from the object's shape.
    std::vector<glm::dvec3> directions{};
    int max_planes = 40;      ///< used if `directions` is empty; includes the six sides of the box, so at least 6
    double tolerance = 1e-3;  ///< target distance of the planes from the object, as a fraction of its diagonal
    /// Maximum number of evaluations, of eight points each. When they run out, the volume is larger than necessary, but
    /// it still contains the solid.
    std::size_t max_evaluations = 50'000;
    std::function<bool()> cancelled{};  ///< polled; return true to cancel
};

/// A convex volume that is guaranteed to contain a solid.
struct CarvedBounds {
    Bounds box;                       ///< empty if the solid is empty
    std::vector<HalfSpace> planes;    ///< each contains the solid; includes the sides of the box that matter
    ConvexPolyhedron::Mesh mesh;      ///< intersection of the planes, up to rounding
    double volume = 0, area = 0;      ///< of the mesh
    std::size_t evaluations = 0;      ///< number of evaluations used
    bool is_within_tolerance = true;  ///< false if the evaluations ran out

    bool contains(const glm::dvec3& p) const;
    /// Clip the interval [near, far] of the line origin + t·direction to the volume. The result is empty if far < near.
    void clip(const glm::dvec3& origin, const glm::dvec3& direction, double& near, double& far) const;
};

/// Carve a convex volume around {f ≤ 0}, using only values of the field (Schott et al., "Sphere Carving: Bounding
/// Volumes for Signed Distance Fields", 2025).
///
/// Throws ModelError if the solid is unbounded or too far from the origin for its size, and CarvingCancelled.
CarvedBounds carve(const Field&, const CarveOptions& = {});
/// The same around phases of an object. An empty set stands for all phases but the vacuum.
CarvedBounds carve(const Phased&, PhaseSet = {}, const CarveOptions& = {});

/// The volume as a field, for example for a bounding_volume node.
Field as_field(const CarvedBounds&);

}  // namespace phasetree
