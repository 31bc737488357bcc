// Whether the box of a tree is much larger than the object, and how many marching steps that costs.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "measuring/decide.hpp"
#include "phasetree/trace/tracer.hpp"

namespace phasetree::measuring {

/// Mean numbers of marching steps (evaluations of a batch of points) per ray.
struct MarchingCost {
    double steps = 0;               ///< from one side of the tree's box to the other
    double steps_in_tight_box = 0;  ///< for the same rays, only where they are in the box around the object
};

inline Cube empty_cube() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
}

inline void unite(Cube& all, const Cube& other) {
    for (std::size_t i = 0; i < 3; ++i) {
        all.low[i] = std::min(all.low[i], other.low[i]);
        all.high[i] = std::max(all.high[i], other.high[i]);
    }
}

/// Counts the steps of the same rays in both boxes. The rays come from all sides and cross the stated box. Each is
/// traced through all of its crossings.
inline MarchingCost marching_cost(const Evidence& e, const Phased& object, const Bounds& stated, const Cube& tight) {
    std::vector<HalfSpace> around;
    for (int axis = 0; axis < 3; ++axis) {
        const auto k = static_cast<std::size_t>(axis);
        glm::dvec3 normal(0);
        normal[axis] = 1;
        around.push_back({normal, tight.high[k]});
        around.push_back({-normal, -tight.low[k]});
    }
    const InterfaceTracer loose(object), tighter(object, around);
    constexpr int count = 256, most_crossings = 64;
    const auto steps = [&](const InterfaceTracer& tracer, const glm::vec3& origin, const glm::vec3& direction) {
        TraceCounters counters;
        float t = 0;
        std::optional<Phase> carried = vacuum;
        for (int i = 0; i < most_crossings; ++i) {
            const auto crossing = tracer.first_crossing(origin, direction, t, std::numeric_limits<float>::max(),
                                                        carried, Evaluator::thread_workspace(), &counters);
            if (!crossing) break;
            t = crossing->t_to;
            carried = crossing->to;
        }
        return static_cast<double>(counters.batches);
    };
    // An additive recurrence in six dimensions: a direction, and a point of the stated box.
    const auto coordinate = [](int i, int dimension) {
        constexpr std::array<double, 6> roots{1.4142135623730951, 1.7320508075688772, 2.23606797749979,
                                              2.6457513110645906, 3.3166247903554,    3.605551275463989};
        const double v = (i + 1) * roots[static_cast<std::size_t>(dimension)];
        return v - std::floor(v);
    };
    MarchingCost cost;
    int traced = 0;
    for (int i = 0; traced < count && !e.is_stopped(); ++i) {
        glm::dvec3 direction, target;
        for (int axis = 0; axis < 3; ++axis) {
            direction[axis] = 2 * coordinate(i, axis) - 1;
            const auto low = static_cast<double>(stated.low[axis]), high = static_cast<double>(stated.high[axis]);
            target[axis] = low + coordinate(i, 3 + axis) * (high - low);
        }
        const double length = glm::length(direction);
        if (!(length > 0.1 && length <= 1)) continue;  // uniform directions: points in a ball
        direction /= length;
        const glm::vec3 origin(target - 1.5 * static_cast<double>(stated.diagonal()) * direction);
        cost.steps += steps(loose, origin, glm::vec3(direction));
        cost.steps_in_tight_box += steps(tighter, origin, glm::vec3(direction));
        ++traced;
    }
    cost.steps /= std::max(traced, 1);
    cost.steps_in_tight_box /= std::max(traced, 1);
    return cost;
}

/// Decides whether the box of the tree fits the object.
inline Proof decide(const Evidence& e, const HasTightBounds& s, const Phased& object) {
    const Bounds stated = bounds(object);
    // Boxes around everything that may be, and that certainly is, in a phase other than the vacuum.
    Cube outer = empty_cube(), inner = outer;
    for (const OctreeLeaf& leaf : e.octree.leaves) {
        if ((leaf.possible & ~std::uint64_t{1}) == 0) continue;
        const Cube cube = e.octree.cube(leaf);
        unite(outer, cube);
        if (leaf.is_certain()) unite(inner, cube);
    }
    double least = 0, most = 0, least_diagonal = 0, stated_diagonal = 0;
    int axis = 0;
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const double side = static_cast<double>(stated.high[i]) - static_cast<double>(stated.low[i]);
        // What is beyond the stated box is only rounding.
        const double outer_side = std::min(side, outer.high[k] - outer.low[k]),
                     inner_side = inner.high[k] - inner.low[k];
        if (side > outer_side * least) {
            least = side / outer_side;
            axis = i;
        }
        most = inner_side > 0 ? std::max(most, side / inner_side) : std::numeric_limits<double>::infinity();
        stated_diagonal += side * side;
        least_diagonal += outer_side * outer_side;
    }
    Proof proof;
    if (least > s.at_most) {
        proof.verdict = Verdict::refuted;
        const MarchingCost cost = marching_cost(e, object, stated, outer);
        proof.reason = fmt::format(
            "the box of the tree is {:.3g} times as long along {} as the object, so the default resolution is {:.3g} "
            "times as coarse as necessary, and tracing the whole object takes {:.3g} steps per ray instead of {:.3g}",
            least, "xyz"[axis], std::sqrt(stated_diagonal / least_diagonal), cost.steps, cost.steps_in_tight_box);
    } else if (most <= s.at_most) {
        proof.verdict = Verdict::proved;
    }
    return proof;
}

}  // namespace phasetree::measuring
