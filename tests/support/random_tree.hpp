#pragma once

/// Random trees for the tests over all nodes. They come from the node lists and the nodes' own lists of parameters, so
/// a new node is drawn, as a root and as a child, without a line here. What a node's prepare() refuses is drawn again.
///
/// The values keep an object about a metre large. A third of them are multiples of a quarter: coincident faces, equal
/// radii, zero angles and exact ties are where sign errors and missing cases hide.

#include <cmath>
#include <concepts>
#include <cstdint>
#include <cstdlib>

#include "phasetree/nodes/node.hpp"

namespace phasetree::tests {

/// SplitMix64 (Steele, Lea, Flood, OOPSLA 2014): the same numbers with every standard library.
class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    /// In [0, 1).
    double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    float uniform(float low, float high) { return low + (high - low) * static_cast<float>(unit()); }
    int below(int n) { return static_cast<int>(unit() * n); }
    bool chance(double p) { return unit() < p; }
    glm::vec3 in(const Bounds& b) {
        const float x = uniform(b.low.x, b.high.x), y = uniform(b.low.y, b.high.y), z = uniform(b.low.z, b.high.z);
        return {x, y, z};
    }
    /// Uniform on the unit sphere.
    glm::vec3 direction() {
        const double z = 2 * unit() - 1, a = 6.283185307179586 * unit(), r = std::sqrt(1 - z * z);
        return glm::vec3(glm::normalize(glm::dvec3(r * std::cos(a), r * std::sin(a), z)));
    }

  private:
    std::uint64_t state_;
};

/// Depth 1 is a primitive; for an object, a primitive with a phase.
Field random_field(Random&, int depth);
Phased random_object(Random&, int depth);

/// The phases that random objects use are 1 … this.
inline constexpr int random_phases = 4;

template <class Node>
concept IsFieldNode = requires {
    Node::is_field_node;
};
/// Nodes that refuse an unbounded child.
template <class Node>
concept NeedsBoundedChild = requires(Node n) {
    n.warp;
    requires LocalWarp<decltype(n.warp)>;
};

