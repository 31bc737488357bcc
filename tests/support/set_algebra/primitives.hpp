#pragma once

/// Primitives: membership by textbook inequalities, signed distances from their parts in double.

#include "support/set_algebra.hpp"
#include "tree/node.hpp"

namespace phasetree::tests::oracle {

// Primitives: membership.

inline bool member(const Sphere& n, const dvec3& p) {
    return glm::dot(p, p) < square(n.radius);
}
inline bool member(const Box& n, const dvec3& p) {
    return 2 * std::abs(p.x) < n.size.x && 2 * std::abs(p.y) < n.size.y && 2 * std::abs(p.z) < n.size.z;
}
/// A box, and a ball rolled about it.
inline bool member(const RoundedBox& n, const dvec3& p) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        const double beyond = std::abs(p[i]) - (n.size[i] / 2.0 - n.radius);
        if (beyond > n.radius) return false;
        if (beyond > 0) sum += beyond * beyond;
    }
    return sum == 0 || sum < square(n.radius);
}
inline bool member(const Cylinder& n, const dvec3& p) {
    return p.x * p.x + p.y * p.y < square(n.radius) && 2 * std::abs(p.z) < n.height;
}
inline bool member(const CappedCone& n, const dvec3& p) {
    const double up = p.z / n.height + 0.5;
    const double radius = n.radius_bottom + (static_cast<double>(n.radius_top) - n.radius_bottom) * up;
    return up > 0 && up < 1 && p.x * p.x + p.y * p.y < square(radius);
}
/// A ball at either end and a cylinder between.
inline bool member(const Capsule& n, const dvec3& p) {
    const dvec3 a(n.from), b(n.to), axis = b - a, q = p - a, side = glm::cross(q, axis);
    const double along = glm::dot(q, axis), squared = glm::dot(axis, axis);
    return glm::dot(q, q) < square(n.radius) || glm::dot(p - b, p - b) < square(n.radius) ||
           (along > 0 && along < squared && glm::dot(side, side) < square(n.radius) * squared);
}
inline bool member(const Polyline& n, const dvec3& p) {
    for (std::size_t i = 0; i + 1 < n.points.size(); ++i)
        if (member(Capsule{.from = n.points[i], .to = n.points[i + 1], .radius = n.radius}, p)) return true;
    return false;
}
inline bool member(const Torus& n, const dvec3& p) {
    return square(std::hypot(p.x, p.y) - n.major) + p.z * p.z < square(n.minor);
}
inline bool member(const Plane& n, const dvec3& p) {
    return glm::dot(p, dvec3(n.normal)) < n.offset;
}
/// Behind every plane.
inline bool member(const Polyhedron& n, const dvec3& p) {
    for (std::size_t i = 0; i < n.normals.size(); ++i) {
        const double offset = n.offsets.size() == 1 ? n.offsets[0] : n.offsets[i];
        if (glm::dot(p, dvec3(n.normals[i])) >= offset * glm::length(dvec3(n.normals[i]))) return false;
    }
    return true;
}

