#include "glsl/pruned_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>

#include "bounding/enclose.hpp"
#include "evaluation/target.hpp"
#include "phasetree/building/options.hpp"
#include "pruning/jumps.hpp"
#include "pruning/prune.hpp"
#include "rewriting/readable_steps.hpp"
#include "rewriting/rewrite.hpp"

namespace phasetree::glsl {

using evaluation::ValuesAtPoint;
using rewriting::Arena, rewriting::ArenaScope, rewriting::Arenas, rewriting::ProgramContext, rewriting::WorkingProgram;

namespace {

// The boxes of a grid from `first` up to `end` in each direction.
struct BoxRange {
    glm::ivec3 first, end;

    bool is_one() const { return end - first == glm::ivec3(1); }
    // The two halves of the range, divided across the direction with the most boxes.
    std::array<BoxRange, 2> halves() const {
        const glm::ivec3 n = end - first;
        const int axis = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
        std::array<BoxRange, 2> result{*this, *this};
        result[0].end[axis] = result[1].first[axis] = first[axis] + n[axis] / 2;
        return result;
    }
};

class GridPruning {
  public:
    GridPruning(PrunedGrid& grid, const WorkingProgram& whole, std::span<const float> constants, float reach,
                const std::function<bool()>& cancelled)
        : grid_(grid),
          context_(whole, constants, PhaseSet(), 0.125f * reach),
          reach_(reach),
          has_jumps_(context_.has_folds && pruning::may_jump(whole)),
          cancelled_(cancelled) {}

    void divide(const BoxRange& range, const WorkingProgram& above) {
        if (cancelled_ && cancelled_()) throw BuildCancelled();
        const ArenaScope programs(programs_), scratch(scratch_);
        const Bounds region = region_of(range);
        std::int32_t label = 0;
        std::optional<WorkingProgram> left = pruned_in_ball(above, region, label);
        if (left) left = pruned_by_enclosures(*left, region);
        if (!left) return fill(range, -1 - label);
        if (range.is_one()) return fill(range, number_of(*left));
        for (const BoxRange& half : range.halves()) divide(half, *left);
    }

  private:
    Arenas arenas() { return {programs_, scratch_}; }
    Bounds region_of(const BoxRange& range) const {
        const glm::vec3 size = grid_.box_size();
        return Bounds{grid_.bounds.low + glm::vec3(range.first) * size, grid_.bounds.low + glm::vec3(range.end) * size}
            .inflated(reach_);
    }

    std::optional<WorkingProgram> pruned_in_ball(const WorkingProgram& program, const Bounds& region,
                                                 std::int32_t& label) {
        const rewriting::ReadableSteps steps = rewriting::readable_steps(program, scratch_);
        const std::span<BatchOfFloats> registers = scratch_.allocate<BatchOfFloats>(steps.slots);
        const glm::vec3 c = region.centre();
        BatchOfFloats x, y, z;
        x.lane.fill(c.x);
        y.lane.fill(c.y);
        z.lane.fill(c.z);
        evaluation::active_kernel().evaluate(steps.routine(context_.constants.data()), x.lane.data(), y.lane.data(),
                                             z.lane.data(), registers.data()->lane.data(), nullptr);
        const ValuesAtPoint centre{registers.data(), steps.slot, 0};
        float least = Bounds::infinity;
        for (const ProgramOutput& o : program.outputs) {
            const float value = o.negate ? -centre[o.value] : centre[o.value];
            if (value < least) least = value, label = static_cast<std::int32_t>(o.phase.index);
        }
        const float radius = 0.5f * region.diagonal() * (1 + 1e-5f);
        const std::span<const float> slope =
            has_jumps_ ? pruning::slopes_in_ball(program, centre, radius, context_, scratch_) : program.lipschitz;
        return pruning::prune(program, pruning::RangesInBall{centre, slope, radius, context_.value_error}, context_,
                              arenas());
    }
    std::optional<WorkingProgram> pruned_by_enclosures(WorkingProgram program, const Bounds& region) {
        bounding::Encloser encloser(context_, region, {}, {}, scratch_);
        for (int round = 0; round < 3; ++round) {
            const auto ranges = encloser.value_ranges(program);
            if (!ranges) break;
            const auto left = pruning::prune(program, *ranges, context_, arenas());
            if (!left) return std::nullopt;
            const bool is_all_left =
                left->code.size() == program.code.size() && left->outputs.size() == program.outputs.size();
            if (is_all_left) break;
            program = *left;
        }
        return program;
    }

    void fill(const BoxRange& range, std::int32_t content) {
        for (int z = range.first.z; z < range.end.z; ++z)
            for (int y = range.first.y; y < range.end.y; ++y)
                for (int x = range.first.x; x < range.end.x; ++x)
                    grid_.content[static_cast<std::size_t>((z * grid_.boxes[1] + y) * grid_.boxes[0] + x)] = content;
    }
    std::int32_t number_of(const WorkingProgram& program) {
        std::vector<std::uint32_t> key;
        for (const Instruction& in : program.code)
            key.insert(key.end(), {static_cast<std::uint32_t>(in.op), in.a, in.b, in.data});
        for (const ProgramOutput& o : program.outputs)
            key.insert(key.end(), {static_cast<std::uint32_t>(o.phase.index), o.value, o.negate ? 1u : 0u});
        const auto [found, is_new] = numbers_.try_emplace(std::move(key), numbers_.size());
        if (is_new)
            grid_.programs.push_back(
                {{program.code.begin(), program.code.end()}, {program.outputs.begin(), program.outputs.end()}});
        return static_cast<std::int32_t>(found->second);
    }

    PrunedGrid& grid_;
    const ProgramContext context_;
    float reach_;
    bool has_jumps_;
    const std::function<bool()>& cancelled_;
    Arena programs_, scratch_;
    std::map<std::vector<std::uint32_t>, std::size_t> numbers_;
};

}  // namespace

PrunedGrid prune_on_grid(Program& program, const Bounds& bounds, float reach, int along,
                         const std::function<bool()>& cancelled) {
    PrunedGrid grid;
    grid.bounds = bounds;
    const glm::vec3 size = bounds.high - bounds.low;
    const float longest = std::max({size.x, size.y, size.z});
    for (int i = 0; i < 3; ++i)
        grid.boxes[static_cast<std::size_t>(i)] =
            std::clamp(static_cast<int>(std::ceil(static_cast<float>(along) * size[i] / longest - 1e-3f)), 1, along);
    grid.content.resize(static_cast<std::size_t>(grid.boxes[0] * grid.boxes[1] * grid.boxes[2]));
    Arena arena;
    const WorkingProgram whole = rewriting::rewrite(program, arena);
    GridPruning pruning(grid, whole, program.constants, reach, cancelled);
    pruning.divide({glm::ivec3(0), glm::ivec3(grid.boxes[0], grid.boxes[1], grid.boxes[2])}, whole);
    return grid;
}

}  // namespace phasetree::glsl
