#include "phasetree/model/bounds_query.hpp"

#include <unordered_map>
#include <unordered_set>

#include "model/preparation.hpp"
#include "phasetree_support/mixed_hash.hpp"
#include "tree/node.hpp"

namespace phasetree {

using model::PreparationTogether;

namespace {

// Returns `box` with only those sides moved that are tighter in `tighter` by more than a hundredth of its size. The
// other sides stay in place, so that rounding errors do not move them.
Bounds tightened(const Bounds& box, const Bounds& tighter) {
    if (tighter.empty()) return {};
    Bounds result = box;
    for (int i = 0; i < 3; ++i) {
        const float size = box.high[i] - box.low[i];
        const auto is_tighter = [&](float by) { return by > (std::isfinite(size) ? 0.01f * size : 0.f); };
        if (is_tighter(tighter.low[i] - box.low[i])) result.low[i] = tighter.low[i];
        if (is_tighter(box.high[i] - tighter.high[i])) result.high[i] = tighter.high[i];
    }
    return result;
}

}  // namespace

struct BoundsQuery::Memory {
    struct Key {
        const void* node;
        float level;
        bool operator==(const Key&) const = default;
    };
    struct DirectedKey {
        Key key;
        Directions directions;
        bool operator==(const DirectedKey&) const = default;
    };
    struct Hash {
        std::size_t operator()(const Key& k) const {
            std::size_t hash = std::hash<const void*>()(k.node);
            hash = support::mixed(hash, std::hash<float>()(k.level));
            return hash;
        }
        std::size_t operator()(const DirectedKey& k) const {
            std::size_t hash = (*this)(k.key);
            for (const glm::dvec3& d : k.directions)
                for (int i = 0; i < 3; ++i) hash = support::mixed(hash, std::hash<double>()(d[i]));
            return hash;
        }
    };
    std::unordered_map<Key, Bounds, Hash> boxes;                        // answers by boxes
    std::unordered_map<DirectedKey, Bounds, Hash> directed;             // answers by directions
    std::unordered_map<const void*, std::unordered_set<float>> levels;  // the levels for which each node was queried
    std::size_t asked = 0;  // the number of subtrees queried by directions since the root was

