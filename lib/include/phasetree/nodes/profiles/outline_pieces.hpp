#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <span>
#include <utility>
#include <vector>

#include "phasetree/nodes/fields/profile.hpp"

namespace phasetree {

/// A quadratic Bézier curve B(t), t in [0, 1], given by its control points.
struct QuadraticCurve {
    glm::dvec2 start, control, end;

    /// B(t) = start + 2 b t + a t².
    glm::dvec2 a() const { return start - 2.0 * control + end; }
    glm::dvec2 b() const { return control - start; }
    glm::dvec2 at(double t) const { return start + t * (2.0 * b() + t * a()); }
    /// The part of the curve between two parameters, by blossoming.
    QuadraticCurve part(double from, double to) const {
        return {at(from), start + (from + to) * b() + from * to * a(), at(to)};
    }
    bool is_point() const { return start == control && start == end; }
    /// The smallest box around the curve, at z = 0.
    Bounds bounds() const {
        Bounds box;
        const glm::dvec2 way = b(), bend = a();
        for (const double t : {0.0, 1.0, -way.x / bend.x, -way.y / bend.y}) {
            if (!(t >= 0 && t <= 1)) continue;
            const glm::vec3 place(at(t), 0);
            box = unite(box, {place, place});
        }
        return box;
    }
};

/// The curves of an outline, cut into pieces B(t) = s + 2bt + at², t in [0, 1]. On each piece the speed increases (a·b
/// ≥ 0), by at most a factor of two, and y is monotone.
///
/// *Nearest point.* Let m = s − p be the vector from a point p to the start of a piece. The nearest point of the piece
/// is one of its ends, or a point where
///     h(t) = (B − p)·B′/2 = a² t³ + 3 a·b t² + (2b² + a·m) t + b·m
/// vanishes and increases. h is convex for t ≥ 0, so only its last root is a minimum. Halley's iteration approaches
/// that root from the right without passing it, and five steps suffice. Convergence is slowest where p is a centre of
/// curvature: the three roots of h then coincide in one root r, and each step only halves the error t − r. But there
/// the squared distance depends only on the fourth power of that error. Where a piece is straight, as in polygons, h is
/// linear.
///
/// *Inside.* A point is inside if a ray from it along +x crosses the outline an odd number of times. A ray crosses a
/// piece at most once, and only if low ≤ p.y < high, where low and high are the heights of its ends. Pieces that meet
/// have identical floats there, so no crossing is missed or counted twice. Where the tangent is horizontal, rounding
/// makes t inaccurate, but the curve's point at that t is still at the height of p.
class OutlinePieces {
  public:
    /// A piece has ten floats: s.x, s.y, y of its end, b.x, b.y, a.x, a.y, a², 3 a·b, 2 b².
    static constexpr std::size_t floats = 10;

    /// Append the pieces of a curve to a table, and return their number. The curve must not be a point.
    static std::size_t append(const QuadraticCurve& curve, std::vector<float>& table) {
        const glm::dvec2 a = curve.a(), b = curve.b();
        if (is_straight_but_for_rounding(curve)) {
            append_piece(curve.start, curve.end, 0.5 * (curve.end - curve.start), glm::dvec2(0), table);
            return 1;
        }
        const double slowest = glm::dot(a, a) > 0 ? -glm::dot(a, b) / glm::dot(a, a) : -1;
        // The parameters at which the speed is 2ᵏ times the minimum.
        std::vector<double> cuts{0, 1, slowest, -b.y / a.y};
        const double least = glm::length(b + slowest * a), per_t = glm::length(a);
        for (double ratio = 2; least > 0 && ratio < 2e6; ratio *= 2) {
            const double away = least * std::sqrt(ratio * ratio - 1) / per_t;
            cuts.insert(cuts.end(), {slowest - away, slowest + away});
        }
        std::erase_if(cuts, [](double t) { return !(t >= 0 && t <= 1); });
        std::sort(cuts.begin(), cuts.end());
        std::size_t count = 0;
        glm::vec2 from(curve.start);
        for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
            QuadraticCurve piece = curve.part(cuts[i], cuts[i + 1]);
            const glm::vec2 to(i + 2 == cuts.size() ? curve.end : piece.end);
            if (to == from) continue;
            // Pieces that meet must have identical floats there.
            piece.start = from;
            piece.end = to;
            from = to;
            piece = towards_faster(piece);
            append_piece(piece.start, piece.end, piece.b(), piece.a(), table);
            ++count;
        }
        return count;
    }

