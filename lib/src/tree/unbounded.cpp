#include "phasetree/tree/unbounded.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <unordered_set>

#include "tree/node.hpp"

namespace phasetree {

namespace {

// The search stops after this many parts, or after building this many nodes with balls instead of children.
constexpr std::size_t most_parts = 3, most_trials = 64;

bool is_unbounded(const Bounds& b) {
    return !b.empty() && !b.finite();
}

// A bounded tree that can take the place of another one.
Field ball_like(const Field&) {
    return Sphere{.radius = 1};
}
Phased ball_like(const Phased& object) {
    Phase first{1};
    for (std::uint8_t i = Phase::capacity - 1; i > 0; --i)
        if (phases(object).contains(Phase{i})) first = Phase{i};
    return Set{.phase = first, .of = Sphere{.radius = 1}};
}

// Calls visit(child, key) for each child of a node, which may be changed. `key` is its parameter, with an index if that
// is a list.
template <class Node, class Visit>
void for_each_child_and_key(Node& node, Visit&& visit) {
    for_each_parameter(node, [&](auto& value, const Parameter& p) {
        using T = std::remove_cvref_t<decltype(value)>;
        if constexpr (std::is_same_v<T, Field> || std::is_same_v<T, Phased>) {
            if (value) visit(value, std::string(p.name));
        } else if constexpr (std::is_same_v<T, std::vector<Field>> || std::is_same_v<T, std::vector<Phased>>) {
            for (std::size_t i = 0; i < value.size(); ++i) visit(value[i], fmt::format("{}[{}]", p.name, i));
        }
    });
}

class Search {
  public:
    // `tree` is unbounded.
    template <class Handle>
    void find(const Handle& tree, const std::string& path) {
        if (!visited_.insert(tree.node()).second) return;
        std::visit([&](const auto& node) { find_in(tree, node, path); }, tree.node()->node);
    }

    std::vector<UnboundedPart> found;

  private:
    template <class Handle, class Node>
    void find_in(const Handle& tree, const Node& node, const std::string& before) {
        const std::string kind(Node::info.name);
        const std::string path = before + kind;
        bool has_cause = false;
        std::size_t number = 0;
        for_each_child_and_key(node, [&](const auto& child, const std::string& key) {
            const std::size_t this_one = number++;
            if (found.size() == most_parts || !is_unbounded(bounds(child))) return;
            if (!is_unbounded_with_only<Handle>(node, this_one)) return;
            has_cause = true;
            find(child, fmt::format("{}.{}.", path, key));
        });
        if (!has_cause) found.push_back({tree, kind, path});
    }

    // Whether the node is unbounded when balls replace all of its children but one.
    template <class Handle, class Node>
    bool is_unbounded_with_only(const Node& node, std::size_t kept) {
        Node copy = node;
        std::size_t number = 0;
        bool is_same = true;
        for_each_child_and_key(copy, [&](auto& child, const std::string&) {
            if (number++ == kept) return;
            child = ball_like(child);
            is_same = false;
        });
        if (is_same) return true;
        if (++trials_ > most_trials) return false;
        try {
            return is_unbounded(bounds(Handle(std::move(copy))));
        } catch (const ModelError&) {
            return true;  // the node does not accept balls
        }
    }

    std::unordered_set<const void*> visited_;
    std::size_t trials_ = 0;
};

template <class Handle>
std::vector<UnboundedPart> parts_of(const Handle& tree) {
    if (!is_unbounded(bounds(tree))) return {};
    Search search;
    search.find(tree, "");
    return std::move(search.found);
}

// "WHAT is unbounded because of its "plane" (at set.of.plane)", and an end that says how to bound it by default.
std::string message_of(std::string_view what, const std::vector<UnboundedPart>& parts, std::string_view end = {}) {
    if (parts.empty()) return fmt::format("{} is unbounded{}", what, end.empty() ? "; intersect it with a box" : end);
    std::vector<std::string> named;
    for (const UnboundedPart& part : parts) named.push_back(fmt::format("\"{}\" (at {})", part.kind, part.path));
    return fmt::format("{} is unbounded because of its {}{}", what, fmt::join(named, ", "),
                       end.empty() ? "; " + how_to_bound(parts.front()) : std::string(end));
}

}  // namespace

std::vector<UnboundedPart> unbounded_parts(const Phased& object) {
    return parts_of(object);
}

std::vector<UnboundedPart> unbounded_parts(const Field& field) {
    return parts_of(field);
}

UnboundedError::UnboundedError(const std::vector<UnboundedPart>& parts) : ModelError(message_of("the object", parts)) {}

void detail::throw_unbounded(std::string_view what, const Field& part, std::string_view end) {
    throw ModelError(message_of(what, unbounded_parts(part), end));
}

void detail::throw_unbounded(std::string_view what, const Phased& part, std::string_view end) {
    throw ModelError(message_of(what, unbounded_parts(part), end));
}

std::string how_to_bound(const UnboundedPart& part) {
    if (std::holds_alternative<Field>(part.node))
        return fmt::format("intersect it with a box: {{\"intersection\": {{\"of\": [{{\"{}\": …}}, {{\"box\": …}}]}}}}",
                           part.kind);
    return fmt::format(
        "intersect it with a box: {{\"intersect_shape\": {{\"of\": {{\"{}\": …}}, \"shape\": {{\"box\": …}}}}}}",
        part.kind);
}

}  // namespace phasetree
