#include "nodes/box_tree.hpp"

#include <algorithm>
#include <numeric>

namespace phasetree {

BoxTree::BoxTree(std::span<const Bounds> items, std::uint32_t most) : order(items.size()) {
    std::iota(order.begin(), order.end(), 0u);
    nodes.reserve(4 * items.size() / most + 1);
    divide(items, 0, static_cast<std::uint32_t>(items.size()), most);
}

void BoxTree::divide(std::span<const Bounds> items, std::uint32_t first, std::uint32_t count, std::uint32_t most) {
    const std::size_t self = nodes.size();
    nodes.push_back({{}, 0, first, count});
    behind_.push_back(0);
    Bounds box, centres;
    const std::span<std::uint32_t> range = std::span(order).subspan(first, count);
    for (const std::uint32_t i : range) {
        box = unite(box, items[i]);
        centres = unite(centres, {items[i].centre(), items[i].centre()});
    }
    nodes[self].box = box;
    if (count > most) {
        const glm::vec3 extent = centres.extent();
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
        const std::uint32_t half = count / 2;
        std::nth_element(range.begin(), range.begin() + half, range.end(), [&](std::uint32_t a, std::uint32_t b) {
            const float ca = items[a].centre()[axis], cb = items[b].centre()[axis];
            return ca != cb ? ca < cb : a < b;
        });
        divide(items, first, half, most);
        nodes[self].second_child = static_cast<std::uint32_t>(nodes.size());
        divide(items, first + half, count - half, most);
    }
    behind_[self] = static_cast<std::uint32_t>(nodes.size());
}

}  // namespace phasetree
