// Fields with known bounds in a box, as functions of the points of another box. For quadratic fields, everything is
// known exactly, so enclosures must be tight, except for the curvature of maps. Also tests bounds of noise.
#include "enclosure/field_in_box.hpp"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "enclosure/value_noise.hpp"
#include "math/dual.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/fractal_noise.hpp"
#include "support/compared_crossings.hpp"

namespace test_field_in_box {

using namespace phasetree;
using namespace phasetree::tests;

using enclosure::enclose, enclosure::Enclosure, enclosure::FieldInBox, enclosure::hull, enclosure::Interval,
    enclosure::Region;

namespace {

/// An affine map, and as much of x·y, y·z and z·x.
struct Bent {
    glm::mat3 linear{1};
    glm::vec3 offset{0}, bend{0};

    template <class T>
    Vec3<T> operator()(const Vec3<T>& p) const {
        const auto row = [&](int i, const T& product) {
            return p.x * linear[0][i] + p.y * linear[1][i] + p.z * linear[2][i] + offset[i] + product * bend[i];
        };
        return {row(0, p.x * p.y), row(1, p.y * p.z), row(2, p.z * p.x)};
    }
    glm::dvec3 at(const glm::dvec3& p) const {
        const auto q = (*this)(Vec3<double>{p.x, p.y, p.z});
        return {q.x, q.y, q.z};
    }
};

/// value + gradient·d + ½ dᵀ hessian d, where d = q − centre.
struct Quadratic {
    glm::dvec3 centre, gradient, eigenvalues;
    double value;
    glm::dmat3 axes;

