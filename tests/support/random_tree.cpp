#include "support/random_tree.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "support/random_node.hpp"

namespace phasetree::tests {

Field random_field(Random& rng, int depth) {
    Field result;
    const auto make = [&]<class Node>() { result = random_rooted<Node>(rng, depth); };
    if (depth <= 1)
        detail::with_random_type(rng, phasetree::detail::OnlyPrimitives<PlainFields>::type(), make);
    else
        detail::with_random_type(rng, FieldNodes(), make);
    return result;
}

Phased random_object(Random& rng, int depth) {
    Phased result;
    const auto make = [&]<class Node>() { result = random_rooted<Node>(rng, depth); };
    if (depth <= 1)
        result = random_rooted<Set>(rng, 2);
    else if (rng.chance(0.3))
        result = random_rooted<Under>(rng, depth);  // else chains of unary nodes with one phase would prevail
    else
        detail::with_random_type(rng, PhasedNodes(), make);
    return result;
}

std::span<const NodeKind> node_kinds() {
    static const std::vector<NodeKind> kinds = [] {
        std::vector<NodeKind> all;
        for_each_type(FieldNodes(), [&]<class Node>() {
            all.push_back({Node::info.name, true,
                           [](Random& rng, int depth) -> Phased {
                               return Set{.phase = Phase{1}, .of = random_rooted<Node>(rng, depth - 1)};
                           },
                           [](Random& rng, int depth) { return random_rooted<Node>(rng, depth); }});
        });
        for_each_type(PhasedNodes(), [&]<class Node>() {
            all.push_back({Node::info.name, false,
                           [](Random& rng, int depth) { return random_rooted<Node>(rng, depth); }, nullptr});
        });
        return all;
    }();
    return kinds;
}

const NodeKind& object_kind(std::string_view name) {
    const auto kinds = node_kinds();
    const auto found =
        std::find_if(kinds.begin(), kinds.end(), [&](const NodeKind& k) { return !k.is_field && k.name == name; });
    if (found == kinds.end()) throw std::logic_error("no such kind of node");
    return *found;
}

}  // namespace phasetree::tests