    /// The distance from p to the nearest of `count` pieces. It is negative inside, unless `is_line`, because a line
    /// has no inside. `sign` is 1 or −1: the sign at p before the crossings of these pieces are counted.
    template <class T>
    static T distance(const float* data, int count, bool is_line, const Vec3<T>& p, T sign) {
        T nearest(3e38f);
        for (int i = 0; i < count; ++i, data += floats) {
            const Way<T> way = way_to(data, p);
            nearest = min(nearest, min(way.squared_to_start, way.x * way.x + way.y * way.y));
            if (!is_line) sign = sign_beyond(data, p, sign);
        }
        return sqrt(nearest) * sign;
    }

    /// The distance at a point and its gradient there. If the nearest point is within a piece, the gradient is
    /// perpendicular to the piece's tangent, because close to the outline the vector to the nearest point is mostly
    /// rounding error. On the outline itself the gradient may point to either side.
    struct Found {
        float distance;
        glm::vec2 at, gradient;
    };
    static Found find(const float* data, int count, bool is_line, const Vec3<float>& p, float sign);
    /// The first-order expansion of the distance around the point of find(): exact there, with its gradient.
    template <class T>
    static T distance_by(const Found& found, const Vec3<T>& p) {
        return found.distance + ((p.x - found.at.x) * found.gradient.x + (p.y - found.at.y) * found.gradient.y);
    }

    static bool is_straight(const float* piece) { return !(piece[7] > 0); }

  private:
    /// The squared distance from p to the start of a piece, and another candidate for the nearest point: the vector
    /// from p to it, and its parameter.
    template <class T>
    struct Way {
        T squared_to_start, x, y, t;
    };
    template <class T>
    static Way<T> way_to(const float* data, const Vec3<T>& p) {
        const T zero(0.f), one(1.f);
        const float bx = data[3], by = data[4], ax = data[5], ay = data[6];
        const float a_squared = data[7], three_ab = data[8];
        const T mx = data[0] - p.x, my = data[1] - p.y;
        const T constant = mx * bx + my * by;
        if (is_straight(data)) {
            const T t = clamp(-constant * (1 / data[9]), zero, one);
            return {mx * mx + my * my, mx + t * (2.f * bx), my + t * (2.f * by), t};
        }
        // Halley's iteration from the right end to the last root of h. If h does not increase at t, restart at the
        // right end.
        const T linear = mx * ax + my * ay + data[9];
        T t = one;
        for (int k = 0; k < 5; ++k) {
            const T h = ((t * a_squared + three_ab) * t + linear) * t + constant;
            const T slope = (t * (3.f * a_squared) + 2.f * three_ab) * t + linear;
            const T bend = t * (3.f * a_squared) + three_ab;  // h″/2
            const T next = t - h * slope / max(slope * slope - h * bend, T(1e-30f));
            t = select(less(zero, slope), clamp(next, zero, one), one);
        }
        return {mx * mx + my * my, mx + (t * ax + 2.f * bx) * t, my + (t * ay + 2.f * by) * t, t};
    }
    /// Flip the sign if a ray along +x crosses the piece.
    template <class T>
    static T sign_beyond(const float* data, const Vec3<T>& p, T sign) {
        const T zero(0.f), one(1.f);
        const float bx = data[3], by = data[4], ax = data[5], ay = data[6];
        const T mx = data[0] - p.x, my = data[1] - p.y;
        // The point of the piece at the height of p: the root of a.y t² + 2 b.y t + m.y in [0, 1]. This form of the
        // solution avoids cancellation. The ray crosses the piece if that point has a larger x.
        const bool up = data[2] > data[1];
        const float low = up ? data[1] : data[2], high = up ? data[2] : data[1];
        T beyond;
        if (is_straight(data)) {
            const T s = min(abs(my) * (0.5f / std::max(std::abs(by), 1e-30f)), one);
            beyond = mx + s * (2.f * bx);
        } else {
            const T root = sqrt(max(by * by - my * ay, zero));
            const T s = min(abs(my) / max(root + std::abs(by), T(1e-30f)), one);
            beyond = mx + (s * ax + 2.f * bx) * s;
        }
        const T crossed = select(less(zero, beyond), -sign, sign);
        return select(less(p.y, T(low)), sign, select(less(p.y, T(high)), crossed, sign));
    }

