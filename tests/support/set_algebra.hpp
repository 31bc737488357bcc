#pragma once

/// An oracle: what every node means, written a second time, in double, from the definitions of the sets (paper,
/// Sections 3 to 6) and textbook inequalities of the primitives. It shares no equation with the library.
///
///     inside(f, p), label(a, p)   plain Boolean set algebra: &&, ||, !, "the later object replaces", inverse
///     transforms value(f, p), values(a, p)   fields as numbers, for those nodes whose very meaning is one (offset,
///     shell, smooth
///                                 operators, thin_shell, layered) and as an independent reference of φ
///
/// The functions dispatch over the library's variants without a default case: a node added to the list does not
/// compile here until the oracle knows it.

#include <glm/geometric.hpp>
#include <limits>
#include <stdexcept>

#include "phasetree/nodes/node.hpp"

namespace phasetree::tests {

inline constexpr double absent = std::numeric_limits<double>::infinity();

/// Φ in double, an absent phase being infinite. The index is the phase's.
struct Components {
    std::array<double, 16> phi;

    Components() { phi.fill(absent); }
    double& operator[](std::size_t i) { return phi.at(i); }
    double operator[](std::size_t i) const { return phi.at(i); }
    static constexpr std::size_t size = 16;

    /// Second smallest component: no label changes within that distance.
    double interface_distance() const {
        double first = absent, second = absent;
        for (const double v : phi) {
            second = std::min(second, std::max(first, v));
            first = std::min(first, v);
        }
        return second;
    }
};

bool inside(const Field&, const glm::dvec3&);
Phase label(const Phased&, const glm::dvec3&);
double value(const Field&, const glm::dvec3&);
Components values(const Phased&, const glm::dvec3&);

namespace oracle {

using glm::dvec3;

inline double square(double x) {
    return x * x;
}

// Inverse transforms.

inline dvec3 back(const Translate& w, const dvec3& p) {
    return p - dvec3(w.by);
}
/// Rodrigues' formula for the opposite angle.
inline dvec3 back(const Rotate& w, const dvec3& p) {
    const dvec3 k = glm::normalize(dvec3(w.axis));
    const double a = -glm::radians(static_cast<double>(w.angle));
    return p * std::cos(a) + glm::cross(k, p) * std::sin(a) + k * (glm::dot(k, p) * (1 - std::cos(a)));
}
inline dvec3 back(const Scale& w, const dvec3& p) {
    return p / static_cast<double>(w.factor);
}
inline dvec3 back(const Twist& w, const dvec3& p) {
    const double a = -glm::radians(static_cast<double>(w.rate)) * p.z;
    return {p.x * std::cos(a) - p.y * std::sin(a), p.x * std::sin(a) + p.y * std::cos(a), p.z};
}
inline dvec3 back(const Stretch& w, const dvec3& p) {
    return p / dvec3(w.factors);
}
inline dvec3 back(const Mirror& w, const dvec3& p) {
    const dvec3 n = glm::normalize(dvec3(w.normal));
    return glm::dot(p, n) < 0 ? glm::reflect(p, n) : p;
}
/// Beyond the apex is nowhere.
inline dvec3 back(const Taper& w, const dvec3& p) {
    const double s = 1 + static_cast<double>(w.rate) * p.z;
    return s > 0 ? dvec3(p.x / s, p.y / s, p.z) : dvec3(1e9);
}
/// About the centre of the arc, which is at height 1/k.
inline dvec3 back(const Bend& w, const dvec3& p) {
    const double k = glm::radians(static_cast<double>(w.rate));
    if (std::abs(k) < 1e-12) return p;
    const double centre = 1 / k, sign = k > 0 ? 1 : -1;
    const double r = std::hypot(p.x, centre - p.z), angle = std::atan2(p.x, sign * (centre - p.z));
    return {angle / std::abs(k), p.y, sign * (std::abs(centre) - r)};
}

// Where a local warp's bounds reach beyond what it warps, the map is the node's choice.

inline dvec3 extended(const Taper& w, const dvec3& p) {
    const dvec3 q = back(w, p);
    return {std::clamp<double>(q.x, w.inverse.low_x, w.inverse.high_x),
            std::clamp<double>(q.y, w.inverse.low_y, w.inverse.high_y), q.z};
}
inline dvec3 extended(const Bend& w, const dvec3& p) {
    dvec3 q = back(w, p);
    if (w.inverse.k == 0) return q;
    const double sign = w.inverse.side, near = w.inverse.near, r = 1 - w.inverse.k * sign * q.z;
    if (r < near) return {q.x * r / near, q.y, sign * w.inverse.highest};
    return q;
}

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
inline bool member(const Torus& n, const dvec3& p) {
    return square(std::hypot(p.x, p.y) - n.major) + p.z * p.z < square(n.minor);
}
inline bool member(const Plane& n, const dvec3& p) {
    return glm::dot(p, dvec3(n.normal)) < n.offset;
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
/// A ball that grows evenly as it moves from one centre to the other: how deep the point is in the one that holds it
/// best. The depth is a concave function of the way, so thirds find its maximum.
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
inline double signed_value(const Torus& n, const dvec3& p) {
    return std::hypot(std::hypot(p.x, p.y) - n.major, p.z) - n.minor;
}
inline double signed_value(const Plane& n, const dvec3& p) {
    return glm::dot(p, dvec3(n.normal)) - n.offset;
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

// Fields that are numbers by their meaning.

/// From g of the angles to the wall: sup‖∇g‖ is √3 · 2π/period.
template <class N>
double wall(const N& n, double g) {
    return std::abs(g) * n.period / (std::sqrt(3.0) * 6.283185307179586) - n.thickness / 2.0;
}
inline double signed_value(const Gyroid& n, const dvec3& p) {
    const dvec3 a = p * (6.283185307179586 / static_cast<double>(n.period)), s = glm::sin(a), c = glm::cos(a);
    return wall(n, s.x * c.y + s.y * c.z + s.z * c.x);
}
inline double signed_value(const SchwarzP& n, const dvec3& p) {
    const dvec3 c = glm::cos(p * (6.283185307179586 / static_cast<double>(n.period)));
    return wall(n, c.x + c.y + c.z);
}
inline double signed_value(const SchwarzD& n, const dvec3& p) {
    const dvec3 a = p * (6.283185307179586 / static_cast<double>(n.period)), s = glm::sin(a), c = glm::cos(a);
    return wall(n, s.x * s.y * s.z + s.x * c.y * c.z + c.x * s.y * c.z + c.x * c.y * s.z);
}
inline bool member(const Gyroid& n, const dvec3& p) {
    return signed_value(n, p) < 0;
}
inline bool member(const SchwarzP& n, const dvec3& p) {
    return signed_value(n, p) < 0;
}
inline bool member(const SchwarzD& n, const dvec3& p) {
    return signed_value(n, p) < 0;
}

/// Noise by whole numbers: the lattice's values, blended over the eight corners of a cell.
inline double lattice_value(const long long (&c)[3]) {
    const auto wrap = [](long long v) { return ((v % 289) + 289) % 289; };
    long long h = 0;
    for (const long long v : c) {
        const long long x = wrap(h + v);
        h = wrap((34 * x + 5) * x);
    }
    return static_cast<double>(h) / 144 - 1;
}
inline double value_noise(const dvec3& u) {
    const dvec3 whole = glm::floor(u), t = u - whole;
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        long long c[3];
        for (int i = 0; i < 3; ++i) {
            const bool high = (corner >> i) & 1;
            const double blend = t[i] * t[i] * t[i] * (10 + t[i] * (6 * t[i] - 15));
            weight *= high ? blend : 1 - blend;
            c[i] = static_cast<long long>(whole[i]) + high;
        }
        sum += weight * lattice_value(c);
    }
    return sum;
}
inline double fractal_noise(dvec3 u, int octaves) {
    u = glm::clamp(u, dvec3(-65536), dvec3(65536));
    double sum = 0, weights = 0;
    for (int i = 0; i < octaves; ++i) {
        sum += std::ldexp(value_noise(u), -i);
        weights += std::ldexp(1.0, -i);
        u = 2.0 * u + dvec3(19.25, 47.375, 71.5625);
    }
    return sum / weights;
}
inline double displaced(const Displace& n, const dvec3& p) {
    return value(n.of, p) + n.amplitude * fractal_noise(p / static_cast<double>(n.scale), static_cast<int>(n.octaves));
}
inline double signed_value(const Displace& n, const dvec3& p) {
    const double f = value(n.of, p), a = n.amplitude;
    const double slope = 3.75 * n.octaves / (n.scale * (2 - std::exp2(1.0 - n.octaves)));
    return std::clamp(displaced(n, p) / (1 + a * slope), f - a, f + a);
}
inline bool member(const Displace& n, const dvec3& p) {
    return displaced(n, p) < 0;
}

// Operators of plain fields.

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

// Objects: the phase at a point, by sets.

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
/// Signed depth in the union of some phases (of all if none are named): how far everything else is.
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

// Objects: Φ as numbers. With infinite absent phases the equations of the table hold without a special case.

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
/// What is kept of the chosen phases is where kept < 0. If that is all phases, what goes need not be within them.
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
inline Components components(const Remove& n, const dvec3& p) {
    Components a = values(n.of, p);
    for (std::size_t i = 1; i < Components::size; ++i) {
        if (!n.gone.contains(static_cast<int>(i))) continue;
        a[0] = std::min(a[0], a[i]);
        a[i] = absent;
    }
    return a;
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

// Warps. λ is the node's choice, which the tests of slopes hold to be large enough.

template <class W, class Child>
double to_bound(const Warped<W, Child>& n, const dvec3& p) {
    return box(p - dvec3(n.bound.centre), dvec3(n.bound.half));
}

template <class W>
bool member(const WarpedField<W>& n, const dvec3& p) {
    return inside(n.of, back(n.warp, p));
}
template <class W>
Phase region(const WarpedPhased<W>& n, const dvec3& p) {
    return label(n.of, back(n.warp, p));
}
/// A local warp is evaluated at the nearest point of its bounds, and the distance to them takes over where it is
/// larger.
template <class N>
dvec3 evaluated_at(const N& n, const dvec3& p) {
    if constexpr (LocalWarp<decltype(n.warp)>) {
        const dvec3 centre(n.bound.centre), half(n.bound.half);
        const dvec3 within = glm::clamp(p, centre - half, centre + half);
        if constexpr (requires { extended(n.warp, within); })
            return extended(n.warp, within);
        else
            return back(n.warp, within);
    } else {
        return back(n.warp, p);
    }
}
template <class W>
double signed_value(const WarpedField<W>& n, const dvec3& p) {
    const double f = value(n.of, evaluated_at(n, p)) * n.warp.value_scale();
    if constexpr (LocalWarp<W>) return std::max(f, to_bound(n, p));
    return f;
}
template <class W>
Components components(const WarpedPhased<W>& n, const dvec3& p) {
    Components a = values(n.of, evaluated_at(n, p));
    for (std::size_t i = 0; i < Components::size; ++i) {
        if (!(a[i] < absent)) continue;
        a[i] *= n.warp.value_scale();
        if constexpr (LocalWarp<W>) a[i] = i == 0 ? std::min(a[i], -to_bound(n, p)) : std::max(a[i], to_bound(n, p));
    }
    return a;
}

// Copies: each is where its inverse transform leads into the child.

struct Copy {
    dvec3 by;
    double turn, scale;  ///< turn in degrees

    dvec3 back(const dvec3& p) const {
        const double a = -glm::radians(turn);
        const dvec3 q = p - by;
        return dvec3(q.x * std::cos(a) - q.y * std::sin(a), q.x * std::sin(a) + q.y * std::cos(a), q.z) / scale;
    }
};
template <class Child>
std::vector<Copy> copies(const Instances<Child>& n) {
    std::vector<Copy> all;
    for (const glm::vec3& v : n.positions) {
        const std::size_t i = all.size();
        const double turn = n.turns.empty() ? 0 : n.turns[n.turns.size() == 1 ? 0 : i];
        const double scale = n.scales.empty() ? 1 : n.scales[n.scales.size() == 1 ? 0 : i];
        all.push_back({dvec3(v), turn, scale});
    }
    return all;
}
template <class Child>
std::vector<Copy> copies(const PolarArray<Child>& n) {
    std::vector<Copy> all;
    for (int i = 0; i < n.count; ++i) all.push_back({dvec3(0), static_cast<double>(n.angle) * i / n.count, 1});
    return all;
}
/// The last along z is the last of all, then along y.
template <class Child>
std::vector<Copy> copies(const Grid<Child>& n) {
    std::vector<Copy> all;
    for (int i = 0; i < n.count_x * n.count_y * n.count_z; ++i) {
        const dvec3 index(i % n.count_x, i / n.count_x % n.count_y, i / (n.count_x * n.count_y));
        all.push_back({index * dvec3(n.spacing), 0, 1});
    }
    return all;
}
template <class N>
concept IsCopies = requires(const N& n) {
    copies(n);
};

template <IsCopies N>
bool member(const N& n, const dvec3& p) {
    const auto all = copies(n);
    return std::any_of(all.begin(), all.end(), [&](const Copy& c) { return inside(n.of, c.back(p)); });
}
template <IsCopies N>
double signed_value(const N& n, const dvec3& p) {
    double result = absent;
    for (const Copy& c : copies(n)) result = std::min(result, value(n.of, c.back(p)) * c.scale);
    return result;
}
template <IsCopies N>
Phase region(const N& n, const dvec3& p) {
    Phase result = vacuum;
    for (const Copy& c : copies(n))
        if (const Phase l = label(n.of, c.back(p)); l != vacuum) result = l;
    return result;
}
template <IsCopies N>
Components components(const N& n, const dvec3& p) {
    std::optional<Components> result;
    for (const Copy& c : copies(n)) {
        Components a = values(n.of, c.back(p));
        for (double& v : a.phi) v *= c.scale;
        result = result ? replaced(*result, a) : a;
    }
    return *result;
}

}  // namespace oracle

inline bool inside(const Field& f, const glm::dvec3& p) {
    return std::visit([&](const auto& n) { return oracle::member(n, p); }, f.node()->node);
}
inline Phase label(const Phased& a, const glm::dvec3& p) {
    return std::visit([&](const auto& n) { return oracle::region(n, p); }, a.node()->node);
}
inline double value(const Field& f, const glm::dvec3& p) {
    return std::visit([&](const auto& n) { return oracle::signed_value(n, p); }, f.node()->node);
}
inline Components values(const Phased& a, const glm::dvec3& p) {
    return std::visit([&](const auto& n) { return oracle::components(n, p); }, a.node()->node);
}

}  // namespace phasetree::tests
