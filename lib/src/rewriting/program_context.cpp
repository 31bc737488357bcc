#include "rewriting/program_context.hpp"

#include <algorithm>

#include "rewriting/specialise.hpp"

namespace phasetree::rewriting {

using program::is_far_bound, program::is_fold;

namespace {

bool has(const WorkingProgram& program, bool (*is_of_kind)(Op)) {
    return std::ranges::any_of(program.code, [&](const Instruction& in) { return is_of_kind(in.op); });
}

}  // namespace

ProgramContext::ProgramContext(const WorkingProgram& whole, std::span<const float> constants_of_whole,
                               PhaseSet opaque_phases, float error_of_values)
    : constants(constants_of_whole),
      opaque(opaque_phases),
      value_error(error_of_values),
      has_folds(has(whole, is_fold)),
      has_local_primitives(has_local_primitive(whole)),
      has_far_bounds(has(whole, is_far_bound)) {}

}  // namespace phasetree::rewriting
