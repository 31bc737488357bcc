#include "building/trial.hpp"

#include <algorithm>
#include <array>

#include "building/children.hpp"

namespace phasetree::building {

using rewriting::ArenaScope;

namespace {

// The child of median cost among those that are left, of which there must be one.
const BuildNode& middle_child(Children& children) {
    std::array<const BuildNode*, SubBoxes::most> left{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < children.count(); ++i)
        if (children.is_left(i)) left[count++] = &children[i];
    std::stable_sort(left.begin(), left.begin() + count,
                     [](const BuildNode* a, const BuildNode* b) { return a->cell.cost < b->cell.cost; });
    return *left[count / 2];
}

// See may_gain_by_known_pattern(). The ratio is the cost of the divisions down to this node, relative to a single cell.
bool may_gain(const BuildNode& node, float ratio, const BuildContext& context, Worker& worker) {
    const ArenaScope programs(worker.programs), scratch(worker.scratch);
    Children children(node, context, worker);
    for (std::size_t i = 0; i < children.count(); ++i) children.prepare(i, worker);
    ratio *= children.cost() / node.cell.cost;
    if (ratio < 1 || children.left_count() == 0) return true;
    const BuildNode& next = middle_child(children);
    return is_pattern_unknown(next) && may_gain(next, ratio, context, worker);
}

}  // namespace

bool may_gain_by_known_pattern(const BuildNode& node, const BuildContext& context, Worker& worker) {
    return may_gain(node, 1, context, worker);
}

}  // namespace phasetree::building
