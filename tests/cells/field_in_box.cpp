// A field that is known in a box, as a function of the points of another: of quadratic fields all is known exactly, so
// that what their enclosures allow is what they do, but for how maps bend. And what is known of noise.
#include "phasetree/math/enclosure/field_in_box.hpp"

#include <doctest/doctest.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "phasetree/math/enclosure/noise_in_box.hpp"
#include "support/compared_crossings.hpp"

using namespace phasetree;
using namespace phasetree::tests;

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
            for (int j = 0; j < 3; ++j) change += std::abs(h[j][k]) * where.reach[static_cast<std::size_t>(j)];
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
        const Enclosure e = enclose(field.known(where), where, {half.x, half.y, half.z});
        const auto at = [&](const glm::dvec3& p) { return field.at(map.at(p)); };
        const glm::dvec3 slope(e.centre_gradient[0], e.centre_gradient[1], e.centre_gradient[2]);
        double highest = -Range::most, lowest = Range::most;
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
                const Range& g = e.gradient[static_cast<std::size_t>(i)];
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

TEST_CASE("noise's values, gradients and curvatures in a box are within what is known of them") {
    Random rng(215);
    std::size_t points = 0, outside = 0, steep = 0, beyond = 0;
    double most_bent = 0;
    for (int n = 0; n < (long_tests() ? 100000 : 4000); ++n) {
        const FractalNoise noise(std::exp2(rng.uniform(-2, 2)), static_cast<float>(1 + rng.below(3)));
        const glm::dvec3 centre(3.f * rng.direction());
        const glm::dvec3 half = static_cast<double>(std::exp2(rng.uniform(-9, -2))) *
                                glm::dvec3(rng.uniform(0.1f, 1), rng.uniform(0.1f, 1), rng.uniform(0.1f, 1));
        const Vec3<Enclosure> p = coordinates(centre, half);
        const Region where(p);
        const FieldInBox f = noise_in_box(noise, where);
        const Enclosure e = enclose(f, where, {half.x, half.y, half.z});
        const auto slope = [&](const glm::dvec3& d) {
            const glm::vec3 q(d);
            return noise.distance(Vec3<Dual>{Dual(q.x, 1, 0, 0), Dual(q.y, 0, 1, 0), Dual(q.z, 0, 0, 1)});
        };
        const glm::vec3 at_centre = slope(centre).gradient();
        for (int k = 0; k < 16; ++k) {
            const glm::dvec3 q = within_box(rng, centre, half);
            const Dual there = slope(q);
            const auto v = static_cast<double>(there.value());
            ++points;
            outside += v < e.value.low - 1e-6 || v > e.value.high + 1e-6;
            const glm::vec3 g = there.gradient();
            for (int i = 0; i < 3; ++i) {
                const Range& known = f.gradients[static_cast<std::size_t>(i)];
                const auto s = static_cast<double>(g[i]);
                steep += s < known.low - 1e-5 || s > known.high + 1e-5;
                // Far from the centre a sixth of the change is too little.
                const double change = std::abs(s - f.gradient[static_cast<std::size_t>(i)]);
                beyond += 6 * change > noise.curvature() * glm::length(half) + 1e-4;
            }
            const double apart = glm::length(q - centre);
            if (apart > 1e-3)
                most_bent =
                    std::max(most_bent, static_cast<double>(glm::length(g - at_centre)) / (apart * noise.curvature()));
        }
    }
    CHECK(outside == 0);
    CHECK(steep == 0);
    MESSAGE(points, " points; a sixth of what gradients may change by would miss ", beyond, "; they change by up to ",
            most_bent, " of what is allowed");
    CHECK(most_bent <= 1);
    CHECK(beyond > 0);
}