    glm::dmat3 hessian() const {
        glm::dmat3 scaled = axes;
        for (int i = 0; i < 3; ++i) scaled[i] *= eigenvalues[i];
        return scaled * glm::transpose(axes);
    }
    double at(const glm::dvec3& q) const {
        const glm::dvec3 d = q - centre;
        return value + glm::dot(gradient + 0.5 * (hessian() * d), d);
    }
    FieldInBox known(const Region& where) const {
        FieldInBox f;
        f.value = value;
        const glm::dmat3 h = hessian();
        for (std::size_t i = 0; i < 3; ++i) {
            const int k = static_cast<int>(i);
            double change = 0;
            for (int j = 0; j < 3; ++j) change += std::abs(h[j][k]) * where.half_extents[static_cast<std::size_t>(j)];
            f.gradient[i] = gradient[k];
            f.gradients[i] = {gradient[k] - change, gradient[k] + change};
        }
        f.curvature = {std::min({eigenvalues.x, eigenvalues.y, eigenvalues.z}),
                       std::max({eigenvalues.x, eigenvalues.y, eigenvalues.z})};
        return f;
    }
};

glm::mat3 random_axes(Random& rng) {
    const glm::vec3 x = rng.direction(), y = glm::normalize(glm::cross(x, rng.direction()));
    return {x, y, glm::cross(x, y)};
}

Vec3<Enclosure> coordinates(const glm::dvec3& centre, const glm::dvec3& half) {
    const auto on = [&](int i) { return Enclosure::coordinate(i, centre[i], half[i]); };
    return {on(0), on(1), on(2)};
}

/// In a box, corners among them.
glm::dvec3 within_box(Random& rng, const glm::dvec3& centre, const glm::dvec3& half) {
    const auto one = [&] { return rng.chance(0.5) ? (rng.chance(0.5) ? 1 : -1) : rng.uniform(-1, 1); };
    const auto x = one(), y = one(), z = one();
    return centre + half * glm::dvec3(x, y, z);
}

}  // namespace

TEST_CASE("a field that is known where its point may be is enclosed, however the point is mapped") {
    Random rng(214);
    std::size_t points = 0, outside = 0, steep = 0, off_tangent = 0, bent = 0;
    double allowed = 0, met = 0;
    for (int n = 0; n < (long_tests() ? 20000 : 1000); ++n) {
        Bent map;
        map.linear = random_axes(rng);
        for (int i = 0; i < 3; ++i) map.linear[i] *= std::exp2(rng.uniform(-2, 2));
        map.offset = rng.direction();
        if (rng.chance(0.7)) map.bend = rng.uniform(0, 3) * rng.direction();
        const glm::dvec3 centre(rng.direction());
        const glm::dvec3 half = static_cast<double>(std::exp2(rng.uniform(-8, -1))) *
                                glm::dvec3(rng.uniform(0.1f, 1), rng.uniform(0.1f, 1), rng.uniform(0.1f, 1));
        const Vec3<Enclosure> q = map(coordinates(centre, half));
        const Region where(q);
        Quadratic field{{where.centre[0], where.centre[1], where.centre[2]},
                        glm::dvec3(rng.uniform(0, 2) * rng.direction()),
                        glm::dvec3(rng.uniform(-4, 4), rng.uniform(-4, 4), rng.uniform(-4, 4)),
                        static_cast<double>(rng.uniform(-1, 1)),
                        glm::dmat3(random_axes(rng))};
        // Mostly one thing at a time.
        if (rng.chance(0.3)) field.gradient = {};
        if (rng.chance(0.3)) field.eigenvalues = {};
        if (rng.chance(0.3)) field.gradient *= glm::dvec3(1, 0, 0);
        const Enclosure e = enclose(field.known(where), where).tightened({half.x, half.y, half.z});
        const auto at = [&](const glm::dvec3& p) { return field.at(map.at(p)); };
        const glm::dvec3 slope(e.centre_gradient[0], e.centre_gradient[1], e.centre_gradient[2]);
        double highest = -Interval::most, lowest = Interval::most;
        for (int k = 0; k < 16; ++k) {
            const glm::dvec3 p = within_box(rng, centre, half);
            const double v = at(p);
            ++points;
            outside += v < e.value.low - 1e-6 || v > e.value.high + 1e-6;
            constexpr double step = 1e-4;
            for (int i = 0; i < 3; ++i) {
                glm::dvec3 d(0);
                d[i] = step;
                const double s = (at(p + d) - at(p - d)) / (2 * step);
                const Interval& g = e.gradient[static_cast<std::size_t>(i)];
                steep += s < g.low - 1e-5 || s > g.high + 1e-5;
            }
            const glm::dvec3 d = p - centre;
            const double rise = v - e.centre - glm::dot(slope, d), squared = 0.5 * glm::dot(d, d);
            off_tangent += rise > e.curvature.high * squared + 1e-6 || rise < e.curvature.low * squared - 1e-6;
            const glm::dvec3 way = step * glm::dvec3(rng.direction());
            const double bend = (at(p + way) + at(p - way) - 2 * v) / (step * step);
            bent += bend < e.curvature.low - 1e-4 || bend > e.curvature.high + 1e-4;
            highest = std::max(highest, bend);
            lowest = std::min(lowest, bend);
        }
        if (glm::length(half) < 0.05) {
            allowed += e.curvature.high - e.curvature.low;
            met += highest - lowest;
        }
    }
    CHECK(outside == 0);
    CHECK(steep == 0);
    CHECK(off_tangent == 0);
    CHECK(bent == 0);
    MESSAGE(points, " points; in small boxes curvatures' ranges are ", allowed / met, " times what was met");
    CHECK(allowed < 8 * met);
}

namespace {

struct NoiseSeen {
    std::size_t points = 0, outside = 0, steep = 0, bent = 0;
    /// Of gradients and curvatures: sums of what was allowed, and of the most that was met.
    double gradient_allowed = 0, gradient_met = 0, curvature_allowed = 0, curvature_met = 0;
};

/// Points of a box, and chords between them.
template <class F>
void look_at_noise(const F& noise, const glm::dvec3& centre, const glm::dvec3& half, Random& rng, NoiseSeen& seen) {
    const Enclosure e = noise(coordinates(centre, half));
    const auto at = [&](const glm::dvec3& d) {
        const glm::vec3 q(d);
        return noise(Vec3<Dual>{Dual(q.x, 1, 0, 0), Dual(q.y, 0, 1, 0), Dual(q.z, 0, 0, 1)});
    };
    std::array<Interval, 3> met;
    double most_bent = 0;
    for (int k = 0; k < 16; ++k) {
        const glm::dvec3 a = within_box(rng, centre, half), b = within_box(rng, centre, half);
        const Dual there = at(a), other = at(b);
        const auto v = static_cast<double>(there.value());
        ++seen.points;
        seen.outside += v < e.value.low - 2e-6 || v > e.value.high + 2e-6;
        const glm::vec3 g = there.gradient();
        for (int i = 0; i < 3; ++i) {
            const Interval& known = e.gradient[static_cast<std::size_t>(i)];
            const auto s = static_cast<double>(g[i]);
            seen.steep += s < known.low - 2e-5 || s > known.high + 2e-5;
            Interval& m = met[static_cast<std::size_t>(i)];
            m = k == 0 ? Interval{s, s} : hull(m, {s, s});
        }
        // How fast the slope along a chord changes along it.
        const double length = glm::length(b - a);
        if (length < 1e-3) continue;
        const glm::dvec3 along = (b - a) / length;
        const double bend = glm::dot(glm::dvec3(other.gradient()) - glm::dvec3(g), along) / length;
        const double rounding = 4e-5 / length;
        seen.bent += bend < e.curvature.low - rounding || bend > e.curvature.high + rounding;
        most_bent = std::max(most_bent, std::abs(bend));
    }
    for (std::size_t i = 0; i < 3; ++i) {
        seen.gradient_allowed += e.gradient[i].high - e.gradient[i].low;
        seen.gradient_met += met[i].high - met[i].low;
    }
    seen.curvature_allowed += e.curvature.magnitude();
    seen.curvature_met += most_bent;
}

}  // namespace

TEST_CASE("noise's values, gradients and curvatures in a box are within what is known of them") {
    Random rng(215);
    for (const bool in_plane : {false, true}) {
        CAPTURE(in_plane);
        NoiseSeen large, small;
        for (int n = 0; n < (long_tests() ? 100000 : 8000); ++n) {
            const float size = std::exp2(rng.uniform(-2, 2)), which = std::floor(rng.uniform(-99, 99));
            const FractalNoise noise(size, static_cast<float>(1 + rng.below(3)));
            const float height = rng.uniform(-1, 1);
            const auto field = [&]<class T>(const Vec3<T>& p) {
                return in_plane ? value_noise(p.x * 0.5f, p.y * 0.3f + p.z * 0.2f, which) * height + p.z * 0.5f
                                : noise.distance(p);
            };
            // Boxes on the lattice's planes, too.
            glm::dvec3 centre(3.f * rng.direction());
            if (rng.chance(0.3)) centre = glm::round(centre * 4.0) / 4.0;
            const double extent = static_cast<double>(std::exp2(rng.uniform(-9, 1)));
            const glm::dvec3 half =
                extent * glm::dvec3(rng.uniform(0.1f, 1), rng.uniform(0.1f, 1), rng.uniform(0.1f, 1));
            look_at_noise(field, centre, half, rng, extent < 0.05 * static_cast<double>(size) ? small : large);
        }
        for (const NoiseSeen& seen : {large, small}) {
            CHECK(seen.points > 20'000);
            CHECK(seen.outside == 0);
            CHECK(seen.steep == 0);
            CHECK(seen.bent == 0);
        }
        MESSAGE("in small boxes gradients' ranges are ", small.gradient_allowed / small.gradient_met,
                " times what was met, curvatures ", small.curvature_allowed / small.curvature_met, " times");
        CHECK(small.gradient_allowed < 4 * small.gradient_met);
        CHECK(small.curvature_allowed < 6 * small.curvature_met);
    }
}

}  // namespace test_field_in_box
