// The layered material: white furnaces at all corners of its parameters, the limits in which it equals one of the other
// BSDFs, reciprocity without coat and fuzz, sampling, and its components alone.
#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

#include "bsdf_checks.hpp"
#include "sampling/sobol.hpp"
#include "shading/fresnel.hpp"
#include "shading/principled_surface.hpp"
#include "shading/roughness.hpp"
#include "spectrum/colour_matching.hpp"
#include "support/long_tests.hpp"

namespace test_principled {

using namespace phasetree;
using namespace phasetree::tests;
using tracer::F82Metal;
using tracer::Fuzz;
using tracer::PrincipledBsdf;
using tracer::PrincipledPoint;
using tracer::PrincipledRanges;
using tracer::PrincipledSurface;
using tracer::SharedSurfaces;
using tracer::ValueRange;

namespace {

constexpr double tolerance = 0.002;

// Angles of view, in degrees.
std::vector<double> angles() {
    if (long_tests()) return {0.0, 40.0, 70.0, 80.0, 86.0, 89.0};
    return {20.0, 70.0, 88.0};
}

// The mean weight in a furnace of radiance 1, from a net of points.
glm::dvec3 furnace(const tracer::Bsdf& bsdf, const glm::vec3& wo, std::uint32_t samples) {
    const auto fraction = [](std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f + 0x1p-25f; };
    glm::dvec3 sum(0.0);
    for (std::uint32_t i = 0; i < samples; ++i) {
        const float lobe = (static_cast<float>(i) + 0.5f) / static_cast<float>(samples);
        const auto sample =
            bsdf.sample(wo, lobe, {fraction(tracer::sobol_first(i)), fraction(tracer::sobol_second(i))});
        if (sample) sum += glm::dvec3(sample->weight);
    }
    return sum / static_cast<double>(samples);
}

double largest(const glm::dvec3& v) {
    return std::max({v.x, v.y, v.z});
}

// How far the reflected light is above a limit, or below it if negative: `excess` of the mean weight. Most means are
// well within the tolerance after a few samples; the others receive more samples.
template <class Excess>
double excess_of(const tracer::Bsdf& bsdf, const glm::vec3& wo, const Excess& excess) {
    struct Level {
        std::uint32_t samples;
        double error;  // of nearly all means
    };
    double found = 0.0;
    for (const Level& level : {Level{1u << 11, 1e-3}, {1u << 13, 5e-4}, {1u << 15, 2.5e-4}, {1u << 17, 0.0}}) {
        found = excess(furnace(bsdf, wo, level.samples));
        if (found < tolerance - level.error) break;
    }
    return found;
}
// The difference from a white furnace.
double off_white(const tracer::Bsdf& bsdf, const glm::vec3& wo, double scale = 1.0) {
    return excess_of(bsdf, wo, [&](const glm::dvec3& mean) { return largest(glm::abs(scale * mean - 1.0)); });
}

// The range of one value.
ValueRange only(float value) {
    return {value, value};
}

// A surface that has the parameters of a point everywhere.
class Uniformly {
  public:
    explicit Uniformly(const PrincipledPoint& p, PrincipledRanges ranges = {}) : surface_(of(p, ranges)), point_(p) {}
    tracer::Bsdf bsdf() const { return surface_.at(point_); }

    static PrincipledSurface of(const PrincipledPoint& p, PrincipledRanges ranges) {
        // Shared, because tables take a while.
        static SharedSurfaces shared;
        ranges.diffuse_roughness = only(p.diffuse_roughness), ranges.metalness = only(p.metalness);
        ranges.roughness = only(p.roughness), ranges.coat_roughness = only(p.coat_roughness);
        ranges.coat_weight = only(p.coat_weight), ranges.fuzz_weight = only(p.fuzz_weight);
        ranges.fuzz_roughness = only(p.fuzz_roughness);
        if (p.film_weight > 0.0f) ranges.film = {1.4f, only(p.film_thickness)};
        return {ranges, shared};
    }

