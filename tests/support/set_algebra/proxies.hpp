#pragma once

/// Proxies and bounding volumes: what they keep, cut off and fill, by sets; and their values, from the distances that
/// replace each other.

#include "support/set_algebra/components.hpp"

namespace phasetree::tests::oracle {

/// A point is in the child and in the volume. The child's own box has all of it, whatever its size.
template <class Child>
bool in_volume(const BoundingVolume<Child>& n, const dvec3& p) {
    return !n.volume || inside(n.volume, p);
}
inline double distance_to_box(const Bounds& b, const dvec3& p) {
    const dvec3 past = glm::max(dvec3(b.low) - p, p - dvec3(b.high));
    return glm::length(glm::max(past, dvec3(0))) + std::min(std::max({past.x, past.y, past.z}), 0.0);
}
template <class Child>
double distance_to_volume(const BoundingVolume<Child>& n, const dvec3& p) {
    return n.volume ? value(n.volume, p) : distance_to_box(phasetree::bounds(n.of), p);
}
/// Beyond the margin, the value is the volume's distance; before it, the rest of twice the margin.
inline double stood_in_for(double by, double child, double margin) {
    if (by >= margin) return by;
    return std::max(by, std::min(child, 2 * margin - by));
}
inline Components stood_in_for(double by, Components a, double margin, PhaseSet there, std::size_t outside) {
    for (std::size_t i = 0; i < Components::size; ++i)
        if (i != outside && there.contains(static_cast<int>(i))) a[i] = stood_in_for(by, a[i], margin);
    a[outside] = -stood_in_for(by, -a[outside], margin);
    return a;
}

inline bool member(const FieldBoundingVolume& n, const dvec3& p) {
    return inside(n.of, p) && in_volume(n, p);
}
inline double signed_value(const FieldBoundingVolume& n, const dvec3& p) {
    return stood_in_for(distance_to_volume(n, p), value(n.of, p), n.margin);
}
inline Phase region(const PhasedBoundingVolume& n, const dvec3& p) {
    return in_volume(n, p) ? label(n.of, p) : vacuum;
}
inline Components components(const PhasedBoundingVolume& n, const dvec3& p) {
    return stood_in_for(distance_to_volume(n, p), values(n.of, p), n.margin, phases(n.of), 0);
}

inline bool member(const FieldProxy& n, const dvec3& p) {
    const double g = value(n.proxy, p);
    return g < -n.error || (g < n.error && inside(n.of, p));
}
inline double signed_value(const FieldProxy& n, const dvec3& p) {
    const double g = value(n.proxy, p), e = n.error;
    return -stood_in_for(-g - e, -stood_in_for(g - e, value(n.of, p), n.margin), n.margin);
}
inline Phase region(const PhasedProxy& n, const dvec3& p) {
    const double g = value(n.proxy, p);
    for (int i = 1; i < Phase::capacity; ++i)
        if (n.inside.contains(i) && g < -n.error) return Phase{static_cast<std::uint8_t>(i)};
    return g < n.error ? label(n.of, p) : vacuum;
}
inline Components components(const PhasedProxy& n, const dvec3& p) {
    const double g = value(n.proxy, p), e = n.error;
    Components a = stood_in_for(g - e, values(n.of, p), n.margin, phases(n.of), 0);
    const PhaseSet there = phases(n.of) | PhaseSet::of(vacuum);
    for (std::size_t i = 1; i < Components::size; ++i)
        if (n.inside.contains(static_cast<int>(i))) a = stood_in_for(-g - e, a, n.margin, there, i);
    return a;
}

/// The level used at a point.
template <class Child>
const Child& level_at(const LevelOfDetail<Child>& n, const dvec3& p) {
    std::size_t i = 0;
    while (i < n.distances.size() && glm::distance(p, dvec3(n.viewpoint)) > n.distances[i]) ++i;
    return n.of[i];
}
/// By the maximum of minima, where the library takes the minimum of maxima.
inline double either(double n, double a, double b) {
    return std::max({std::min(a, -n), std::min(b, n), std::min(a, b)});
}
inline bool member(const FieldLevelOfDetail& n, const dvec3& p) {
    return inside(level_at(n, p), p);
}
inline double signed_value(const FieldLevelOfDetail& n, const dvec3& p) {
    if (n.distances.empty()) return value(n.of.front(), p);
    double result = value(n.of.back(), p);
    for (std::size_t i = n.distances.size(); i-- > 0;)
        result = either(glm::distance(p, dvec3(n.viewpoint)) - n.distances[i], value(n.of[i], p), result);
    return result;
}
inline Phase region(const PhasedLevelOfDetail& n, const dvec3& p) {
    return label(level_at(n, p), p);
}
inline Components components(const PhasedLevelOfDetail& n, const dvec3& p) {
    if (n.distances.empty()) return values(n.of.front(), p);
    Components result = values(n.of.back(), p);
    for (std::size_t i = n.distances.size(); i-- > 0;) {
        const Components finer = values(n.of[i], p);
        for (std::size_t k = 0; k < Components::size; ++k)
            result[k] = either(glm::distance(p, dvec3(n.viewpoint)) - n.distances[i], finer[k], result[k]);
    }
    return result;
}

}  // namespace phasetree::tests::oracle
