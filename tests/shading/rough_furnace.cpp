// Rough surfaces in a white furnace return all the light that they receive, whatever their roughness, index and the
// angle. They return it to the same sides and in the same colours as a random walk on the microsurface.
#include <doctest/doctest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "bsdf_checks.hpp"
#include "microsurface.hpp"
#include "sampling/sobol.hpp"
#include "shading/fresnel.hpp"
#include "shading/metals.hpp"
#include "shading/roughness.hpp"
#include "support/long_tests.hpp"

namespace test_rough_furnace {

using namespace phasetree;
using namespace phasetree::tests;
using tracer::CoatedDiffuseBsdf;
using tracer::CoatingAlbedo;
using tracer::ConductorSurface;
using tracer::DielectricSurface;
using tracer::RoughConductorBsdf;
using tracer::RoughDielectricBsdf;
using tracer::ValueRange;

namespace {

constexpr float roughnesses[] = {0.001f, 0.05f, 0.2f, 0.5f, 1.0f};
constexpr double angles[] = {0.0, 40.0, 70.0, 80.0, 86.0, 89.0, 89.9};
constexpr double tolerance = 0.001;
// Where the lost light is interpolated between roughnesses or azimuths. The largest error is at 89.9° and small
// roughness.
constexpr double tolerance_between = 0.002;

// The mean weight in a furnace of radiance 1, where a medium of index η has radiance η². `square` is η² of the other
// side over that of this side.
glm::dvec3 furnace(const tracer::Bsdf& bsdf, const glm::vec3& wo, double square = 1.0) {
    // Equal steps in the first dimension and two of Sobol's dimensions form a net, whose error is far below that of
    // random points. With an eighth of the points, the error would be as large as the tolerance. The short form takes
    // half of them.
    const std::uint32_t samples = 1u << (long_tests() ? 17 : 16);
    const auto fraction = [](std::uint32_t bits) { return static_cast<float>(bits >> 8) * 0x1p-24f + 0x1p-25f; };
    glm::dvec3 sum(0.0);
    for (std::uint32_t i = 0; i < samples; ++i) {
        const float lobe = (static_cast<float>(i) + 0.5f) / static_cast<float>(samples);
        const auto sample =
            bsdf.sample(wo, lobe, {fraction(tracer::sobol_first(i)), fraction(tracer::sobol_second(i))});
        if (sample) sum += glm::dvec3(sample->weight) * (sample->transmitted ? square : 1.0);
    }
    return sum / static_cast<double>(samples);
}

// The largest difference from 1 over all angles. If `scale` is not 1, it is a planted defect. φ is the angle to the
// grain.
double worst(const tracer::Bsdf& bsdf, double square = 1.0, double scale = 1.0, double phi = 30.0) {
    double most = 0.0;
    for (const double theta : angles) {
        const double off = std::abs(scale * furnace(bsdf, direction(theta, phi), square).x - 1.0);
        if (scale == 1.0 && !(off <= tolerance_between)) MESSAGE(theta << "°: off by " << off);
        most = std::max(most, off);
    }
    return most;
}

const glm::vec3 all_reflecting{1e6f};

}  // namespace

TEST_CASE("rough furnace: a metal that absorbs nothing is white at every roughness and angle") {
    for (const float roughness : roughnesses) {
        CAPTURE(roughness);
        const ConductorSurface surface(1.0f, glm::vec3(1.0f), all_reflecting, ValueRange{roughness, roughness});
        CHECK(worst(RoughConductorBsdf(surface, roughness)) < tolerance);
    }
}

TEST_CASE("rough furnace: brushed metal that absorbs nothing is white from along its grain, across, and between") {
    const std::vector<double> azimuths =
        long_tests() ? std::vector<double>{0, 3, 25, 63, 90} : std::vector<double>{0, 25, 90};
    for (const float aspect : {0.1f, 0.2f, 0.6f}) {
        if (aspect == 0.2f && !long_tests()) continue;
        for (const float roughness : {0.004f, 0.02f, 0.2f, 1.0f}) {
            CAPTURE(aspect);
            CAPTURE(roughness);
            const ConductorSurface surface(1.0f, glm::vec3(1.0f), all_reflecting, ValueRange{roughness, roughness}, {},
                                           {}, aspect);
            for (const double phi : azimuths) {
                CAPTURE(phi);
                CHECK(worst(RoughConductorBsdf(surface, roughness), 1.0, 1.0, phi) < tolerance_between);
            }
        }
    }
}

TEST_CASE("rough furnace: glass is white from both sides, at every roughness, angle and index") {
    for (const float eta : {1.128f, 1.5f, 2.4f}) {
        for (const float roughness : roughnesses) {
            CAPTURE(eta);
            CAPTURE(roughness);
            const DielectricSurface from_air(1.0f, eta, ValueRange{roughness, roughness});
            const DielectricSurface from_glass = from_air.reversed();
            const double square = static_cast<double>(eta) * static_cast<double>(eta);
            CHECK(worst(RoughDielectricBsdf(from_air, roughness), square) < tolerance);
            CHECK(worst(RoughDielectricBsdf(from_glass, roughness), 1.0 / square) < tolerance);
        }
    }
}

TEST_CASE("rough furnace: surfaces whose roughness varies are as white between the tables") {
    const ValueRange range{tracer::least_roughness, 1.0f};  // the range that interfaces use
    const ConductorSurface metal(1.0f, glm::vec3(1.0f), all_reflecting, range);
    const DielectricSurface glass(1.0f, 1.5f, range);
    const CoatingAlbedo coating(DielectricSurface(1.0f, 1.5f), range, {});
    for (const float roughness : {0.0013f, 0.004f, 0.0091f, 0.0205f, 0.09f, 0.28f, 0.53f, 0.97f}) {
        CAPTURE(roughness);
        CHECK(worst(RoughConductorBsdf(metal, roughness)) < tolerance_between);
        CHECK(worst(RoughDielectricBsdf(glass, roughness), 2.25) < tolerance_between);
        CHECK(worst(CoatedDiffuseBsdf(coating.at(roughness), glm::vec3(1.0f))) < tolerance_between);
    }
}

TEST_CASE("rough furnace: a white varnish is white at every roughness, angle and index") {
    for (const float eta : {0.75f, 1.5f}) {
        for (const float roughness : roughnesses) {
            CAPTURE(eta);
            CAPTURE(roughness);
            const CoatingAlbedo coating(eta, roughness);
            CHECK(worst(CoatedDiffuseBsdf(coating.at(roughness), glm::vec3(1.0f))) < tolerance);
        }
    }
}

TEST_CASE("rough furnace: an error of 1 % is seen") {
    const ConductorSurface metal(1.0f, glm::vec3(1.0f), all_reflecting, ValueRange{0.5f, 0.5f});
    CHECK(worst(RoughConductorBsdf(metal, 0.5f), 1.0, 1.01) > tolerance);
    CHECK(worst(RoughConductorBsdf(metal, 0.5f), 1.0, 0.99) > tolerance);
}

TEST_CASE("rough furnace: copper and gold are as deep in colour as a walk on the microsurface makes them") {
    struct Case {
        const char* name;
        float roughness;
        float aspect = 1.0f;  // of brushed metal
    };
    for (const Case& c :
         {Case{"gold", 0.3f}, Case{"gold", 0.6f}, Case{"gold", 1.0f}, Case{"copper", 0.3f}, Case{"copper", 0.6f},
          Case{"copper", 1.0f}, Case{"gold", 0.6f, 0.3f}, Case{"gold", 1.0f, 0.15f}}) {
        const tracer::Metal metal = *tracer::find_metal(c.name);
        CAPTURE(std::string(c.name));
        CAPTURE(c.roughness);
        CAPTURE(c.aspect);
        const ConductorSurface surface(1.0f, metal.eta, metal.k, ValueRange{c.roughness, c.roughness}, {}, {},
                                       c.aspect);
        const RoughConductorBsdf bsdf(surface, c.roughness);
        const auto fresnel = [&](float cosine) { return tracer::fresnel_conductor(cosine, metal.eta, metal.k); };
        const Microsurface microsurface(c.aspect * c.roughness, c.roughness);
        const auto walked = [&](const glm::vec3& wo, int walks) {
            Uniform uniform(5);
            glm::dvec3 sum(0.0);
            for (int i = 0; i < walks; ++i) {
                const auto left = microsurface.reflect(wo, fresnel, uniform);
                if (left) sum += glm::dvec3(left->weight);
            }
            return sum / static_cast<double>(walks);
        };
        // Under uniform light: at the middles of equal parts of μ², each with its own azimuth.
        glm::dvec3 expected(0.0), ours(0.0);
        constexpr int parts = 16;
        for (int i = 0; i < parts; ++i) {
            const float z2 = (static_cast<float>(i) + 0.5f) / parts;
            const float phi = 2.0f * std::numbers::pi_v<float> * std::numbers::phi_v<float> * static_cast<float>(i);
            const float sine = std::sqrt(1.0f - z2);
            const glm::vec3 wo(sine * std::cos(phi), sine * std::sin(phi), std::sqrt(z2));
            expected += walked(wo, 4000) / static_cast<double>(parts);
            ours += furnace(bsdf, wo) / static_cast<double>(parts);
        }
        for (int k = 0; k < 3; ++k) {
            const double ratio = ours[k] / expected[k];
            CHECK(std::abs(ratio - 1.0) < 0.015);
            CHECK_FALSE(std::abs(1.03 * ratio - 1.0) < 0.015);
        }
        // For single directions, the result depends on the model: at grazing angles, more of the light escapes early.
        for (const double theta : {0.0, 50.0, 75.0}) {
            CAPTURE(theta);
            expected = walked(direction(theta), 30000);
            ours = furnace(bsdf, direction(theta));
            for (int k = 0; k < 3; ++k) CHECK(std::abs(ours[k] - expected[k]) < 0.02);
        }
    }
}

TEST_CASE("rough furnace: from outside, glass lets through about as much as a walk on the microsurface does") {
    for (const float eta : {1.128f, 1.5f}) {
        for (const float roughness : {0.3f, 1.0f}) {
            const DielectricSurface surface(1.0f, eta, ValueRange{roughness, roughness});
            const RoughDielectricBsdf bsdf(surface, roughness);
            const Microsurface microsurface(roughness);
            for (const double theta : {0.0, 50.0, 75.0}) {
                Uniform uniform(6);
                constexpr int walks = 20000;
                int through = 0, ours = 0;
                for (int i = 0; i < walks; ++i) {
                    const auto left = microsurface.scatter(direction(theta), eta, uniform);
                    through += left && left->transmitted;
                    const float lobe = uniform(), first = uniform();
                    const auto sample = bsdf.sample(direction(theta), lobe, {first, uniform()});
                    ours += sample && sample->transmitted;
                }
                CAPTURE(eta);
                CAPTURE(roughness);
                CAPTURE(theta);
                // How light that is scattered again is divided between the two sides depends on the model.
                CHECK(std::abs(through - ours) < 0.08 * walks);
            }
        }
    }
}

}  // namespace test_rough_furnace