  private:
    PrincipledSurface surface_;
    PrincipledPoint point_;
};

PrincipledPoint white() {
    return {.base_color = glm::vec3(1.0f)};
}

void check_reciprocal(const tracer::Bsdf& bsdf, float relative) {
    Uniform uniform(34);
    for (int i = 0; i < 500; ++i) {
        const glm::vec3 a = tracer::square_to_cosine_hemisphere({uniform(), uniform()});
        const glm::vec3 b = tracer::square_to_cosine_hemisphere({uniform(), uniform()});
        const glm::vec3 there = bsdf.evaluate(a, b) / b.z, back = bsdf.evaluate(b, a) / a.z;
        CHECK(glm::length(there - back) <= relative * glm::length(there) + 1e-6f);
    }
}

void check_equal(const tracer::Bsdf& a, const tracer::Bsdf& b, float relative) {
    Uniform uniform(35);
    for (int i = 0; i < 300; ++i) {
        const glm::vec3 wo = tracer::square_to_cosine_hemisphere({uniform(), uniform()});
        const glm::vec3 wi = tracer::square_to_cosine_hemisphere({uniform(), uniform()});
        const glm::vec3 expected = b.evaluate(wo, wi);
        CHECK(glm::length(a.evaluate(wo, wi) - expected) <= relative * glm::length(expected) + 1e-6f);
    }
}

}  // namespace

TEST_CASE("principled: white furnace at all corners of the parameters") {
    for (const float metalness : {0.0f, 0.5f, 1.0f})
        for (const float roughness : {0.0f, 0.4f, 1.0f})
            for (const float coat_weight : {0.0f, 0.5f, 1.0f})
                for (const float coat_roughness : {0.0f, 0.5f})
                    for (const float fuzz_weight : {0.0f, 1.0f})
                        for (const float diffuse_roughness : {0.0f, 1.0f}) {
                            if (coat_weight == 0.0f && coat_roughness > 0.0f) continue;
                            if (metalness == 1.0f && diffuse_roughness > 0.0f) continue;
                            PrincipledPoint p = white();
                            p.metalness = metalness, p.roughness = roughness, p.diffuse_roughness = diffuse_roughness;
                            p.coat_weight = coat_weight, p.coat_roughness = coat_roughness;
                            p.fuzz_weight = fuzz_weight, p.fuzz_roughness = 0.4f;
                            CAPTURE(metalness);
                            CAPTURE(roughness);
                            CAPTURE(coat_weight);
                            CAPTURE(coat_roughness);
                            CAPTURE(fuzz_weight);
                            CAPTURE(diffuse_roughness);
                            const Uniformly surface(p);
                            for (const double theta : angles()) {
                                CAPTURE(theta);
                                CHECK(off_white(surface.bsdf(), direction(theta)) < tolerance);
                            }
                        }
}

TEST_CASE("principled: white furnace in a denser medium, with a grain, and with a partial film") {
    PrincipledPoint p = white();
    p.metalness = 0.5f, p.coat_weight = 0.5f, p.diffuse_roughness = 0.5f, p.specular_weight = 1.0f;
    for (const float roughness : {0.0f, 0.5f}) {
        p.roughness = roughness;
        CAPTURE(roughness);
        for (const double theta : angles()) {
            CAPTURE(theta);
            CHECK(off_white(Uniformly(p, {.outside = 1.7f}).bsdf(), direction(theta)) < tolerance);
            PrincipledPoint brushed = p;
            brushed.coat_weight = 0.0f;
            for (const double phi : {0.0, 30.0, 90.0})
                CHECK(off_white(Uniformly(brushed, {.aspect = 0.2f}).bsdf(), direction(theta, phi)) < tolerance);
            PrincipledPoint film = p;
            film.film_weight = 0.6f, film.metalness = 0.0f;
            CHECK(off_white(Uniformly(film).bsdf(), direction(theta)) < tolerance);
        }
    }
    const Uniformly surface(p);
    CHECK(off_white(surface.bsdf(), direction(40.0), 1.01) > tolerance);
    CHECK(off_white(surface.bsdf(), direction(40.0), 0.99) > tolerance);
}

TEST_CASE("principled: random settings reflect at most what they receive, and white ones all of it") {
    static SharedSurfaces shared;
    PrincipledRanges ranges;
    ranges.diffuse_roughness = ranges.metalness = ranges.coat_weight = ranges.fuzz_weight = {0.0f, 1.0f};
    ranges.roughness = {0.3f, 0.7f}, ranges.coat_roughness = {0.0f, 0.4f}, ranges.fuzz_roughness = {0.4f, 0.8f};
    ranges.film = {1.6f, {300.0f, 340.0f}};
    const PrincipledSurface in_air(ranges, shared);
    ranges.outside = 1.33f, ranges.ior = 1.9f, ranges.coat_ior = 1.25f, ranges.film.reset();
    ranges.roughness = ranges.coat_roughness = {0.0f, 0.0f};
    const PrincipledSurface in_water(ranges, shared);
    Uniform uniform(36);
    // Corners are drawn as often as the interior.
    const auto number = [&](float low = 0.0f, float high = 1.0f) {
        const float u = 2.0f * uniform() - 0.5f;
        return low + (high - low) * std::clamp(u, 0.0f, 1.0f);
    };
    const auto color = [&](bool is_white) {
        return is_white ? glm::vec3(1.0f) : glm::vec3(number(), number(), number());
    };
    double most = -1.0;
    const int settings = long_tests() ? 4000 : 400;
    for (int i = 0; i < settings; ++i) {
        const bool is_white = i % 4 == 0, is_in_air = i % 3 != 0;
        PrincipledPoint p{.base_weight = is_white ? 1.0f : number(),
                          .base_color = color(is_white),
                          .diffuse_roughness = number(),
                          .metalness = number(),
                          .specular_weight = is_white ? 1.0f : number(),
                          .specular_color = color(is_white),
                          .roughness = is_in_air ? number(0.3f, 0.7f) : 0.0f,
                          .coat_weight = number(),
                          .coat_color = color(is_white),
                          .coat_roughness = is_in_air ? number(0.0f, 0.4f) : 0.0f,
                          .coat_darkening = number(),
                          .fuzz_weight = number(),
                          .fuzz_color = color(is_white),
                          .fuzz_roughness = number(0.4f, 0.8f),
                          .film_weight = is_white && p.metalness > 0.0f ? 0.0f : number(),
                          .film_thickness = number(300.0f, 340.0f)};
        const tracer::Bsdf bsdf = (is_in_air ? in_air : in_water).at(p);
        const double theta = static_cast<double>(number(0.0f, 88.0f));
        const glm::vec3 wo = direction(theta);
        CAPTURE(i);
        if (is_white) {
            CHECK(off_white(bsdf, wo) < tolerance);
        } else {
            const double excess = excess_of(bsdf, wo, [](const glm::dvec3& mean) { return largest(mean) - 1.0; });
            CHECK(excess < tolerance);
            most = std::max(most, excess);
        }
    }
    CHECK(most > -0.1);  // otherwise, the settings would be too dark to show an excess
}

TEST_CASE("principled: directions follow the pdf, weights the function, and 1 % errors are seen") {
    struct Case {
        PrincipledPoint point;
        double theta;
        float aspect = 1.0f;
        bool tries_skew = false;  // false where lobes with different maps overlap and hide each other's skew
    };
    const glm::vec3 red(0.7f, 0.3f, 0.2f);
    std::vector<Case> cases = {{{.base_color = red,
                                 .diffuse_roughness = 0.8f,
                                 .metalness = 0.4f,
                                 .roughness = 0.5f,
                                 .coat_weight = 0.6f,
                                 .coat_roughness = 0.4f,
                                 .fuzz_weight = 0.8f,
                                 .fuzz_color = red},
                                70.0}};
    if (long_tests()) {
        cases.push_back({{.base_color = red, .roughness = 0.5f}, 60.0, 1.0f, true});
        cases.push_back({{.base_color = red, .metalness = 0.4f, .roughness = 0.6f, .coat_weight = 0.5f}, 30.0, 0.3f});
        cases.push_back({{.base_color = red, .roughness = 0.0f, .coat_weight = 0.5f, .fuzz_weight = 0.5f}, 40.0});
        cases.push_back({{.base_color = red, .roughness = 0.7f, .coat_weight = 1.0f, .coat_roughness = 0.4f}, 75.0});
    }
    const double significance = sidak(1e-4, 2 * cases.size());
    for (const Case& c : cases) {
        CAPTURE(&c - cases.data());
        const Uniformly surface(c.point, {.aspect = c.aspect});
        const BsdfReport report = examine(surface.bsdf(), direction(c.theta), 31, c.tries_skew);
        if (c.tries_skew) CHECK(report.directions_skewed < significance);
        CHECK(report.directions > significance);
        CHECK(report.directions_scaled < significance);
        CHECK(report.pdf_integral <= 1.00001);
        CHECK(report.weight > significance);
        CHECK(report.weight_scaled < significance);
        CHECK(worst_disagreement(surface.bsdf(), direction(c.theta), 32) < 2e-3);
    }
}

TEST_CASE("principled: the base is reciprocal") {
    PrincipledPoint p{.base_color = {0.7f, 0.3f, 0.2f}, .metalness = 0.3f, .specular_weight = 0.8f};
    for (const float roughness : {0.0f, 0.5f})
        for (const float diffuse_roughness : {0.0f, 0.7f}) {
            p.roughness = roughness, p.diffuse_roughness = diffuse_roughness;
            CAPTURE(roughness);
            CAPTURE(diffuse_roughness);
            check_reciprocal(Uniformly(p).bsdf(), 1e-3f);
        }
}

TEST_CASE("principled: limits are the other BSDFs") {
    // A metal, whose reflectance depends on the colours alone.
    PrincipledPoint p{.base_color = {0.9f, 0.6f, 0.3f},
                      .metalness = 1.0f,
                      .specular_weight = 0.9f,
                      .specular_color = {0.8f, 1.0f, 0.5f},
                      .roughness = 0.6f};
    const float alpha = p.roughness * p.roughness;
    const auto metal = tracer::ConductorSurface::of_reflectance(1.0f, only(alpha));
    tracer::ConductorSurface::Place place;
    place.by_colours = F82Metal{p.base_color, p.specular_color, p.specular_weight};
    check_equal(Uniformly(p).bsdf(), tracer::RoughConductorBsdf(metal, alpha, place), 1e-5f);
    // White metals are the same in either description.
    PrincipledPoint mirror = white();
    mirror.metalness = 1.0f, mirror.roughness = 0.6f;
    const tracer::ConductorSurface silver(1.0f, glm::vec3(1.0f), glm::vec3(1e6f), only(alpha));
    check_equal(Uniformly(mirror).bsdf(), tracer::RoughConductorBsdf(silver, alpha), 1e-4f);
    mirror.roughness = 0.0f;
    const tracer::Bsdf smooth = Uniformly(mirror).bsdf();
    CHECK(smooth.is_delta());
    CHECK(smooth.is_metal());
    CHECK(smooth.sample(direction(50.0), 0.3f, {})->weight == glm::vec3(1.0f));

    // Gloss over a diffuse base: `coated`, with the base whose visible colour is the same.
    for (const float roughness : {0.0f, 0.5f}) {
        PrincipledPoint plastic{.base_color = {0.7f, 0.3f, 0.2f}, .roughness = roughness};
        const tracer::CoatingAlbedo coating(1.5f, roughness * roughness);
        const glm::vec3 f = coating.at(roughness * roughness).internal();
        const glm::vec3 base = plastic.base_color / (1.0f - f + f * plastic.base_color);
        const tracer::Bsdf expected(tracer::CoatedDiffuseBsdf(coating.at(roughness * roughness), base));
        check_equal(Uniformly(plastic).bsdf(), expected, 3e-3f);
        // A coat and fuzz with no coverage change nothing.
        const Uniformly range(plastic);
        PrincipledRanges ranges{.roughness = only(roughness), .coat_weight = {0.0f, 1.0f}, .fuzz_weight = {0.0f, 1.0f}};
        SharedSurfaces shared;
        const PrincipledSurface coatable(ranges, shared);
        check_equal(coatable.at(plastic), range.bsdf(), 0.0f);
    }
    // Without gloss: rough diffuse and Lambert.
    PrincipledPoint clay{.base_color = {0.7f, 0.3f, 0.2f}, .diffuse_roughness = 0.6f, .specular_weight = 0.0f};
    check_equal(Uniformly(clay).bsdf(), tracer::RoughDiffuseBsdf(clay.base_color, 0.6f), 2e-3f);
    clay.diffuse_roughness = 0.0f;
    check_equal(Uniformly(clay).bsdf(), tracer::DiffuseBsdf(clay.base_color), 1e-5f);
}

TEST_CASE("principled: a coat darkens a coloured base, tints it, and roughens it") {
    const auto reflected = [](const PrincipledPoint& p) {
        return glm::vec3(furnace(Uniformly(p).bsdf(), direction(0.0), 1 << 16));
    };
    PrincipledPoint p{.base_color = {0.5f, 0.5f, 0.5f}, .specular_weight = 0.0f, .coat_weight = 1.0f};
    // The interfaced Lambertian model is exact here: a smooth coat of n = 1.5 on a Lambertian base, whose internal
    // diffuse reflectance is 0.5963 (test_coating).
    const Uniformly surface(p, {.coat_ior = 1.5f});
    const double coated = furnace(surface.bsdf(), direction(0.0), 1 << 16).x;
    CHECK(coated == doctest::Approx(0.04 + 0.96 * 0.5 * (1 - 0.5963) / (1 - 0.5 * 0.5963)).epsilon(2e-3));
    p.coat_darkening = 0.0f;
    CHECK(furnace(Uniformly(p, {.coat_ior = 1.5f}).bsdf(), direction(0.0), 1 << 16).x ==
          doctest::Approx(0.04 + 0.96 * 0.5).epsilon(1e-3));
    // The coat's colour is that of light which crosses it twice at normal incidence. Oblique light takes longer paths.
    p.coat_color = {0.5f, 1.0f, 0.25f};
    const glm::vec3 tinted = reflected(p);
    CHECK(tinted.x < 0.6f * tinted.y);
    CHECK(tinted.z < 0.35f * tinted.y);
    // A smooth metal under a rough coat is rough.
    PrincipledPoint steel{.metalness = 1.0f, .roughness = 0.0f, .coat_weight = 1.0f, .coat_roughness = 0.5f};
    const auto sample = Uniformly(steel).bsdf().sample(direction(30.0), 0.99f, {0.4f, 0.2f});
    REQUIRE(sample);
    CHECK(!sample->delta);
}

TEST_CASE("F82: the colours at 0° and 82°, and the mean are those asked for") {
    const F82Metal metal{{0.9f, 0.6f, 0.3f}, {0.8f, 1.0f, 0.5f}, 0.9f};
    CHECK(glm::length(metal.reflectance(1.0f, nullptr) - 0.9f * metal.normal) < 1e-6f);
    const glm::vec3 schlick = metal.normal + (1.0f - metal.normal) * std::pow(6.0f / 7.0f, 5.0f);
    CHECK(glm::length(metal.reflectance(1.0f / 7.0f, nullptr) - 0.9f * metal.edge * schlick) < 1e-6f);
    CHECK(metal.reflectance(0.0f, nullptr) == glm::vec3(0.9f));
    glm::dvec3 mean(0.0);
    for (int i = 0; i < 1000; ++i) {
        const float mu = (static_cast<float>(i) + 0.5f) / 1000;
        mean += glm::dvec3(2.0f * mu * metal.reflectance(mu, nullptr) / 1000.0f);
    }
    CHECK(glm::length(glm::vec3(mean) - metal.average()) < 1e-4f);
    // Never negative, however dark and tinted.
    const F82Metal black{glm::vec3(0.0f), glm::vec3(0.0f), 1.0f};
    for (int i = 0; i <= 100; ++i) CHECK(black.reflectance(static_cast<float>(i) / 100, nullptr).x >= 0.0f);
}

// Thicker films are left out, because they have more fringes than the sum has wavelengths.
TEST_CASE("film colours: those of the spectrum, for any metal, thickness and angle") {
    const auto weights = tracer::spectral_weights();
    const tracer::FilmColours colours;
    double worst = 0.0;
    for (const float film : {1.33f, 1.7f, 2.5f})
        for (const float thickness : {0.0f, 120.0f, 400.0f, 1500.0f})
            for (const float k : {0.5f, 3.0f, 8.0f}) {
                for (const float cosine : {1.0f, 0.8f, 0.4f, 0.1f}) {
                    const glm::vec3 found = colours.reflectance(1.0f, film, {k, 2.0f, k}, cosine, thickness);
                    glm::dvec3 sum(0.0);
                    for (const tracer::SpectralWeight& w : weights) {
                        const auto at = [&](float k_of_colour) {
                            return tracer::thin_film_reflectance(
                                1.0, static_cast<double>(film), 1.0, static_cast<double>(k_of_colour),
                                static_cast<double>(cosine), static_cast<double>(thickness), w.wavelength);
                        };
                        sum += w.weight * glm::dvec3(at(k), at(2.0f), at(k));
                    }
                    const glm::vec3 expected(glm::clamp(sum, 0.0, 1.0));
                    const glm::vec3 off = glm::abs(found - expected);
                    worst = std::max(worst, static_cast<double>(std::max({off.x, off.y, off.z})));
                }
            }
    CHECK(worst < 2e-3);
    const glm::vec3 thick = colours.reflectance(1.0f, 1.5f, glm::vec3(2.0f), 1.0f, 300.0f);
    CHECK(std::abs(thick.x - thick.z) > 0.02f);  // it is coloured
}

TEST_CASE("fuzz: never more than it receives, its albedo is the table's, and only grazing light sees much of it") {
    for (const float roughness : {0.0f, 0.3f, 0.6f, 1.0f}) {
        CAPTURE(roughness);
        const float alpha = Fuzz::alpha_of(roughness);
        const tracer::LossTables losses = Fuzz::losses_of(only(alpha));
        const Fuzz fuzz(losses, alpha);
        for (const double theta : {0.0, 45.0, 80.0, 88.0}) {
            CAPTURE(theta);
            const glm::vec3 wo = direction(theta);
            const double albedo = total(
                integrate_cells([&](const glm::vec3& wi) { return wi.z > 0.0f ? fuzz.evaluate(wo, wi) : 0.0f; }, 32));
            CHECK(albedo < 1.0);
            CHECK(static_cast<double>(fuzz.reflected(wo.z)) == doctest::Approx(albedo).epsilon(2e-3).scale(0.2));
        }
        CHECK(fuzz.reflected(0.1f) > 2.0f * fuzz.reflected(1.0f));
    }
}

TEST_CASE("principled: in spectral light, grey surfaces are the same, and colours are those of the light") {
    const tracer::Wavelengths light = tracer::Wavelengths::three(0.3f, tracer::WavelengthDistribution());
    const PrincipledPoint grey{
        .base_color = glm::vec3(0.5f), .metalness = 0.3f, .coat_weight = 0.5f, .fuzz_weight = 0.5f};
    const PrincipledSurface surface = Uniformly::of(grey, {});
    check_equal(tracer::Bsdf(surface.at(grey, &light)), tracer::Bsdf(surface.at(grey)), 1e-4f);
    // A film on a metal reflects the exact amount at each wavelength.
    const tracer::FilmColours colours;
    F82Metal metal{glm::vec3(0.7f)};
    metal.film = F82Metal::Film{&colours, 1.0f, 1.4f, 400.0f, 1.0f};
    const glm::vec3 found = metal.reflectance(0.8f, &light);
    const double k = static_cast<double>(tracer::k_of_reflectance(0.7f));
    for (int i = 0; i < 3; ++i)
        CHECK(static_cast<double>(found[i]) == doctest::Approx(tracer::thin_film_reflectance(
                                                   1.0, static_cast<double>(1.4f), 1.0, k, static_cast<double>(0.8f),
                                                   400.0, static_cast<double>(light.nanometres[i]))));
}

}  // namespace test_principled