namespace detail {

inline float allowed(float v, const Limits& l, Random& rng) {
    if (l.contains(v)) return v;
    const float low = std::max(l.low, -1.f), high = std::min(l.high, 1.f);
    return rng.uniform(low + 0.01f * (high - low), high - 0.01f * (high - low));
}

/// A number that suits its unit and limits; mostly small sizes, a few large ones.
inline float random_number(Random& rng, const Parameter& p) {
    const bool negative = p.limits.contains(-0.01f), round = rng.chance(0.3);
    const auto rounded = [&](float v, float unit) { return round ? std::round(v / unit) * unit : v; };
    if (p.unit == "degrees") return allowed(rounded(rng.uniform(-180, 180), 45), p.limits, rng);
    if (p.unit == "degrees/m") return allowed(rounded(rng.uniform(-150, 150), 45), p.limits, rng);
    // Counts; and waves long enough that an object has not thousands of them.
    if (p.unit.empty() && p.limits.low > 2) return std::floor(rng.uniform(p.limits.low, p.limits.low + 6));
    if (p.name == "period" || p.name == "scale") return rounded(rng.uniform(0.4f, 1.5f), 0.25f);
    if (p.unit == "m" && !negative) {
        const float u = rng.uniform(0, 1);
        return allowed(rounded(0.04f + 1.2f * u * u, 0.25f), p.limits, rng);
    }
    if (p.unit == "m") return allowed(rounded(rng.uniform(-0.6f, 0.6f), 0.25f), p.limits, rng);
    if (negative) return allowed(rounded(rng.uniform(-1, 1), 1), p.limits, rng);
    return allowed(rounded(rng.uniform(0.4f, 2.2f), 0.5f), p.limits, rng);
}

inline Field bounded(Random& rng, Field f) {
    if (bounds(f).finite()) return f;
    return Intersection{.of = {std::move(f), Sphere{.radius = rng.uniform(0.8f, 1.6f)}}};
}
inline Phased bounded(Random& rng, Phased a) {
    if (bounds(a).finite()) return a;
    return IntersectShape{.of = std::move(a), .shape = Sphere{.radius = rng.uniform(0.8f, 1.6f)}, .phases_cut = {}};
}

template <class Node, class Value>
void fill(Random& rng, Value& value, const Parameter& p, int depth) {
    const auto draw = [&](auto& child) {
        if constexpr (std::is_same_v<std::remove_cvref_t<decltype(child)>, Field>)
            child = random_field(rng, depth);
        else
            child = random_object(rng, depth);
        if constexpr (NeedsBoundedChild<Node>) child = bounded(rng, child);
    };
    if (p.optional && rng.chance(0.3)) return;
    if constexpr (std::is_same_v<Value, float>) {
        value = random_number(rng, p);
    } else if constexpr (std::is_same_v<Value, int>) {
        value = 1 + rng.below(2);  // counts multiply, in a grid and down the tree
    } else if constexpr (std::is_same_v<Value, glm::vec3>) {
        for (int i = 0; i < 3; ++i) value[i] = random_number(rng, p);
    } else if constexpr (std::is_same_v<Value, Phase>) {
        value = Phase{static_cast<std::uint8_t>(1 + rng.below(random_phases))};
    } else if constexpr (std::is_same_v<Value, PhaseSet>) {
        value = PhaseSet{(rng.bits() & ((1u << (random_phases + 1)) - 1)) & ~std::uint64_t{rng.chance(0.8)}};
    } else if constexpr (std::is_same_v<Value, Field> || std::is_same_v<Value, Phased>) {
        draw(value);
    } else if constexpr (std::is_same_v<Value, std::vector<float>> || std::is_same_v<Value, std::vector<Phase>>) {
        // A node's lists belong together, one as long as the other, or one shorter, or one for all: it refuses the
        // rest.
        value.resize(static_cast<std::size_t>(1 + rng.below(3)));
        Parameter each = p;
        each.optional = false;
        for (auto& item : value) fill<Node>(rng, item, each, depth);
    } else {
        // Mostly two or three, now and then the single child that a fold over the rest must survive.
        value.resize(static_cast<std::size_t>(rng.chance(0.1) ? 1 : 2 + rng.below(2)));
        using Entry = typename Value::value_type;
        if constexpr (std::is_same_v<Entry, Field> || std::is_same_v<Entry, Phased>) {
            for (auto& child : value) draw(child);
        } else {
            Parameter each = p;
            each.optional = false;
            for (auto& v : value) fill<Node>(rng, v, each, depth);
        }
    }
}

template <class... Nodes, class F>
void with_random_type(Random& rng, TypeList<Nodes...>, F&& f) {
    int chosen = rng.below(static_cast<int>(sizeof...(Nodes)));
    ((chosen-- == 0 ? f.template operator()<Nodes>() : void()), ...);
}

}  // namespace detail

/// One random instance with this node at its root.
template <class Node>
auto random_rooted(Random& rng, int depth) {
    using Handle = std::conditional_t<IsFieldNode<Node>, Field, Phased>;
    for (int attempt = 0;; ++attempt) {
        Node node;
        // What a shallow tree never has, such as two phases, a deeper one has.
        const int below = depth - 1 + attempt / 20;
        for_each_parameter(node, [&](auto& value, const Parameter& p) { detail::fill<Node>(rng, value, p, below); });
        try {
            return Handle(node);
        } catch (const ModelError&) {
            if (attempt == 200) throw;
        }
    }
}

inline Field random_field(Random& rng, int depth) {
    Field result;
    const auto make = [&]<class Node>() { result = random_rooted<Node>(rng, depth); };
    if (depth <= 1)
        detail::with_random_type(rng, phasetree::detail::OnlyPrimitives<PlainFields>::type(), make);
    else
        detail::with_random_type(rng, FieldNodes(), make);
    return result;
}

inline Phased random_object(Random& rng, int depth) {
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

/// Where to sample an object: its bounds, and some space around; the part about the origin if it is unbounded.
inline Bounds region_of_interest(const Bounds& b) {
    const Bounds near = intersect(b, Bounds::centred(glm::vec3(3)));
    return near.empty() ? Bounds::centred(glm::vec3(1)) : near.inflated(0.1f + 0.1f * near.diagonal());
}

/// The long form of a test: many times the samples, for a run over night.
inline bool long_tests() {
    return std::getenv("PHASETREE_LONG_TESTS") != nullptr;
}

}  // namespace phasetree::tests
