#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "phasetree/math/support.hpp"
#include "phasetree/nodes/profiles/outline_in_box.hpp"

namespace phasetree {

/// For the equation see outline_pieces.hpp, for the data outline_in_box.hpp.
struct Bezier {
    static constexpr bool is_field_node = true;
    static constexpr NodeInfo info{"bezier", "",
                                   "± min over the curves of |p − B(t)|, t from the cubic (p − B)·B′ = 0;  "
                                   "for a line, less half of its thickness",
                                   "A shape with an outline of quadratic Bézier curves, or a line along them, for "
                                   "extruding and revolving; the same at every z, exact."};
    static constexpr std::size_t max_points = 2048;
    std::vector<glm::vec2> points{};
    float thickness = 0;
    /// Derived; the data of OutlineInBox.
    std::vector<float> table{};

    template <class V>
    static void parameters(V&& v) {
        v(&Bezier::points, Parameter{"points", "m",
                                     "[x, y] of a point on the curve, then of a control point, and so on; at most 2048 "
                                     "points. An even number makes a closed curve. An odd number makes an open one, "
                                     "which needs a thickness and ends at its last point."});
        v(&Bezier::thickness,
          Parameter{"thickness", "m", "Width of a line along the curve; 0 fills a closed curve by the even-odd rule.",
                    limits::non_negative, true});
    }
    void prepare() {
        if (points.size() > max_points) throw ModelError("bezier: more than 2048 points");
        const bool closed = points.size() % 2 == 0;
        if (points.size() < (closed ? 4u : 3u))
            throw ModelError("bezier: an open curve needs at least three points, a closed one at least four");
        if (thickness == 0 && !closed)
            throw ModelError("bezier: an odd number of points is an open curve, which needs a thickness");
        for (const glm::vec2& v : points)
            if (std::abs(v.x) > 1e9f || std::abs(v.y) > 1e9f)
                throw ModelError("bezier: its points must be within 1e9 m of the origin");
        table = {0.f, thickness * 0.5f};
        std::size_t pieces = 0;
        for_each_curve(points, [&](const QuadraticCurve& curve) { pieces += OutlinePieces::append(curve, table); });
        if (pieces == 0) throw ModelError("bezier: all of its points are the same");
        table[0] = static_cast<float>(pieces);
    }
    std::span<const float> data() const { return table; }
    template <class T>
    static T distance(const float* data, const Vec3<T>& p) {
        return OutlineInBox::distance(data, p);
    }
    using Specialised = OutlineInBox::Specialised;
    using Parts = TypeList<Specialised>;
    static float spacing(const float* data) { return OutlineInBox::spacing(data); }
    static constexpr unsigned search_half_instructions = OutlineInBox::search_half_instructions;
    static bool specialise(const float* data, const PointRange& range, std::span<const float> of,
                           std::vector<float>& floats) {
        return OutlineInBox::specialise(data, range, of, floats);
    }
    double support(const glm::dvec3& d, float level) const {
        // A curve lies within the hull of its control points.
        double most = -std::numeric_limits<double>::infinity();
        for (const glm::vec2& v : points)
            most = std::max(most, d.x * static_cast<double>(v.x) + d.y * static_cast<double>(v.y));
        return detail::section_support(d,
                                       most + detail::disk_support(d) * static_cast<double>(0.5f * thickness + level));
    }
    Bounds bounds(BoundsQuery&, float level) const {
        Bounds b;
        for_each_curve(points, [&](const QuadraticCurve& curve) { b = unite(b, curve.bounds()); });
        const float rounding = 2e-7f * (glm::length(b.centre()) + b.diagonal());
        return detail::at_every_height(b, rounding + thickness * 0.5f + level);
    }
};

}  // namespace phasetree
