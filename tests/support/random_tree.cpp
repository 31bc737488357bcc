#include "support/random_tree.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include "support/random_node.hpp"

namespace phasetree::tests {

namespace {

// A hash of a name and a number.
std::uint64_t mixed(std::string_view name, std::uint64_t number) {
    for (const char c : name) number = Random(number ^ static_cast<unsigned char>(c)).bits();
    return number;
}

// Each name is hashed with one random number, and the name with the greatest hash is chosen (rendezvous hashing).
template <class... Nodes, class F>
void with_random_type(Random& rng, TypeList<Nodes...>, F&& f) {
    const std::uint64_t number = rng.bits();
    const std::array<std::uint64_t, sizeof...(Nodes)> hashes{mixed(Nodes::info.name, number)...};
    auto chosen = std::ranges::max_element(hashes) - hashes.begin();
    ((chosen-- == 0 ? f.template operator()<Nodes>() : void()), ...);
}

// One random instance with this node at its root.
template <class Node>
auto drawn(Random& of_parent, int depth) {
    Random rng(of_parent.bits());
    using Handle = std::conditional_t<IsFieldNode<Node>, Field, Phased>;
    for (int attempt = 0;; ++attempt) {
        Node node;
        // If shallow trees never have a property, such as two phases, deeper trees are tried.
        const int below = depth - 1 + attempt / 20;
        for_each_parameter(node, [&](auto& value, const Parameter& p) { fill<Node>(rng, value, p, below); });
        if constexpr (IsEndlessGrid<Node>) {
            // Copies must not touch. They are small, so that several are near the origin.
            const glm::vec3 extent = bounds(node.of).extent();
            for (int i = 0; i < 3; ++i)
                node.spacing[i] = i < 2 && rng.chance(0.3) ? 0.f : (extent[i] + 0.01f) * rng.uniform(1.02f, 1.8f);
        }
        try {
            return Handle(node);
        } catch (const ModelError&) {
            if (attempt == 200) throw;
        }
    }
}

}  // namespace

Field random_field(Random& of_parent, int depth) {
    Random rng(of_parent.bits());
    Field result;
    const auto make = [&]<class Node>() { result = drawn<Node>(rng, depth); };
    if (depth <= 1)
        with_random_type(rng, phasetree::detail::OnlyPrimitives<PlainFields>::type(), make);
    else
        with_random_type(rng, FieldNodes(), make);
    return result;
}

Phased random_object(Random& of_parent, int depth) {
    Random rng(of_parent.bits());
    Phased result;
    const auto make = [&]<class Node>() { result = drawn<Node>(rng, depth); };
    if (depth <= 1)
        result = drawn<Set>(rng, 2);
    else if (rng.chance(0.3))
        result = drawn<Under>(rng, depth);  // else chains of unary nodes with one phase would prevail
    else
        with_random_type(rng, PhasedNodes(), make);
    return result;
}

std::span<const NodeKind> node_kinds() {
    static const std::vector<NodeKind> kinds = [] {
        std::vector<NodeKind> all;
        for_each_type(FieldNodes(), [&]<class Node>() {
            all.push_back({Node::info.name, true,
                           [](Random& rng, int depth) -> Phased {
                               return Set{.phase = Phase{1}, .of = drawn<Node>(rng, depth - 1)};
                           },
                           [](Random& rng, int depth) { return drawn<Node>(rng, depth); }});
        });
        for_each_type(PhasedNodes(), [&]<class Node>() {
            all.push_back(
                {Node::info.name, false, [](Random& rng, int depth) { return drawn<Node>(rng, depth); }, nullptr});
        });
        return all;
    }();
    return kinds;
}

Random random_for(std::uint64_t seed, const NodeKind& kind) {
    return Random(mixed(kind.name, seed));
}

const NodeKind& object_kind(std::string_view name) {
    const auto kinds = node_kinds();
    const auto found =
        std::find_if(kinds.begin(), kinds.end(), [&](const NodeKind& k) { return !k.is_field && k.name == name; });
    if (found == kinds.end()) throw std::logic_error("no such kind of node");
    return *found;
}

}  // namespace phasetree::tests