    // Whether the curve bends by less than the rounding of its points to floats, because its control point is that
    // close to the midpoint of its ends. Straight pieces are faster to evaluate.
    static bool is_straight_but_for_rounding(const QuadraticCurve& curve) {
        const auto largest = [](const glm::dvec2& v) { return std::max(std::abs(v.x), std::abs(v.y)); };
        const double farthest = std::max({largest(curve.start), largest(curve.control), largest(curve.end)});
        return curve.start != curve.end && largest(curve.a()) <= 0x1p-22 * farthest;
    }
    static void append_piece(const glm::dvec2& start, const glm::dvec2& end, const glm::dvec2& b, const glm::dvec2& a,
                             std::vector<float>& table) {
        for (const double v :
             {start.x, start.y, end.y, b.x, b.y, a.x, a.y, glm::dot(a, a), 3 * glm::dot(a, b), 2 * glm::dot(b, b)})
            table.push_back(static_cast<float>(v));
    }
    /// Exchange the ends of a piece that is slower at its second end. Pieces are cut where the speed has doubled. If
    /// the speed still grows by a factor above √5, either the piece starts where the curve turns back on itself, or the
    /// growth is due to rounding. Such a piece is straight; it is replaced by one of constant speed.
    static QuadraticCurve towards_faster(QuadraticCurve piece) {
        const auto squared = [](const glm::dvec2& v) { return glm::dot(v, v); };
        if (squared(piece.end - piece.control) < squared(piece.b())) std::swap(piece.start, piece.end);
        if (squared(piece.end - piece.control) > 5 * squared(piece.b()))
            piece.control = (piece.start + piece.end) * 0.5;
        return piece;
    }
};

/// Call f for the curves of an outline, given by points that alternate between points on the curve and control points.
/// An even number of points is a closed outline.
template <class F>
void for_each_curve(std::span<const glm::vec2> points, F&& f) {
    for (std::size_t i = 0; i + 1 < points.size(); i += 2) {
        const QuadraticCurve curve{points[i], points[i + 1], points[(i + 2) % points.size()]};
        if (!curve.is_point()) f(curve);
    }
}

inline OutlinePieces::Found OutlinePieces::find(const float* data, int count, bool is_line, const Vec3<float>& p,
                                                float sign) {
    float nearest = 3e38f;
    glm::vec2 away(0), tangent(0);  // from the nearest point; no tangent at an end
    for (int i = 0; i < count; ++i, data += floats) {
        const Way<float> way = way_to(data, p);
        const float squared = way.x * way.x + way.y * way.y;
        if (way.squared_to_start < nearest) {
            nearest = way.squared_to_start;
            away = {p.x - data[0], p.y - data[1]};
            tangent = glm::vec2(0);
        }
        if (squared < nearest) {
            nearest = squared;
            away = {-way.x, -way.y};
            const bool is_end = !(way.t > 0 && way.t < 1);
            tangent = is_end ? glm::vec2(0) : glm::vec2(data[3], data[4]) + way.t * glm::vec2(data[5], data[6]);
        }
        if (!is_line) sign = sign_beyond(data, p, sign);
    }
    const float length = std::sqrt(nearest);
    glm::vec2 across(-tangent.y, tangent.x);
    if (glm::dot(across, away) < 0) across = -across;
    if (tangent == glm::vec2(0)) across = away;
    const float size = glm::length(across);
    return {length * sign, {p.x, p.y}, size > 0 ? sign / size * across : glm::vec2(0)};
}

}  // namespace phasetree
