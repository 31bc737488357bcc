// Rectangle and sphere lights: density, samples, intersection, and the irradiance they give.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "light_checks.hpp"
#include "lights/lights.hpp"
#include "lights/rectangle_light.hpp"
#include "lights/sphere_light.hpp"

namespace test_light_areas {

using namespace phasetree::tracer;
using namespace phasetree::tests;

namespace {

constexpr double half_turn = std::numbers::pi;

struct Rectangle {
    glm::vec3 centre, edge_u, edge_v;

    glm::vec3 normal() const { return glm::normalize(glm::cross(edge_u, edge_v)); }
    glm::dvec3 point(double s, double t) const {
        return glm::dvec3(centre) + (s - 0.5) * glm::dvec3(edge_u) + (t - 0.5) * glm::dvec3(edge_v);
    }
    RectangleLight light() const { return {centre, edge_u, edge_v, glm::vec3(1.0f)}; }
};

const Rectangle tilted{{0.3f, 0.5f, 2.0f}, {1.2f, 0.0f, 0.4f}, {0.0f, -0.7f, 0.0f}};

// Lambert's formula for the irradiance of a polygon that is wholly above the horizon, L = 1:
// E = 1/2 Σ angle(vᵢ, vᵢ₊₁) n·(vᵢ × vᵢ₊₁)/|vᵢ × vᵢ₊₁|.
double lambert(const Rectangle& rectangle, const glm::vec3& p, const glm::vec3& normal) {
    const std::array<glm::dvec3, 4> corners{rectangle.point(0, 0), rectangle.point(1, 0), rectangle.point(1, 1),
                                            rectangle.point(0, 1)};
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 a = glm::normalize(corners[i] - glm::dvec3(p));
        const glm::dvec3 b = glm::normalize(corners[(i + 1) % 4] - glm::dvec3(p));
        CHECK(glm::dot(a, glm::dvec3(normal)) > 0.0);
        const glm::dvec3 axis = glm::cross(a, b);
        sum += std::atan2(glm::length(axis), glm::dot(a, b)) * glm::dot(glm::dvec3(normal), glm::normalize(axis));
    }
    return 0.5 * std::abs(sum);
}

// Van Oosterom and Strackee's solid angle of a triangle seen from the origin.
double triangle_solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double numerator = glm::dot(a, glm::cross(b, c));
    const double denominator = la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la;
    return 2.0 * std::abs(std::atan2(numerator, denominator));
}

double solid_angle_of(const Rectangle& r, const glm::vec3& p) {
    const glm::dvec3 o(p);
    return triangle_solid_angle(r.point(0, 0) - o, r.point(1, 0) - o, r.point(1, 1) - o) +
           triangle_solid_angle(r.point(0, 0) - o, r.point(1, 1) - o, r.point(0, 1) - o);
}

template <class Light>
float pdf(const Light& light, const glm::vec3& p, const glm::vec3& w) {
    const auto distance = light.intersect(p, w);
    return distance ? light.pdf_at(p, w, *distance) : 0.0f;
}

void check_rectangle(const Rectangle& rectangle, const glm::vec3& p) {
    const RectangleLight light = rectangle.light();
    constexpr int cells = 8;
    constexpr int finer = 32;
    // p dω = p cos θ/d² dA, by the midpoint rule on 256 × 256 points; its error, (cell/distance)², is below 1e-5 unless
    // the point is nearer than a tenth of the light's size.
    std::vector<double> probability(cells * cells, 0.0);
    const double area = glm::length(glm::cross(rectangle.edge_u, rectangle.edge_v)) / std::pow(cells * finer, 2.0);
    for (int j = 0; j < cells * finer; ++j) {
        for (int i = 0; i < cells * finer; ++i) {
            const glm::dvec3 to_light =
                rectangle.point((i + 0.5) / (cells * finer), (j + 0.5) / (cells * finer)) - glm::dvec3(p);
            const double d = glm::length(to_light);
            const glm::vec3 w = to_light / d;
            const double cosine = -glm::dot(w, rectangle.normal());
            probability[static_cast<std::size_t>((j / finer) * cells + i / finer)] +=
                pdf(light, p, w) * cosine / (d * d) * area;
        }
    }
    CHECK(sum_of(probability) == doctest::Approx(1.0).epsilon(1e-4));
    const glm::dvec3 u =
        glm::dvec3(rectangle.edge_u) / glm::dot(glm::dvec3(rectangle.edge_u), glm::dvec3(rectangle.edge_u));
    const glm::dvec3 v =
        glm::dvec3(rectangle.edge_v) / glm::dot(glm::dvec3(rectangle.edge_v), glm::dvec3(rectangle.edge_v));
    check_directions(
        probability, [&](const glm::vec2& s) { return std::optional(light.sample(p, s).direction); },
        [&](const glm::vec3& w) {
            const auto distance = light.intersect(p, w);
            if (!distance) return -1;
            const glm::dvec3 from_centre =
                glm::dvec3(p) + static_cast<double>(*distance) * glm::dvec3(w) - glm::dvec3(rectangle.centre);
            const int s = std::clamp(static_cast<int>((glm::dot(from_centre, u) + 0.5) * cells), 0, cells - 1);
            const int t = std::clamp(static_cast<int>((glm::dot(from_centre, v) + 0.5) * cells), 0, cells - 1);
            return t * cells + s;
        });
}

