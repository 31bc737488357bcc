#pragma once

#include "kernel/linear_bound.hpp"
#include "rewriting/specialise.hpp"

/// The surface area heuristic for cells: what rays are expected to spend in a cell. The number of rays that enter a box
/// is proportional to its surface, and each of them pays for entering the cell and for batches of samples that are as
/// long as the cell's program:
///     cost = surface · (visit + batches · (batch + instruction · work)),
/// where the number of batches is larger the less is known of the field. A box that is divided costs traversal ·
/// surface and what its children cost.
///
/// Costs are in nanoseconds times an area, up to a common factor. They are rough, because they serve only to compare a
/// box with the cells that it could be divided into. The constants were measured (benchmarks/experiments.md).
namespace phasetree::building {

using kernel::Curvature, kernel::LinearBound;
using rewriting::Arena, rewriting::Specialisation, rewriting::WorkingProgram;

namespace cost_model {
// These are in nanoseconds.
/// Of one more node of Embree's hierarchy, which stands for a box that is divided.
inline constexpr float traversal = 12;
inline constexpr float visit = 60;          ///< of entering a cell
inline constexpr float batch = 25;          ///< of a batch of samples,
inline constexpr float instruction = 2.4f;  ///< and of each simple instruction in it
// These count batches.
inline constexpr float batches_of_linear_field = 1.8f;   ///< where the field is linear
inline constexpr float batches_by_slack = 0.7f;          ///< more, times the share of the box within the bound's slack
inline constexpr float batches_by_spread = 3;            ///< more, times the variation of the gradient
inline constexpr float batches_with_certificate = 0.5f;  ///< more where curvature is known by a certificate alone
inline constexpr float batches_without_curvature = 2;    ///< more where nothing is known of curvature
/// How many rays start at an interface for each unit of its area. (A ray that enters a box passes its surface twice.)
inline constexpr float starting_rays = 0.5f;
}  // namespace cost_model

/// How much work a batch is, in simple instructions: of all of a program, and of its first component alone, which
/// differs if more than two phases meet.
struct Work {
    float all = 0, first = 0;
};
Work work(const WorkingProgram&, std::span<const float> constants, std::span<const Specialisation>, Arena& scratch);

/// Half of a box's surface, to which the number of rays that enter it is proportional.
inline float surface(const Bounds& box) {
    const glm::vec3 e = box.extent();
    return e.x * e.y + e.y * e.z + e.z * e.x;
}

/// About the area of one interface across a box.
inline float interface_area(const Bounds& box) {
    const glm::vec3 e = box.extent();
    return std::max({e.x * e.y, e.y * e.z, e.z * e.x});
}

/// What the cost of a cell depends on besides its program.
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

}  // namespace phasetree::building
