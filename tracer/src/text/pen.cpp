#include "text/pen.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "phasetree/math/portable.hpp"

namespace phasetree::tracer {

namespace {

// Maximum error in ems of the best-fitting curves. Curves with the cubic's tangents may be off by twice as much.
constexpr double tolerance = 1e-4;

// The intersection of the tangents at both ends of a part of a cubic, so that the quadratic curves of adjacent parts
// share a tangent. If the intersection is too far away, the control point of the best-fitting curve instead.
glm::dvec2 control_point(const glm::dvec2& start, const glm::dvec2& control1, const glm::dvec2& control2,
                         const glm::dvec2& end) {
    const auto cross = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; };
    const glm::dvec2 leaving = control1 - start, arriving = end - control2, chord = end - start;
    const double turn = cross(leaving, arriving);
    const double along = cross(chord, arriving) / turn, before_end = cross(leaving, chord) / turn;
    // Up to twice as far away as the ends' own control points, the quadratic curve resembles the cubic.
    if (std::isfinite(along) && along > 0.75 && along < 3 && before_end > 0.75 && before_end < 3)
        return start + along * leaving;
    return 0.25 * (3.0 * (control1 + control2) - start - end);
}

}  // namespace

void Pen::add(const glm::dvec2& control, const glm::dvec2& end) {
    if (contour_.empty()) contour_.emplace_back(at_);
    contour_.emplace_back(control);
    contour_.emplace_back(end);
    at_ = end;
}

void Pen::move_to(const glm::vec2& p) {
    close();
    at_ = placed(p);
}

void Pen::line_to(const glm::vec2& p) {
    const glm::dvec2 end = placed(p);
    if (end != at_) add(0.5 * (at_ + end), end);
}

void Pen::quadratic_to(const glm::vec2& control, const glm::vec2& p) {
    add(placed(control), placed(p));
}

void Pen::cubic_to(const glm::vec2& control1, const glm::vec2& control2, const glm::vec2& p) {
    const glm::dvec2 p0 = at_, p1 = placed(control1), p2 = placed(control2), p3 = placed(p);
    // Replacing each of n equal parts of a cubic by a quadratic curve causes an error of at most √3/36 |p₃ − 3p₂ + 3p₁
    // − p₀| / n³.
    const double off = std::sqrt(3.0) / 36 * glm::length(p3 - 3.0 * p2 + 3.0 * p1 - p0);
    const int parts = static_cast<int>(std::clamp(std::ceil(portable::cbrt(off / tolerance)), 1.0, 32.0));
    const auto point = [&](double t) {
        const double s = 1 - t;
        return s * s * s * p0 + 3 * s * s * t * p1 + 3 * s * t * t * p2 + t * t * t * p3;
    };
    const auto third_of_velocity = [&](double t) {
        const double s = 1 - t;
        return s * s * (p1 - p0) + 2 * s * t * (p2 - p1) + t * t * (p3 - p2);
    };
    for (int i = 0; i < parts; ++i) {
        const double from = static_cast<double>(i) / parts, to = static_cast<double>(i + 1) / parts;
        const glm::dvec2 start = at_, end = i + 1 == parts ? p3 : point(to);
        add(control_point(start, start + (to - from) * third_of_velocity(from),
                          end - (to - from) * third_of_velocity(to), end),
            end);
    }
}

void Pen::close() {
    if (!contour_.empty()) {
        if (contour_.back() == contour_.front())
            contour_.pop_back();
        else
            contour_.push_back(0.5f * (contour_.back() + contour_.front()));
        if (contour_.size() >= 4) contours.push_back(contour_);
    }
    contour_.clear();
}

}  // namespace phasetree::tracer
