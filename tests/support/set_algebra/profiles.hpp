#pragma once

/// The oracle's part for profiles in the plane and what is made of them, coils, terrain and the solids that came with
/// them: see set_algebra.hpp.

#include <glm/vec2.hpp>
#include <vector>

#include "support/set_algebra/primitives.hpp"
#include "support/set_algebra/textures.hpp"

namespace phasetree::tests::oracle {

using glm::dvec2;

// Cross-sections.

inline bool member(const Extrude& n, const dvec3& p) {
    return 2 * std::abs(p.z) < n.height && inside(n.of, {p.x, p.y, 0});
}
inline double signed_value(const Extrude& n, const dvec3& p) {
    const double section = value(n.of, {p.x, p.y, 0}), beyond = std::abs(p.z) - n.height / 2.0;
    return section > 0 && beyond > 0 ? std::hypot(section, beyond) : std::max(section, beyond);
}
inline dvec3 half_plane(const Revolve& n, const dvec3& p) {
    return {std::hypot(p.x, p.y) - n.offset, p.z, 0};
}
inline bool member(const Revolve& n, const dvec3& p) {
    return inside(n.of, half_plane(n, p));
}
inline double signed_value(const Revolve& n, const dvec3& p) {
    return value(n.of, half_plane(n, p));
}

// Profiles.

/// The signed angle under which the segment from a to b is seen from p.
inline double seen(const dvec2& p, const dvec2& a, const dvec2& b) {
    const dvec2 u = a - p, v = b - p;
    return std::atan2(u.x * v.y - u.y * v.x, glm::dot(u, v));
}
/// The winding number of a closed path whose parts are seen under these angles; odd means inside.
inline bool is_around(double angle) {
    return std::llround(angle / 6.283185307179586) % 2 != 0;
}
inline bool in_polygon(const std::vector<dvec2>& corners, const dvec2& p) {
    double angle = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) angle += seen(p, corners[i], corners[(i + 1) % corners.size()]);
    return is_around(angle);
}
inline double to_outline(const std::vector<dvec2>& corners, const dvec2& p) {
    double d = absent;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const dvec2 &a = corners[i], &b = corners[(i + 1) % corners.size()];
        d = std::min(d, to_segment(p.x, p.y, a.x, a.y, b.x, b.y));
    }
    return in_polygon(corners, p) ? -d : d;
}

inline bool member(const Circle& n, const dvec3& p) {
    return p.x * p.x + p.y * p.y < square(n.radius);
}
inline double signed_value(const Circle& n, const dvec3& p) {
    return std::hypot(p.x, p.y) - n.radius;
}
/// Two rectangles, and a disk in each corner.
inline bool member(const Rectangle& n, const dvec3& p) {
    const double r = n.corner_radius, x = std::abs(p.x) - n.width / 2.0, y = std::abs(p.y) - n.height / 2.0;
    return x < 0 && y < 0 && (x < -r || y < -r || square(x + r) + square(y + r) < r * r);
}
inline double signed_value(const Rectangle& n, const dvec3& p) {
    const double r = n.corner_radius;
    return box({p.x, p.y, 0}, {n.width / 2.0 - r, n.height / 2.0 - r, absent}) - r;
}
inline std::vector<dvec2> corners(const Star& n) {
    std::vector<dvec2> all;
    for (int k = 0; k < 2 * static_cast<int>(n.points); ++k) {
        const double a = 3.14159265358979323846 * k / static_cast<double>(n.points);
        all.push_back(static_cast<double>(k % 2 == 0 ? n.radius : n.inner_radius) * dvec2(std::cos(a), std::sin(a)));
    }
    return all;
}
inline bool member(const Star& n, const dvec3& p) {
    return in_polygon(corners(n), p);
}
inline double signed_value(const Star& n, const dvec3& p) {
    return to_outline(corners(n), p);
}

// Solids.

