#pragma once

#include "phasetree/math/support.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// The coordinate planes are mirrors, so it suffices to consider |p|. Measured from the inner edges, (x, y, z) = |p| −
/// s/2 + t. The bar along x is x ≤ t, y and z in [0, t]; the others are analogous. Outside, the distance is that to the
/// nearest of the three bars.
///
/// Inside, let a ≥ b ≥ c be the sorted coordinates; the solid is b ≥ 0, a ≤ t. The outer faces are t − a away. To leave
/// towards the hollow, two coordinates must become negative; the shortest way changes b and c, √(b² + max(c, 0)²).
struct BoxFrame {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"box_frame", "",
                                   "min over the bars of the distance to the bar, − depth within the union",
                                   "The twelve edges of a box as bars of square cross-section; exact."};
    glm::vec3 size{1};
    float thickness = 0.1f;

    template <class V>
    static void parameters(V&& v) {
        v(&BoxFrame::size, Parameter{"size", "m", "Edge lengths along x, y and z.", limits::positive});
        v(&BoxFrame::thickness,
          Parameter{"thickness", "m", "Width of the bars, less than half of the shortest edge.", limits::positive});
    }
    void prepare() const {
        if (!(thickness < 0.5f * std::min({size.x, size.y, size.z})))
            throw ModelError("box_frame: \"thickness\" must be less than half of the shortest edge");
        detail::require_usable(info.name, {size.x, size.y, size.z, thickness});
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        const T zero(0.f);
        const T x = abs(p.x) - (size.x * 0.5f - thickness), y = abs(p.y) - (size.y * 0.5f - thickness),
                z = abs(p.z) - (size.z * 0.5f - thickness);
        // Squared distances along one axis to the bars parallel to it, and to those across it.
        const auto squared = [](const T& d) { return d * d; };
        const T past_x = max(x - thickness, zero), past_y = max(y - thickness, zero), past_z = max(z - thickness, zero);
        const T along_x = squared(past_x), along_y = squared(past_y), along_z = squared(past_z);
        const T across_x = squared(max(past_x, -x)), across_y = squared(max(past_y, -y)),
                across_z = squared(max(past_z, -z));
        const T outside =
            sqrt(min(along_x + across_y + across_z, min(across_x + along_y + across_z, across_x + across_y + along_z)));
        const T most = max(x, y), least = min(x, y);
        const T a = max(most, z), b = max(least, min(most, z)), c = min(least, z);
        return outside - min(max(thickness - a, zero), length(max(b, zero), max(c, zero)));
    }
    double support(const glm::dvec3& d, float level) const {
        return detail::box_support(d, glm::dvec3(size) * 0.5) + glm::length(d) * static_cast<double>(level);
    }
    Bounds bounds(BoundsQuery&, float level) const {
        // The frame is deepest where three bars meet, at a = b = c = t/(1 + √2).
        if (thickness * 0.5857865f + level < 0) return {};
        return Bounds::centred(size * 0.5f + level);
    }
};

}  // namespace phasetree