// E = ∫ cos θ dω over the light, L = 1.
template <class Light>
EstimatorResult irradiance_test(const Light& light, const glm::vec3& p, const glm::vec3& normal, double expected,
                                std::size_t count = 500000) {
    return estimator_test(expected, count, [&](Uniform& random) {
        const auto [w, density] = light.sample(p, random.two());
        return light.intersect(p, w) ? static_cast<double>(std::max(0.0f, glm::dot(normal, w)) / density) : 0.0;
    });
}

}  // namespace

TEST_CASE("rectangle: density and samples") {
    REQUIRE(tilted.normal().z < 0.0f);
    check_rectangle(tilted, {0.0f, 0.0f, 0.0f});
    check_rectangle(tilted, {-1.5f, 2.0f, 1.0f});     // from the side
    check_rectangle(tilted, {0.3f, 0.5f, 1.8f});      // close below
    check_rectangle(tilted, {40.0f, 30.0f, -90.0f});  // far away
}

TEST_CASE("rectangle: solid angle from everywhere in front") {
    Uniform random(2);
    const RectangleLight light = tilted.light();
    for (int i = 0; i < 20000; ++i) {
        const float distance = std::pow(10.0f, 6.0f * random() - 3.0f);
        const glm::vec3 from = direction_of(2.0 * half_turn * random(), 2.0 * random() - 1.0);
        const glm::vec3 p = tilted.centre + distance * from;
        const double expected = solid_angle_of(tilted, p);
        if (glm::dot(p - tilted.centre, tilted.normal()) < 1e-3f * distance) {
            if (glm::dot(p - tilted.centre, tilted.normal()) < -1e-5f * distance) CHECK(light.solid_angle(p) == 0.0);
            continue;
        }
        // The edges are stored in single precision and made exactly perpendicular: 1e-6.
        CHECK(light.solid_angle(p) == doctest::Approx(expected).epsilon(2e-5));
    }
}

TEST_CASE("rectangle: solid angle from nearly its own plane, a half-space before it and nothing beside it") {
    const RectangleLight light({0, 0, 0}, {2, 0, 0}, {0, 1, 0}, glm::vec3(1.0f));
    for (const float depth : {1e-2f, 1e-5f, 1e-9f, 1e-15f, 1e-30f}) {
        CAPTURE(depth);
        // Each edge is at least 0.1 away, so it hides or reveals at most 2 depth/0.1 of its half-space.
        const double most = 80.0 * static_cast<double>(depth) + 1e-14;
        for (const float x : {-0.9f, 0.0f, 0.5f, 0.9f})
            for (const float y : {-0.4f, 0.0f, 0.3f}) {
                const double solid_angle = light.solid_angle({x, y, depth});
                CHECK(std::abs(solid_angle - 2.0 * half_turn) < most);
            }
        for (const glm::vec2 aside :
             {glm::vec2(1.1f, 0.0f), {-3.0f, 0.2f}, {0.3f, 0.7f}, {-0.3f, -0.6f}, {5.0f, 5.0f}, {-1.2f, 0.8f}})
            CHECK(light.solid_angle({aside.x, aside.y, depth}) < most);
    }
}

TEST_CASE("rectangle: irradiance by Lambert's polygon formula") {
    const glm::vec3 up = glm::normalize(glm::vec3(0.1f, 0.2f, 1.0f));
    for (const glm::vec3 p : {glm::vec3(0.0f), glm::vec3(-0.8f, 0.2f, 0.5f), glm::vec3(0.3f, 0.5f, 1.0f)}) {
        check(irradiance_test(tilted.light(), p, up, lambert(tilted, p, up)));
    }
    const glm::vec3 far_away(0.0f, 0.0f, -3000.0f);
    check(irradiance_test(tilted.light(), far_away, up, lambert(tilted, far_away, up)));
}

