// Support functions of solids: the maximum of d·p over all points p of the solid, for a vector d of any length.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>

namespace phasetree::detail {

/// The support of the unit disk in the xy plane.
inline double disk_support(const glm::dvec3& d) {
    return std::sqrt(d.x * d.x + d.y * d.y);
}
/// The support of the box with half extents h around the origin.
inline double box_support(const glm::dvec3& d, const glm::dvec3& h) {
    return std::abs(d.x) * h.x + std::abs(d.y) * h.y + std::abs(d.z) * h.z;
}
/// The support of the convex hull of points.
template <class Points>
double hull_support(const glm::dvec3& d, const Points& points) {
    double most = -std::numeric_limits<double>::infinity();
    for (const auto& p : points) most = std::max(most, glm::dot(d, glm::dvec3(p)));
    return most;
}
inline double hull_support(const glm::dvec3& d, std::initializer_list<glm::dvec3> points) {
    return hull_support<std::initializer_list<glm::dvec3>>(d, points);
}
/// The support of a solid with the same cross section at every z, from the support of the section. Infinite for
/// directions outside the xy plane.
inline double section_support(const glm::dvec3& d, double of_section) {
    return d.z == 0 ? of_section : std::numeric_limits<double>::infinity();
}

}  // namespace phasetree::detail
