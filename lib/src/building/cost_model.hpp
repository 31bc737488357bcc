#pragma once

#include "kernel/linear_bound.hpp"
#include "phasetree/program/batch.hpp"
#include "rewriting/specialise.hpp"

/// The surface area heuristic for cells: the expected time that rays spend in a cell. The number of rays that enter a
/// box is proportional to its surface. Each of them pays for entering the cell and for batches of samples, whose cost
/// depends on the cell's program:
///     cost = surface · (visit + batches · (batch + instruction · work)).
/// The less is known about the field, the more batches there are. A divided box costs traversal · surface plus the cost
/// of its children.
///
/// Costs are in nanoseconds times an area, up to a common factor. They are rough, because they only serve to compare a
/// box with the cells into which it could be divided. The constants were measured (benchmarks/experiments.md).
namespace phasetree::building {

using kernel::Curvature, kernel::LinearBound;
using rewriting::Arena, rewriting::Specialisation, rewriting::WorkingProgram;

namespace cost_model {
// In nanoseconds:
/// visiting one more node of Embree's hierarchy, for a box that is divided
inline constexpr float traversal = 12;
inline constexpr float visit = 60;          ///< entering a cell
inline constexpr float batch = 25;          ///< a batch of samples
inline constexpr float instruction = 2.4f;  ///< each simple instruction in a batch
/// Entering a cell of a mesh's faces, and intersecting eight of them:
inline constexpr float visit_of_faces = 30, batch_of_faces = 20;
// In batches:
inline constexpr float batches_of_linear_field = 1.8f;   ///< for a linear field
inline constexpr float batches_by_slack = 0.7f;          ///< additional, times the share of the box within the slack
inline constexpr float batches_by_spread = 3;            ///< additional, times the variation of the gradient
inline constexpr float batches_with_certificate = 0.5f;  ///< additional where only a certificate bounds the curvature
inline constexpr float batches_without_curvature = 2;    ///< additional where nothing is known of the curvature
/// The number of rays that start at an interface, per unit of its area. (A ray that enters a box passes its surface
/// twice.)
inline constexpr float starting_rays = 0.5f;
}  // namespace cost_model

/// The work of a batch in simple instructions: for the whole program, and for its first component alone, which differs
/// if more than two phases meet.
struct Work {
    float all = 0, first = 0;
};
Work work(const WorkingProgram&, std::span<const float> constants, std::span<const Specialisation>, Arena& scratch);

/// Half of a box's surface, which is proportional to the number of rays that enter it.
inline float surface(const Bounds& box) {
    const glm::vec3 e = box.extent();
    return e.x * e.y + e.y * e.z + e.z * e.x;
}

/// The approximate area of one interface across a box.
inline float interface_area(const Bounds& box) {
    const glm::vec3 e = box.extent();
    return std::max({e.x * e.y, e.y * e.z, e.z * e.x});
}

/// What the cost of a cell depends on, apart from its program.
struct CellFacts {
    Bounds box{};
    LinearBound bound{};
    Curvature curvature{};
    bool has_certificate = false;
};

/// The cost of a cell.
float cost(const CellFacts&, const WorkingProgram&, const Work&, PhaseSet opaque);

/// The cost of the cheapest cell that has this box.
inline float least_cost(const Bounds& box) {
    return surface(box) *
           (cost_model::visit + cost_model::batches_of_linear_field * (cost_model::batch + cost_model::instruction));
}

/// The cost of a cell in which rays intersect a mesh's faces.
inline float cost_of_faces(const Bounds& box, std::size_t faces) {
    const auto batches = static_cast<float>((faces + batch_size - 1) / batch_size);
    return surface(box) * (cost_model::visit_of_faces + cost_model::batch_of_faces * batches);
}

}  // namespace phasetree::building