inline bool member(const Slab& n, const dvec3& p) {
    return 2 * std::abs(glm::dot(p, dvec3(n.normal)) - n.offset) < n.thickness;
}
inline double signed_value(const Slab& n, const dvec3& p) {
    const double height = glm::dot(p, dvec3(n.normal)) - n.offset;
    return std::max(height, -height) - n.thickness / 2.0;
}
/// In the box, and near a face along two axes at least.
inline bool member(const BoxFrame& n, const dvec3& p) {
    int near = 0;
    for (int i = 0; i < 3; ++i) {
        if (2 * std::abs(p[i]) >= n.size[i]) return false;
        near += std::abs(p[i]) > n.size[i] / 2.0 - n.thickness;
    }
    return near >= 2;
}
/// From outside, twelve boxes; from inside, the faces and three square tunnels.
inline double signed_value(const BoxFrame& n, const dvec3& p) {
    const double t = n.thickness;
    const dvec3 half = dvec3(n.size) / 2.0;
    double outside = absent, depth = absent;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        for (const double u : {-1.0, 1.0}) {
            for (const double v : {-1.0, 1.0}) {
                dvec3 centre(0), extent(t / 2);
                extent[i] = half[i];
                centre[j] = u * (half[j] - t / 2);
                centre[k] = v * (half[k] - t / 2);
                outside = std::min(outside, box(p - centre, extent));
            }
        }
        depth = std::min(depth, half[i] - std::abs(p[i]));
        depth = std::min(depth, std::hypot(std::max(std::abs(p[j]) - (half[j] - t), 0.0),
                                           std::max(std::abs(p[k]) - (half[k] - t), 0.0)));
    }
    return member(n, p) ? -depth : outside;
}
/// A ring about the rim, and the part of a thick sphere seen from the centre below it.
inline bool member(const Bowl& n, const dvec3& p) {
    const double rho = std::hypot(p.x, p.y), c = n.cut, w = std::sqrt(square(n.radius) - c * c), t = n.thickness / 2.0;
    return square(rho - w) + square(p.z - c) < t * t ||
           (std::abs(glm::length(p) - n.radius) < t && std::atan2(p.z, rho) < std::atan2(c, w));
}
inline double signed_value(const Bowl& n, const dvec3& p) {
    const double rho = std::hypot(p.x, p.y), r = n.radius;
    const double a = std::min(std::atan2(p.z, rho), std::asin(n.cut / r));
    return std::hypot(rho - r * std::cos(a), p.z - r * std::sin(a)) - n.thickness / 2.0;
}
inline constexpr double golden_ratio = 1.618033988749894848;
/// With all signs and cyclic permutations.
inline std::vector<dvec3> all_of(std::initializer_list<dvec3> points) {
    std::vector<dvec3> all;
    for (const dvec3& v : points) {
        for (int i = 0; i < 24; ++i) {
            const int turn = i / 8;
            const dvec3 s(i & 1 ? -1 : 1, i & 2 ? -1 : 1, i & 4 ? -1 : 1);
            const dvec3 q = s * dvec3(v[turn], v[(turn + 1) % 3], v[(turn + 2) % 3]);
            if (std::none_of(all.begin(), all.end(), [&](const dvec3& o) { return glm::length(o - q) < 1e-9; }))
                all.push_back(q);
        }
    }
    for (dvec3& v : all) v = glm::normalize(v);
    return all;
}
inline const std::vector<dvec3>& icosahedron_corners() {
    static const std::vector<dvec3> all = all_of({{0, golden_ratio, 1}});
    return all;
}
inline const std::vector<dvec3>& dodecahedron_corners() {
    static const std::vector<dvec3> all = all_of({{1, 1, 1}, {1 / golden_ratio, golden_ratio, 0}});
    return all;
}
/// The corners farthest along each of the normals, in order about it.
inline std::vector<std::vector<dvec3>> faces_across(const std::vector<dvec3>& normals,
                                                    const std::vector<dvec3>& corners) {
    std::vector<std::vector<dvec3>> faces;
    for (const dvec3& n : normals) {
        double most = 0;
        for (const dvec3& c : corners) most = std::max(most, glm::dot(c, n));
        std::vector<dvec3> face;
        for (const dvec3& c : corners)
            if (glm::dot(c, n) > most - 1e-9) face.push_back(c);
        const dvec3 u = glm::normalize(face[0] - n * glm::dot(face[0], n)), v = glm::cross(n, u);
        std::sort(face.begin(), face.end(), [&](const dvec3& a, const dvec3& b) {
            return std::atan2(glm::dot(a, v), glm::dot(a, u)) < std::atan2(glm::dot(b, v), glm::dot(b, u));
        });
        faces.push_back(face);
    }
    return faces;
}
inline bool below_all(const std::vector<dvec3>& normals, double height, const dvec3& p) {
    return std::all_of(normals.begin(), normals.end(), [&](const dvec3& n) { return glm::dot(n, p) < height; });
}
/// Either's faces are across the other's corners, and both have the same height over the radius.
inline double height_of_faces() {
    return glm::dot(glm::normalize(dvec3(1, 1, 1)), glm::normalize(dvec3(0, golden_ratio, 1)));
}
inline bool member(const Dodecahedron& n, const dvec3& p) {
    return below_all(icosahedron_corners(), n.radius * height_of_faces(), p);
}
inline bool member(const Icosahedron& n, const dvec3& p) {
    return below_all(dodecahedron_corners(), n.radius * height_of_faces(), p);
}
/// Of a solid whose corners are at distance 1.
inline double to_faces(const std::vector<std::vector<dvec3>>& faces, const dvec3& p) {
    double d = absent;
    for (const auto& f : faces) d = std::min(d, to_polygon(p, f));
    return d;
}
inline double signed_value(const Dodecahedron& n, const dvec3& p) {
    static const auto faces = faces_across(icosahedron_corners(), dodecahedron_corners());
    const double r = n.radius;
    return (member(n, p) ? -r : r) * to_faces(faces, p / r);
}
inline double signed_value(const Icosahedron& n, const dvec3& p) {
    static const auto faces = faces_across(dodecahedron_corners(), icosahedron_corners());
    const double r = n.radius;
    return (member(n, p) ? -r : r) * to_faces(faces, p / r);
}

