#pragma once

/// Draws a number for a node's parameter.

#include <algorithm>
#include <cmath>

#include "phasetree/model/parameter.hpp"
#include "support/random_tree.hpp"

namespace phasetree::tests::detail {

inline float allowed(float v, const Limits& l, Random& rng) {
    if (l.contains(v)) return v;
    const float low = std::max(l.low, -1.f), high = std::min(l.high, 1.f);
    return rng.uniform(low + 0.01f * (high - low), high - 0.01f * (high - low));
}

/// A number that suits the parameter's unit and limits; sizes are mostly small, a few are large.
inline float random_number(Random& rng, const Parameter& p) {
    const bool negative = p.limits.contains(-0.01f), round = rng.chance(0.3);
    const auto rounded = [&](float v, float unit) { return round ? std::round(v / unit) * unit : v; };
    if (p.unit == "degrees") return allowed(rounded(rng.uniform(-180, 180), 45), p.limits, rng);
    if (p.unit == "degrees/m") return allowed(rounded(rng.uniform(-150, 150), 45), p.limits, rng);
    // Counts, and waves that are long enough not to occur thousands of times in an object.
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

}  // namespace phasetree::tests::detail
