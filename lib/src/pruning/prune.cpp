#include "pruning/prune.hpp"

#include <algorithm>

#include "pruning/backward_sweep.hpp"

namespace phasetree::pruning {

using program::is_far_bound;
using rewriting::ArenaScope;

namespace {

// Ranges that contain no information.
struct RangesAnywhere {
    std::span<const float> slope;

    float low(std::uint32_t) const { return -Bounds::infinity; }
    float high(std::uint32_t) const { return Bounds::infinity; }
    bool is_above(std::uint32_t, std::uint32_t, float) const { return false; }
};

template <class Ranges>
std::optional<WorkingProgram> pruned(const WorkingProgram& program, const Ranges& ranges, const ProgramContext& context,
                                     const Arenas& arenas, bool drops_far_bounds,
                                     std::span<const RequiredOfLocal>* required = nullptr) {
    const ArenaScope scope(arenas.scratch);
    BackwardSweep<Ranges> sweep(program, ranges, context, arenas, drops_far_bounds);
    auto result = sweep.run();
    if (result && required && context.has_local_primitives) *required = sweep.required_of_locals();
    return result;
}

}  // namespace

std::optional<WorkingProgram> prune(const WorkingProgram& program, const ValueRanges& ranges,
                                    const ProgramContext& context, const Arenas& arenas) {
    return pruned(program, ranges, context, arenas, false);
}
std::optional<WorkingProgram> prune(const WorkingProgram& program, const RangesInBall& ranges,
                                    const ProgramContext& context, const Arenas& arenas) {
    return pruned(program, ranges, context, arenas, false);
}

std::optional<WorkingProgram> prune(const WorkingProgram& program, const RangesInBall& ranges,
                                    const ProgramContext& context, const Arenas& arenas,
                                    std::span<const RequiredOfLocal>& required) {
    required = {};
    return pruned(program, ranges, context, arenas, false, &required);
}

std::optional<WorkingProgram> without_far_bounds(const WorkingProgram& program, const ProgramContext& context,
                                                 const Arenas& arenas) {
    if (std::ranges::none_of(program.code, [](const Instruction& in) { return is_far_bound(in.op); }))
        return std::nullopt;
    return pruned(program, RangesAnywhere{program.lipschitz}, context, arenas, true);
}

}  // namespace phasetree::pruning
