#include <doctest/doctest.h>

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

}  // namespace test_diffuse
