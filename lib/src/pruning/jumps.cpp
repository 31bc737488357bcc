#include "pruning/jumps.hpp"

#include <algorithm>
#include <cstring>

#include "phasetree/nodes/copies/endless_grid.hpp"
#include "program/fused.hpp"

namespace phasetree::pruning {

using program::is_fold, program::operands;

namespace {

/// A slope above this has a jump in it.
constexpr float half_a_jump = 0x1p20f;

}  // namespace

float finest_jump(const WorkingProgram& program, std::span<const float> constants) {
    float finest = Bounds::infinity;
    for (std::size_t i = 0; i < program.code.size(); ++i) {
        if (!is_fold(program.code[i].op) || program.lipschitz[i] <= half_a_jump) continue;
        FoldMap fold;
        std::memcpy(static_cast<void*>(&fold), constants.data() + program.code[i].data, sizeof fold);
        for (int axis = 0; axis < 3; ++axis)
            if (fold.spacing[axis] > 0) finest = std::min(finest, fold.spacing[axis]);
    }
    return finest;
}

bool may_jump(const WorkingProgram& program) {
    return std::ranges::any_of(program.lipschitz, [](float l) { return l > half_a_jump; });
}

/// Slopes within the ball. A fold of space jumps, which is recorded as a slope of FoldMap::jump; in a ball that
/// touches none of its jumps that factor goes from all that follows. The guard above the fold tells: its bound is
/// more than half of `far` wherever the fold jumps.
std::span<const float> slopes_in_ball(const WorkingProgram& program, std::span<const float> constants,
                                      const ValuesAtPoint& value, float radius, float rounding, Arena& scratch) {
    const std::span<float> slope = scratch.copy(program.lipschitz);
    const auto size = static_cast<std::uint32_t>(program.code.size());
    const std::span<char> is_still = scratch.take<char>(size);  // 1: folds without a jump in the ball
    const std::span<char> jumps = scratch.take<char>(size);
    std::ranges::fill(is_still, 0);
    std::ranges::fill(jumps, 0);
    for (std::uint32_t i = 1; i < size; ++i) {
        const Instruction& guard = program.code[i];
        if (guard.op != Op::guarded) continue;
        // The bound's own slope is that of its point.
        const float high = value[guard.a] + slope[guard.a] * radius + rounding;
        // Several folds may have one point: none is still unless all of their guards say so.
        const char says = high < 0.5f * constants[guard.data] ? 1 : 2;
        for (std::uint32_t k = 1; k < i; ++k)
            if (is_fold(program.code[k].op) && program.code[k].a == program.code[guard.a].a)
                is_still[k] = static_cast<char>(is_still[k] | says);
    }
    for (std::uint32_t i = 1; i < size; ++i) {
        const Instruction& in = program.code[i];
        if (slope[i] <= half_a_jump) continue;
        const int n = operands(in.op);
        jumps[i] = (n > 0 && jumps[in.a]) || (n > 1 && jumps[in.b]) || (is_fold(in.op) && is_still[i] != 1);
        while (!jumps[i] && slope[i] > half_a_jump) slope[i] /= FoldMap::jump;
    }
    return slope;
}

}  // namespace phasetree::pruning
