#include "building/subdivision_policy.hpp"

#include <algorithm>

namespace phasetree::building {

using program::traits;

namespace {

// Work is counted in simple instructions. A program whose work is more than this for each of its own instructions
// consists of little but long primitives.
constexpr float work_of_each_if_long = 10;
// The work of a program that is little but a neural field is larger by more than this than that of such a program.
// Where less is left of a network, or more of other long primitives, a box is treated as one with long primitives.
constexpr float least_work_of_network = 200;
// Boxes larger than this share of the object are always divided where a trial is dear.
constexpr float large_if_dear = 0.25f;
// How much of itself the gradient of a neural field varies by in boxes that are small enough for rays.
constexpr float uneven_network = 0.2f;
// Programs of more instructions than this have features on several scales: a division may save nothing in the coarse
// ones, and only a few divisions later reach those that it can tell apart.
constexpr float long_program = 24;
constexpr int futile_divisions_of_network = 1, futile_divisions_of_long_program = 5;

}  // namespace

// The constants are compromises between the time of a build and that of rays. They were chosen among a few values each
// by timing both for the scenes of the gallery and the objects of `phasetree-bench`, and none of them is critical.
SubdivisionPolicy::SubdivisionPolicy(const WorkingProgram& program, float work) {
    const auto size = static_cast<float>(program.code.size());
    const auto is_network = [](const Instruction& in) { return traits(in.op).is_network; };
    const float of_long_primitives = work_of_each_if_long * size;
    if (work > least_work_of_network + of_long_primitives && std::ranges::any_of(program.code, is_network)) {
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
