#include <doctest/doctest.h>

#include <numbers>

#include "bsdf_checks.hpp"

namespace test_diffuse {

using namespace phasetree;
using namespace phasetree::tests;

TEST_CASE("diffuse: directions follow the pdf, weights the function, and 1 % errors are seen") {
    const tracer::Bsdf bsdf(tracer::DiffuseBsdf({0.7f, 0.5f, 0.2f}));
    const double significance = sidak(1e-4, 4);
    for (const double theta : {0.0, 75.0}) {
        CAPTURE(theta);
        const BsdfReport report = examine(bsdf, direction(theta), 1);
        CHECK(report.directions > significance);
        CHECK(report.directions_skewed < significance);
        CHECK(report.directions_scaled < significance);
        CHECK(report.pdf_integral == doctest::Approx(1.0).epsilon(1e-5));
        CHECK(report.weight > significance);
        CHECK(report.weight_scaled < significance);
        CHECK(report.albedo == doctest::Approx(0.7).epsilon(1e-5));
        CHECK(worst_disagreement(bsdf, direction(theta), 2) < 1e-5);
    }
}

TEST_CASE("diffuse: a white surface is a white furnace, exactly") {
    const tracer::Bsdf bsdf(tracer::DiffuseBsdf(glm::vec3{1.0f}));
    Uniform uniform(3);
    for (int i = 0; i < 1000; ++i) {
        const auto sample = bsdf.sample(direction(40.0), uniform(), {uniform(), uniform()});
        if (sample) CHECK(sample->weight == glm::vec3{1.0f});
    }
}

TEST_CASE("diffuse: reciprocal, and dark from below") {
    const tracer::Bsdf bsdf(tracer::DiffuseBsdf(glm::vec3{0.5f}));
    const glm::vec3 a = direction(20.0);
    const glm::vec3 b = direction(70.0, 200.0);
    CHECK(bsdf.evaluate(a, b).x / b.z == doctest::Approx(bsdf.evaluate(b, a).x / a.z));
    CHECK(bsdf.evaluate(a, -b) == glm::vec3{0.0f});
    CHECK(bsdf.pdf(a, -b) == 0.0f);
    CHECK_FALSE(bsdf.is_delta());
    CHECK_FALSE(bsdf.passes_through());
}

TEST_CASE("rough diffuse: directions follow the pdf, weights the function, and 1 % errors are seen") {
    const double significance = sidak(1e-4, 8);
    for (const float roughness : {0.3f, 1.0f}) {
        const tracer::Bsdf bsdf(tracer::RoughDiffuseBsdf({0.7f, 0.5f, 0.2f}, roughness));
        for (const double theta : {5.0, 75.0}) {
            CAPTURE(theta);
            const BsdfReport report = examine(bsdf, direction(theta), 1);
            CHECK(report.directions > significance);
            CHECK(report.directions_skewed < significance);
            CHECK(report.directions_scaled < significance);
            CHECK(report.pdf_integral == doctest::Approx(1.0).epsilon(1e-5));
            CHECK(report.weight > significance);
            CHECK(report.weight_scaled < significance);
            CHECK(worst_disagreement(bsdf, direction(theta), 2) < 1e-5);
        }
    }
}

TEST_CASE("rough diffuse: a white surface gives back all light, from every direction") {
    for (const float roughness : {0.01f, 0.5f, 1.0f}) {
        const auto given_back = [&](float albedo, double theta) {
            const tracer::Bsdf bsdf(tracer::RoughDiffuseBsdf(glm::vec3(albedo), roughness));
            const glm::vec3 wo = direction(theta);
            // The midpoint rule, over the square of the sine and the angle.
            double sum = 0;
            constexpr int rings = 400, spokes = 200;
            for (int i = 0; i < rings; ++i)
                for (int k = 0; k < spokes; ++k) {
                    const double s2 = (i + 0.5) / rings, phi = 2 * std::numbers::pi * (k + 0.5) / spokes;
                    const double s = std::sqrt(s2), c = std::sqrt(1 - s2);
                    const glm::vec3 wi(static_cast<float>(s * std::cos(phi)), static_cast<float>(s * std::sin(phi)),
                                       static_cast<float>(c));
                    sum += static_cast<double>(bsdf.evaluate(wo, wi).x) / c * std::numbers::pi / (rings * spokes);
                }
            return sum;
        };
        for (const double theta : {0.0, 30.0, 60.0, 80.0, 88.0}) {
            CAPTURE(roughness);
            CAPTURE(theta);
            CHECK(given_back(1.0f, theta) == doctest::Approx(1.0).epsilon(2e-3));
            CHECK(given_back(0.99f, theta) < 0.9925);
            // Light that is scattered more than once is darker than the albedo.
            CHECK(given_back(0.5f, theta) < 0.5 + 1e-3);
        }
    }
}

TEST_CASE("rough diffuse: reciprocal, Lambert's law where it is smooth, brighter towards the light, dark from below") {
    const tracer::Bsdf rough(tracer::RoughDiffuseBsdf(glm::vec3{0.5f}, 1.0f)),
        lambert(tracer::DiffuseBsdf(glm::vec3{0.5f}));
    const tracer::Bsdf smooth(tracer::RoughDiffuseBsdf(glm::vec3{0.5f}, 0.0f));
    for (const double phi : {0.0, 100.0, 180.0}) {
        const glm::vec3 a = direction(20.0), b = direction(70.0, phi);
        CHECK(rough.evaluate(a, b).x / b.z == doctest::Approx(rough.evaluate(b, a).x / a.z).epsilon(1e-5));
        CHECK(smooth.evaluate(a, b).x == doctest::Approx(lambert.evaluate(a, b).x).epsilon(1e-6));
    }
    const glm::vec3 slanted = direction(70.0);
    CHECK(rough.evaluate(slanted, slanted).x > 1.3f * lambert.evaluate(slanted, slanted).x);
    CHECK(rough.evaluate(slanted, direction(70.0, 180.0)).x < 0.9f * lambert.evaluate(slanted, slanted).x);
    CHECK(rough.evaluate(slanted, -slanted) == glm::vec3{0.0f});
    CHECK_FALSE(rough.is_delta());
    CHECK_FALSE(rough.passes_through());
    CHECK(rough.is_diffuse());
}

}  // namespace test_diffuse
