// Plane layers of absorbing glass against closed forms with all their internal reflections.
//
// In light of radiance 1 from everywhere, the radiance of a stack is R + T. An estimate of N paths has the standard
// error σ/√N. The value of a path is 1 if it is reflected, which has probability F, and otherwise about a = e^(−σd): σ
// ≈ (1 − a) √(F (1−F)), which is 0.06 … 0.4 here, and with N = 1.2·10⁵ the error is 0.0002 … 0.001, of radiances of 0.2
// … 0.8. The tolerance of 0.5 % is the promised one. The z-test beside it detects smaller errors, such as 1 % more
// absorption, which is 0.2 … 1.6 % of the radiance.
#include <doctest/doctest.h>

#include <vector>

#include "tracer/support/closed_form.hpp"
#include "tracer/support/paths.hpp"

namespace test_slab {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;
using phasetree::tests::cosine_within;
using phasetree::tests::fresnel;
using phasetree::tests::integrate_cosines;
using phasetree::tests::Layer;
using phasetree::tests::Response;
using phasetree::tests::slab;
using phasetree::tests::stack;

namespace {

constexpr std::array<double, 3> absorption{0.4, 1.0, 2.0};  // of the three channels
constexpr double degree = 3.14159265358979324 / 180;

std::string glass(double ior, double scale = 1) {
    const auto a = [&](std::size_t c) { return std::to_string(absorption[c] * scale); };
    return R"({"clear": {"ior": )" + std::to_string(ior) + R"(, "absorption": [)" + a(0) + ", " + a(1) + ", " + a(2) +
           "]}}";
}

// Wide enough that no path with significant weight leaves through the sides: a passage moves it by less than the
// thickness, and the edge is fifteen times as far.
std::string plate(const std::string& phase, double z0, double z1) {
    return R"({"set": {"phase": ")" + phase + R"(", "of": {"translate": {"by": [0, 0, )" +
           std::to_string((z0 + z1) / 2) + R"(], "of": {"box": {"size": [30, 30, )" + std::to_string(z1 - z0) +
           "]}}}}}}";
}

// A ray from above that meets (0, 0, top) at this angle. It is slightly rotated, so that it is parallel to no axis.
std::array<Moments, 3> seen(const Scene& scene, double angle, double top, std::uint32_t count) {
    const World world(scene);
    const double s = std::sin(angle * degree), c = std::cos(angle * degree);
    const glm::vec3 direction(s * 0.96, s * 0.28, -c);
    const glm::vec3 origin = glm::vec3(0.1f, 0.2f, static_cast<float>(top)) - 2.0f * direction;
    return radiance_along(world, scene, origin, direction, count);
}

}  // namespace

TEST_CASE("the closed forms agree with each other") {
    for (const double angle : {0.0, 30.0, 60.0, 85.0}) {
        const double c = std::cos(angle * degree);
        const Layer whole{1.5, 0.7, 0.8};
        const Layer halves[] = {{1.5, 0.7, 0.3}, {1.5, 0.7, 0.5}};
        CHECK(stack(c, {&whole, 1}).reflected == doctest::Approx(slab(c, whole).reflected).epsilon(1e-12));
        CHECK(stack(c, {&whole, 1}).transmitted == doctest::Approx(slab(c, whole).transmitted).epsilon(1e-12));
        CHECK(stack(c, halves).reflected == doctest::Approx(slab(c, whole).reflected).epsilon(1e-12));
        const Layer clear[] = {{1.5, 0, 1}, {1.33, 0, 1}};
        CHECK(stack(c, clear).reflected + stack(c, clear).transmitted == doctest::Approx(1).epsilon(1e-12));
    }
}

TEST_CASE("slab of absorbing glass: Fresnel and Beer-Lambert, all internal reflections") {
    constexpr double angles[] = {0, 40, 75};
    constexpr double d = 0.8;
    const double significance = sidak(1e-4, 3 * std::size(angles));
    const auto scene = [&](double scale) { return scene_of(R"("glass": )" + glass(1.5, scale), plate("glass", 0, d)); };
    for (const double angle : angles) {
        const auto right = seen(scene(1), angle, d, 120000);
        const auto wrong = seen(scene(1.01), angle, d, 120000);
        for (std::size_t c = 0; c < 3; ++c) {
            CAPTURE(angle);
            CAPTURE(c);
            const Response r = slab(std::cos(angle * degree), {1.5, absorption[c], d});
            const double expected = r.reflected + r.transmitted;
            CHECK(std::abs(right[c].mean() / expected - 1) < 0.005);
            CHECK(mean_p_value(right[c], expected, 1e-5) > significance);
            // At 75°, a quarter of all paths is reflected at once, which is noise to the effect of absorption.
            if (angle < 70) CHECK(mean_p_value(wrong[c], expected, 1e-5) < significance);
        }
    }
}

TEST_CASE("slab that lets nothing through: F itself, and 1 % of it is seen") {
    // A choice of probability F has the variance F (1−F): a defect of 1 % is six standard errors with
    // N = 3.6·10⁵ (1−F)/F paths, 2.3·10⁵ at 85° where F = 0.61.
    const std::string black = R"("glass": {"clear": {"ior": 1.5, "absorption": [60, 60, 60]}})";
    const Scene scene = scene_of(black, plate("glass", 0, 1));
    const Moments m = seen(scene, 85, 1, 230000)[0];
    const double f = fresnel(std::cos(85 * degree), 1, 1.5);
    CHECK(std::abs(m.mean() / f - 1) < 0.005);
    CHECK(mean_p_value(m, f, 1e-5) > 1e-4);
    CHECK(mean_p_value(m, 1.01 * f, 1e-5) < 1e-4);
    CHECK(mean_p_value(m, 0.99 * f, 1e-5) < 1e-4);
}

// Over a black floor, only reflected light is visible, so an air gap would be detected at once. In light from
// everywhere, the light that a gap reflects replaces the light that it transmits.
TEST_CASE("two touching layers: no air gap between glass and glass, glass and water") {
    struct Case {
        double first, second;
    };
    constexpr Case cases[] = {{1.5, 1.9}, {1.5, 1.33}, {1.5, 1.5}};
    constexpr double angles[] = {20, 70};
    const double significance = sidak(1e-4, 6 * std::size(cases) * std::size(angles));
    const std::string black =
        R"("meshes": [{"floor": {"height": -2, "material": {"diffuse": {"color": [0, 0, 0]}}}}], )";
    for (const Case& c : cases) {
        CAPTURE(c.first);
        CAPTURE(c.second);
        const auto scene = [&](const std::string& rest) {
            return scene_of(R"("upper": )" + glass(c.first) + R"(, "lower": )" + glass(c.second, 0.5),
                            R"({"under": [)" + plate("upper", -0.2, 0.3) + ", " + plate("lower", -0.6, 0) + "]}", rest);
        };
        for (const double angle : angles) {
            CAPTURE(angle);
            const auto both = seen(scene(white_environment), angle, 0.3, 40000);
            const auto reflected = seen(scene(black + white_environment), angle, 0.3, 40000);
            const double cosine = std::cos(angle * degree);
            for (std::size_t channel = 0; channel < 3; ++channel) {
                CAPTURE(channel);
                const Layer upper{c.first, absorption[channel], 0.3}, lower{c.second, absorption[channel] / 2, 0.6};
                const Layer layers[] = {upper, lower};
                const Response r = stack(cosine, layers);
                CHECK(mean_p_value(both[channel], r.reflected + r.transmitted, 1e-5) > significance);
                CHECK(mean_p_value(reflected[channel], r.reflected, 1e-5) > significance);
                const Layer gap[] = {upper, {1, 0, 1e-3}, lower};
                CHECK(mean_p_value(reflected[channel], stack(cosine, gap).reflected) < significance);
            }
        }
    }
}

}  // namespace test_slab
