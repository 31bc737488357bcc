#include "building/subdivision_policy.hpp"

#include <algorithm>

namespace phasetree::building {

using program::traits;

namespace {

// Work is counted in simple instructions. A program with more work per instruction than this consists almost entirely
// of long primitives.
constexpr float work_of_each_if_long = 10;
// A program counts as a neural field if its work exceeds that limit by more than this. If less of a network is left, or
// if other long primitives dominate, the box is treated as one with long primitives.
constexpr float least_work_of_network = 200;
// Where a trial is expensive, boxes larger than this fraction of the object are always divided.
constexpr float large_if_dear = 0.25f;
// How much, relative to itself, the gradient of a neural field varies in boxes that are small enough for rays.
constexpr float uneven_network = 0.2f;
// Programs with more instructions than this have features on several scales. A division may save nothing on the coarse
// scales; only a few divisions further down are boxes small enough to tell features apart.
constexpr float long_program = 24;
constexpr int futile_divisions_of_network = 1, futile_divisions_of_long_program = 5;

}  // namespace

// The constants are compromises between build time and ray time. Each was chosen among a few values by timing the
// scenes of the gallery and the objects of `phasetree-bench`. None of them is critical.
SubdivisionPolicy::SubdivisionPolicy(const WorkingProgram& program, float work) {
    const auto size = static_cast<float>(program.code.size());
    const auto is_best_in_small_boxes = [](const Instruction& in) { return traits(in.op).is_best_in_small_boxes; };
    const float of_long_primitives = work_of_each_if_long * size;
    if (work > least_work_of_network + of_long_primitives &&
        std::ranges::any_of(program.code, is_best_in_small_boxes)) {
        large = large_if_dear;
        most_futile_divisions = futile_divisions_of_network;
        uneven = uneven_network;
    } else if (work > of_long_primitives) {
        large = large_if_dear;
    } else if (size > long_program) {
        most_futile_divisions = futile_divisions_of_long_program;
    }
}

}  // namespace phasetree::building
