#include "pruning/jumps.hpp"

#include <algorithm>

#include "phasetree/nodes/copies/endless_grid.hpp"
#include "program/dispatch.hpp"
#include "program/fused.hpp"

namespace phasetree::pruning {

using program::first_map, program::is_fold, program::operands;

namespace {

// A Lipschitz bound above this contains the factor FoldMap::jump, which is 2⁴⁰.
constexpr float least_slope_of_jump = 0x1p20f;

}  // namespace

float finest_jump(const WorkingProgram& program, std::span<const float> constants) {
    float finest = Bounds::infinity;
    for (std::size_t i = 0; i < program.code.size(); ++i) {
        const Instruction& in = program.code[i];
        if (!is_fold(in.op) || program.lipschitz[i] <= least_slope_of_jump) continue;
        program::dispatch(PointMaps(), static_cast<std::uint32_t>(in.op) - first_map, [&]<class M>() {
            if constexpr (FoldingMap<M>)
                finest = std::min(finest, program::read<M>(constants.data() + in.data).finest_spacing());
        });
    }
    return finest;
}

bool may_jump(const WorkingProgram& program) {
    return std::ranges::any_of(program.lipschitz, [](float l) { return l > least_slope_of_jump; });
}

// A guard is the instruction `guarded`, max(a, min(b, c − a)), of a bound a and a field b that depends on a fold
// (math/number.hpp). It shows whether the fold may jump in the ball, because a ≥ c/2 wherever the fold jumps.
//
// A guard belongs to the folds that map the point from which its bound is computed, because endless_grid uses one point
// for both. Pruning can replace the bound by another value, though only by an equal one (resolve_guarded). If that
// value is computed from another point, the fold has lost its guard. A fold without a guard counts as one that may
// jump.
std::span<const float> slopes_in_ball(const WorkingProgram& program, const ValuesAtPoint& centre, float radius,
                                      const ProgramContext& context, Arena& arena) {
    const std::span<float> slope = arena.copy(program.lipschitz);
    const auto size = static_cast<std::uint32_t>(program.code.size());
    // Several folds may share a point; they count as continuous only if every guard confirms it.
    constexpr char is_continuous = 1, may_jump_here = 2;
    const std::span<char> verdicts = arena.allocate<char>(size);  // what the guards say of each fold, as a set
    const std::span<char> jumps = arena.allocate<char>(size);     // whether a value depends on a fold that may jump
    std::ranges::fill(verdicts, 0);
    std::ranges::fill(jumps, 0);
    for (std::uint32_t i = 1; i < size; ++i) {
        const Instruction& guard = program.code[i];
        if (guard.op != Op::guarded) continue;
        const float high = centre[guard.a] + slope[guard.a] * radius + context.value_error;
        const char verdict = high < 0.5f * context.constants[guard.data] ? is_continuous : may_jump_here;
        for (std::uint32_t k = 1; k < i; ++k)
            if (is_fold(program.code[k].op) && program.code[k].a == program.code[guard.a].a)
                verdicts[k] = static_cast<char>(verdicts[k] | verdict);
    }
    for (std::uint32_t i = 1; i < size; ++i) {
        const Instruction& in = program.code[i];
        if (slope[i] <= least_slope_of_jump) continue;
        const int n = operands(in.op);
        jumps[i] = (n > 0 && jumps[in.a]) || (n > 1 && jumps[in.b]) || (is_fold(in.op) && verdicts[i] != is_continuous);
        // Each fold on which the value depends has multiplied its bound once.
        while (!jumps[i] && slope[i] > least_slope_of_jump) slope[i] /= FoldMap::jump;
    }
    return slope;
}

}  // namespace phasetree::pruning
