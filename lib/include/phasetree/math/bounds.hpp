#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace phasetree {

/// A closed axis-aligned box. It is empty if low > high on any axis. Sides may be infinite.
struct Bounds {
    static constexpr float infinity = std::numeric_limits<float>::infinity();

    glm::vec3 low{infinity};
    glm::vec3 high{-infinity};

    static Bounds everything() { return {glm::vec3(-infinity), glm::vec3(infinity)}; }
    /// The box with half extents h around the origin; empty if an extent is negative.
    static Bounds centred(const glm::vec3& h) { return {-h, h}; }

    bool empty() const { return !(low.x <= high.x && low.y <= high.y && low.z <= high.z); }
    bool finite() const {
        for (int i = 0; i < 3; ++i)
            if (!std::isfinite(low[i]) || !std::isfinite(high[i])) return false;
        return true;
    }
    glm::vec3 centre() const { return (low + high) * 0.5f; }
    glm::vec3 extent() const { return high - low; }
    float diagonal() const { return glm::length(extent()); }
    bool contains(const glm::vec3& p) const {
        return p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x <= high.x && p.y <= high.y && p.z <= high.z;
    }
    /// Grow by d on every side. An empty box stays empty.
    Bounds inflated(float d) const {
        if (empty()) return {};
        return {low - d, high + d};
    }
    glm::vec3 corner(int i) const {
        return {(i & 1) ? high.x : low.x, (i & 2) ? high.y : low.y, (i & 4) ? high.z : low.z};
    }
};

/// The smallest box around both. If one is empty, it must equal Bounds{}.
inline Bounds unite(const Bounds& a, const Bounds& b) {
    return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

inline Bounds intersect(const Bounds& a, const Bounds& b) {
    return {glm::max(a.low, b.low), glm::min(a.high, b.high)};
}

/// A box around the image of a box under a linear map, with a margin for rounding. An infinite side makes only those
/// sides infinite that depend on it: a profile that is infinite only in z stays bounded in x and y when it is rotated
/// about z.
inline Bounds image_of(const Bounds& box, const glm::mat3& map) {
    if (box.empty()) return {};
    Bounds result{glm::vec3(0), glm::vec3(0)};
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            const float k = map[column][row];
            if (k == 0) continue;
            const float a = k * box.low[column], b = k * box.high[column];
            result.low[row] += std::min(a, b);
            result.high[row] += std::max(a, b);
        }
    }
    float largest = 0;
    for (int i = 0; i < 3; ++i)
        for (const float side : {result.low[i], result.high[i]})
            if (std::isfinite(side)) largest = std::max(largest, std::abs(side));
    return result.inflated(2e-6f * largest);
}

}  // namespace phasetree
