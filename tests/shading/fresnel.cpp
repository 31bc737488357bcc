#include "shading/fresnel.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>

#include "media/medium.hpp"

namespace test_fresnel {

using phasetree::tracer::AbsorbingMedium;
using phasetree::tracer::fresnel_conductor;
using phasetree::tracer::fresnel_dielectric;
using phasetree::tracer::transmittance;

TEST_CASE("Fresnel: normal incidence is ((n − 1)/(n + 1))²") {
    for (const double n : {1.0, 1.1, 1.33, 1.5, 2.42, 1.0 / 1.5}) {
        const double expected = (n - 1.0) * (n - 1.0) / ((n + 1.0) * (n + 1.0));
        CHECK(std::abs(static_cast<double>(fresnel_dielectric(1.0f, static_cast<float>(n)).reflectance) - expected) <
              1e-7);
    }
}

TEST_CASE("Fresnel: at Brewster's angle only the perpendicular part is reflected") {
    // tan θ = n, where r∥ = 0 and r⊥ = (1 − n²)/(1 + n²).
    for (const double n : {1.33, 1.5, 2.0}) {
        const double cosine = 1.0 / std::sqrt(1.0 + n * n);
        const double perpendicular = (1.0 - n * n) / (1.0 + n * n);
        CHECK(std::abs(static_cast<double>(
                           fresnel_dielectric(static_cast<float>(cosine), static_cast<float>(n)).reflectance) -
                       0.5 * perpendicular * perpendicular) < 1e-6);
    }
}

TEST_CASE("Fresnel: total internal reflection begins at the critical angle") {
    const float eta = 1.0f / 1.5f;
    const double critical = std::sqrt(1.0 - 1.0 / (1.5 * 1.5));
    CHECK(fresnel_dielectric(static_cast<float>(critical - 1e-4), eta).reflectance == 1.0f);
    CHECK(fresnel_dielectric(static_cast<float>(critical + 1e-4), eta).reflectance < 1.0f);
    CHECK(fresnel_dielectric(0.0f, eta).reflectance == 1.0f);
    CHECK(fresnel_dielectric(0.0f, 1.5f).reflectance == 1.0f);
}

TEST_CASE("Fresnel: the same from both sides at the angles of Snell's law") {
    for (int i = 1; i <= 100; ++i) {
        const float cosine = static_cast<float>(i) / 100.0f;
        const auto in = fresnel_dielectric(cosine, 1.5f);
        const auto out = fresnel_dielectric(in.cos_transmitted, 1.0f / 1.5f);
        CHECK(out.reflectance == doctest::Approx(in.reflectance).epsilon(1e-4));
        CHECK(out.cos_transmitted == doctest::Approx(cosine).epsilon(1e-4));
    }
}

TEST_CASE("Fresnel: a conductor that does not absorb is a dielectric, also in total reflection") {
    for (const float eta : {1.33f, 1.5f, 2.5f, 1.0f / 1.5f}) {
        for (int i = 0; i <= 1000; ++i) {
            const float cosine = static_cast<float>(i) / 1000.0f;
            CAPTURE(eta);
            CAPTURE(cosine);
            const float difference = fresnel_conductor(cosine, eta, 0.0f) - fresnel_dielectric(cosine, eta).reflectance;
            // Near the critical angle both have infinite slope; elsewhere they agree up to rounding errors.
            CHECK(std::abs(difference) < 2e-3f);
            if (eta > 1.0f) CHECK(std::abs(difference) < 2e-6f);
        }
    }
}

TEST_CASE("Fresnel: conductor at normal incidence is ((η − 1)² + k²)/((η + 1)² + k²)") {
    const double eta = 0.2;
    const double k = 3.9;
    const double expected = ((eta - 1) * (eta - 1) + k * k) / ((eta + 1) * (eta + 1) + k * k);
    CHECK(std::abs(static_cast<double>(fresnel_conductor(1.0f, 0.2f, 3.9f)) - expected) < 1e-6);
    CHECK(fresnel_conductor(0.0f, 0.2f, 3.9f) == doctest::Approx(1.0f));
}

TEST_CASE("Beer-Lambert") {
    const glm::vec3 t = phasetree::tracer::beer_lambert({0.0f, 0.5f, 2.0f}, 3.0f);
    CHECK(t.x == 1.0f);
    CHECK(static_cast<double>(t.y) == doctest::Approx(std::exp(-1.5)));
    CHECK(static_cast<double>(t.z) == doctest::Approx(std::exp(-6.0)));
    const glm::vec3 far = phasetree::tracer::beer_lambert({0.0f, 0.5f, 0.0f}, INFINITY);
    CHECK(far == glm::vec3{1.0f, 0.0f, 1.0f});
}

TEST_CASE("conductors of any index: a reflectance between 0 and 1, and the right one") {
    const float most = std::numeric_limits<float>::max();
    for (const float eta : {1e-38f, 1e-10f, 0.1f, 1.0f, 7.0f, 1e5f, 1e10f, 1e20f, most})
        for (const float k : {0.0f, 1e-38f, 1e-10f, 1.0f, 5.0f, 1e5f, 1e10f, 1e20f, most})
            for (const float c : {0.0f, 1e-30f, 1e-4f, 0.3f, 0.9f, 1.0f}) {
                CAPTURE(eta);
                CAPTURE(k);
                CAPTURE(c);
                const float r = fresnel_conductor(c, eta, k);
                CHECK(r >= 0.0f);
                CHECK(r <= 1.0f);
                if (c < 1.0f) continue;
                // At normal incidence ((η − 1)² + k²)/((η + 1)² + k²).
                const long double n = eta, x = k;
                const long double expected = ((n - 1) * (n - 1) + x * x) / ((n + 1) * (n + 1) + x * x);
                CHECK(static_cast<double>(r) == doctest::Approx(static_cast<double>(expected)).epsilon(1e-6));
            }
}

}  // namespace test_fresnel
