// Rough surfaces in a white furnace give back all that they get, whatever their roughness, their index and the angle;
// and they give it back to the side, and in the colour, that a random walk on the microsurface does.
#include <doctest/doctest.h>

#include "bsdf_checks.hpp"
#include "microsurface.hpp"
#include "shading/fresnel.hpp"
#include "shading/metals.hpp"

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
constexpr double tolerance = 0.005;

// The mean weight in a furnace of radiance 1, of which a medium of index η has η²: `square` is that of the other side's
// over this side's.
glm::dvec3 furnace(const tracer::Bsdf& bsdf, double theta, double square = 1.0) {
    constexpr int samples = 1 << 15;
    const glm::vec3 wo = direction(theta);
    glm::dvec3 sum(0.0);
    for (int i = 0; i < samples; ++i) {
        // The additive sequence of three dimensions: multiples of powers of the root of g⁴ = g + 1.
        constexpr double g = 1.2207440846057596;
        const auto fraction = [&](double step) {
            const double turns = 0.5 + (i + 1) * step;
            return std::min(static_cast<float>(turns - std::floor(turns)), 0x1.fffffep-1f);
        };
        const auto sample = bsdf.sample(wo, fraction(1 / g), {fraction(1 / (g * g)), fraction(1 / (g * g * g))});
        if (sample) sum += glm::dvec3(sample->weight) * (sample->transmitted ? square : 1.0);
    }
    return sum / static_cast<double>(samples);
}

// The farthest from 1 over all angles, `scale` other than 1 being a planted defect.
double worst(const tracer::Bsdf& bsdf, double square = 1.0, double scale = 1.0) {
    double most = 0.0;
    for (const double theta : angles) {
        const double off = std::abs(scale * furnace(bsdf, theta, square).x - 1.0);
        if (!(off <= tolerance)) MESSAGE(theta << "°: off by " << off);
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
    const ValueRange range{0.0f, 1.0f};
    const ConductorSurface metal(1.0f, glm::vec3(1.0f), all_reflecting, range);
    const DielectricSurface glass(1.0f, 1.5f, range);
    const CoatingAlbedo coating(DielectricSurface(1.0f, 1.5f), range, {});
    for (const float roughness : {0.02f, 0.09f, 0.28f, 0.53f, 0.97f}) {
        CAPTURE(roughness);
        CHECK(worst(RoughConductorBsdf(metal, roughness)) < tolerance);
        CHECK(worst(RoughDielectricBsdf(glass, roughness), 2.25) < tolerance);
        CHECK(worst(CoatedDiffuseBsdf(coating.at(roughness), glm::vec3(1.0f))) < tolerance);
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
    for (const char* name : {"gold", "copper"}) {
        const tracer::Metal metal = *tracer::find_metal(name);
        for (const float roughness : {0.3f, 0.6f, 1.0f}) {
            const ConductorSurface surface(1.0f, metal.eta, metal.k, ValueRange{roughness, roughness});
            const RoughConductorBsdf bsdf(surface, roughness);
            const Microsurface microsurface(roughness);
            for (const double theta : {0.0, 50.0, 75.0}) {
                Uniform uniform(5);
                glm::dvec3 sum(0.0);
                constexpr int walks = 40000;
                for (int i = 0; i < walks; ++i) {
                    const auto left = microsurface.reflect(
                        direction(theta), [&](float c) { return tracer::fresnel_conductor(c, metal.eta, metal.k); },
                        uniform);
                    if (left) sum += glm::dvec3(left->weight);
                }
                const glm::dvec3 expected = sum / static_cast<double>(walks);
                const glm::dvec3 ours = furnace(bsdf, theta);
                CAPTURE(name);
                CAPTURE(roughness);
                CAPTURE(theta);
                for (int c = 0; c < 3; ++c) CHECK(ours[c] == doctest::Approx(expected[c]).epsilon(0.02));
            }
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
                // How the part that is scattered again is shared among the two sides is a model's.
                CHECK(std::abs(through - ours) < 0.08 * walks);
            }
        }
    }
}
