#include <doctest/doctest.h>

#include "bsdf_checks.hpp"
#include "shading/fresnel.hpp"
#include "shading/metals.hpp"

namespace test_conductor {

using namespace phasetree;
using namespace phasetree::tests;
using tracer::ConductorSurface;
using tracer::find_metal;
using tracer::Metal;
using tracer::RoughConductorBsdf;
using tracer::SmoothConductorBsdf;
using tracer::ValueRange;

TEST_CASE("rough conductor: directions follow the pdf, weights the function, and 1 % errors are seen") {
    struct Case {
        float roughness;
        double theta;
        float aspect = 1.0f;
    };
    constexpr Case cases[] = {{0.3f, 0.0}, {0.4f, 60.0}, {0.5f, 86.0}, {1.0f, 30.0}, {0.6f, 50.0, 0.4f}};
    const Metal copper = *find_metal("copper");
    const double significance = sidak(1e-4, 2 * std::size(cases));
    for (const Case& c : cases) {
        CAPTURE(c.theta);
        const ConductorSurface surface(1.0f, copper.eta, copper.k, ValueRange{c.roughness, c.roughness}, {}, {},
                                       c.aspect);
        const tracer::Bsdf bsdf(RoughConductorBsdf(surface, c.roughness));
        const BsdfReport report = examine(bsdf, direction(c.theta), 21);
        CHECK(report.directions > significance);
        CHECK(report.directions_skewed < significance);
        CHECK(report.directions_scaled < significance);
        CHECK(report.pdf_integral <= 1.00001);
        CHECK(report.weight > significance);
        CHECK(report.weight_scaled < significance);
        CHECK(report.albedo < 1.0);
        CHECK(worst_disagreement(bsdf, direction(c.theta), 22) < 2e-3);
    }
}

TEST_CASE("rough conductor: reciprocal") {
    const Metal gold = *find_metal("gold");
    for (const float aspect : {1.0f, 0.2f}) {
        const ConductorSurface surface(1.0f, gold.eta, gold.k, ValueRange{0.3f, 0.3f}, {}, {}, aspect);
        const tracer::Bsdf bsdf(RoughConductorBsdf(surface, 0.3f));
        Uniform uniform(23);
        for (int i = 0; i < 1000; ++i) {
            const glm::vec3 a = tracer::square_to_cosine_hemisphere({uniform(), uniform()});
            const glm::vec3 b = tracer::square_to_cosine_hemisphere({uniform(), uniform()});
            const glm::vec3 there = bsdf.evaluate(a, b) / b.z;
            const glm::vec3 back = bsdf.evaluate(b, a) / a.z;
            CHECK(glm::length(there - back) <= 1e-4f * glm::length(there));
        }
    }
}

TEST_CASE("rough conductor: what single scattering loses at normal incidence is the closed form's") {
    // At normal incidence the visible normals have the density α²/(α² + t)² in t = tan²θ, light leaves at 2θ with
    // cos 2θ = (1 − t)/(1 + t) if t < 1, and G₂/G₁ is G₁ of that direction.
    for (const float alpha : {0.1f, 0.2f, 0.5f, 1.0f}) {
        const ConductorSurface surface(1.0f, glm::vec3{1.0f}, glm::vec3{1e6f}, ValueRange{alpha, alpha});
        const double alpha2 = static_cast<double>(alpha) * static_cast<double>(alpha);
        double expected = 0.0;
        constexpr int steps = 100000;
        for (int i = 0; i < steps; ++i) {
            const double t = (i + 0.5) / steps;
            const double cosine = (1.0 - t) / (1.0 + t);
            const double masking =
                2.0 * cosine / (cosine + std::sqrt(cosine * cosine + alpha2 * (1.0 - cosine * cosine)));
            expected += alpha2 / ((alpha2 + t) * (alpha2 + t)) * masking / steps;
        }
        CAPTURE(alpha);
        const double lost = static_cast<double>(surface.multiple(alpha, {}).losses.at(1.0f).x);
        CHECK(1.0 - lost == doctest::Approx(expected).epsilon(3e-4));
    }
}

TEST_CASE("smooth conductor: mirror direction, Fresnel weight") {
    const Metal silver = *find_metal("silver");
    const ConductorSurface surface(1.0f, silver.eta, silver.k);
    const tracer::Bsdf bsdf{SmoothConductorBsdf(surface)};
    const glm::vec3 wo = direction(50.0);
    const auto sample = bsdf.sample(wo, 0.7f, {0.2f, 0.4f});
    REQUIRE(sample);
    CHECK(sample->wi == glm::vec3{-wo.x, -wo.y, wo.z});
    CHECK(sample->delta);
    CHECK(sample->pdf == 1.0f);
    CHECK(sample->weight == tracer::fresnel_conductor(wo.z, silver.eta, silver.k));
    CHECK(bsdf.is_delta());
}

TEST_CASE("a metal of a reflectance is that of the index which has it, in air and in water, smooth and rough") {
    const glm::vec3 color(0.9f, 0.5f, 0.03f);
    const glm::vec3 k = tracer::k_of_reflectance(color);
    CHECK(glm::length(tracer::fresnel_conductor(1.0f, glm::vec3(1.0f), k) - color) < 1e-6f);
    for (const float ior : {1.0f, 1.33f}) {
        const ValueRange roughness{0.2f, 0.6f};
        const ConductorSurface by_index(ior, glm::vec3(1.0f), k, roughness);
        const ConductorSurface by_color = ConductorSurface::of_reflectance(ior, roughness);
        for (const float cosine : {0.05f, 0.4f, 1.0f}) {
            const glm::vec3 f = by_color.fresnel(cosine, {.reflectance = color});
            CHECK(glm::length(f - by_index.fresnel(cosine, {})) < 1e-6f);
        }
        const glm::vec3 expected = by_index.multiple(0.4f, {}).reflected;
        const glm::vec3 found = by_color.multiple(0.4f, {.reflectance = color}).reflected;
        CHECK(glm::length(found - expected) < 1e-4f);
        CHECK(glm::length(1.01f * found - expected) > 1e-3f);
    }
    // The limits: metals that reflect all light, or none.
    const ConductorSurface white = ConductorSurface::of_reflectance(1.0f, ValueRange{0.5f, 0.5f});
    CHECK(white.multiple(0.5f, {.reflectance = glm::vec3(1.0f)}).reflected.x == doctest::Approx(1).epsilon(1e-3));
    CHECK(white.multiple(0.5f, {.reflectance = glm::vec3(0.0f)}).reflected.x == 0.0f);
}

TEST_CASE("metals: known colours at normal incidence") {
    const auto reflectance = [](std::string_view name) {
        const std::optional<Metal> metal = find_metal(name);
        REQUIRE(metal);
        return tracer::fresnel_conductor(1.0f, metal->eta, metal->k);
    };
    const auto close = [](const glm::vec3& a, const glm::vec3& b, float tolerance) {
        return std::abs(a.x - b.x) < tolerance && std::abs(a.y - b.y) < tolerance && std::abs(a.z - b.z) < tolerance;
    };
    CHECK(close(reflectance("gold"), {1.0f, 0.78f, 0.34f}, 0.08f));
    CHECK(close(reflectance("copper"), {0.95f, 0.64f, 0.54f}, 0.03f));
    CHECK(close(reflectance("silver"), {0.99f, 0.985f, 0.98f}, 0.02f));
    CHECK(close(reflectance("aluminium"), {0.91f, 0.915f, 0.92f}, 0.01f));
    CHECK(close(reflectance("brass"), {0.89f, 0.79f, 0.43f}, 0.02f));
    CHECK(close(reflectance("iron"), {0.53f, 0.51f, 0.50f}, 0.02f));
    CHECK(close(reflectance("chromium"), {0.55f, 0.556f, 0.554f}, 0.02f));
    CHECK(close(reflectance("titanium"), {0.62f, 0.58f, 0.54f}, 0.02f));
    CHECK(close(reflectance("nickel"), {0.70f, 0.64f, 0.57f}, 0.02f));
    CHECK(close(reflectance("tungsten"), {0.52f, 0.50f, 0.47f}, 0.02f));
    CHECK(reflectance("aluminum") == reflectance("aluminium"));
    CHECK_FALSE(find_metal("unobtainium"));
    CHECK(tracer::metals().size() == 10);
}

}  // namespace test_conductor
