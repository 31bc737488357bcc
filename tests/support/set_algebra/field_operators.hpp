#pragma once

/// Operators of plain fields.

#include "support/set_algebra.hpp"
#include "tree/node.hpp"

namespace phasetree::tests::oracle {

/// Section 9.3.
inline double smooth_minimum(double a, double b, double r) {
    const double d = std::max(1 - std::abs(b - a) / r, 0.0);
    return std::min(a, b) - r / 6 * d * d * d;
}
template <class Combine>
double folded(const std::vector<Field>& of, const dvec3& p, Combine&& combine) {
    double result = value(of.front(), p);
    for (std::size_t i = 1; i < of.size(); ++i) result = combine(result, value(of[i], p));
    return result;
}
inline bool in_any(const std::vector<Field>& of, const dvec3& p) {
    return std::any_of(of.begin(), of.end(), [&](const Field& f) { return inside(f, p); });
}

inline double signed_value(const Union& n, const dvec3& p) {
    return folded(n.of, p, [](double a, double b) { return std::min(a, b); });
}
inline double signed_value(const Intersection& n, const dvec3& p) {
    return folded(n.of, p, [](double a, double b) { return std::max(a, b); });
}
inline double signed_value(const Difference& n, const dvec3& p) {
    double result = value(n.from, p);
    for (const Field& f : n.subtract) result = std::max(result, -value(f, p));
    return result;
}
inline double signed_value(const SmoothUnion& n, const dvec3& p) {
    return folded(n.of, p, [&](double a, double b) { return smooth_minimum(a, b, n.radius); });
}
inline double signed_value(const SmoothIntersection& n, const dvec3& p) {
    return folded(n.of, p, [&](double a, double b) { return -smooth_minimum(-a, -b, n.radius); });
}
inline double signed_value(const SmoothDifference& n, const dvec3& p) {
    const double cut = folded(n.subtract, p, [&](double a, double b) { return smooth_minimum(a, b, n.radius); });
    return -smooth_minimum(-value(n.from, p), cut, n.radius);
}
inline double signed_value(const Offset& n, const dvec3& p) {
    return value(n.of, p) - n.amount;
}
inline double signed_value(const Shell& n, const dvec3& p) {
    return std::abs(value(n.of, p)) - n.half_thickness;
}
inline double signed_value(const Merge& n, const dvec3& p) {
    const Components a = values(n.of, p);
    double result = absent;
    for (std::size_t i = 0; i < Components::size; ++i)
        if (n.phases.empty() ? i > 0 : n.phases.contains(static_cast<int>(i))) result = std::min(result, a[i]);
    return result;
}

inline bool member(const Union& n, const dvec3& p) {
    return in_any(n.of, p);
}
inline bool member(const Intersection& n, const dvec3& p) {
    return std::all_of(n.of.begin(), n.of.end(), [&](const Field& f) { return inside(f, p); });
}
inline bool member(const Difference& n, const dvec3& p) {
    return inside(n.from, p) && !in_any(n.subtract, p);
}
inline bool member(const SmoothUnion& n, const dvec3& p) {
    return signed_value(n, p) < 0;
}
inline bool member(const SmoothIntersection& n, const dvec3& p) {
    return signed_value(n, p) < 0;
}
inline bool member(const SmoothDifference& n, const dvec3& p) {
    return signed_value(n, p) < 0;
}
inline bool member(const Offset& n, const dvec3& p) {
    return signed_value(n, p) < 0;
}
inline bool member(const Shell& n, const dvec3& p) {
    return signed_value(n, p) < 0;
}
inline bool member(const Merge& n, const dvec3& p) {
    const Phase l = label(n.of, p);
    return n.phases.empty() ? l != vacuum : n.phases.contains(l);
}

}  // namespace phasetree::tests::oracle