TEST_CASE("rectangle: too small for the spherical parametrisation, sampled by area") {
    const glm::vec3 p(200.0f, -100.0f, -30000.0f);
    const double solid_angle = solid_angle_of(tilted, p);
    REQUIRE(solid_angle < 1e-9);
    const glm::vec3 to_light = glm::normalize(tilted.centre - p);
    // E ≈ Ω cos θ; the light's extent changes that by (size/distance)² ≈ 1e-9. Directions in single precision miss such
    // a light by 6e-8 of its 4e-5. So half a percent is lost at the rim, which is the tolerance here. Samples that hit
    // must have the right density.
    const RectangleLight light = tilted.light();
    CHECK(light.solid_angle(p) == doctest::Approx(solid_angle).epsilon(1e-3));
    Uniform random(9);
    int hits = 0;
    for (int i = 0; i < 10000; ++i) {
        const auto [w, density] = light.sample(p, random.two());
        if (!light.intersect(p, w)) continue;
        ++hits;
        CHECK(density == doctest::Approx(pdf(light, p, w)).epsilon(1e-3));
        CHECK(pdf(light, p, w) * solid_angle == doctest::Approx(1.0).epsilon(1e-3));
        CHECK(glm::dot(w, to_light) > 0.99999f);
    }
    CHECK(hits > 9900);
}

TEST_CASE("rectangle: it shines to one side only, and faces what it was told to") {
    const RectangleLight light = RectangleLight::facing({0, 0, 3}, {0, 0, 0}, 2.0f, 1.0f, glm::vec3(1.0f), false);
    CHECK_FALSE(light.visible_to_camera());
    CHECK(light.normal().z == doctest::Approx(-1.0));
    CHECK(light.intersect({0.9f, 0.4f, 0.0f}, {0, 0, 1}).value() == doctest::Approx(3.0));
    CHECK_FALSE(light.intersect({0.4f, 0.9f, 0.0f}, {0, 0, 1}));
    CHECK_FALSE(light.intersect({0.9f, 0.4f, 0.0f}, {0, 0, -1}));
    CHECK_FALSE(light.intersect({0.9f, 0.4f, 5.0f}, {0, 0, -1}));
    CHECK(light.solid_angle({0, 0, 5}) == 0.0);
    const RectangleLight wall = RectangleLight::facing({0, 5, 1}, {0, 0, 1}, 4.0f, 1.0f, glm::vec3(1.0f));
    CHECK(wall.intersect({1.9f, 0.0f, 1.4f}, {0, 1, 0}).value() == doctest::Approx(5.0));
    CHECK_FALSE(wall.intersect({0.4f, 0.0f, 1.9f}, {0, 1, 0}));
    CHECK_THROWS_AS(RectangleLight({}, {1, 0, 0}, {1, 1, 0}, {}), std::invalid_argument);
    CHECK_THROWS_AS(RectangleLight({}, {1, 0, 0}, {0, 0, 0}, {}), std::invalid_argument);
    CHECK_THROWS_AS(RectangleLight::facing({}, {}, 1, 1, {}), std::invalid_argument);
}

TEST_CASE("sphere: density and samples from outside, near and far") {
    const glm::vec3 centre(0.5f, -1.0f, 2.0f);
    for (const float distance : {1.01f, 1.5f, 4.0f, 400.0f}) {
        CAPTURE(distance);
        const SphereLight light(centre, 1.0f, glm::vec3(1.0f));
        const glm::vec3 p = centre - distance * glm::normalize(glm::vec3(0.2f, 0.3f, 0.9f));
        const glm::dvec3 axis = glm::normalize(glm::dvec3(centre) - glm::dvec3(p));
        const double exact_distance = glm::length(glm::dvec3(centre) - glm::dvec3(p));
        const double height = 1.0 - std::sqrt(1.0 - 1.0 / (exact_distance * exact_distance));
        const double solid_angle = 2.0 * half_turn * height;
        CHECK(light.solid_angle(p) == doctest::Approx(solid_angle).epsilon(1e-6));
        CHECK(pdf(light, p, glm::vec3(axis)) * solid_angle == doctest::Approx(1.0).epsilon(1e-6));
        const std::vector<double> probability(ConeBins::count, 1.0 / ConeBins::count);
        check_directions(
            probability, [&](const glm::vec2& u) { return std::optional(light.sample(p, u).direction); },
            ConeBins(axis, height));
        Uniform random(6);
        int missed = 0;
        for (int i = 0; i < 100000; ++i) missed += light.intersect(p, light.sample(p, random.two()).direction) ? 0 : 1;
        // Rounding at the rim: 1e-7 of the angle 1/distance, at most 400 times that.
        CHECK(missed < 20);
    }
}

TEST_CASE("sphere: irradiance by its form factor, wholly visible, E = π (r/d)² cos θ") {
    const SphereLight light({0.0f, 0.0f, 3.0f}, 1.0f, glm::vec3(1.0f));
    const glm::vec3 p(0.0f);
    for (const glm::vec3 normal : {glm::vec3(0, 0, 1), glm::vec3(0.6f, 0, 0.8f)}) {
        check(irradiance_test(light, p, normal, half_turn / 9.0 * normal.z));
    }
}

