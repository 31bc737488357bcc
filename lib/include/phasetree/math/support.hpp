#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <initializer_list>

/// Support functions: the most of d·p over the points of a solid, for any d, not only of unit length.
namespace phasetree::detail {

/// Of the unit disk across the z axis.
inline double disk_support(const glm::dvec3& d) {
    return std::sqrt(d.x * d.x + d.y * d.y);
}
/// Of the box of half extents h about the origin.
inline double box_support(const glm::dvec3& d, const glm::dvec3& h) {
    return std::abs(d.x) * h.x + std::abs(d.y) * h.y + std::abs(d.z) * h.z;
}
/// Of what lies between points.
template <class Points>
double hull_support(const glm::dvec3& d, const Points& points) {
    double most = -std::numeric_limits<double>::infinity();
    for (const auto& p : points) most = std::max(most, glm::dot(d, glm::dvec3(p)));
    return most;
}
inline double hull_support(const glm::dvec3& d, std::initializer_list<glm::dvec3> points) {
    return hull_support<std::initializer_list<glm::dvec3>>(d, points);
}
/// Of what is the same at every z: along any direction but those across the z axis it has no end.
inline double section_support(const glm::dvec3& d, double of_section) {
    return d.z == 0 ? of_section : std::numeric_limits<double>::infinity();
}

}  // namespace phasetree::detail
