#pragma once

#include "phasetree/math/support.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// A torus cut in two and moved apart along y, with straight rods in between. For a point with |py| ≤ l/2, the nearest
/// point of the centre line is on a rod at the same y; otherwise it is on a half circle around (0, ±l/2, 0). Both cases
/// are the torus equation once y is shortened by the length of the rods.
struct Link {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{
        "link", "", "y = max(|py| − l/2, 0);  |(|(px, y)| − R, pz)| − r",
        "A link of a chain in the xy plane, long along y; exact if the rod's radius is at most the ring's."};
    float length = 1;
    float major = 0.5f;
    float minor = 0.15f;

    template <class V>
    static void parameters(V&& v) {
        v(&Link::length, Parameter{"length", "m", "Length of the straight part.", limits::non_negative});
        v(&Link::major, Parameter{"major", "m", "Radius of the centre line of the half rings.", limits::positive});
        v(&Link::minor, Parameter{"minor", "m", "Radius of the rod.", limits::positive});
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        const T y = max(abs(p.y) - length * 0.5f, T(0.f));
        return phasetree::length(phasetree::length(p.x, y) - major, p.z) - minor;
    }
    double support(const glm::dvec3& d, float level) const {
        return detail::disk_support(d) * static_cast<double>(major) +
               std::abs(d.y) * 0.5 * static_cast<double>(length) + glm::length(d) * static_cast<double>(minor + level);
    }
    Bounds bounds(BoundsQuery&, float level) const {
        const float r = minor + level;
        if (r < 0) return {};
        return Bounds::centred({major + r, length * 0.5f + major + r, r});
    }
};

}  // namespace phasetree
