#include "building/subdivision_policy.hpp"

#include <algorithm>

namespace phasetree::building {

using program::traits;

namespace {

// A program whose work, in simple instructions, is more than this many for each of its own instructions consists of
// little but long primitives.
constexpr float work_of_long_primitives = 10;
// A neural field takes more than this besides.
constexpr float work_of_network = 200;
// Boxes larger than this are always divided where a trial is dear.
constexpr float large_if_dear = 0.25f;
// A neural field's linear bound is good enough for rays when its gradient varies by a fifth.
constexpr float uneven_network = 0.2f;
// Programs of more instructions have features on several scales: a division may save nothing in the coarse ones, and
// only a few divisions later reach those that it can tell apart.
constexpr float long_program = 24;
constexpr int futile_divisions_of_network = 1, futile_divisions_of_long_program = 5;

}  // namespace

// The constants are compromises between the time of a build and that of rays, found by timing both.
SubdivisionPolicy::SubdivisionPolicy(const WorkingProgram& program, float work) {
    const auto size = static_cast<float>(program.code.size());
    const auto is_network = [](const Instruction& in) { return traits(in.op).is_network; };
    const float of_long_primitives = work_of_long_primitives * size;
    if (work > work_of_network + of_long_primitives && std::ranges::any_of(program.code, is_network)) {
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
