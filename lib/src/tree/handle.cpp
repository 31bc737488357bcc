#include "phasetree/model/handle.hpp"

#include <fmt/format.h>
#include <unordered_set>

#include "tree/walk.hpp"

namespace phasetree {

namespace detail {

std::string describe(const Limits& l) {
    if (l == limits::positive) return "positive";
    if (l == limits::non_negative) return "zero or more";
    if (l == limits::any) return "a finite number";
    const bool lower = l.low > limits::any.low, upper = l.high < limits::any.high;
    std::string low = fmt::format("{} {}", l.low_open ? "more than" : "at least", l.low);
    std::string high = fmt::format("{} {}", l.high_open ? "less than" : "at most", l.high);
    if (lower && upper) return low + " and " + high;
    return lower ? low : high;
}

}  // namespace detail

namespace {

template <class Handle>
void count(const Handle& handle, std::unordered_set<const void*>& seen, TreeStatistics& s) {
    if (!seen.insert(handle.node()).second) return;
    s.depth = std::max(s.depth, handle.node()->depth);
    std::visit(
        [&](const auto& n) {
            // A node counts with the size of its own struct, although the variant has room for the largest one. The two
            // pointers of the handle that refers to it are added.
            s.nodes += 1;
            s.bytes += sizeof(n) + 2 * sizeof(void*);
            for_each_parameter(n, [&](const auto& value, const Parameter&) {
                if constexpr (requires { value.capacity(); }) s.bytes += value.size() * sizeof(value[0]);
                if constexpr (requires { value.content; })
                    if (value.content) s.bytes += value.content->bytes();
            });
            // Data that nodes derive from their parameters and keep count, too.
            if constexpr (requires { n.derived_bytes(); })
                s.bytes += n.derived_bytes();
            else if constexpr (requires { n.data(); })
                s.bytes += n.data().size_bytes();
            for_each_child(n, [&](const auto& child) { count(child, seen, s); });
        },
        handle.node()->node);
}

template <class Handle>
TreeStatistics statistics_of(const Handle& handle) {
    TreeStatistics s;
    std::unordered_set<const void*> seen;
    count(handle, seen, s);
    return s;
}

}  // namespace

Bounds bounds(const Field& f) {
    BoundsQuery query;
    return query(f, 0.f);
}
Bounds bounds(const Phased& a) {
    BoundsQuery query;
    return query(a, 0.f);
}

PhaseSet phases(const Phased& a) {
    return a.node()->phases;
}

float distance(const Field& f, const glm::vec3& p) {
    return Walk<float>().field(f, {p.x, p.y, p.z});
}
Phases<float> distances(const Phased& a, const glm::vec3& p) {
    return Walk<float>().phases(a, {p.x, p.y, p.z});
}

Phase label(const Phases<float>& a) {
    int best = std::countr_zero(a.present);
    for_each_phase(a.present, [&](int i) {
        if (a[i] < a[best]) best = i;
    });
    return {static_cast<std::uint8_t>(best)};
}

TreeStatistics statistics(const Field& f) {
    return statistics_of(f);
}
TreeStatistics statistics(const Phased& a) {
    return statistics_of(a);
}

}  // namespace phasetree
