#pragma once

/// The oracle's part for outlines of many points: polygons and Bézier curves. See set_algebra.hpp.

#include <array>

#include "support/random_text.hpp"
#include "support/set_algebra/profiles.hpp"

namespace phasetree::tests::oracle {

inline bool member(const Polygon& n, const dvec3& p) {
    return in_polygon({n.points.begin(), n.points.end()}, p);
}
inline double signed_value(const Polygon& n, const dvec3& p) {
    return to_outline({n.points.begin(), n.points.end()}, p);
}
/// De Casteljau's construction.
struct Quadratic {
    dvec2 a, b, c;

    dvec2 at(double t) const { return glm::mix(glm::mix(a, b, t), glm::mix(b, c, t), t); }
    std::array<Quadratic, 2> halves() const {
        const dvec2 ab = (a + b) / 2.0, bc = (b + c) / 2.0, middle = (ab + bc) / 2.0;
        return {{{a, ab, middle}, {middle, bc, c}}};
    }
};
inline std::vector<Quadratic> curves(const Bezier& n) {
    std::vector<Quadratic> all;
    for (std::size_t i = 0; i + 1 < n.points.size(); i += 2)
        all.push_back({n.points[i], n.points[i + 1], n.points[(i + 2) % n.points.size()]});
    return all;
}
/// A curve lies within the triangle of its points, so from outside the triangle, it is seen under the same angle as its
/// chord. From a point on an edge of the triangle, the ends may be seen in opposite directions.
inline double seen(const dvec2& p, const Quadratic& q, int depth = 0) {
    const double turns[] = {seen(p, q.a, q.b), seen(p, q.b, q.c), seen(p, q.c, q.a)};
    const bool on_edge = std::any_of(std::begin(turns), std::end(turns), [](double a) { return std::abs(a) > 3.14; });
    if (depth == 50 || (!on_edge && std::abs(turns[0] + turns[1] + turns[2]) < 3)) return seen(p, q.a, q.c);
    const auto halves = q.halves();
    return seen(p, halves[0], depth + 1) + seen(p, halves[1], depth + 1);
}
inline double to_curves(const std::vector<Quadratic>& all, const dvec2& p) {
    double squared = absent;
    for (const Quadratic& q : all) {
        squared = std::min(squared, least([&](double t) { return glm::dot(q.at(t) - p, q.at(t) - p); }, 0, 1));
    }
    return std::sqrt(squared);
}
inline double to_curves(const Bezier& n, const dvec2& p) {
    return to_curves(curves(n), p);
}
inline bool member(const Bezier& n, const dvec3& p) {
    if (n.thickness > 0) return 2 * to_curves(n, p) < n.thickness;
    double angle = 0;
    for (const Quadratic& q : curves(n)) angle += seen(p, q);
    return is_around(angle);
}
inline double signed_value(const Bezier& n, const dvec3& p) {
    const double d = to_curves(n, p);
    if (n.thickness > 0) return d - n.thickness / 2.0;
    return member(n, p) ? -d : d;
}

/// The contours of a text at their positions, grouped by the strokes of letters. In the texts of tests
/// (random_text.hpp), the holes of a stroke follow its outer contour.
inline std::vector<std::vector<std::vector<Quadratic>>> strokes(const Text& n) {
    std::vector<std::vector<std::vector<Quadratic>>> all;
    double y = 0;
    for (const TextOutlines::Line& line : n.file.content->lines) {
        const double gaps = std::max(0, line.places - 1), begin = -(line.width + gaps * n.spacing) * n.align;
        for (const TextOutlines::Letter& letter : line.letters) {
            const auto area = [&](const TextOutlines::Contour& c) {
                double sum = 0;
                for (std::size_t i = 0; i < c.size(); ++i) {
                    const dvec2 a(c[i]), b(c[(i + 1) % c.size()]);
                    sum += a.x * b.y - a.y * b.x;
                }
                return sum;
            };
            for (const TextOutlines::Contour& contour : letter.contours) {
                const bool is_hole = area(contour) * area(letter.contours.front()) < 0;
                if (!is_hole) all.emplace_back();
                std::vector<Quadratic>& curves = all.back().emplace_back();
                const auto placed = [&](std::size_t i) {
                    return static_cast<double>(n.size) *
                           (dvec2(begin + letter.x + letter.place * static_cast<double>(n.spacing), y) +
                            dvec2(contour[i % contour.size()]));
                };
                for (std::size_t i = 0; i < contour.size(); i += 2)
                    curves.push_back({placed(i), placed(i + 1), placed(i + 2)});
            }
        }
        y -= n.line_height;
    }
    return all;
}
inline double signed_value(const Text& n, const dvec3& p) {
    double d = absent;
    for (const std::vector<std::vector<Quadratic>>& stroke : strokes(n)) {
        double angle = 0, away = absent;
        for (const std::vector<Quadratic>& contour : stroke) {
            for (const Quadratic& q : contour) angle += seen(p, q);
            away = std::min(away, to_curves(contour, p));
        }
        d = std::min(d, is_around(angle) ? -away : away);
    }
    return d;
}
inline bool member(const Text& n, const dvec3& p) {
    return signed_value(n, p) < 0;
}

}  // namespace phasetree::tests::oracle

namespace phasetree::tests {

inline TextOutlines random_content(Random& rng, std::type_identity<TextOutlines>) {
    return random_text(rng);
}

}  // namespace phasetree::tests
