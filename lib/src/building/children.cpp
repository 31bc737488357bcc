#include "building/children.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include "building/values_at_points.hpp"
#include "pruning/jumps.hpp"
#include "rewriting/features.hpp"

namespace phasetree::building {

using evaluation::ValuesAtPoint;
using pruning::finest_jump, pruning::may_jump, pruning::prune, pruning::RangesInBall, pruning::slopes_in_ball;
using rewriting::ArenaScope, rewriting::finest_pattern;

namespace {

// Evaluates a node's program at the centres of boxes, one per lane. The result reads lane 0, which holds the values for
// the first box; Children::prepare() reads the lanes of the others.
ValuesAtPoint values_at_centres(const BuildNode& node, const SubBoxes& boxes, Worker& worker) {
    static_assert(batch_size >= SubBoxes::most, "each child has a lane of its own");
    std::array<glm::vec3, SubBoxes::most> centres;
    for (std::size_t i = 0; i < boxes.count; ++i) centres[i] = boxes.box[i].centre();
    return values_at_points(node.program, node.specialisations, std::span(centres).first(boxes.count), worker);
}

}  // namespace

Children::Children(const BuildNode& parent, const BuildContext& context, Worker& worker)
    : parent_(parent),
      context_(context),
      boxes_(parent.box),
      values_(values_at_centres(parent, boxes_, worker)),
      nodes_(worker.scratch.allocate<BuildNode>(boxes_.count)),
      has_jumps_(context.program.has_folds && may_jump(parent.program)) {}

void Children::prepare(std::size_t i, Worker& own) {
    const ArenaScope scope(own.scratch);
    const float radius = 0.5f * boxes_.box[i].inflated(context_.reach).diagonal() * (1 + 1e-5f);
    const ValuesAtPoint centre{values_.registers, values_.slot, i};
    const std::span<const float> slope =
        has_jumps_ ? slopes_in_ball(parent_.program, centre, radius, context_.program, own.scratch)
                   : parent_.program.lipschitz;
    const RangesInBall ranges{centre, slope, radius, context_.program.value_error};
    std::span<const RequiredOfLocal> required;
    const auto program = prune(parent_.program, ranges, context_.program, own.arenas(), required);
    if (!program) return;
    BuildNode& child = *std::construct_at(
        &nodes_[i], BuildNode{boxes_.box[i], *program, parent_.specialisations, required, parent_.depth + 1});
    if (std::isfinite(parent_.fold_period)) child.fold_period = finest_jump(child.program, context_.program.constants);
    if (std::isfinite(parent_.pattern_period))
        child.pattern_period = finest_pattern(child.program, context_.program.constants);
    child.is_small_cheaper = parent_.is_small_cheaper;
    is_left_[i] = building::prepare(child, context_, own);
}

std::ptrdiff_t Children::left_count() const {
    return std::ranges::count(is_left_, true);
}

float Children::cost() const {
    float sum = cost_model::traversal * surface(parent_.box);
    for (std::size_t i = 0; i < boxes_.count; ++i)
        if (is_left_[i]) sum += nodes_[i].cell.cost;
    return sum;
}

}  // namespace phasetree::building