    // The level for which a node is queried instead of the given one. A tree of offsets of shared subtrees can query
    // exponentially many levels. So beyond the first few, levels are rounded up to a small set of numbers: the box of a
    // higher level contains that of a lower one.
    float rounded_level(const void* node, float level) {
        std::unordered_set<float>& known = levels[node];
        if (known.contains(level)) return level;
        if (known.size() < 16) {
            known.insert(level);
            return level;
        }
        int exponent = 0;
        const float mantissa = std::frexp(level, &exponent);
        return std::ldexp(std::ceil(mantissa * 8) / 8, exponent);
    }
};

BoundsQuery::BoundsQuery() : memory_(std::make_unique<Memory>()) {}
BoundsQuery::~BoundsQuery() = default;

// The box of six supports, with a margin for rounding errors that grows with the largest of them.
Bounds BoundsQuery::gathered(const Supports& supports) {
    double largest = 0;
    for (const double r : supports)
        if (std::isfinite(r)) largest = std::max(largest, std::abs(r));
    const double margin = 1e-6 * largest;
    Bounds b;
    for (int i = 0; i < 3; ++i) {
        b.low[i] = static_cast<float>(-(supports[static_cast<std::size_t>(i)] + margin));
        b.high[i] = static_cast<float>(supports[static_cast<std::size_t>(i) + 3] + margin);
    }
    return b;
}

// The box of a child's six supports, after adding to each what a map of space contributes.
Bounds BoundsQuery::moved(const Bounds& box, const Supports& more) {
    if (box.low.x == Bounds::infinity) return {};
    Supports supports;
    for (int i = 0; i < 3; ++i) {
        const auto low = static_cast<std::size_t>(i), high = low + 3;
        supports[low] = more[low] - static_cast<double>(box.low[i]);
        supports[high] = more[high] + static_cast<double>(box.high[i]);
    }
    return gathered(supports);
}

// The supports of a box along the six directions.
Bounds BoundsQuery::placed(const Bounds& box) const {
    if (is_by_boxes()) return box;
    if (box.empty()) return {};
    // An infinite side counts only for directions that are not parallel to it.
    Supports supports{};
    for (std::size_t k = 0; k < supports.size(); ++k) {
        for (int i = 0; i < 3; ++i) {
            const double d = directions_[k][i];
            if (d != 0) supports[k] += d * static_cast<double>(d > 0 ? box.high[i] : box.low[i]);
        }
    }
    return gathered(supports);
}

template <class Handle>
Bounds BoundsQuery::by_boxes(const Handle& handle, float level) {
    // Nodes also query bounds when they are created, each with a new query, so the work is charged: 60 steps for a
    // query by boxes, 120 for one by directions.
    PreparationTogether::pay("bounds", 60);
    const typename Memory::Key key{handle.node(), memory_->rounded_level(handle.node(), level)};
    if (const auto found = memory_->boxes.find(key); found != memory_->boxes.end()) return found->second;
    Bounds b = std::visit([&](const auto& n) { return n.bounds(*this, key.level); }, handle.node()->node);
    if (b.empty()) b = {};
    memory_->boxes.emplace(key, b);
    return b;
}

template <class Handle>
Bounds BoundsQuery::by_directions(const Handle& handle, float level) {
    PreparationTogether::pay("bounds", 120);
    const typename Memory::DirectedKey key{{handle.node(), memory_->rounded_level(handle.node(), level)}, directions_};
    if (const auto found = memory_->directed.find(key); found != memory_->directed.end()) return found->second;
    if (++memory_->asked > max_directed) {
        way_ = Way::by_boxes;
        const Bounds box = by_boxes(handle, level);
        way_ = Way::by_directions;
        return placed(box);
    }
    const Bounds b = std::visit(
        [&](const auto& n) {
            using N = std::remove_cvref_t<decltype(n)>;
            if constexpr (requires(const glm::dvec3& d) { n.support(d, level); })
                return placed(n.bounds(*this, key.key.level),
                              [&](const glm::dvec3& d) { return n.support(d, key.key.level); });
            else if constexpr (Primitive<N> || DataPrimitive<N>)
                return placed(n.bounds(*this, key.key.level));
            else
                return n.bounds(*this, key.key.level);
        },
        handle.node()->node);
    memory_->directed.emplace(key, b);
    return b;
}

template <class Handle>
Bounds BoundsQuery::along_own_axes(const Handle& handle, float level) {
    const Directions outer = directions_;
    directions_ = along_axes;
    const Bounds b = by_directions(handle, level);
    directions_ = outer;
    return b;
}

// The answer in the requested way. The root is queried in both ways, and gets the intersection.
template <class Handle>
Bounds BoundsQuery::answer(const Handle& handle, float level) {
    if (way_ == Way::by_boxes) return by_boxes(handle, level);
    if (way_ == Way::by_directions) return by_directions(handle, level);
    way_ = Way::by_boxes;
    const Bounds box = by_boxes(handle, level);
    Bounds result = box;
    if (!box.empty()) {
        way_ = Way::by_directions;
        memory_->asked = 0;
        result = tightened(box, along_own_axes(handle, level));
    }
    way_ = Way::both;
    return result;
}

Bounds BoundsQuery::operator()(const Field& f, float level) {
    return answer(f, level);
}
Bounds BoundsQuery::operator()(const Phased& a, float level) {
    return answer(a, level);
}
Bounds BoundsQuery::own_box(const Field& f, float level) {
    return is_by_boxes() ? answer(f, level) : along_own_axes(f, level);
}
Bounds BoundsQuery::own_box(const Phased& a, float level) {
    return is_by_boxes() ? answer(a, level) : along_own_axes(a, level);
}

}  // namespace phasetree
