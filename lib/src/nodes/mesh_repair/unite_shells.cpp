#include "nodes/mesh_repair/unite_shells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "nodes/box_tree.hpp"
#include "nodes/mesh_repair/arrange.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree::mesh {

namespace {

// Arranges a chain. Returns nullopt if rays contradict its winding numbers.
std::optional<std::vector<SideWinding>> arranged_windings(Chain& chain, const std::string& name,
                                                          model::Preparation& work) {
    const std::vector<std::uint32_t> touching_others = arrange(chain, name, work);
    std::vector<SideWinding> windings = windings_of(chain);
    if (!are_confirmed(chain, windings, touching_others)) return std::nullopt;
    return windings;
}

[[noreturn]] void reject_inseparable(const std::string& name) {
    throw ModelError(
        fmt::format("mesh: {} has parts that lie on each other within rounding and cannot be separated: "
                    "move one of them by a ten-thousandth of the mesh's size, or remove it",
                    name));
}

Bounds box_of(const Chain& chain) {
    Bounds box;
    for (std::size_t t = 0; t < chain.triangles.size(); ++t) box = unite(box, chain.box(t));
    return box;
}

std::vector<Bounds> boxes_of_shells(const Chain& chain, std::span<const std::uint32_t> shells) {
    std::vector<Bounds> boxes;
    for (std::size_t t = 0; t < shells.size(); ++t) {
        if (shells[t] >= boxes.size()) boxes.resize(shells[t] + 1);
        boxes[shells[t]] = unite(boxes[shells[t]], chain.box(t));
    }
    return boxes;
}

class Uniting {
  public:
    Uniting(const Chain& chain, std::span<const std::uint32_t> shells, const std::string& name,
            model::Preparation& work)
        : chain_(chain), name_(name), work_(work), boxes_(boxes_of_shells(chain, shells)), members_(boxes_.size()) {
        for (std::uint32_t t = 0; t < shells.size(); ++t) members_[shells[t]].push_back(t);
        number_.assign(chain.points.size(), unused);
    }

    std::optional<Chain> run() {
        std::vector<std::uint32_t> order;
        for (std::uint32_t s = 0; s < members_.size(); ++s)
            if (!members_[s].empty()) order.push_back(s);  // others were sheets
        return union_of(order);
    }

  private:
    static constexpr std::uint32_t unused = 0xffffffff;

    // Of at least one shell.
    std::optional<Chain> union_of(std::span<std::uint32_t> shells) {
        if (shells.size() == 1) return solid(shells[0]);
        Bounds centres;
        for (const std::uint32_t s : shells) centres = unite(centres, {boxes_[s].centre(), boxes_[s].centre()});
        const glm::vec3 extent = centres.extent();
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
        std::ranges::sort(shells, {}, [&](std::uint32_t s) { return std::pair(boxes_[s].centre()[axis], s); });
        std::optional<Chain> first = union_of(shells.first(shells.size() / 2));
        if (!first) return std::nullopt;
        std::optional<Chain> second = union_of(shells.subspan(shells.size() / 2));
        if (!second || first->triangles.empty()) return second;
        if (second->triangles.empty()) return first;
        return united(*first, *second);
    }

    Chain united(const Chain& first, const Chain& second) {
        const bool are_apart = intersect(box_of(first).inflated(margin), box_of(second)).empty();
        Chain both = first;
        const auto offset = static_cast<std::uint32_t>(both.points.size());
        both.points.insert(both.points.end(), second.points.begin(), second.points.end());
        for (ChainTriangle t : second.triangles) {
            for (std::uint32_t& v : t.corners) v += offset;
            both.triangles.push_back(t);
        }
        if (are_apart) return both;
        return arranged_boundary(both, WindingRule::winding_number, name_, work_);
    }

    // The solid within a shell; nullopt if it winds around some points negatively.
    std::optional<Chain> solid(std::uint32_t shell) {
        Chain own{chain_.step, {}, {}};
        std::vector<std::uint32_t> used;
        for (const std::uint32_t t : members_[shell]) {
            ChainTriangle moved = chain_.triangles[t];
            for (std::uint32_t& v : moved.corners) {
                if (number_[v] == unused) {
                    number_[v] = static_cast<std::uint32_t>(own.points.size());
                    own.points.push_back(chain_.points[v]);
                    used.push_back(v);
                }
                v = number_[v];
            }
            own.triangles.push_back(moved);
        }
        for (const std::uint32_t v : used) number_[v] = unused;
        const auto windings = arranged_windings(own, name_, work_);
        const auto is_negative = [](const SideWinding& w) { return w.front < 0 || w.back < 0; };
        if (!windings || std::ranges::any_of(*windings, is_negative)) return std::nullopt;
        return boundary_of(own, *windings, WindingRule::winding_number);
    }

    static constexpr float margin = static_cast<float>(touching);

    const Chain& chain_;
    const std::string& name_;
    model::Preparation& work_;
    std::vector<Bounds> boxes_;
    std::vector<std::vector<std::uint32_t>> members_;  // the triangles of each shell
    std::vector<std::uint32_t> number_;                // of each vertex in the chain that is being made
};

}  // namespace

Chain arranged_boundary(Chain& chain, WindingRule rule, const std::string& name, model::Preparation& work) {
    const auto windings = arranged_windings(chain, name, work);
    if (!windings) reject_inseparable(name);
    return boundary_of(chain, *windings, rule);
}

bool overlap_often(const Chain& chain, std::span<const std::uint32_t> shells) {
    constexpr std::size_t often = 8;  // pairs per shell
    const std::vector<Bounds> boxes = boxes_of_shells(chain, shells);
    if (boxes.size() <= often) return false;
    const BoxTree tree(boxes, 4);
    std::size_t pairs = 0;
    for (std::uint32_t s = 0; s < boxes.size() && pairs <= often * boxes.size(); ++s) {
        const auto overlaps = [&](const Bounds& box) { return !intersect(box, boxes[s]).empty(); };
        tree.for_each_leaf(overlaps, [&](std::uint32_t first, std::uint32_t count) {
            for (std::uint32_t i = first; i < first + count; ++i)
                pairs += tree.order[i] > s && overlaps(boxes[tree.order[i]]);
        });
    }
    return pairs > often * boxes.size();
}

std::optional<Chain> union_of_shells(const Chain& chain, std::span<const std::uint32_t> shells, const std::string& name,
                                     model::Preparation& work) {
    return Uniting(chain, shells, name, work).run();
}

}  // namespace phasetree::mesh
