#include <doctest/doctest.h>

#include "bsdf_checks.hpp"
#include "shading/bsdf/coating_albedo.hpp"

namespace test_coating {

using namespace phasetree;
using namespace phasetree::tests;
using tracer::CoatedDiffuseBsdf;
using tracer::CoatingAlbedo;

namespace {

// All light that is reflected under uniform light of radiance 1: the integral of evaluate, plus the mirror reflection
// if the coating is smooth.
double furnace(const CoatingAlbedo::At& coating, const glm::vec3& albedo, double theta) {
    const tracer::Bsdf bsdf(CoatedDiffuseBsdf(coating, albedo));
    const glm::vec3 wo = direction(theta);
    const double scattered = total(integrate_cells([&](const glm::vec3& wi) { return bsdf.evaluate(wo, wi).x; }, 32));
    return scattered + (coating.roughness() > 0.0f ? 0.0 : static_cast<double>(coating.directional(wo.z).x));
}

}  // namespace

TEST_CASE("coated diffuse: directions follow the pdf, weights the function, and 1 % errors are seen") {
    struct Case {
        float eta, roughness;
        double theta;
    };
    constexpr Case cases[] = {{1.5f, 0.0f, 70.0}, {1.5f, 0.3f, 15.0}, {1.5f, 0.3f, 80.0}, {0.9f, 0.4f, 60.0}};
    const double significance = sidak(1e-4, 2 * std::size(cases));
    for (const Case& c : cases) {
        CAPTURE(c.eta);
        CAPTURE(c.roughness);
        CAPTURE(c.theta);
        const CoatingAlbedo coating(c.eta, c.roughness);
        const tracer::Bsdf bsdf(CoatedDiffuseBsdf(coating.at(c.roughness), {0.6f, 0.3f, 0.1f}));
        const BsdfReport report = examine(bsdf, direction(c.theta), 31);
        CHECK(report.directions > significance);
        CHECK(report.directions_skewed < significance);
        CHECK(report.directions_scaled < significance);
        CHECK(report.pdf_integral <= 1.00001);
        CHECK(report.weight > significance);
        CHECK(report.weight_scaled < significance);
        CHECK(worst_disagreement(bsdf, direction(c.theta), 32) < 2e-3);
    }
}

TEST_CASE("coated diffuse: a white base is a white furnace") {
    for (const float eta : {1.0f, 1.1f, 1.5f, 2.0f, 0.75f}) {
        for (const float roughness : {0.0f, 0.2f, 0.5f}) {
            const CoatingAlbedo coating(eta, roughness);
            for (const double theta : {0.0, 45.0, 75.0, 85.0}) {
                CAPTURE(eta);
                CAPTURE(roughness);
                CAPTURE(theta);
                // Quadrature and table: the tabulated E is off by less than 1e-3. For a smooth coating with an index
                // below 1, the quadrature also contains the edge of total reflection.
                CHECK(furnace(coating.at(roughness), glm::vec3{1.0f}, theta) ==
                      doctest::Approx(1.0).epsilon(roughness > 0.0f ? 1e-3
                                                   : eta < 1.0f     ? 5e-4
                                                                    : 1e-4));
            }
        }
    }
}

TEST_CASE("coated diffuse: the sampled furnace is 1, and an error of 1 % is seen") {
    for (const float roughness : {0.0f, 0.3f}) {
        const CoatingAlbedo coating(1.5f, roughness);
        const tracer::Bsdf bsdf(CoatedDiffuseBsdf(coating.at(roughness), glm::vec3{1.0f}));
        for (const double theta : {10.0, 70.0}) {
            Uniform uniform(33);
            Moments weight;
            for (int i = 0; i < 300000; ++i) {
                const float lobe = uniform();
                const float first = uniform();
                const auto sample = bsdf.sample(direction(theta), lobe, {first, uniform()});
                weight.add(sample ? static_cast<double>(sample->weight.x) : 0.0);
            }
            CAPTURE(roughness);
            CAPTURE(theta);
            CHECK(mean_p_value(weight, 1.0, 3e-4) > sidak(1e-4, 4));
            CHECK(mean_p_value(weight, 1.01, 3e-4) < sidak(1e-4, 4));
            CHECK(mean_p_value(weight, 0.99, 3e-4) < sidak(1e-4, 4));
        }
    }
}

TEST_CASE("coated diffuse: never more than it receives, and reciprocal") {
    for (const float eta : {1.5f, 0.8f}) {
        for (const float roughness : {0.0f, 0.3f}) {
            const CoatingAlbedo coating(eta, roughness);
            CHECK(furnace(coating.at(roughness), glm::vec3{0.5f}, 50.0) < 0.9);
            CHECK(furnace(coating.at(roughness), glm::vec3{0.0f}, 50.0) ==
                  doctest::Approx(static_cast<double>(coating.at(roughness).directional(direction(50.0).z).x))
                      .epsilon(2e-3));
            const tracer::Bsdf bsdf(CoatedDiffuseBsdf(coating.at(roughness), glm::vec3{0.5f}));
            Uniform uniform(34);
            for (int i = 0; i < 500; ++i) {
                const glm::vec3 a = tracer::square_to_cosine_hemisphere({uniform(), uniform()});
                const glm::vec3 b = tracer::square_to_cosine_hemisphere({uniform(), uniform()});
                const float there = bsdf.evaluate(a, b).x / b.z;
                const float back = bsdf.evaluate(b, a).x / a.z;
                CHECK(std::abs(there - back) <= 1e-4f * there + 1e-7f);
            }
        }
    }
}

TEST_CASE("coated diffuse: without a difference of index the base is plain Lambert") {
    const CoatingAlbedo coating(1.0f, 0.0f);
    const tracer::Bsdf bsdf(CoatedDiffuseBsdf(coating.at(0.0f), {0.6f, 0.4f, 0.2f}));
    const glm::vec3 wo = direction(30.0);
    const glm::vec3 wi = direction(60.0, 100.0);
    CHECK(bsdf.evaluate(wo, wi).x == doctest::Approx(0.6f * wi.z / tracer::pi));
    CHECK(coating.at(0.0f).average().x < 1e-7f);
    CHECK(coating.at(0.0f).internal().x < 1e-7f);
}

TEST_CASE("coating albedo: published diffuse reflectances of a smooth interface") {
    // For n = 1.5 the external diffuse reflectance is 0.0918 and the internal one 0.5963 (Egan & Hilgeman 1979).
    const CoatingAlbedo coating(1.5f, 0.0f);
    CHECK(static_cast<double>(coating.at(0.0f).average().x) == doctest::Approx(0.0918).epsilon(2e-3));
    CHECK(static_cast<double>(coating.at(0.0f).internal().x) == doctest::Approx(0.5963).epsilon(2e-3));
    // A rough coating reflects about as much; the table is continuous with the smooth one.
    CHECK(static_cast<double>(CoatingAlbedo(1.5f, 0.01f).at(0.01f).average().x) ==
          doctest::Approx(0.0918).epsilon(0.01));
}

}  // namespace test_coating
