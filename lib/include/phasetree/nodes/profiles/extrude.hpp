#pragma once

#include "phasetree/model/concepts.hpp"

namespace phasetree {

/// The projection (x, y, z) ↦ (x, y, height). A field that is evaluated at the result is its cross section at this
/// height, extended along z.
struct CrossSection {
    float height = 0;  ///< of the section

    template <class T>
    Vec3<T> operator()(const Vec3<T>& p) const {
        return {p.x, p.y, T(height)};
    }
};

/// Signed distance to |z| < half.
struct HeightBand {
    float half = 1;

    template <class T>
    T distance(const Vec3<T>& p) const {
        return abs(p.z) - half;
    }
};

/// The section's field varies along x and y, that of the band along z; see corner() in math/number.hpp.
struct Extrude {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"extrude", "",
                                   "a = f(x, y, 0),  b = |z| − h/2;  |(max(a, 0), max(b, 0))| + min(max(a, b), 0)",
                                   "Extrudes a field's cross-section at z = 0 along z; exact where the field is the "
                                   "exact distance to its cross-section."};
    using Parts = TypeList<CrossSection, HeightBand>;
    Field of{};
    float height = 1;

    template <class V>
    static void parameters(V&& v) {
        v(&Extrude::of, Parameter{"of", "", "The field, for example a circle, a rectangle or a star."});
        v(&Extrude::height, Parameter{"height", "m", "Whole height, centred at z = 0.", limits::positive});
    }
    template <class D>
    typename D::Scalar evaluate(D& d, const typename D::Point& p) const {
        const typename D::Scalar section = d.field(of, d.map(CrossSection{}, p, 1.f));
        return corner(section, d.primitive(HeightBand{height * 0.5f}, p));
    }
    /// corner() is at least as large as each of its operands, so both bound the extrusion.
    Bounds bounds(BoundsQuery& q, float level) const {
        const float half = height * 0.5f + level;
        if (!q.is_by_boxes())
            return half < 0 ? Bounds{}
                            : q.through([](const glm::dvec3& d) { return glm::dvec3(d.x, d.y, 0); },
                                        [&](const glm::dvec3& d) { return std::abs(d.z) * static_cast<double>(half); },
                                        [&] { return q(of, level); });
        Bounds b = q(of, level);
        if (b.empty() || b.low.z > 0 || b.high.z < 0 || half < 0) return {};
        b.low.z = -half;
        b.high.z = half;
        return b;
    }
};

}  // namespace phasetree
