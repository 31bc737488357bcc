#pragma once

/// Objects: the phase at a point, by sets.

#include "support/set_algebra/field_operators.hpp"

namespace phasetree::tests::oracle {

inline Phase region(const Set& n, const dvec3& p) {
    return inside(n.of, p) ? n.phase : vacuum;
}
/// The wall is where the surface is nearer than t, the inside what is deeper.
inline Phase region(const ThinShell& n, const dvec3& p) {
    const double f = value(n.of, p);
    if (f >= n.half_thickness) return vacuum;
    return f > -n.half_thickness ? n.shell : n.inside;
}
/// The last of the objects that are here.
inline Phase region(const Under& n, const dvec3& p) {
    for (std::size_t i = n.of.size(); i-- > 0;)
        if (const Phase l = label(n.of[i], p); l != vacuum) return l;
    return vacuum;
}
/// The first of the objects that are here.
inline Phase region(const Over& n, const dvec3& p) {
    for (const Phased& a : n.of)
        if (const Phase l = label(a, p); l != vacuum) return l;
    return vacuum;
}
/// I(complement of A₀, t) ∩ A₀ gets the layer's phase.
inline Phase region(const Layered& n, const dvec3& p) {
    const Phase l = label(n.of, p);
    return l == vacuum && -values(n.of, p)[0] < n.thickness ? n.phase : l;
}
inline bool is_cut(PhaseSet chosen, Phase l) {
    return l != vacuum && (chosen.empty() || chosen.contains(l));
}
inline Phase region(const IntersectShape& n, const dvec3& p) {
    const Phase l = label(n.of, p);
    return is_cut(n.phases_cut, l) && !inside(n.shape, p) ? vacuum : l;
}
inline Phase region(const SubtractShape& n, const dvec3& p) {
    const Phase l = label(n.of, p);
    return is_cut(n.phases_cut, l) && inside(n.shape, p) ? vacuum : l;
}
inline Phase region(const Change& n, const dvec3& p) {
    const Phase l = label(n.of, p);
    return l == n.from && (!n.shape || inside(n.shape, p)) ? n.to : l;
}
inline Phase region(const Remove& n, const dvec3& p) {
    const Phase l = label(n.of, p);
    return n.gone.contains(l) ? vacuum : l;
}
/// Signed depth in the union of some phases (of all if none are named): the distance to everything else.
inline double depth(const Components& a, PhaseSet among) {
    double inside = absent, outside = absent;
    for (std::size_t i = 0; i < Components::size; ++i) {
        const bool is_in = i > 0 && (among.empty() || among.contains(static_cast<int>(i)));
        (is_in ? inside : outside) = std::min(is_in ? inside : outside, a[i]);
    }
    return outside < absent ? -outside : inside;
}
/// Where a phase of K meets one of L, the deeper wins; elsewhere the last of the objects that are here.
inline Phase region(const Contact& n, const dvec3& p) {
    const Phase a = label(n.a, p), b = label(n.b, p);
    if (a != n.phase_a || b != n.phase_b) return b == vacuum ? a : b;
    const double weighted_a = n.alpha * values(n.a, p)[a.index], weighted_b = (1 - n.alpha) * values(n.b, p)[b.index];
    return weighted_a < weighted_b ? a : b;
}
inline Phase region(const Contacts& n, const dvec3& p) {
    const Phase a = label(n.a, p), b = label(n.b, p);
    if (a == vacuum || b == vacuum) return b == vacuum ? a : b;
    if ((!n.phases_a.empty() && !n.phases_a.contains(a)) || (!n.phases_b.empty() && !n.phases_b.contains(b))) return b;
    const double weighted_a = n.alpha * depth(values(n.a, p), n.phases_a);
    return weighted_a < (1 - n.alpha) * depth(values(n.b, p), n.phases_b) ? a : b;
}
/// In the vacuum, the first phase of a pair whose distances add up to less than the gap.
inline Phase region(const CloseGaps& n, const dvec3& p) {
    const Phase l = label(n.of, p);
    if (l != vacuum) return l;
    const Components a = values(n.of, p);
    for (std::size_t i = 0; i < n.of_phases.size(); ++i)
        for (std::size_t j = i + 1; j < n.of_phases.size(); ++j)
            if (a[n.of_phases[i].index] + a[n.of_phases[j].index] < n.gap) return n.of_phases[i];
    return vacuum;
}
/// Outside, the layer within whose reach the point is.
inline Phase region(const LayeredSequence& n, const dvec3& p) {
    const Phase l = label(n.of, p);
    if (l != vacuum) return l;
    double away = -values(n.of, p)[0];
    for (std::size_t i = 0; i < n.layers.size(); ++i) {
        away -= n.thicknesses[i];
        if (away < 0) return n.layers[i];
    }
    return vacuum;
}
/// The phases' fields blended one after the other.
inline double all_blended(const Components& a, double r) {
    double result = absent;
    for (std::size_t i = 1; i < Components::size; ++i)
        if (a[i] < absent) result = result < absent ? smooth_minimum(result, a[i], r) : a[i];
    return result;
}
inline Phase region(const SmoothLayered& n, const dvec3& p) {
    const Phase l = label(n.of, p);
    return l == vacuum && all_blended(values(n.of, p), n.radius) < n.thickness ? n.phase : l;
}
inline Phase region(const UniteShapeBelow& n, const dvec3& p) {
    const Phase l = label(n.of, p);
    return l == vacuum && inside(n.shape, p) ? n.phase : l;
}
/// The field of a phase and a shape, blended.
template <class N>
double blended_pair(const N& n, const dvec3& p) {
    const double a = values(n.of, p)[n.phase.index], f = value(n.shape, p);
    return a < absent ? smooth_minimum(a, f, n.radius) : f;
}
inline Phase region(const SmoothUniteShape& n, const dvec3& p) {
    return blended_pair(n, p) < 0 ? n.phase : label(n.of, p);
}
inline Phase region(const SmoothUniteShapeBelow& n, const dvec3& p) {
    const Phase l = label(n.of, p);
    return l == vacuum && blended_pair(n, p) < 0 ? n.phase : l;
}
/// The smooth intersection of a phase with what is kept, a field.
inline bool worn_away(const Phased& of, Phase k, double kept, double r, const dvec3& p) {
    return label(of, p) == k && -smooth_minimum(-values(of, p)[k.index], -kept, r) > 0;
}
inline Phase region(const SmoothIntersectShape& n, const dvec3& p) {
    return worn_away(n.of, n.phase, value(n.shape, p), n.radius, p) ? vacuum : label(n.of, p);
}
inline Phase region(const SmoothSubtractShape& n, const dvec3& p) {
    return worn_away(n.of, n.phase, -value(n.shape, p), n.radius, p) ? vacuum : label(n.of, p);
}
/// What lies in one phase of the pair, nearer than ε to the other.
inline Phase region(const Interface& n, const dvec3& p) {
    const Phase l = label(n.of, p);
    if (l != n.phase_a && l != n.phase_b) return vacuum;
    const Phase other = l == n.phase_a ? n.phase_b : n.phase_a;
    return values(n.of, p)[other.index] < n.half_thickness ? l : vacuum;
}
/// What lies in a phase, nearer than ε to any other.
inline Phase region(const Interfaces& n, const dvec3& p) {
    const Phase l = label(n.of, p);
    const Components a = values(n.of, p);
    for (std::size_t i = 1; i < Components::size; ++i)
        if (i != l.index && a[i] < n.half_thickness) return l;
    return vacuum;
}

/// Counted by walking from cube to cube: each step changes the phase.
inline Phase region(const Checker& n, const dvec3& p) {
    bool even = true;
    for (int i = 0; i < 3; ++i) {
        const auto steps = static_cast<long long>(std::floor((p[i] - n.origin[i]) / n.size));
        even = even == (((steps % 2) + 2) % 2 == 0);
    }
    return even ? n.even : n.odd;
}
template <class N>
double thickness(const N& n, std::size_t i) {
    return n.thicknesses.size() == 1 ? n.thicknesses[0] : n.thicknesses[i];
}
/// Which layer of the listed ones a height above the first one's beginning is in.
template <class N>
Phase layer_at(const N& n, double height) {
    std::size_t i = 0;
    for (; i + 1 < n.of_phases.size() && height >= thickness(n, i); ++i) height -= thickness(n, i);
    return n.of_phases[i];
}
template <class N>
double along(const N& n, const dvec3& p) {
    return glm::dot(p, glm::normalize(dvec3(n.direction))) - n.offset;
}
inline double period(const Layers& n) {
    double sum = 0;
    for (std::size_t i = 0; i < n.of_phases.size(); ++i) sum += thickness(n, i);
    return sum;
}
inline Phase region(const Layers& n, const dvec3& p) {
    const double height = along(n, p);
    return layer_at(n, height - period(n) * std::floor(height / period(n)));
}
inline Phase region(const Strata& n, const dvec3& p) {
    return layer_at(n, along(n, p));
}

}  // namespace phasetree::tests::oracle
