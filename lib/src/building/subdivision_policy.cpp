#include "building/subdivision_policy.hpp"

#include <algorithm>

namespace phasetree::building {

using program::traits;

SubdivisionPolicy::SubdivisionPolicy(const WorkingProgram& program, float work) {
    const auto size = static_cast<float>(program.code.size());
    const auto is_network = [](const Instruction& in) { return traits(in.op).is_network; };
    if (work > 200 + 10 * size && std::ranges::any_of(program.code, is_network)) {
        large = 0.25f;
        most_futile_divisions = 1;
        uneven = 0.2f;
    } else if (work > 10 * size) {
        large = 0.25f;
    } else if (size > 24) {
        most_futile_divisions = 5;
    }
}

}  // namespace phasetree::building
