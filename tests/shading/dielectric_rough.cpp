#include <doctest/doctest.h>

#include "bsdf_checks.hpp"
#include "shading/fresnel.hpp"

namespace test_dielectric_rough {

using namespace phasetree;
using namespace phasetree::tests;
using tracer::DielectricSurface;
using tracer::RoughDielectricBsdf;
using tracer::ValueRange;

namespace {

struct Case {
    float from, to, roughness;
    double theta;
};

constexpr Case cases[] = {
    {1.0f, 1.5f, 0.3f, 10.0}, {1.0f, 1.5f, 0.5f, 84.0}, {1.5f, 1.0f, 0.4f, 30.0}, {1.5f, 1.33f, 0.3f, 70.0}};

// The share of the energy of a uniform furnace that is returned. In a medium of index η, the radiance is η².
double furnace(const Case& c, int points = 64) {
    const DielectricSurface surface(c.from, c.to, ValueRange{c.roughness, c.roughness});
    const tracer::Bsdf bsdf(RoughDielectricBsdf(surface, c.roughness));
    const double square = static_cast<double>(c.to) * c.to / (static_cast<double>(c.from) * c.from);
    const glm::vec3 wo = direction(c.theta);
    return total(integrate_cells(
        [&](const glm::vec3& wi) {
            const double value = static_cast<double>(bsdf.evaluate(wo, wi).x);
            return wi.z > 0.0f ? value : value * square;
        },
        points));
}

}  // namespace

TEST_CASE("rough dielectric: directions follow the pdf, weights the function, and 1 % errors are seen") {
    const double significance = sidak(1e-4, 2 * std::size(cases));
    for (const Case& c : cases) {
        CAPTURE(c.from);
        CAPTURE(c.to);
        CAPTURE(c.roughness);
        CAPTURE(c.theta);
        const DielectricSurface surface(c.from, c.to, ValueRange{c.roughness, c.roughness});
        const tracer::Bsdf bsdf(RoughDielectricBsdf(surface, c.roughness));
        const BsdfReport report = examine(bsdf, direction(c.theta), 11);
        CHECK(report.directions > significance);
        CHECK(report.directions_skewed < significance);
        CHECK(report.directions_scaled < significance);
        CHECK(report.pdf_integral <= 1.00001);
        CHECK(report.weight > significance);
        CHECK(report.weight_scaled < significance);
        CHECK(worst_disagreement(bsdf, direction(c.theta), 12) < 2e-3);
    }
}

TEST_CASE("rough dielectric: its function integrates to a white furnace") {
    for (const Case& c : cases) {
        CAPTURE(c.theta);
        // The quadrature of narrow lobes is accurate to 2e-4.
        CHECK(furnace(c) == doctest::Approx(1.0).epsilon(1e-3));
    }
}

TEST_CASE("rough dielectric: the reverse density is that of the same interface, met from the other direction's side") {
    const tracer::FilmOfSurface soap{1.4f, {300.0f, 300.0f}};
    for (const float from : {1.0f, 1.33f, 2.0f})
        for (const float roughness : {0.02f, 0.3f, 1.0f})
            for (const auto& film : {std::optional<tracer::FilmOfSurface>(), std::optional(soap)}) {
                CAPTURE(from);
                CAPTURE(roughness);
                const DielectricSurface surface(from, 1.6f, ValueRange{roughness, roughness}, film);
                const DielectricSurface behind = surface.reversed();
                const tracer::Bsdf bsdf(RoughDielectricBsdf(surface, roughness)),
                    reverse(RoughDielectricBsdf(behind, roughness));
                Uniform uniform(17);
                int transmitted = 0, compared = 0;
                for (int i = 0; i < 5000; ++i) {
                    const glm::vec3 wo = tracer::square_to_cosine_hemisphere({uniform(), uniform()});
                    const auto sample = bsdf.sample(wo, uniform(), {uniform(), uniform()});
                    if (!sample) continue;
                    transmitted += sample->transmitted;
                    ++compared;
                    // Its normal points to the other side.
                    const glm::vec3 turned(1, 1, sample->transmitted ? -1 : 1);
                    const float expected = (sample->transmitted ? reverse : bsdf).pdf(sample->wi * turned, wo * turned);
                    REQUIRE(bsdf.reverse_pdf(wo, sample->wi) == doctest::Approx(expected).epsilon(2e-3));
                }
                CHECK(transmitted > compared / 3);
                CHECK(transmitted < compared);
            }
    // Opaque surfaces have a reverse pdf only for reflection.
    const tracer::Bsdf diffuse(tracer::DiffuseBsdf(glm::vec3(0.5f)));
    const glm::vec3 up(0, 0, 1), aside(0.6f, 0, 0.8f);
    CHECK(diffuse.reverse_pdf(up, aside) == diffuse.pdf(aside, up));
    CHECK(diffuse.reverse_pdf(up, -aside) == 0.0f);
}

TEST_CASE("rough dielectric: reciprocal, with the square of the index across the interface") {
    const float from = 1.33f;
    const float to = 1.6f;
    const DielectricSurface surface(from, to, ValueRange{0.3f, 0.3f});
    const tracer::Bsdf bsdf(RoughDielectricBsdf(surface, 0.3f));
    const DielectricSurface reverse_surface(to, from, ValueRange{0.3f, 0.3f});
    const tracer::Bsdf reverse(RoughDielectricBsdf(reverse_surface, 0.3f));
    Uniform uniform(13);
    int transmitted = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::vec3 wo = tracer::square_to_cosine_hemisphere({uniform(), uniform()});
        const auto sample = bsdf.sample(wo, uniform(), {uniform(), uniform()});
        if (!sample) continue;
        const glm::vec3 wi = sample->wi;
        const double there = static_cast<double>(bsdf.evaluate(wo, wi).x / std::abs(wi.z));
        double back = 0.0;
        if (sample->transmitted) {
            ++transmitted;
            back = static_cast<double>(reverse.evaluate({wi.x, wi.y, -wi.z}, {wo.x, wo.y, -wo.z}).x / wo.z);
            back *= static_cast<double>(from) * from / (static_cast<double>(to) * to);
        } else {
            back = static_cast<double>(bsdf.evaluate(wi, wo).x / wo.z);
        }
        const bool agrees = std::abs(there - back) <= 1e-3 * there + 1e-6;
        CHECK(agrees);
        if (!agrees) break;
    }
    CHECK(transmitted > 1000);
}

