#pragma once

#include "phasetree/math/support.hpp"
#include "phasetree/model/concepts.hpp"

namespace phasetree {

/// The map (x, y, z) ↦ (√(x² + y²) − offset, z, 0) into the half-plane of the point. It never increases distances.
struct IntoHalfPlane {
    float offset = 0;

    template <class T>
    Vec3<T> operator()(const Vec3<T>& p) const {
        return {length(p.x, p.y) - offset, p.z, T(0.f)};
    }
};

/// The nearest point of a body of revolution is in the half-plane of the point itself. The field therefore stays exact
/// if its cross section lies on one side of the axis, or is symmetric about it.
struct Revolve {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{
        "revolve", "", "f(|pxy| − o, z, 0)",
        "Revolves a field's cross-section at z = 0 about its y axis, which becomes the z axis; exact if the field is "
        "the exact distance to its cross-section, and the section is on one side of the axis or symmetric about it."};
    using Parts = TypeList<IntoHalfPlane>;
    Field of{};
    float offset = 0;

    template <class V>
    static void parameters(V&& v) {
        v(&Revolve::of, Parameter{"of", "", "The field; the part of its section beyond the axis is cut off."});
        v(&Revolve::offset, Parameter{"offset", "m", "Distance by which the section is first moved away from the axis.",
                                      limits::any, true});
    }
    template <class D>
    typename D::Scalar evaluate(D& d, const typename D::Point& p) const {
        return d.field(of, d.map(IntoHalfPlane{offset}, p, 1.f));
    }
    Bounds bounds(BoundsQuery& q, float level) const {
        if (!q.is_by_boxes())
            return q.through([](const glm::dvec3& d) { return glm::dvec3(detail::disk_support(d), d.z, 0); },
                             [&](const glm::dvec3& d) { return detail::disk_support(d) * static_cast<double>(offset); },
                             [&] { return q(of, level); });
        const Bounds b = q(of, level);
        const float reach = (b.high.x + offset) * (1 + 1e-6f);
        if (b.empty() || b.low.z > 0 || b.high.z < 0 || reach < 0) return {};
        return {{-reach, -reach, b.low.y}, {reach, reach, b.high.y}};
    }
};

}  // namespace phasetree
