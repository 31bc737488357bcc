#pragma once

#include "phasetree/math/support.hpp"
#include "phasetree/model/concepts.hpp"

namespace phasetree {

struct Torus {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"torus", "", "|(|pxy| − R, pz)| − r",
                                   "A ring about the z axis; exact if the tube's radius is at most the ring's."};
    float major = 1;
    float minor = 0.25f;

    template <class V>
    static void parameters(V&& v) {
        v(&Torus::major, Parameter{"major", "m", "Radius of the ring's centre line.", limits::positive});
        v(&Torus::minor, Parameter{"minor", "m", "Radius of the tube.", limits::positive});
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        return length(length(p.x, p.y) - major, p.z) - minor;
    }
    double support(const glm::dvec3& d, float level) const {
        return detail::disk_support(d) * static_cast<double>(major) +
               glm::length(d) * static_cast<double>(minor + level);
    }
    Bounds bounds(BoundsQuery&, float level) const {
        const float r = minor + level;
        if (r < 0) return {};
        return Bounds::centred({major + r, major + r, r});
    }
};

}  // namespace phasetree