/// Sum of squares.
inline bool member(const Ellipsoid& n, const dvec3& p) {
    const dvec3 q = p / dvec3(n.radii);
    return glm::dot(q, q) < 1;
}
/// Within the tube of the ring, and within the arc or in one of the balls at its ends.
inline bool member(const CappedTorus& n, const dvec3& p) {
    const double half = glm::radians(static_cast<double>(n.angle)) / 2, y = std::abs(p.y);
    const dvec3 end(n.major * std::cos(half), n.major * std::sin(half), 0), q = dvec3(p.x, y, p.z) - end;
    const bool ring = square(std::hypot(p.x, p.y) - n.major) + p.z * p.z < square(n.minor);
    return (ring && std::atan2(y, p.x) <= half) || glm::dot(q, q) < square(n.minor);
}
inline bool member(const Link& n, const dvec3& p) {
    const double half = n.length / 2.0;
    if (std::abs(p.y) < half) return square(std::abs(p.x) - n.major) + p.z * p.z < square(n.minor);
    return square(std::hypot(p.x, std::abs(p.y) - half) - n.major) + p.z * p.z < square(n.minor);
}
inline bool member(const Tube& n, const dvec3& p) {
    const double squared = p.x * p.x + p.y * p.y;
    return squared < square(n.radius) && squared > square(n.inner_radius) && 2 * std::abs(p.z) < n.height;
}
/// A disk of the inner radius at the point's own height, widened by the quarter circle of the edge.
inline bool member(const RoundedCylinder& n, const dvec3& p) {
    const double e = n.edge, into = std::abs(p.z) - (n.height / 2.0 - e);
    if (into >= e && 2 * std::abs(p.z) >= n.height) return false;
    const double wide = n.radius - e + (into > 0 ? std::sqrt(std::max(e * e - into * into, 0.0)) : e);
    return p.x * p.x + p.y * p.y < wide * wide;
}
/// A ball that grows evenly as it moves from one centre to the other: the maximum depth of the point in any of these
/// balls. The depth is a concave function of the position, so ternary search finds its maximum.
inline double swept(const RoundCone& n, const dvec3& p) {
    const auto outside = [&](double t) {
        return glm::length(p - glm::mix(dvec3(n.from), dvec3(n.to), t)) -
               ((1 - t) * n.radius_from + t * static_cast<double>(n.radius_to));
    };
    double low = 0, high = 1;
    for (int i = 0; i < 60; ++i) {
        const double third = (high - low) / 3;
        if (outside(low + third) < outside(high - third))
            high -= third;
        else
            low += third;
    }
    return std::min({outside(0), outside(1), outside((low + high) / 2)});
}
inline bool member(const RoundCone& n, const dvec3& p) {
    return swept(n, p) < 0;
}
inline bool member(const SphericalCap& n, const dvec3& p) {
    return glm::dot(p, p) < square(n.radius) && p.z > n.cut;
}
/// Below the edge at each of the angles 2πk/n.
inline bool member(const Prism& n, const dvec3& p) {
    const double step = 6.283185307179586 / static_cast<double>(n.sides), reach = n.radius * std::cos(step / 2);
    for (int k = 0; k < static_cast<int>(n.sides); ++k)
        if (p.x * std::cos(step * k) + p.y * std::sin(step * k) >= reach) return false;
    return 2 * std::abs(p.z) < n.height;
}
inline bool member(const Wedge& n, const dvec3& p) {
    return 2 * std::abs(p.y) < n.size.y && 2 * p.x > -n.size.x && 2 * p.z > -n.size.z &&
           p.x / n.size.x + p.z / n.size.z < 0;
}
inline bool member(const Pyramid& n, const dvec3& p) {
    const double up = p.z / n.height + 0.5;
    return up > 0 && 2 * std::max(std::abs(p.x), std::abs(p.y)) < n.base * (1 - up);
}
inline bool member(const Octahedron& n, const dvec3& p) {
    return std::abs(p.x) + std::abs(p.y) + std::abs(p.z) < n.radius;
}
/// A regular tetrahedron's faces are opposite its corners, a third of their distance from the centre.
inline bool member(const Tetrahedron& n, const dvec3& p) {
    const double k = n.radius / std::sqrt(3.0);
    return p.x + p.y + p.z > -k && p.x - p.y - p.z > -k && -p.x + p.y - p.z > -k && -p.x - p.y + p.z > -k;
}

// Primitives: signed distance.

