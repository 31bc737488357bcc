#include "building/cost_model.hpp"

#include <algorithm>

#include "rewriting/data_primitive.hpp"
#include "rewriting/live_set.hpp"

namespace phasetree::building {

using program::OpTraits, program::ProgramOutput, program::traits;
using rewriting::ArenaScope, rewriting::LiveSet, rewriting::with_data_primitive;

namespace {

// The cost of an instruction; a simple one costs 2.
unsigned half_instructions(const Instruction& in, std::span<const float> constants) {
    const OpTraits& t = traits(in.op);
    unsigned halves = t.half_instructions;
    if (t.has_cost_in_data)
        with_data_primitive(in.op, [&]<class P>() {
            if constexpr (HasCostInData<P>) halves = P::half_instructions(&constants[in.data]);
        });
    return halves;
}

// The average number of batches per visit for rays on one side of the interface, given the bound of the curvature
// there.
float batches(const CellFacts& cell, const LinearBound& bound, float curvature_bound, bool has_certificate) {
    // An unknown slack counts three times as much as the largest known one, which is 1.
    float slack = 3, spread = 1;
    if (bound.slack < Bounds::infinity) {
        const float thickness = 0.5f * glm::dot(glm::abs(bound.normal), cell.box.extent());
        slack = std::min(1.f, bound.slack / std::max(thickness, 1e-30f));
        spread = std::min(1.f, bound.spread);
    }
    const bool is_curvature_known = curvature_bound < Curvature::unknown;
    return cost_model::batches_of_linear_field + cost_model::batches_by_slack * slack +
           cost_model::batches_by_spread * spread +
           (is_curvature_known ? 0.f
            : has_certificate  ? cost_model::batches_with_certificate
                               : cost_model::batches_without_curvature);
}

}  // namespace

Work work(const WorkingProgram& program, std::span<const float> constants,
          std::span<const Specialisation> specialisations, Arena& scratch) {
    unsigned halves = 0;
    for (const Instruction& in : program.code.subspan(1)) halves += half_instructions(in, constants);
    for (const Specialisation& s : specialisations) halves -= s.half_instructions_saved;
    const float all = 0.5f * static_cast<float>(halves);
    if (program.outputs.size() == 2) return {all, all};
    const ArenaScope scope(scratch);
    const LiveSet first(program, program.outputs.first(1), scratch);
    unsigned others = 0;
    for (std::size_t i = 1; i < program.code.size(); ++i)
        others += first.has(i) ? 0u : half_instructions(program.code[i], constants);
    for (const Specialisation& s : specialisations) others -= first.has(s.value) ? 0u : s.half_instructions_saved;
    return {all, all - 0.5f * static_cast<float>(others)};
}

// Assumes that half of the rays are in the first phase and half in the others; all are in the first if the others are
// opaque, and none if the first is opaque. Where more than two phases meet, rays in the first phase evaluate its
// component alone, and the whole program once, where they leave it. This is expected only of the vacuum, and of a phase
// that is the only clear one.
float cost(const CellFacts& cell, const WorkingProgram& program, const Work& work, PhaseSet opaque) {
    const float all = cost_model::batch + cost_model::instruction * work.all;
    const auto is_opaque = [&](const ProgramOutput& o) { return opaque.contains(o.phase); };
    const bool is_first_alone_clear = std::ranges::all_of(program.outputs.subspan(1), is_opaque);
    const bool has_two = program.outputs.size() == 2;
    const float batches_in_first = batches(cell, cell.bound, cell.curvature.bound[0], cell.has_certificate);
    const float in_others =
        batches(cell, has_two ? cell.bound : LinearBound{}, cell.curvature.bound[1], has_two && cell.has_certificate) *
        all;
    float in_first = batches_in_first * all;
    if (!has_two) {
        in_first = in_others;
        if (program.outputs[0].phase == vacuum || is_first_alone_clear)
            in_first = batches_in_first * (cost_model::batch + cost_model::instruction * work.first) + all;
    }
    const float share_in_first = is_first_alone_clear ? 1.f : is_opaque(program.outputs[0]) ? 0.f : 0.5f;
    return surface(cell.box) * (cost_model::visit + share_in_first * in_first + (1 - share_in_first) * in_others);
}

}  // namespace phasetree::building