// Coils.

/// The minimum of a function of one variable: sampled 48 times per unit, then refined by ternary search around each
/// sample that is below its neighbours.
template <class F>
double least(F&& f, double from, double to) {
    const int steps = std::max(8, static_cast<int>(48 * (to - from)));
    const double step = (to - from) / steps;
    std::vector<double> at(static_cast<std::size_t>(steps) + 1);
    for (int i = 0; i <= steps; ++i) at[static_cast<std::size_t>(i)] = f(from + step * i);
    double result = std::min(at.front(), at.back());
    for (int i = 0; i <= steps; ++i) {
        const auto k = static_cast<std::size_t>(i);
        if ((i > 0 && at[k - 1] < at[k]) || (i < steps && at[k + 1] < at[k])) continue;
        double low = std::max(from, from + step * (i - 1)), high = std::min(to, from + step * (i + 1));
        for (int j = 0; j < 60; ++j) {
            const double third = (high - low) / 3;
            (f(low + third) < f(high - third) ? high : low) += f(low + third) < f(high - third) ? -third : third;
        }
        result = std::min(result, f((low + high) / 2));
    }
    return result;
}
inline double signed_value(const Helix& n, const dvec3& p) {
    const double way = least(
        [&](double turn) {
            const double a = 6.283185307179586 * turn;
            const dvec3 on(n.radius * std::cos(a), n.radius * std::sin(a) * (n.pitch < 0 ? -1 : 1),
                           std::abs(n.pitch) * (turn - n.turns / 2.0));
            return glm::dot(p - on, p - on);
        },
        0, n.turns);
    return std::sqrt(way) - n.wire;
}
inline bool member(const Helix& n, const dvec3& p) {
    return signed_value(n, p) < 0;
}

// Terrain.

inline double plane_noise(double x, double y, long long which) {
    const double across = std::floor(x), up = std::floor(y);
    const auto fade = [](double t) { return t * t * t * (10 + t * (6 * t - 15)); };
    const double s = fade(x - across), t = fade(y - up);
    double sum = 0;
    for (int corner = 0; corner < 4; ++corner) {
        const int right = corner & 1, top = corner >> 1;
        sum += (right ? s : 1 - s) * (top ? t : 1 - t) *
               lattice_value({which, static_cast<long long>(across) + right, static_cast<long long>(up) + top});
    }
    return sum;
}
inline double ground(const Heightfield& n, const dvec3& p) {
    const double far = 65536;
    double x = std::clamp(p.x / n.size, -far, far), y = std::clamp(p.y / n.size, -far, far), sum = 0, weights = 0;
    for (int i = 0; i < static_cast<int>(n.octaves); ++i) {
        const double value = plane_noise(x, y, static_cast<long long>(n.seed) + 71 * i);
        const double ridge = 1 - 2 * std::abs(value);
        sum += std::ldexp(value + n.ridged * (ridge - value), -i);
        weights += std::ldexp(1.0, -i);
        x = 2 * x + 19.25;
        y = 2 * y + 47.375;
    }
    return n.amplitude * sum / weights;
}
inline bool member(const Heightfield& n, const dvec3& p) {
    return p.z < ground(n, p);
}
inline double signed_value(const Heightfield& n, const dvec3& p) {
    const double a = n.amplitude;
    const double slope =
        a * (1 + static_cast<double>(n.ridged)) * 3.75 * n.octaves / (n.size * (2 - std::exp2(1.0 - n.octaves)));
    return std::clamp((p.z - ground(n, p)) / std::hypot(1, slope), p.z - a, p.z + a);
}

}  // namespace phasetree::tests::oracle
