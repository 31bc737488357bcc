#include "nodes/box_tree.hpp"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace phasetree {

namespace {

// Divides boxes, which are moved along with their indices, because memory is read fastest in order.
class Divider {
  public:
    struct Item {
        std::array<float, 3> centre;
        std::uint32_t index;
    };

    Divider(std::span<const Bounds> boxes, std::uint32_t most, BoxTree& tree, std::vector<std::uint32_t>& behind)
        : boxes_(boxes), most_(most), tree_(tree), behind_(behind), items_(boxes.size()) {
        for (std::uint32_t i = 0; i < items_.size(); ++i) {
            const glm::vec3 c = boxes[i].centre();
            items_[i] = {{c.x, c.y, c.z}, i};
        }
    }
    void run() {
        const auto count = static_cast<std::uint32_t>(items_.size());
        tree_.nodes.resize(nodes_of(count));
        behind_.resize(tree_.nodes.size());
        divide(0, 0, count);
    }

  private:
    // The number of nodes of a tree with this number of items. On each level, nodes have either n or n + 1 items.
    std::uint32_t nodes_of(std::uint32_t count) const {
        // How many nodes of the level have `count` items, and how many have one more.
        std::uint64_t fewer = 1, more = 0, nodes = 0;
        for (; fewer + more > 0; count /= 2) {
            nodes += fewer + more;
            if (count <= most_) fewer = 0;
            if (count + 1 <= most_) more = 0;
            const bool is_odd = count % 2 != 0;
            const std::uint64_t next_fewer = is_odd ? fewer : 2 * fewer + more,
                                next_more = is_odd ? fewer + 2 * more : more;
            fewer = next_fewer;
            more = next_more;
        }
        return static_cast<std::uint32_t>(nodes);
    }

    // Writes the node `self` and all below it.
    void divide(std::uint32_t self, std::uint32_t first, std::uint32_t count) {
        Bounds centres;
        const std::span<Item> range = std::span(items_).subspan(first, count);
        for (const Item& item : range) {
            const glm::vec3 c(item.centre[0], item.centre[1], item.centre[2]);
            centres = unite(centres, {c, c});
        }
        BoxTree::Node& node = tree_.nodes[self];
        node.first = first;
        node.count = count;
        behind_[self] = self + nodes_of(count);
        if (count <= most_) {
            for (std::uint32_t i = first; i < first + count; ++i) {
                tree_.order[i] = items_[i].index;
                node.box = unite(node.box, boxes_[items_[i].index]);
            }
            return;
        }
        const glm::vec3 extent = centres.extent();
        const std::size_t axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
        const std::uint32_t half = count / 2;
        std::nth_element(range.begin(), range.begin() + half, range.end(), [&](const Item& a, const Item& b) {
            return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis] : a.index < b.index;
        });
        node.second_child = self + 1 + nodes_of(half);
        constexpr std::uint32_t enough_for_two_threads = 4096;
        const auto one = [&] { divide(self + 1, first, half); };
        const auto other = [&] { divide(node.second_child, first + half, count - half); };
        if (count < enough_for_two_threads) {
            one();
            other();
        } else {
            tbb::parallel_invoke(one, other);
        }
        node.box = unite(tree_.nodes[self + 1].box, tree_.nodes[node.second_child].box);
    }

    std::span<const Bounds> boxes_;
    std::uint32_t most_;
    BoxTree& tree_;
    std::vector<std::uint32_t>& behind_;
    std::vector<Item> items_;
};

}  // namespace

BoxTree::BoxTree(std::span<const Bounds> items, std::uint32_t most) : order(items.size()) {
    Divider(items, most, *this, behind_).run();
}

}  // namespace phasetree
