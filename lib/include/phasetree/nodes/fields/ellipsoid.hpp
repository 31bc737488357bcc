#pragma once

#include "phasetree/math/support.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// A lower bound on the distance that is 1-Lipschitz and zero only on the surface. It is the maximum of three fields:
///
/// * m(|p/r| − 1), where m is the smallest radius. |p/r| is a norm, so |p/r| − |q/r| ≤ |(p − q)/r| ≤ |p − q|/m.
/// * the distance to the box with half extents r.
/// * |p| − M, where M is the largest radius.
///
/// Each is 1-Lipschitz, so the maximum is too. The first has the ellipsoid's sign everywhere. The box and the ball
/// contain the ellipsoid, so they are positive only outside and do not affect the sign inside. A 1-Lipschitz field that
/// vanishes on the surface never exceeds the distance. Outside, the box makes it exact at the ends of the axes and
/// bounds its error far away; the first field alone grows only with the slope m/M. (The usual k₀(k₀ − 1)/k₁, k₀ =
/// |p/r|, k₁ = |p/r²|, overestimates the distance and has slopes far above 1.)
struct Ellipsoid {
    static constexpr bool is_field_node = true;
    static constexpr bool is_convex = true;
    static constexpr NodeInfo info{"ellipsoid", "", "max(min r · (|p/r| − 1), box(p, 2r), |p| − max r)",
                                   "An ellipsoid about the origin; a lower bound, exact at the ends of the axes."};
    glm::vec3 radii{1, 0.75f, 0.5f};
    glm::vec3 inverse{1};   ///< 1/r, derived
    float smallest = 0.5f;  ///< derived
    float largest = 1;      ///< derived

    template <class V>
    static void parameters(V&& v) {
        v(&Ellipsoid::radii, Parameter{"radii", "m", "Half axes along x, y and z.", limits::positive});
    }
    void prepare() {
        detail::require_usable(info.name, {radii.x, radii.y, radii.z});
        inverse = 1.f / radii;
        smallest = std::min({radii.x, radii.y, radii.z});
        largest = std::max({radii.x, radii.y, radii.z});
    }
    template <class T>
    T distance(const Vec3<T>& p) const {
        const T k = length(Vec3<T>{p.x * inverse.x, p.y * inverse.y, p.z * inverse.z});
        return max((k - 1.f) * smallest, max(box_distance(p, radii), length(p) - largest));
    }
    /// The smaller of the supports of {m(|p/r| − 1) ≤ level} and of the ball.
    double support(const glm::dvec3& d, float level) const {
        const double shape =
            glm::length(d * glm::dvec3(radii)) * (1 + static_cast<double>(level) / static_cast<double>(smallest));
        return std::min(shape, glm::length(d) * static_cast<double>(largest + level));
    }
    /// Outside, the box is the bound; inside, m(|p/r| − 1) ≤ level is the ellipsoid scaled by 1 + level/m.
    Bounds bounds(BoundsQuery&, float level) const {
        return Bounds::centred(level < 0 ? radii * (1 + level / smallest) : radii + level);
    }
};

}  // namespace phasetree
