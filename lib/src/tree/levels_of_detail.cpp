#include "phasetree/tree/levels_of_detail.hpp"

#include <map>
#include <optional>
#include <tuple>
#include <unordered_map>

#include "tree/node.hpp"

namespace phasetree {

namespace {

template <class Node>
concept IsLevelOfDetail = requires {
    Node::is_level_of_detail;
};

// A warp that preserves angles and places its child exactly once.
template <class Warp>
concept KeepsAngles = std::is_same_v<Warp, Translate> || std::is_same_v<Warp, Rotate> || std::is_same_v<Warp, Scale>;

class Choice {
  public:
    explicit Choice(float angle) : angle_(angle) {}

    // Subtrees without such a node are kept, and shared subtrees stay shared where the view is the same.
    template <class Handle>
    Handle chosen(const Handle& tree, const glm::vec3& view) {
        if (!tree || !has_levels(tree)) return tree;
        const Key key{tree.node(), view.x, view.y, view.z};
        auto& known = known_by(tree);
        if (const auto found = known.find(key); found != known.end()) return found->second;
        Handle result =
            std::visit([&](const auto& node) { return rebuilt<Handle>(tree, node, view); }, tree.node()->node);
        known.emplace(key, result);
        return result;
    }

  private:
    using Key = std::tuple<const void*, float, float, float>;

    // The view of the node's child; nothing if the child appears in several places.
    template <class Node>
    static std::optional<glm::vec3> view_below(const Node& node, const glm::vec3& view) {
        if constexpr (requires { node.warp; }) {
            if constexpr (!KeepsAngles<std::remove_cvref_t<decltype(node.warp)>>) return std::nullopt;
            if constexpr (requires { node.over; })
                if (!node.over.empty() || !node.under.empty()) return std::nullopt;
            const Vec3<float> q = node.warp.map()(Vec3<float>{view.x, view.y, view.z});
            return glm::vec3(q.x, q.y, q.z);
        } else if constexpr (requires { Node::has_copies; }) {
            return std::nullopt;
        } else {
            return view;
        }
    }

    template <class Handle, class Node>
    Handle rebuilt(const Handle& tree, const Node& node, const glm::vec3& view) {
        const std::optional<glm::vec3> below = view_below(node, view);
        if (!below) return tree;
        Node copy = node;
        bool is_same = true;
        const auto choose = [&](auto& child) {
            auto other = chosen(child, *below);
            is_same = is_same && other == child;
            child = std::move(other);
        };
        for_each_parameter(copy, [&](auto& value, const Parameter&) {
            using T = std::remove_cvref_t<decltype(value)>;
            if constexpr (std::is_same_v<T, Field> || std::is_same_v<T, Phased>) {
                choose(value);
            } else if constexpr (std::is_same_v<T, std::vector<Field>> || std::is_same_v<T, std::vector<Phased>>) {
                for (auto& child : value) choose(child);
            }
        });
        if constexpr (IsLevelOfDetail<Node>) {
            if (copy.distances.empty() && !copy.errors.empty()) {
                copy.viewpoint = view;
                for (const float error : copy.errors) copy.distances.push_back(error / angle_);
                is_same = false;
            }
        }
        return is_same ? tree : Handle(std::move(copy));
    }

    template <class Handle>
    bool has_levels(const Handle& tree) {
        const auto found = has_levels_.find(tree.node());
        if (found != has_levels_.end()) return found->second;
        const bool has = std::visit(
            [&](const auto& node) {
                bool any = false;
                if constexpr (IsLevelOfDetail<std::remove_cvref_t<decltype(node)>>)
                    any = node.distances.empty() && !node.errors.empty();
                for_each_child(node, [&](const auto& child) { any = has_levels(child) || any; });
                return any;
            },
            tree.node()->node);
        has_levels_.emplace(tree.node(), has);
        return has;
    }

    std::map<Key, Field>& known_by(const Field&) { return fields_; }
    std::map<Key, Phased>& known_by(const Phased&) { return objects_; }

    float angle_;
    std::unordered_map<const void*, bool> has_levels_;
    std::map<Key, Field> fields_;
    std::map<Key, Phased> objects_;
};

}  // namespace

Phased with_levels_of_detail(const Phased& object, const DetailView& view) {
    if (!(view.angle > 0) || !std::isfinite(view.angle))
        throw ModelError("the viewing angle of levels of detail must be positive");
    return Choice(view.angle).chosen(object, view.position);
}

}  // namespace phasetree
