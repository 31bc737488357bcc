// Thin films: their reflectance against Airy's formula, their energy, and the surfaces that have them.
#include "shading/thin_film.hpp"

#include <doctest/doctest.h>

#include "bsdf_checks.hpp"
#include "shading/fresnel.hpp"
#include "shading/metals.hpp"
#include "spectrum/colour_matching.hpp"
#include "spectrum/daylight.hpp"

namespace test_thin_film {

using namespace phasetree;
using namespace phasetree::tests;
using tracer::CoatedDiffuseBsdf;
using tracer::CoatingAlbedo;
using tracer::ConductorSurface;
using tracer::DielectricSurface;
using tracer::FilmOfSurface;
using tracer::RoughConductorBsdf;
using tracer::RoughDielectricBsdf;
using tracer::SmoothConductorBsdf;
using tracer::SmoothDielectricBsdf;
using tracer::ThinFilm;
using tracer::ValueRange;

namespace {

FilmOfSurface soap(float thickness) {
    return {1.33f, {thickness, thickness}};
}

// The mean weight over both outcomes of a smooth surface, as in a furnace, per channel.
glm::dvec3 given_back(const tracer::Bsdf& bsdf, const glm::vec3& wo, double square) {
    glm::dvec3 sum(0.0);
    for (const float lobe : {0.0f, 0x1.fffffep-1f}) {
        const auto sample = bsdf.sample(wo, lobe, {});
        if (!sample) continue;
        if (lobe > 0.0f && !sample->transmitted) continue;  // it reflects everything
        sum += glm::dvec3(sample->weight) * static_cast<double>(sample->pdf) * (sample->transmitted ? square : 1.0);
    }
    return sum;
}

}  // namespace

TEST_CASE("thin film: at normal incidence, between the same media, it is the formula of Fabry and Airy") {
    // R = F sin²(δ/2)/(1 + F sin²(δ/2)), F = 4ρ/(1 − ρ)², ρ = ((n − 1)/(n + 1))², δ = 4π n d/λ.
    for (const double n : {1.33, 1.8, 2.5}) {
        for (const double thickness : {0.0, 90.0, 410.0, 1300.0}) {
            for (const double wavelength : {400.0, 550.0, 700.0}) {
                const double rho = (n - 1) * (n - 1) / ((n + 1) * (n + 1));
                const double coefficient = 4 * rho / ((1 - rho) * (1 - rho));
                const double sine = std::sin(2 * std::numbers::pi * n * thickness / wavelength);
                const double expected = coefficient * sine * sine / (1 + coefficient * sine * sine);
                const double ours = tracer::thin_film_reflectance(1.0, n, 1.0, 0.0, 1.0, thickness, wavelength);
                CHECK(ours == doctest::Approx(expected).epsilon(1e-9).scale(1e-3));
                if (expected > 1e-3) CHECK_FALSE(ours == doctest::Approx(1.01 * expected).epsilon(1e-3).scale(1e-3));
            }
        }
    }
}

TEST_CASE("thin film: a quarter of a wavelength of magnesium fluoride makes glass less bright") {
    // At normal incidence R = ((n₁ n₃ − n₂²)/(n₁ n₃ + n₂²))².
    const double n2 = 1.38, n3 = 1.52;
    const double expected = std::pow((n3 - n2 * n2) / (n3 + n2 * n2), 2);
    CHECK(tracer::thin_film_reflectance(1.0, n2, n3, 0.0, 1.0, 550.0 / (4 * n2), 550.0) ==
          doctest::Approx(expected).epsilon(1e-9));
}

TEST_CASE("thin film: without thickness, or with the index of one side, it is not there") {
    for (const double cosine : {1.0, 0.7, 0.2, 0.01}) {
        const double bare =
            static_cast<double>(tracer::fresnel_dielectric(static_cast<float>(cosine), 1.5f).reflectance);
        CHECK(tracer::thin_film_reflectance(1.0, 1.33, 1.5, 0.0, cosine, 0.0, 500.0) ==
              doctest::Approx(bare).epsilon(1e-5));
        CHECK(tracer::thin_film_reflectance(1.0, 1.0, 1.5, 0.0, cosine, 300.0, 500.0) ==
              doctest::Approx(bare).epsilon(1e-5));
        CHECK(tracer::thin_film_reflectance(1.0, 1.5, 1.5, 0.0, cosine, 300.0, 500.0) ==
              doctest::Approx(bare).epsilon(1e-5));
        const double gold = static_cast<double>(tracer::fresnel_conductor(static_cast<float>(cosine), 0.42f, 2.47f));
        CHECK(tracer::thin_film_reflectance(1.0, 1.4, static_cast<double>(0.42f), static_cast<double>(2.47f), cosine,
                                            0.0, 500.0) == doctest::Approx(gold).epsilon(1e-5));
    }
}

TEST_CASE(
    "thin film: colours are the spectrum's in daylight by the colour matching functions, and a flat one is grey") {
    glm::dvec3 sum(0.0);
    for (const tracer::SpectralWeight& w : tracer::spectral_weights()) sum += w.weight;
    for (int c = 0; c < 3; ++c) CHECK(sum[c] == doctest::Approx(1.0).epsilon(1e-12));
    // 1 nm steps and the exact formula, against the table, at angles between its nodes.
    const ThinFilm film({1.0f, 1.33f, glm::vec3(1.0f)}, 380.0f, 380.0f);
    for (const double cosine : {1.0, 0.8031, 0.4567, 0.1234}) {
        glm::dvec3 expected(0.0), weight(0.0);
        for (double wavelength = 380; wavelength <= 780; wavelength += 1) {
            const glm::dvec3 w =
                tracer::daylight_at(wavelength) * tracer::rec709_from_xyz(tracer::colour_matching(wavelength));
            expected +=
                w * tracer::thin_film_reflectance(1.0, static_cast<double>(1.33f), 1.0, 0.0, cosine, 380.0, wavelength);
            weight += w;
        }
        const glm::vec3 ours = film.reflectance(static_cast<float>(cosine), 380.0f);
        for (int c = 0; c < 3; ++c) {
            CAPTURE(cosine);
            CHECK(static_cast<double>(ours[c]) ==
                  doctest::Approx(std::clamp(expected[c] / weight[c], 0.0, 1.0)).epsilon(3e-3).scale(0.1));
        }
    }
    CHECK(film.reflectance(0.0f, 380.0f) == glm::vec3(1.0f));
    // The result is coloured.
    const glm::vec3 straight = film.reflectance(1.0f, 380.0f);
    CHECK(std::max({straight.x, straight.y, straight.z}) > 1.5f * std::min({straight.x, straight.y, straight.z}));
}

TEST_CASE("thin film: thicknesses between those of the table") {
    const ThinFilm many({1.0f, 1.4f, glm::vec3(1.33f)}, 100.0f, 900.0f);
    for (const float thickness : {100.0f, 233.3f, 514.1f, 899.0f}) {
        const ThinFilm one({1.0f, 1.4f, glm::vec3(1.33f)}, thickness, thickness);
        for (const float cosine : {1.0f, 0.5f, 0.1f}) {
            const glm::vec3 a = many.reflectance(cosine, thickness), b = one.reflectance(cosine, thickness);
            for (int c = 0; c < 3; ++c) CHECK(std::abs(a[c] - b[c]) < 1e-3f);
        }
        CHECK(glm::length(many.average(thickness) - one.average(thickness)) < 1e-3f);
    }
}

TEST_CASE("thin film: on clear surfaces nothing is lost, and both sides reflect the same") {
    for (const float to : {1.0f, 1.33f, 1.5f}) {
        const DielectricSurface surface(1.0f, to, std::nullopt, soap(420.0f));
        const DielectricSurface reverse = surface.reversed();
        CHECK_FALSE(tracer::Bsdf(SmoothDielectricBsdf(surface, 420.0f)).passes_through());
        const double square = static_cast<double>(to) * static_cast<double>(to);
        for (const double theta : {0.0, 35.0, 60.0, 85.0}) {
            CAPTURE(to);
            CAPTURE(theta);
            const glm::vec3 wo = direction(theta);
            const glm::dvec3 there = given_back(SmoothDielectricBsdf(surface, 420.0f), wo, square);
            const glm::dvec3 back = given_back(SmoothDielectricBsdf(reverse, 420.0f), wo, 1.0 / square);
            for (int c = 0; c < 3; ++c) {
                CHECK(there[c] == doctest::Approx(1.0).epsilon(1e-5));
                CHECK(back[c] == doctest::Approx(1.0).epsilon(1e-5));
            }
            const auto fresnel = surface.fresnel(wo.z, 420.0f);
            const auto inside = reverse.fresnel(fresnel.cos_transmitted, 420.0f);
            CHECK(glm::length(fresnel.reflectance - inside.reflectance) < 1e-4f);
        }
    }
    // Straight on through a soap film between air and air.
    const DielectricSurface bubble(1.0f, 1.0f, std::nullopt, soap(420.0f));
    const glm::vec3 wo = direction(50.0);
    const auto through = tracer::Bsdf(SmoothDielectricBsdf(bubble, 420.0f)).sample(wo, 0.99f, {});
    REQUIRE(through);
    CHECK(through->transmitted);
    CHECK(through->delta);
    CHECK(glm::length(through->wi + wo) < 1e-6f);
}

TEST_CASE("thin film: rough surfaces with films are sampled as they are evaluated, and white in a furnace") {
    const double significance = sidak(1e-4, 6);
    const glm::vec3 wo = direction(40.0);
    const DielectricSurface glass(1.0f, 1.5f, ValueRange{0.4f, 0.4f}, FilmOfSurface{1.8f, {300.0f, 300.0f}});
    const ConductorSurface mirror(1.0f, glm::vec3(1.0f), glm::vec3(1e6f), ValueRange{0.4f, 0.4f}, soap(300.0f));
    const CoatingAlbedo varnish(DielectricSurface(1.0f, 1.5f, std::nullopt, FilmOfSurface{1.8f, {300.0f, 300.0f}}),
                                ValueRange{0.4f, 0.4f}, ValueRange{300.0f, 300.0f});
    const tracer::Bsdf bsdfs[] = {RoughDielectricBsdf(glass, 0.4f),
                                  RoughConductorBsdf(mirror, 0.4f, {.thickness = 300.0f}),
                                  CoatedDiffuseBsdf(varnish.at(0.4f, 300.0f), glm::vec3(1.0f))};
    for (const tracer::Bsdf& bsdf : bsdfs) {
        const BsdfReport report = examine(bsdf, wo, 71);
        CHECK(report.directions > significance);
        CHECK(report.directions_scaled < significance);
        CHECK(report.weight > significance);
        CHECK(report.weight_scaled < significance);
        CHECK(worst_disagreement(bsdf, wo, 72) < 2e-3);
        for (int c = 0; c < 3; ++c) {
            const double white = total(integrate_cells([&](const glm::vec3& wi) {
                return static_cast<double>(bsdf.evaluate(wo, wi)[c]) * (wi.z < 0.0f ? 2.25 : 1.0);
            }));
            CHECK(white == doctest::Approx(1.0).epsilon(2e-3));
        }
    }
}

TEST_CASE("thin film: varnish with a film whose thickness varies is white at each") {
    const CoatingAlbedo varnish(DielectricSurface(1.0f, 1.5f, std::nullopt, FilmOfSurface{1.8f, {100.0f, 600.0f}}),
                                ValueRange{}, ValueRange{100.0f, 600.0f});
    for (const float thickness : {100.0f, 251.0f, 598.0f}) {
        const auto coating = varnish.at(0.0f, thickness);
        const tracer::Bsdf bsdf{CoatedDiffuseBsdf(coating, glm::vec3(1.0f))};
        const glm::vec3 wo = direction(50.0);
        for (int c = 0; c < 3; ++c) {
            const double base =
                total(integrate_cells([&](const glm::vec3& wi) { return bsdf.evaluate(wo, wi)[c]; }, 32));
            CHECK(base + static_cast<double>(coating.directional(wo.z)[c]) == doctest::Approx(1.0).epsilon(1e-3));
        }
    }
}

}  // namespace test_thin_film