TEST_CASE("sphere: however small, it gives E = π (r/d)² cos θ, though directions are rounded") {
    const glm::vec3 centre(0.3f, 7.0f, 7.0f), p(0.1f, 0.2f, 0.3f), normal(0, 0, 1);
    const glm::dvec3 to_centre = glm::dvec3(centre) - glm::dvec3(p);
    const double squared_distance = glm::dot(to_centre, to_centre);
    for (const float radius : {1e-2f, 1e-4f, 1e-5f, 1e-6f}) {
        CAPTURE(radius);
        Lights lights;
        lights.add(SphereLight(centre, radius, glm::vec3(1.0f)));
        Uniform random(9);
        double sum = 0;
        constexpr int count = 20000;
        for (int i = 0; i < count; ++i) {
            const auto sample = lights.sample(p, random.two());
            if (!sample) continue;
            sum += static_cast<double>(glm::dot(sample->wi, normal)) / static_cast<double>(sample->pdf);
            // Sampling and intersection agree.
            CHECK(lights.seen(p, sample->wi, INFINITY, false)->distance < 20);
            CHECK(lights.pdf(p, sample->wi) == sample->pdf);
        }
        const double exact = half_turn * static_cast<double>(radius) * static_cast<double>(radius) / squared_distance *
                             to_centre.z / std::sqrt(squared_distance);
        CHECK(sum / count / exact == doctest::Approx(1).epsilon(1e-4));
    }
}

TEST_CASE("sphere: from inside it is everywhere") {
    const SphereLight light({1.0f, 2.0f, 3.0f}, 2.0f, glm::vec3(1.0f));
    const glm::vec3 p(1.5f, 1.0f, 3.5f);
    CHECK(light.solid_angle(p) == doctest::Approx(4.0 * half_turn));
    constexpr int columns = 16;
    constexpr int rows = 8;
    const auto probability =
        lat_long_probabilities(columns, rows, 4, [&](const glm::vec3& w) { return pdf(light, p, w); });
    CHECK(sum_of(probability) == doctest::Approx(1.0).epsilon(1e-6));
    check_directions(
        probability, [&](const glm::vec2& u) { return std::optional(light.sample(p, u).direction); },
        [](const glm::vec3& w) { return lat_long_bin(columns, rows, w); });
    check(irradiance_test(light, p, {0.0f, 0.6f, 0.8f}, half_turn, 2500000));
    Uniform random(4);
    for (int i = 0; i < 1000; ++i) {
        const auto [w, density] = light.sample(p, random.two());
        CHECK(density == pdf(light, p, w));
        const float distance = light.intersect(p, w).value();
        CHECK(glm::length(p + distance * w - glm::vec3(1, 2, 3)) == doctest::Approx(2.0).epsilon(1e-5));
    }
}

TEST_CASE("sphere: intersection") {
    const SphereLight light({0.0f, 5.0f, 0.0f}, 1.0f, glm::vec3(1.0f));
    CHECK(light.intersect({0, 0, 0}, {0, 1, 0}).value() == doctest::Approx(4.0));
    CHECK_FALSE(light.intersect({0, 0, 0}, {0, -1, 0}));
    CHECK_FALSE(light.intersect({1.01f, 0, 0}, {0, 1, 0}));
    CHECK_THROWS_AS(SphereLight({}, 0.0f, {}), std::invalid_argument);
    CHECK_THROWS_AS(SphereLight({}, 1.0f, glm::vec3(-1.0f)), std::invalid_argument);
}

TEST_CASE("rectangle light: the rough solid angle is never far off, and zero where the light is not seen") {
    const RectangleLight light({0, 0, 1}, {2, 0, 0}, {0, 1, 0}, glm::vec3(1));  // emits upwards
    for (const float x : {0.0f, 0.5f, 2.0f, 10.0f, 100.0f}) {
        for (const float height : {0.02f, 0.2f, 1.0f, 5.0f, 50.0f}) {
            const glm::vec3 p(x, 0.3f * x, 1 + height);
            const double ratio = light.approximate_solid_angle(p) / light.solid_angle(p);
            CHECK(ratio > 0.2);
            // At grazing angles, where the solid angle tends to zero, the estimate is generous: as if seen from r
            // higher up.
            const double generous = (static_cast<double>(height) + 0.8) / static_cast<double>(height);
            CHECK(ratio < 1.5 * generous);
        }
    }
    CHECK(light.approximate_solid_angle({0, 0, 0.5f}) == 0.0);
    CHECK(light.approximate_solid_angle({100, 0, 201}) ==
          doctest::Approx(light.solid_angle({100, 0, 201})).epsilon(1e-2));
}

}  // namespace test_light_areas