TEST_CASE("rough dielectric: a slightly rough surface reflects and refracts nearly as a smooth one") {
    for (const double theta : {0.0, 30.0, 60.0}) {
        const glm::vec3 wo = direction(theta);
        const DielectricSurface surface(1.0f, 1.5f, ValueRange{0.03f, 0.03f});
        const tracer::Bsdf bsdf(RoughDielectricBsdf(surface, 0.03f));
        const double reflected = total(
            integrate_cells([&](const glm::vec3& wi) { return wi.z > 0.0f ? bsdf.evaluate(wo, wi).x : 0.0f; }, 128));
        const double smooth = static_cast<double>(tracer::fresnel_dielectric(wo.z, 1.5f).reflectance);
        CAPTURE(theta);
        CHECK(reflected == doctest::Approx(smooth).epsilon(0.03));
    }
}

TEST_CASE("rough dielectric: the transmitted weight carries the same factor of radiance as the smooth one") {
    // Nearly smooth, so that masking is close to 1.
    const DielectricSurface surface(1.0f, 1.5f, ValueRange{0.001f, 0.001f});
    const tracer::Bsdf bsdf(RoughDielectricBsdf(surface, 0.001f));
    const auto sample = bsdf.sample(direction(30.0), 0.9999f, {0.3f, 0.6f});
    REQUIRE(sample);
    REQUIRE(sample->transmitted);
    CHECK(static_cast<double>(sample->weight.x) == doctest::Approx(1.0 / 2.25).epsilon(1e-5));
    CHECK(glm::length(glm::vec2{sample->wi}) == doctest::Approx(0.5f / 1.5f).epsilon(0.02));
}

TEST_CASE("rough dielectric: extreme directions give numbers") {
    Uniform uniform(14);
    for (const float roughness : {0.001f, 0.1f, 1.0f}) {
        for (const float z : {1e-20f, 1e-7f, 1e-3f, 1.0f}) {
            for (const float to : {1.0001f, 1.5f, 0.6f}) {
                const DielectricSurface surface(1.0f, to, ValueRange{roughness, roughness});
                const tracer::Bsdf bsdf(RoughDielectricBsdf(surface, roughness));
                const glm::vec3 wo{std::sqrt(std::max(0.0f, 1.0f - z * z)), 0.0f, z};
                for (int i = 0; i < 200; ++i) {
                    const auto sample = bsdf.sample(wo, uniform(), {uniform(), uniform()});
                    if (!sample) continue;
                    const bool sane = std::isfinite(sample->weight.x) && sample->weight.x >= 0.0f &&
                                      sample->pdf >= 0.0f && !std::isnan(sample->pdf) &&
                                      std::abs(glm::length(sample->wi) - 1.0f) < 1e-4f &&
                                      std::isfinite(bsdf.evaluate(wo, sample->wi).x);
                    CAPTURE(roughness);
                    CAPTURE(z);
                    CAPTURE(to);
                    CHECK(sane);
                    if (!sane) return;
                }
            }
        }
    }
}

}  // namespace test_dielectric_rough
