#include "sampling/warps.hpp"

#include <doctest/doctest.h>

#include "bsdf_checks.hpp"
#include "sampling/ggx.hpp"

namespace test_warps {

using namespace phasetree::tests;
using namespace phasetree::tracer;

namespace {

template <typename Warp>
std::vector<double> histogram(const Warp& warp, std::size_t samples, float power) {
    Uniform uniform(41);
    std::vector<double> counts(direction_cells + 1, 0.0);
    for (std::size_t i = 0; i < samples; ++i) {
        glm::vec2 u{uniform(), 0.0f};
        u.y = uniform();
        if (power != 1.0f)
            u = {std::min(std::pow(u.x, power), 0x1.fffffep-1f), std::min(std::pow(u.y, power), 0x1.fffffep-1f)};
        counts[direction_cell(warp(u))] += 1.0;
    }
    return counts;
}

template <typename Warp, typename Pdf>
void check(const Warp& warp, const Pdf& pdf) {
    const std::size_t samples = samples_to_detect(1e-4, direction_cells);
    const std::vector<double> integrals = integrate_cells(pdf);
    CHECK(total(integrals) == doctest::Approx(1.0).epsilon(1e-3));
    std::vector<double> expected;
    for (const double integral : integrals) {
        expected.push_back(integral * static_cast<double>(samples) / total(integrals));
    }
    expected.push_back(0.0);
    const double significance = sidak(1e-4, 5);
    CHECK(chi_squared_test(histogram(warp, samples, 1.0f), expected).p_value > significance);
    CHECK(chi_squared_test(histogram(warp, samples, 1.01f), expected).p_value < significance);
}

}  // namespace

TEST_CASE("warp: cosine hemisphere") {
    check([](const glm::vec2& u) { return square_to_cosine_hemisphere(u); },
          [](const glm::vec3& w) { return cosine_hemisphere_pdf(w.z); });
}

TEST_CASE("warp: uniform sphere") {
    check([](const glm::vec2& u) { return square_to_uniform_sphere(u); },
          [](const glm::vec3&) { return uniform_sphere_pdf(); });
}

TEST_CASE("warp: uniform cone") {
    // Half-angle with cos θ = 1/4: an edge of the cells.
    check([](const glm::vec2& u) { return square_to_uniform_cone(u, 0.75f); },
          [](const glm::vec3& w) { return w.z > 0.25f ? uniform_cone_pdf(0.75f) : 0.0f; });
}

TEST_CASE("warp: the cone of the sun keeps its digits") {
    const float height = 1.0814e-5f;  // half-angle 0.2665°
    const double radius = std::sqrt(static_cast<double>(height) * (2.0 - static_cast<double>(height)));
    Uniform uniform(42);
    Moments squares;
    double widest = 0.0;
    for (int i = 0; i < 100000; ++i) {
        const float first = uniform();
        const glm::vec3 w = square_to_uniform_cone({first, uniform()}, height);
        const double sine = std::hypot(static_cast<double>(w.x), static_cast<double>(w.y));
        widest = std::max(widest, sine);
        squares.add(sine * sine / (radius * radius));
    }
    CHECK(widest <= radius * (1.0 + 1e-6));
    CHECK(mean_p_value(squares, 0.5) > 1e-4);  // uniform: sin² is uniform for a small cone
    CHECK(mean_p_value(squares, 0.505) < 1e-4);
}

TEST_CASE("warp: uniform disk") {
    constexpr int rings = 8;
    constexpr int sectors = 16;
    const std::size_t samples = samples_to_detect(1e-4, rings * sectors);
    const auto fill = [&](float power) {
        std::vector<double> counts(rings * sectors, 0.0);
        Uniform uniform(43);
        for (std::size_t i = 0; i < samples; ++i) {
            const float first = std::pow(uniform(), power);
            const glm::vec2 p = square_to_uniform_disk({first, uniform()});
            const float radius2 = p.x * p.x + p.y * p.y;
            const float turn = std::atan2(p.y, p.x) / (2.0f * pi) + 0.5f;
            const int ring = std::min(static_cast<int>(radius2 * rings), rings - 1);
            const int sector = std::min(static_cast<int>(turn * sectors), sectors - 1);
            counts[static_cast<std::size_t>(ring * sectors + sector)] += 1.0;
        }
        return counts;
    };
    const std::vector<double> expected(rings * sectors, static_cast<double>(samples) / (rings * sectors));
    CHECK(chi_squared_test(fill(1.0f), expected).p_value > sidak(1e-4, 5));
    CHECK(chi_squared_test(fill(1.01f), expected).p_value < sidak(1e-4, 5));
    CHECK(uniform_disk_pdf() == doctest::Approx(1.0f / pi));
}

TEST_CASE("GGX: visible normals follow their density") {
    const glm::vec3 o = direction(70.0);
    for (const Ggx& ggx : {Ggx(0.4f), Ggx(0.2f, 0.6f)})
        check([&](const glm::vec2& u) { return ggx.sample_visible_normal(o, u); },
              [&](const glm::vec3& m) { return m.z > 0.0f ? ggx.visible_normal_pdf(o, m) : 0.0f; });
}

TEST_CASE(
    "GGX: with two roughnesses the slopes follow the bivariate Student's t distribution, each over its own roughness") {
    constexpr double a = 0.1, b = 0.35;
    const Ggx ggx(static_cast<float>(a), static_cast<float>(b));
    for (const double theta : {0.0, 3.0, 20.0, 60.0}) {
        for (const double phi : {0.0, 40.0, 90.0}) {
            const glm::dvec3 m(direction(theta, phi));
            const double x = m.x / m.z / a, y = m.y / m.z / b;
            const double of_slopes = 1 / (std::numbers::pi * a * b * (1 + x * x + y * y) * (1 + x * x + y * y));
            const double z2 = m.z * m.z;
            const auto found = static_cast<double>(ggx.distribution(glm::vec3(m)));
            CHECK(found == doctest::Approx(of_slopes / (z2 * z2)).epsilon(1e-5));
        }
    }
}

TEST_CASE(
    "GGX: the projected area of all microfacets is that of the surface, and of the visible ones that of the view") {
    for (const glm::vec2 alpha : {glm::vec2(0.2f), glm::vec2(0.5f), glm::vec2(1.0f), glm::vec2(0.3f, 0.8f)}) {
        const Ggx ggx(alpha.x, alpha.y);
        const double area = total(
            integrate_cells([&](const glm::vec3& m) { return m.z > 0.0f ? ggx.distribution(m) * m.z : 0.0f; }, 128));
        CHECK(area == doctest::Approx(1.0).epsilon(1e-3));
        for (const double theta : {0.0, 50.0, 85.0}) {
            const glm::vec3 o = direction(theta);
            const double visible = total(integrate_cells(
                [&](const glm::vec3& m) {
                    return m.z > 0.0f ? ggx.masking(o) * std::max(0.0f, glm::dot(o, m)) * ggx.distribution(m) : 0.0f;
                },
                128));
            CAPTURE(alpha.x);
            CAPTURE(theta);
            CHECK(visible == doctest::Approx(static_cast<double>(o.z)).epsilon(2e-3));
        }
    }
}

}  // namespace test_warps
