#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <stdexcept>
#include <vector>

#include "phasetree/math/convex_polyhedron.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree {

/// Thrown by a carving that CarveOptions::cancelled has stopped.
class CarvingCancelled : public std::runtime_error {
  public:
    CarvingCancelled() : std::runtime_error("the carving of bounds was cancelled") {}
};

/// How bounds are carved.
struct CarveOptions {
    /// The outward normals of the planes, of any length but zero, besides the six sides of the box: a k-DOP. Empty: as
    /// many as pay, chosen by the object's shape.
    std::vector<glm::dvec3> directions{};
    int most_planes = 40;     ///< that are chosen, the six sides of the box included; at least 6
    double tolerance = 1e-3;  ///< how far planes may be from the object, as a share of its diagonal, if work suffices
    /// The most evaluations, each of eight points. What is then not reached is larger than it need be, and certain all
    /// the same.
    std::size_t most_evaluations = 50'000;
    std::function<bool()> cancelled{};  ///< polled; return true to cancel
};

/// A convex volume that certainly contains all of a solid.
struct CarvedBounds {
    Bounds box;                       ///< empty if there is nothing of the solid
    std::vector<HalfSpace> planes;    ///< each contains the solid; the box's sides that matter are among them
    ConvexPolyhedron::Mesh mesh;      ///< their intersection, up to rounding
    double volume = 0, area = 0;      ///< of the mesh
    std::size_t evaluations = 0;      ///< that it took
    bool is_within_tolerance = true;  ///< false if the evaluations came to their end

    bool contains(const glm::dvec3& p) const;
    /// What of the line origin + t·direction within [near, far] is in the volume: nothing if far < near afterwards.
    void clip(const glm::dvec3& origin, const glm::dvec3& direction, double& near, double& far) const;
};

/// Sphere Carving (Schott et al., "Sphere Carving: Bounding Volumes for Signed Distance Fields", 2025): a convex volume
/// around {f ≤ 0}, from nothing but values of the field. Throws ModelError if the solid is unbounded, or too far from
/// the origin for its size.
CarvedBounds carve(const Field&, const CarveOptions& = {});
/// The same around phases of an object; around all but the vacuum if none is named.
CarvedBounds carve(const Phased&, PhaseSet = {}, const CarveOptions& = {});

/// The volume as a field, to be that of a bounding_volume for example: a node of the tree.
Field as_field(const CarvedBounds&);

}  // namespace phasetree
