#pragma once

/// Objects: Φ as numbers. With infinite absent phases the equations of the table hold without a special case.

#include "support/set_algebra/regions.hpp"

namespace phasetree::tests::oracle {

inline Components components(const Set& n, const dvec3& p) {
    Components r;
    r[n.phase.index] = value(n.of, p);
    r[0] = -r[n.phase.index];
    return r;
}
inline Components components(const ThinShell& n, const dvec3& p) {
    Components r;
    const double f = value(n.of, p);
    r[0] = n.half_thickness - f;
    r[n.shell.index] = std::abs(f) - n.half_thickness;
    r[n.inside.index] = f + n.half_thickness;
    return r;
}
inline Components replaced(const Components& a, const Components& b) {
    Components r;
    r[0] = std::max(a[0], b[0]);
    for (std::size_t i = 1; i < Components::size; ++i) {
        double others = absent;
        for (std::size_t j = 1; j < Components::size; ++j)
            if (j != i) others = std::min(others, b[j]);
        r[i] = std::min(a[i], b[i]);
        if (r[i] < absent) r[i] = std::max(r[i], -others);
    }
    return r;
}
inline Components components(const Under& n, const dvec3& p) {
    Components r = values(n.of.front(), p);
    for (std::size_t i = 1; i < n.of.size(); ++i) r = replaced(r, values(n.of[i], p));
    return r;
}
inline Components components(const Over& n, const dvec3& p) {
    Components r = values(n.of.back(), p);
    for (std::size_t i = n.of.size() - 1; i-- > 0;) r = replaced(r, values(n.of[i], p));
    return r;
}
inline Components components(const Layered& n, const dvec3& p) {
    Components a = values(n.of, p);
    const double outside = a[0], t = n.thickness;
    a[n.phase.index] = std::min(a[n.phase.index], std::max(-outside - t, outside));
    a[0] = outside + t;
    return a;
}
/// The chosen phases are kept where kept < 0. If all phases are chosen, the removed part need not be within them.
inline Components cut(Components a, double kept, PhaseSet chosen, PhaseSet there) {
    const bool all = chosen.empty() || (there.bits & ~chosen.bits & ~std::uint64_t{1}) == 0;
    double vacuum_value = all ? std::min(a[0], -kept) : a[0];
    for (std::size_t i = 1; i < Components::size; ++i) {
        if (!(a[i] < absent) || !(all || chosen.contains(static_cast<int>(i)))) continue;
        if (!all) vacuum_value = std::min(vacuum_value, std::max(a[i], -kept));
        a[i] = std::max(a[i], kept);
    }
    a[0] = vacuum_value;
    return a;
}
inline Components components(const IntersectShape& n, const dvec3& p) {
    return cut(values(n.of, p), value(n.shape, p), n.phases_cut, phases(n.of));
}
inline Components components(const SubtractShape& n, const dvec3& p) {
    return cut(values(n.of, p), -value(n.shape, p), n.phases_cut, phases(n.of));
}
inline Components components(const Change& n, const dvec3& p) {
    const Components a = values(n.of, p);
    const double f = n.shape ? value(n.shape, p) : -absent;
    Components r = a;
    if (!(a[n.from.index] < absent)) return a;
    r[n.to.index] = std::min(a[n.to.index], std::max(a[n.from.index], f));
    r[n.from.index] = std::max(a[n.from.index], -f);
    return r;
}
inline Components without(Components a, PhaseSet gone) {
    for (std::size_t i = 1; i < Components::size; ++i) {
        if (!gone.contains(static_cast<int>(i))) continue;
        a[0] = std::min(a[0], a[i]);
        a[i] = absent;
    }
    return a;
}
inline Components components(const Remove& n, const dvec3& p) {
    return without(values(n.of, p), n.gone);
}
/// Bⱼ retreats to f = 0, and replaces A with what is left.
inline Components in_contact(const Components& a, Components b, PhaseSet l, double f) {
    for (std::size_t j = 1; j < Components::size; ++j)
        if (b[j] < absent && (l.empty() || l.contains(static_cast<int>(j)))) b[j] = std::max(b[j], -f);
    return replaced(a, b);
}
inline Components components(const Contact& n, const dvec3& p) {
    const Components a = values(n.a, p), b = values(n.b, p);
    const double f = n.alpha * a[n.phase_a.index] - (1.0 - n.alpha) * b[n.phase_b.index];
    return in_contact(a, b, PhaseSet::of(n.phase_b), f);
}
inline Components components(const Contacts& n, const dvec3& p) {
    const Components a = values(n.a, p), b = values(n.b, p);
    return in_contact(a, b, n.phases_b, n.alpha * depth(a, n.phases_a) - (1.0 - n.alpha) * depth(b, n.phases_b));
}
/// Each phase except the last fills its gaps, below all other phases.
inline Components components(const CloseGaps& n, const dvec3& p) {
    const Components a = values(n.of, p);
    Components r = a;
    if (!(a[0] < absent)) return a;
    for (std::size_t i = 0; i + 1 < n.of_phases.size(); ++i) {
        double sum = absent;
        for (std::size_t j = i + 1; j < n.of_phases.size(); ++j)
            sum = std::min(sum, a[n.of_phases[i].index] + a[n.of_phases[j].index]);
        Components filling;
        filling[n.of_phases[i].index] = (sum - n.gap) / 2;
        filling[0] = -filling[n.of_phases[i].index];
        r = replaced(filling, r);
    }
    return r;
}
inline Components components(const LayeredSequence& n, const dvec3& p) {
    Components a = values(n.of, p);
    if (!(a[0] < absent)) return a;
    for (std::size_t i = 0; i < n.layers.size(); ++i) {
        double& layer = a[n.layers[i].index];
        layer = std::min(layer, std::max(-a[0] - n.thicknesses[i], a[0]));
        a[0] += n.thicknesses[i];
    }
    return a;
}
inline Components components(const SmoothLayered& n, const dvec3& p) {
    Components a = values(n.of, p);
    const double m = all_blended(a, n.radius) - n.thickness;
    if (!(a[0] < absent) || !(m < absent)) return a;
    a[n.phase.index] = std::min(a[n.phase.index], std::max(m, a[0]));
    a[0] = std::max(a[0], -m);
    return a;
}
/// Phase k becomes what is within s but in no other phase.
inline Components grown_below(Components a, Phase k, double s) {
    double others = absent;
    for (std::size_t i = 1; i < Components::size; ++i)
        if (i != k.index) others = std::min(others, a[i]);
    a[k.index] = std::max(s, -others);
    if (a[0] < absent) a[0] = std::max(a[0], -s);
    return a;
}
/// S filled with the phase, under the object.
inline Components components(const UniteShapeBelow& n, const dvec3& p) {
    Components shape;
    shape[n.phase.index] = value(n.shape, p);
    shape[0] = -shape[n.phase.index];
    return replaced(shape, values(n.of, p));
}
inline Components components(const SmoothUniteShapeBelow& n, const dvec3& p) {
    return grown_below(values(n.of, p), n.phase, blended_pair(n, p));
}
/// The blended shape over the object.
inline Components components(const SmoothUniteShape& n, const dvec3& p) {
    Components shape, rest = values(n.of, p);
    shape[n.phase.index] = blended_pair(n, p);
    shape[0] = -shape[n.phase.index];
    rest[n.phase.index] = absent;
    return replaced(rest, shape);
}
inline Components smoothly_cut(Components a, Phase k, double kept, double r) {
    if (!(a[k.index] < absent)) return a;
    const double s = -smooth_minimum(-a[k.index], -kept, r);
    a[0] = std::min(a[0], std::max({a[k.index], -s, -kept - r}));
    a[k.index] = s;
    return a;
}
inline Components components(const SmoothIntersectShape& n, const dvec3& p) {
    return smoothly_cut(values(n.of, p), n.phase, value(n.shape, p), n.radius);
}
inline Components components(const SmoothSubtractShape& n, const dvec3& p) {
    return smoothly_cut(values(n.of, p), n.phase, -value(n.shape, p), n.radius);
}
inline Components components(const Interface& n, const dvec3& p) {
    const Components a = values(n.of, p);
    const double s = std::max(a[n.phase_a.index], a[n.phase_b.index]) - n.half_thickness;
    Components r;
    r[0] = -s;
    for (std::size_t i = 0; i < Components::size; ++i)
        if (i == n.phase_a.index || i == n.phase_b.index)
            r[i] = std::max(a[i], s);
        else
            r[0] = std::min(r[0], a[i]);
    return r;
}
inline Components components(const Interfaces& n, const dvec3& p) {
    Components a = values(n.of, p);
    double s = absent;
    for (std::size_t i = 1; i < Components::size; ++i)
        for (std::size_t j = 1; j < i; ++j) s = std::min(s, std::max(a[i], a[j]));
    s -= n.half_thickness;
    for (std::size_t i = 1; i < Components::size; ++i)
        if (a[i] < absent) a[i] = std::max(a[i], s);
    a[0] = std::min(a[0], -s);
    return a;
}

inline Components components(const Checker& n, const dvec3& p) {
    double face = absent;
    for (int i = 0; i < 3; ++i) face = std::min(face, std::abs(std::remainder(p[i] - n.origin[i], n.size)));
    Components r;
    const bool even = region(n, p) == n.even;
    r[n.even.index] = even ? -face : face;
    r[n.odd.index] = even ? face : -face;
    return r;
}
/// The signed distance to an interval, over those of the listed layers in a few periods.
inline void fill_layer(Components& r, Phase k, double height, double low, double high) {
    r[k.index] = std::min(r[k.index], std::max(low - height, height - high));
}
inline Components components(const Layers& n, const dvec3& p) {
    Components r;
    const double P = period(n), height = std::remainder(along(n, p), P);
    for (int repeat = -2; repeat <= 2; ++repeat) {
        double low = repeat * P;
        for (std::size_t i = 0; i < n.of_phases.size(); ++i) {
            const double t = thickness(n, i);
            fill_layer(r, n.of_phases[i], height, low, low + t);
            low += t;
        }
    }
    return r;
}
inline Components components(const Strata& n, const dvec3& p) {
    Components r;
    double low = -absent;
    double top = 0;
    for (std::size_t i = 0; i < n.of_phases.size(); ++i) {
        const bool last = i + 1 == n.of_phases.size();
        if (!last) top += thickness(n, i);
        fill_layer(r, n.of_phases[i], along(n, p), low, last ? absent : top);
        low = top;
    }
    return r;
}

}  // namespace phasetree::tests::oracle
