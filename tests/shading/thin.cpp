// Thin panes and sheets: closed forms against series, energy, sampling and reciprocity.
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>

#include "bsdf_checks.hpp"
#include "sampling/sobol.hpp"
#include "shading/interface.hpp"
#include "shading/thin_pane.hpp"
#include "tracer/support/closed_form.hpp"

namespace test_thin {

using namespace phasetree;
using namespace phasetree::tests;
using tracer::ThinPane;

namespace {

struct Sum {
    double reflected, transmitted;
};

// The light in a pane, followed from face to face in double precision. `a` is the share that crosses it once at normal
// incidence.
Sum followed(double cosine, double eta, double a) {
    const double r = phasetree::tests::fresnel(cosine, 1, eta);
    if (r == 1) return {1, 0};
    const double inside = std::sqrt(1 - (1 - cosine * cosine) / (eta * eta)), crossing = std::pow(a, 1 / inside);
    Sum sum{r, 0};
    double light = 1 - r;
    for (int i = 0; i < 100000 && light > 1e-16; ++i) {
        light *= crossing;
        (i % 2 == 0 ? sum.transmitted : sum.reflected) += light * (1 - r);
        light *= r;
    }
    return sum;
}

constexpr double degree = std::numbers::pi / 180;

double worst_share(double scale_of_index, double exponent_of_colour) {
    double worst = 0;
    for (const float eta : {1.1f, 1.5f, 2.4f, 1.5f / 1.33f, 0.75f})
        for (const float a : {1.0f, 0.9f, 0.3f})
            for (const double theta : {0.0, 20.0, 45.0, 60.0, 80.0, 88.0}) {
                const double c = std::cos(theta * degree);
                const Sum right = followed(c, static_cast<double>(eta), static_cast<double>(a));
                const ThinPane pane(static_cast<float>(scale_of_index) * eta,
                                    glm::vec3(std::pow(a, static_cast<float>(exponent_of_colour))));
                const ThinPane::Shares found = pane.at(static_cast<float>(c));
                worst = std::max({worst, std::abs(static_cast<double>(found.reflected.x) - right.reflected),
                                  std::abs(static_cast<double>(found.transmitted.y) - right.transmitted)});
            }
    return worst;
}

// The mean weight in a furnace, for reflected and transmitted light.
Sum furnace(const tracer::Bsdf& bsdf, const glm::vec3& wo) {
    constexpr std::uint32_t samples = 1 << 16;
    const auto fraction = [](std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f + 0x1p-25f; };
    Sum sum{0, 0};
    for (std::uint32_t i = 0; i < samples; ++i) {
        const float lobe = (static_cast<float>(i) + 0.5f) / static_cast<float>(samples);
        const auto sample =
            bsdf.sample(wo, lobe, {fraction(tracer::sobol_first(i)), fraction(tracer::sobol_second(i))});
        if (!sample) continue;
        CHECK((sample->wi.z < 0.0f) == sample->transmitted);
        (sample->transmitted ? sum.transmitted : sum.reflected) += static_cast<double>(sample->weight.x) / samples;
    }
    return sum;
}

// A frosted pane with tables of its own.
struct Frosted {
    tracer::LossTables tables;
    tracer::Bsdf bsdf;
    Frosted(float eta, float colour, float roughness)
        : tables(*tracer::ConductorSurface::losses_of({roughness, roughness}, 1.0f)),
          bsdf(tracer::RoughThinGlassBsdf(ThinPane(eta, glm::vec3(colour)), roughness, tables.at(roughness))) {}
    Frosted(const Frosted&) = delete;
    Frosted& operator=(const Frosted&) = delete;
};

glm::vec3 mirrored(const glm::vec3& w) {
    return {w.x, w.y, -w.z};
}

// The largest relative difference of f between a pair of directions and the same pair the other way round, and between
// reverse_pdf() and the pdf seen from the other side.
double worst_asymmetry(const tracer::Bsdf& bsdf, double skew = 1.0) {
    Uniform uniform(5);
    double worst = 0;
    for (int i = 0; i < 2000; ++i) {
        const float first = uniform();
        const glm::vec3 wo = tracer::square_to_cosine_hemisphere({first, uniform()});
        const float second = uniform();
        glm::vec3 wi = tracer::square_to_cosine_hemisphere({second, uniform()});
        if (!(wo.z > 0.02f) || !(wi.z > 0.02f)) continue;
        const bool is_transmitted = i % 2 == 0;
        if (is_transmitted) wi.z = -wi.z;
        const glm::vec3 from = is_transmitted ? mirrored(wi) : wi, to = is_transmitted ? mirrored(wo) : wo;
        const auto f = static_cast<double>(bsdf.evaluate(wo, wi).x / std::abs(wi.z)) * skew;
        const auto g = static_cast<double>(bsdf.evaluate(from, to).x / std::abs(to.z));
        worst = std::max({worst, std::abs(f / g - 1),
                          std::abs(static_cast<double>(bsdf.reverse_pdf(wo, wi) / bsdf.pdf(from, to)) - 1)});
    }
    return worst;
}

}  // namespace

TEST_CASE("thin pane: the closed form is the sum of all reflections inside, and errors of 1 % are seen") {
    CHECK(worst_share(1, 1) < 2e-6);
    CHECK(worst_share(1.01, 1) > 1e-3);
    CHECK(worst_share(1, 1.01) > 1e-3);
}

TEST_CASE("thin pane: light that cannot enter is reflected, and clear glass absorbs nothing") {
    const ThinPane bubble(0.75f, glm::vec3(0.5f));
    CHECK(bubble.at(0.1f).reflected == glm::vec3(1.0f));
    CHECK(bubble.at(0.1f).transmitted == glm::vec3(0.0f));
    for (int i = 0; i <= 1000; ++i) {
        const ThinPane::Shares shares = ThinPane(1.5f, glm::vec3(1.0f)).at(static_cast<float>(i) / 1000);
        CHECK(shares.reflected.x + shares.transmitted.x == doctest::Approx(1.0).epsilon(1e-6));
    }
    const ThinPane black(1.5f, glm::vec3(0.0f));
    CHECK(black.at(1.0f).reflected.x == doctest::Approx(0.04));
    CHECK(black.at(1.0f).transmitted == glm::vec3(0.0f));
    const ThinPane filter(1.0f, {0.2f, 0.5f, 1.0f});
    CHECK(filter.at(1.0f).transmitted.y == doctest::Approx(0.5));
    CHECK(filter.at(0.5f).transmitted.y == doctest::Approx(0.25));
    CHECK(filter.at(0.5f).reflected == glm::vec3(0.0f));
}

TEST_CASE("thin pane: the shares of uniform light are those of its directions") {
    for (const float a : {1.0f, 0.5f}) {
        const ThinPane pane(1.5f, glm::vec3(a));
        const ThinPane::Shares mean = pane.under_uniform_light();
        const auto integral = [&](bool of_reflection) {
            return 2 * integrate_cosines([&](double c) {
                       const ThinPane::Shares shares = pane.at(static_cast<float>(c));
                       return c * static_cast<double>((of_reflection ? shares.reflected : shares.transmitted).x);
                   });
        };
        CHECK(static_cast<double>(mean.reflected.x) == doctest::Approx(integral(true)).epsilon(1e-3));
        CHECK(static_cast<double>(mean.transmitted.x) == doctest::Approx(integral(false)).epsilon(1e-3));
    }
}

TEST_CASE("smooth thin glass: a mirror and a straight passage, with the shares of the pane") {
    const ThinPane pane(1.5f, {0.9f, 0.5f, 0.1f});
    const tracer::Bsdf bsdf{tracer::SmoothThinGlassBsdf(pane)};
    CHECK(bsdf.is_delta());
    CHECK_FALSE(bsdf.passes_through());
    CHECK(bsdf.pane() != nullptr);
    for (const double theta : {0.0, 50.0, 85.0}) {
        const glm::vec3 wo = direction(theta);
        const ThinPane::Shares shares = pane.at(wo.z);
        const auto reflected = bsdf.sample(wo, 0.0f, {}), transmitted = bsdf.sample(wo, 0.99999f, {});
        REQUIRE((reflected && transmitted));
        CHECK(reflected->wi == glm::vec3(-wo.x, -wo.y, wo.z));
        CHECK(transmitted->wi == -wo);
        CHECK((transmitted->delta && transmitted->transmitted && reflected->delta && !reflected->transmitted));
        CHECK(reflected->pdf + transmitted->pdf == doctest::Approx(1.0));
        for (int c = 0; c < 3; ++c) {
            CHECK(reflected->weight[c] * reflected->pdf == doctest::Approx(shares.reflected[c]));
            CHECK(transmitted->weight[c] * transmitted->pdf == doctest::Approx(shares.transmitted[c]));
        }
        const Sum sum = furnace(tracer::Bsdf(tracer::SmoothThinGlassBsdf(ThinPane(1.5f, glm::vec3(1.0f)))), wo);
        CHECK(sum.reflected + sum.transmitted == doctest::Approx(1.0).epsilon(1e-5));
    }
    CHECK_FALSE(bsdf.sample(direction(100.0), 0.5f, {}));
}

TEST_CASE("frosted thin glass: a white furnace at every roughness and angle, and an error of 1 % is seen") {
    for (const float roughness : {0.001f, 0.05f, 0.2f, 0.5f, 1.0f}) {
        const Frosted frosted(1.5f, 1.0f, roughness);
        for (const double theta : {0.0, 40.0, 70.0, 86.0}) {
            CAPTURE(roughness);
            CAPTURE(theta);
            const Sum sum = furnace(frosted.bsdf, direction(theta));
            CHECK(std::abs(sum.reflected + sum.transmitted - 1) < 0.001);
            CHECK(std::abs(1.01 * (sum.reflected + sum.transmitted) - 1) > 0.001);
        }
    }
}

TEST_CASE("frosted thin glass: barely rough, it has the shares of smooth glass") {
    const Frosted frosted(1.5f, 0.6f, 0.01f);
    const ThinPane pane(1.5f, glm::vec3(0.6f));
    for (const double theta : {0.0, 40.0, 60.0}) {
        const glm::vec3 wo = direction(theta);
        const Sum sum = furnace(frosted.bsdf, wo);
        CHECK(sum.reflected == doctest::Approx(pane.at(wo.z).reflected.x).epsilon(0.005));
        CHECK(sum.transmitted == doctest::Approx(pane.at(wo.z).transmitted.x).epsilon(0.005));
    }
}

TEST_CASE("frosted thin glass: directions follow the pdf, weights the function, and 1 % errors are seen") {
    const double significance = sidak(1e-4, 12);
    for (const float roughness : {0.3f, 0.8f}) {
        const Frosted frosted(1.5f, 0.7f, roughness);
        for (const double theta : {10.0, 65.0}) {
            CAPTURE(roughness);
            CAPTURE(theta);
            const BsdfReport report = examine(frosted.bsdf, direction(theta), 1);
            CHECK(report.directions > significance);
            CHECK(report.directions_skewed < significance);
            CHECK(report.directions_scaled < significance);
            CHECK(report.pdf_integral <= 1.0 + 1e-4);
            CHECK(report.weight > significance);
            CHECK(report.weight_scaled < significance);
            CHECK(worst_disagreement(frosted.bsdf, direction(theta), 2) < 1e-3);
        }
        CHECK(worst_asymmetry(frosted.bsdf) < 1e-3);
        CHECK(worst_asymmetry(frosted.bsdf, 1.01) > 9e-3);
    }
}

TEST_CASE("thin diffuse: directions follow the pdf, weights the function, and 1 % errors are seen") {
    const tracer::Bsdf bsdf{tracer::ThinDiffuseBsdf({0.5f, 0.4f, 0.1f}, {0.3f, 0.6f, 0.2f})};
    const double significance = sidak(1e-4, 6);
    for (const double theta : {0.0, 75.0}) {
        CAPTURE(theta);
        const BsdfReport report = examine(bsdf, direction(theta), 1);
        CHECK(report.directions > significance);
        CHECK(report.directions_skewed < significance);
        CHECK(report.directions_scaled < significance);
        CHECK(report.pdf_integral == doctest::Approx(1.0).epsilon(1e-5));
        CHECK(report.weight > significance);
        CHECK(report.weight_scaled < significance);
        CHECK(report.albedo == doctest::Approx(0.8).epsilon(1e-5));
        CHECK(worst_disagreement(bsdf, direction(theta), 2) < 1e-5);
        const Sum sum = furnace(bsdf, direction(theta));
        CHECK(sum.reflected == doctest::Approx(0.5).epsilon(1e-3));
        CHECK(sum.transmitted == doctest::Approx(0.3).epsilon(1e-3));
    }
    CHECK(worst_asymmetry(bsdf) < 1e-5);
    CHECK(worst_asymmetry(bsdf, 1.01) > 9e-3);
}

TEST_CASE("thin diffuse: never creates light, and may be black on one side or both") {
    const tracer::Bsdf bright{tracer::ThinDiffuseBsdf(glm::vec3(1.0f), glm::vec3(0.6f))};
    const Sum sum = furnace(bright, direction(30.0));
    CHECK(sum.reflected == doctest::Approx(1 / 1.6).epsilon(1e-3));
    CHECK(sum.transmitted == doctest::Approx(0.6 / 1.6).epsilon(1e-3));
    const glm::vec3 up = direction(20.0), down = direction(160.0);
    const tracer::Bsdf opaque{tracer::ThinDiffuseBsdf(glm::vec3(0.5f), glm::vec3(0.0f))};
    CHECK(opaque.pdf(up, down) == 0.0f);
    CHECK(opaque.evaluate(up, down) == glm::vec3(0.0f));
    const tracer::Bsdf dark{tracer::ThinDiffuseBsdf(glm::vec3(0.0f), glm::vec3(0.5f))};
    CHECK(dark.pdf(up, up) == 0.0f);
    CHECK_FALSE(dark.sample(up, 0.0f, {0.3f, 0.6f})->wi.z > 0.0f);
    const tracer::Bsdf black{tracer::ThinDiffuseBsdf(glm::vec3(0.0f), glm::vec3(0.0f))};
    CHECK(black.sample(up, 0.5f, {0.3f, 0.6f})->weight == glm::vec3(0.0f));
}

TEST_CASE("interface: a pane in water reflects less than in air, and a thicker one is darker") {
    const tracer::Material glass = tracer::ThinGlass{.ior = 1.5f}, water = tracer::Clear{1.33f, {}, 0.0f};
    tracer::SharedSurfaces shared;
    const auto share = [&](const tracer::Material& from, const tracer::Material& pane) {
        const tracer::Interface interface = tracer::Interface::between(from, pane, shared);
        CHECK(interface.is_thin());
        const auto shares = interface.at(glm::vec3(0.0f)).pane()->at(1.0f);
        return std::pair(static_cast<double>(shares.reflected.x), static_cast<double>(shares.transmitted.x));
    };
    CHECK(share(tracer::vacuum(), glass).first == doctest::Approx(followed(1, 1.5, 1).reflected).epsilon(1e-5));
    CHECK(share(water, glass).first == doctest::Approx(followed(1, 1.5 / 1.33, 1).reflected).epsilon(1e-5));
    const tracer::Material twice =
        tracer::ThinGlass{.ior = 1.5f, .color = tracer::ConstantTexture{glm::vec3(0.8f)}, .crossings = 2.0f};
    CHECK(share(tracer::vacuum(), twice).second == doctest::Approx(followed(1, 1.5, 0.64).transmitted).epsilon(1e-5));
}

TEST_CASE("interface: two sides have their own materials") {
    const tracer::Material red = tracer::Diffuse{tracer::ConstantTexture{{0.8f, 0.1f, 0.1f}}};
    const tracer::Material mirror = tracer::Conductor{glm::vec3(0.2f), glm::vec3(3.0f)};
    const tracer::Material both =
        tracer::TwoSided{std::make_shared<const tracer::Mixture>(tracer::Mixture{red, mirror})};
    tracer::SharedSurfaces shared;
    const tracer::Interface interface = tracer::Interface::between(tracer::vacuum(), both, shared);
    tracer::TexturePoint point(glm::vec3(0.0f));
    CHECK_FALSE(interface.at(point).is_metal());
    CHECK_FALSE(interface.is_thin());
    point.is_back = true;
    CHECK(interface.at(point).is_metal());
    CHECK(interface.chosen_at(point).at(glm::vec3(0.0f)).is_metal());
    CHECK(tracer::has_metal(both));
    CHECK(tracer::has_two_sides(both));
    CHECK_FALSE(tracer::is_thin(both));
}

}  // namespace test_thin
