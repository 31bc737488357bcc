#include <doctest/doctest.h>

#include <limits>

#include "bsdf_checks.hpp"

namespace test_dielectric_smooth {

using namespace phasetree;
using namespace phasetree::tests;
using tracer::SmoothDielectricBsdf;

TEST_CASE("smooth dielectric: the lobe is chosen with Fresnel's probability and the weights are exact") {
    const float from = 1.0f;
    const float to = 1.5f;
    const tracer::Bsdf bsdf(SmoothDielectricBsdf(from, to));
    for (const double theta : {0.0, 30.0, 56.3, 80.0, 89.9}) {
        CAPTURE(theta);
        const glm::vec3 wo = direction(theta);
        const auto reflected = bsdf.sample(wo, 0.0f, {});
        REQUIRE(reflected);
        const double reflectance = static_cast<double>(tracer::fresnel_dielectric(wo.z, to / from).reflectance);
        if (!reflected->transmitted) {
            CHECK(reflected->weight == glm::vec3{1.0f});
            CHECK(reflected->wi == glm::vec3{-wo.x, -wo.y, wo.z});
            CHECK(static_cast<double>(reflected->pdf) == doctest::Approx(reflectance));
        }
        const auto transmitted = bsdf.sample(wo, 0.9999999f, {});
        REQUIRE(transmitted);
        REQUIRE(transmitted->transmitted);
        CHECK(transmitted->weight == glm::vec3{tracer::radiance_factor(from, to)});
        // Snell's law: the tangential part scales by η_from/η_to; the direction keeps unit length.
        CHECK(transmitted->wi.x == doctest::Approx(-wo.x * from / to));
        CHECK(transmitted->wi.y == doctest::Approx(-wo.y * from / to));
        CHECK(glm::length(transmitted->wi) == doctest::Approx(1.0f).epsilon(1e-6));
        CHECK(transmitted->wi.z < 0.0f);
        CHECK(static_cast<double>(transmitted->pdf) == doctest::Approx(1.0 - reflectance));
    }
}

TEST_CASE("smooth dielectric: the frequency of reflection is F, and F off by 1 % is seen") {
    // At 80° F = 0.388; √(F(1−F)/N) = 4.9e-4 with a million samples, an eighth of 1 % of F.
    const tracer::Bsdf bsdf(SmoothDielectricBsdf(1.0f, 1.5f));
    const glm::vec3 wo = direction(80.0);
    const double reflectance = static_cast<double>(tracer::fresnel_dielectric(wo.z, 1.5f).reflectance);
    Uniform uniform(5);
    Moments reflections;
    for (int i = 0; i < 1000000; ++i) {
        const auto sample = bsdf.sample(wo, uniform(), {});
        reflections.add(sample->transmitted ? 0.0 : 1.0);
    }
    CHECK(mean_p_value(reflections, reflectance) > 1e-4);
    CHECK(mean_p_value(reflections, 1.01 * reflectance) < 1e-4);
    CHECK(mean_p_value(reflections, 0.99 * reflectance) < 1e-4);
}

TEST_CASE("smooth dielectric: total internal reflection always reflects") {
    const tracer::Bsdf bsdf(SmoothDielectricBsdf(1.5f, 1.0f));
    const auto sample = bsdf.sample(direction(42.0), 0.9999999f, {});  // the critical angle is 41.81°
    REQUIRE(sample);
    CHECK_FALSE(sample->transmitted);
    CHECK(sample->pdf == 1.0f);
    CHECK(sample->weight == glm::vec3{1.0f});
    CHECK(bsdf.sample(direction(41.6), 0.9999999f, {})->transmitted);
}

TEST_CASE("smooth dielectric: leaving undoes entering within an ulp") {
    Uniform uniform(7);
    for (int i = 0; i < 100000; ++i) {
        const float a = 1.0f + 2.0f * uniform();
        const float b = 1.0f + 2.0f * uniform();
        const float product = tracer::radiance_factor(a, b) * tracer::radiance_factor(b, a);
        CHECK(std::abs(product - 1.0f) <= std::numeric_limits<float>::epsilon());
        if (std::abs(product - 1.0f) > std::numeric_limits<float>::epsilon()) break;
    }
}

TEST_CASE("smooth dielectric: a path goes back the way it came") {
    const tracer::Bsdf in(SmoothDielectricBsdf(1.33f, 1.5f));
    const tracer::Bsdf out(SmoothDielectricBsdf(1.5f, 1.33f));
    const glm::vec3 wo = direction(60.0);
    const auto refracted = in.sample(wo, 0.9999999f, {});
    REQUIRE(refracted);
    const glm::vec3 w = refracted->wi;
    // The same surface from the other side, with z reversed.
    const auto back = out.sample({w.x, w.y, -w.z}, 0.9999999f, {});
    REQUIRE(back);
    CHECK(glm::length(back->wi - glm::vec3{wo.x, wo.y, -wo.z}) < 2e-7f);
    CHECK(back->pdf == doctest::Approx(refracted->pdf).epsilon(1e-6));
}

TEST_CASE("smooth dielectric: equal indices let the ray pass unchanged") {
    const tracer::Bsdf bsdf(SmoothDielectricBsdf(1.5f, 1.5f));
    CHECK(bsdf.passes_through());
    const glm::vec3 wo = direction(89.99);
    for (const float lobe : {0.0f, 0.5f, 0.9999999f}) {
        const auto sample = bsdf.sample(wo, lobe, {});
        REQUIRE(sample);
        CHECK(sample->wi == -wo);
        CHECK(sample->weight == glm::vec3{1.0f});
        CHECK(sample->transmitted);
    }
    CHECK_FALSE(tracer::Bsdf(SmoothDielectricBsdf(1.5f, 1.33f)).passes_through());
    CHECK(bsdf.is_delta());
}

}  // namespace test_dielectric_smooth