inline double box(const dvec3& p, const dvec3& half) {
    const dvec3 q = glm::abs(p) - half;
    const double most = std::max({q.x, q.y, q.z});
    return most < 0 ? most : glm::length(glm::max(q, dvec3(0)));
}
inline double signed_value(const Sphere& n, const dvec3& p) {
    return glm::length(p) - n.radius;
}
inline double signed_value(const Box& n, const dvec3& p) {
    return box(p, dvec3(n.size) / 2.0);
}
inline double signed_value(const RoundedBox& n, const dvec3& p) {
    return box(p, dvec3(n.size) / 2.0 - static_cast<double>(n.radius)) - n.radius;
}
/// Distance in the plane (ρ, z) to a segment.
inline double to_segment(double rho, double z, double r0, double z0, double r1, double z1) {
    const double dr = r1 - r0, dz = z1 - z0;
    const double s = std::clamp(((rho - r0) * dr + (z - z0) * dz) / (dr * dr + dz * dz), 0.0, 1.0);
    return std::hypot(rho - r0 - s * dr, z - z0 - s * dz);
}
/// The profile's three edges; the fourth is the axis.
inline double signed_value(const CappedCone& n, const dvec3& p) {
    const double rho = std::hypot(p.x, p.y), h = n.height / 2.0, b = n.radius_bottom, t = n.radius_top;
    double d = to_segment(rho, p.z, b, -h, t, h);
    d = std::min(d, b > 0 ? to_segment(rho, p.z, 0, -h, b, -h) : std::hypot(rho, p.z + h));
    d = std::min(d, t > 0 ? to_segment(rho, p.z, 0, h, t, h) : std::hypot(rho, p.z - h));
    return member(n, p) ? -d : d;
}
inline double signed_value(const Cylinder& n, const dvec3& p) {
    return signed_value(CappedCone{.radius_bottom = n.radius, .radius_top = n.radius, .height = n.height}, p);
}
inline double signed_value(const Capsule& n, const dvec3& p) {
    const dvec3 a(n.from), b(n.to), axis = b - a;
    const double squared = glm::dot(axis, axis);
    const double s = squared > 0 ? std::clamp(glm::dot(p - a, axis) / squared, 0.0, 1.0) : 0.0;
    return glm::length(p - a - axis * s) - n.radius;
}
inline double signed_value(const Polyline& n, const dvec3& p) {
    double d = absent;
    for (std::size_t i = 0; i + 1 < n.points.size(); ++i)
        d = std::min(d, signed_value(Capsule{.from = n.points[i], .to = n.points[i + 1], .radius = n.radius}, p));
    return d;
}
inline double signed_value(const Torus& n, const dvec3& p) {
    return std::hypot(std::hypot(p.x, p.y) - n.major, p.z) - n.minor;
}
inline double signed_value(const Plane& n, const dvec3& p) {
    return glm::dot(p, dvec3(n.normal)) - n.offset;
}
inline double signed_value(const Polyhedron& n, const dvec3& p) {
    double farthest = -absent;
    for (std::size_t i = 0; i < n.normals.size(); ++i)
        farthest = std::max(farthest, glm::dot(p, glm::normalize(dvec3(n.normals[i]))) -
                                          static_cast<double>(n.offsets.size() == 1 ? n.offsets[0] : n.offsets[i]));
    return farthest;
}
inline double signed_value(const Ellipsoid& n, const dvec3& p) {
    const dvec3 r(n.radii);
    return std::max(
        {std::min({r.x, r.y, r.z}) * (glm::length(p / r) - 1), box(p, r), glm::length(p) - std::max({r.x, r.y, r.z})});
}
inline double signed_value(const CappedTorus& n, const dvec3& p) {
    const double half = glm::radians(static_cast<double>(n.angle)) / 2;
    const double a = std::clamp(std::atan2(p.y, p.x), -half, half);
    return glm::length(p - static_cast<double>(n.major) * dvec3(std::cos(a), std::sin(a), 0)) - n.minor;
}
/// Two rods and two half rings.
inline double signed_value(const Link& n, const dvec3& p) {
    const double half = n.length / 2.0, y = std::abs(p.y);
    double d = absent;
    for (const double x : {-static_cast<double>(n.major), static_cast<double>(n.major)})
        d = std::min(d, glm::length(dvec3(p.x - x, y - std::min(y, half), p.z)));
    if (y >= half) d = std::min(d, std::hypot(std::hypot(p.x, y - half) - n.major, p.z));
    return d - n.minor;
}
inline double signed_value(const Tube& n, const dvec3& p) {
    const double rho = std::hypot(p.x, p.y), h = n.height / 2.0, r = n.radius, i = n.inner_radius;
    const double d = std::min({to_segment(rho, p.z, i, -h, r, -h), to_segment(rho, p.z, i, h, r, h),
                               to_segment(rho, p.z, i, -h, i, h), to_segment(rho, p.z, r, -h, r, h)});
    return member(n, p) ? -d : d;
}
/// From the outside, the distance to the smaller cylinder; inside of that, to the nearest of its two faces.
inline double signed_value(const RoundedCylinder& n, const dvec3& p) {
    const double side = std::hypot(p.x, p.y) - (static_cast<double>(n.radius) - n.edge);
    const double cap = std::abs(p.z) - (n.height / 2.0 - n.edge);
    if (side < 0 && cap < 0) return std::max(side, cap) - n.edge;
    return std::hypot(std::max(side, 0.0), std::max(cap, 0.0)) - n.edge;
}
inline double signed_value(const RoundCone& n, const dvec3& p) {
    return swept(n, p);
}
/// The disk, and the nearest point of the arc by its angle from the z axis.
inline double signed_value(const SphericalCap& n, const dvec3& p) {
    const double rho = std::hypot(p.x, p.y), r = n.radius, c = n.cut;
    const double a = std::min(std::atan2(rho, p.z), std::acos(c / r));
    const double d = std::min(std::hypot(rho - r * std::sin(a), p.z - r * std::cos(a)),
                              to_segment(rho, p.z, 0, c, std::sqrt(r * r - c * c), c));
    return member(n, p) ? -d : d;
}
/// Distance to a segment.
inline double to_edge(const dvec3& p, const dvec3& a, const dvec3& b) {
    const dvec3 e = b - a;
    return glm::length(p - a - e * std::clamp(glm::dot(p - a, e) / glm::dot(e, e), 0.0, 1.0));
}
/// Distance to a convex plane polygon, whose corners are in order.
inline double to_polygon(const dvec3& p, const std::vector<dvec3>& corners) {
    const std::size_t n = corners.size();
    const dvec3 normal = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[1]));
    double d = absent;
    bool above = true;
    for (std::size_t i = 0; i < n; ++i) {
        const dvec3 &a = corners[i], &b = corners[(i + 1) % n];
        above = above && glm::dot(glm::cross(normal, b - a), p - a) >= 0;
        d = std::min(d, to_edge(p, a, b));
    }
    return above ? std::abs(glm::dot(normal, p - corners[0])) : d;
}
template <class N>
double signed_polyhedron(const N& n, const dvec3& p, const std::vector<std::vector<dvec3>>& faces) {
    double d = absent;
    for (const auto& f : faces) d = std::min(d, to_polygon(p, f));
    return member(n, p) ? -d : d;
}
/// A polygon in a plane moved along a vector.
inline std::vector<std::vector<dvec3>> extruded(const std::vector<dvec3>& polygon, const dvec3& by) {
    std::vector<std::vector<dvec3>> faces{polygon, polygon};
    for (dvec3& v : faces[1]) v += by;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const dvec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        faces.push_back({a, b, b + by, a + by});
    }
    return faces;
}
inline double signed_value(const Prism& n, const dvec3& p) {
    std::vector<dvec3> polygon;
    for (int k = 0; k < static_cast<int>(n.sides); ++k) {
        const double a = 3.14159265358979323846 * (2 * k + 1) / static_cast<double>(n.sides);
        polygon.emplace_back(n.radius * std::cos(a), n.radius * std::sin(a), -n.height / 2.0);
    }
    return signed_polyhedron(n, p, extruded(polygon, {0, 0, n.height}));
}
inline double signed_value(const Wedge& n, const dvec3& p) {
    const dvec3 h = dvec3(n.size) / 2.0;
    return signed_polyhedron(n, p,
                             extruded({{-h.x, -h.y, -h.z}, {h.x, -h.y, -h.z}, {-h.x, -h.y, h.z}}, {0, n.size.y, 0}));
}
inline double signed_value(const Pyramid& n, const dvec3& p) {
    const double a = n.base / 2.0, h = n.height / 2.0;
    const dvec3 top(0, 0, h), c[4] = {{a, a, -h}, {-a, a, -h}, {-a, -a, -h}, {a, -a, -h}};
    return signed_polyhedron(
        n, p, {{c[0], c[1], c[2], c[3]}, {c[0], c[1], top}, {c[1], c[2], top}, {c[2], c[3], top}, {c[3], c[0], top}});
}
inline double signed_value(const Octahedron& n, const dvec3& p) {
    const double r = n.radius;
    std::vector<std::vector<dvec3>> faces;
    for (const double x : {-r, r})
        for (const double y : {-r, r})
            for (const double z : {-r, r}) faces.push_back({{x, 0, 0}, {0, y, 0}, {0, 0, z}});
    return signed_polyhedron(n, p, faces);
}
inline double signed_value(const Tetrahedron& n, const dvec3& p) {
    const double k = n.radius / std::sqrt(3.0);
    const dvec3 a(k, k, k), b(k, -k, -k), c(-k, k, -k), d(-k, -k, k);
    return signed_polyhedron(n, p, {{a, b, c}, {a, b, d}, {a, c, d}, {b, c, d}});
}

}  // namespace phasetree::tests::oracle
