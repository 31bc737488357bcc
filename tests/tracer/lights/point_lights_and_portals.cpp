// Lights without an extent, and portals, as paths find them: closed forms for a point light on a floor and in a medium,
// and the same picture with less noise through a portal.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "tracer/support/paths.hpp"

namespace test_light_points {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

const std::string floor_mesh = R"("meshes": [{"floor": {"material": {"diffuse": {"color": [0.6, 0.6, 0.6]}}}}], )";
const std::string black = R"("black": {"diffuse": {"color": [0, 0, 0]}})";
const std::string black_ball_aside =
    R"({"set": {"phase": "black", "of": {"translate": {"by": [50, 0, 1], "of": {"sphere": {"radius": 0.1}}}}}})";

double radiance_of_floor(const std::string& lights) {
    const Scene scene = scene_of(black, black_ball_aside, floor_mesh + lights);
    return radiance_along(World(scene), scene, {-2, -1.5f, 0.1f}, {2, 1.5f, -0.1f}, 4000)[0].mean();
}

}  // namespace

TEST_CASE("a floor below a point and a spot: I cos θ/d², whichever was chosen") {
    // The floor has the albedo 0.6, and only the lights illuminate it.
    const double cosine = 2 / std::sqrt(5.0);
    const double expected = 0.6 / std::numbers::pi * 10 * cosine / 5;
    const std::string point = R"({"point": {"position": [1, 0, 2], "intensity": 10}})";
    CHECK(radiance_of_floor("\"lights\": [" + point + "]") == doctest::Approx(expected).epsilon(1e-5));
    const auto with_spot = [&](const std::string& target) {
        return radiance_of_floor("\"lights\": [" + point + R"(, {"spot": {"position": [0, 0, 2], "intensity": 5,
                                 "target": )" +
                                 target + R"(, "cone": 40, "edge": 4}}])");
    };
    // Each of the two lights is chosen in proportion to its light on the floor, so the estimate has no noise except
    // rounding errors.
    CHECK(with_spot("[0, 0, 0]") == doctest::Approx(expected + 0.6 / std::numbers::pi * 5 / 4).epsilon(1e-5));
    // 25° off its axis it is dark: it ends at 20°.
    CHECK(with_spot("[0.93, 0, 0]") == doctest::Approx(expected).epsilon(1e-5));
    // 14° off its axis it is as bright as on it: the edge begins at 20° − 4°.
    CHECK(with_spot("[0.5, 0, 0]") == doctest::Approx(expected + 0.6 / std::numbers::pi * 5 / 4).epsilon(1e-5));
}

TEST_CASE("what is before a point shades the floor, what is behind it does not, and what bends nothing does neither") {
    // Rays leave the floor 10⁻⁵ of the object's diagonal, 17 m, above it.
    const double lit = 0.6 / std::numbers::pi * 10 / std::pow(2 - 1.7e-4, 2);
    const auto radiance_below = [](const std::string& material, double height) {
        const Scene scene = scene_of("\"plate\": " + material,
                                     R"({"set": {"phase": "plate", "of": {"translate": {"by": [0, 0, )" +
                                         std::to_string(height) + R"(], "of": {"box": {"size": [12, 12, 0.02]}}}}}})",
                                     floor_mesh + R"("lights": [{"point": {"position": [0, 0, 2], "intensity": 10}}])");
        return radiance_along(World(scene), scene, {-2, -1.5f, 0.1f}, {2, 1.5f, -0.1f}, 200)[0].mean();
    };
    const std::string wall = R"({"diffuse": {"color": [0, 0, 0]}})", air = R"({"clear": {"ior": 1}})";
    for (const double height : {0.3, 1.0, 1.9}) CHECK(radiance_below(wall, height) == 0);
    for (const double height : {2.1, 3.0}) CHECK(radiance_below(wall, height) == doctest::Approx(lit).epsilon(1e-5));
    for (const double height : {0.3, 1.0, 1.9, 2.1})
        CHECK(radiance_below(air, height) == doctest::Approx(lit).epsilon(1e-5));
}

TEST_CASE("a point in fog: light that is scattered once") {
    // The fog's albedo is so low that light which is scattered twice is only a thousandth.
    constexpr double scattering = 0.001, extinction = 0.8, intensity = 10;
    const Scene scene = scene_of(
        R"("fog": {"clear": {"ior": 1, "absorption": [0.799, 0.799, 0.799], "scattering": [0.001, 0.001, 0.001]}})",
        R"({"set": {"phase": "fog", "of": {"sphere": {"radius": 20}}}})",
        R"("lights": [{"point": {"position": [1, 1, 0], "intensity": 10}}])");
    // Along x, past the lamp at the distance 1.
    const Moments m = radiance_along(World(scene), scene, {-1, 0, 0}, {1, 0, 0}, 400000)[0];
    double expected = 0;
    constexpr int steps = 20000;
    for (int i = 0; i < steps; ++i) {
        const double t = (i + 0.5) * 18 / steps, d = std::hypot(t - 2, 1);
        expected +=
            std::exp(-extinction * (t + d)) * intensity / (d * d) * scattering / (4 * std::numbers::pi) * 18 / steps;
    }
    CAPTURE(m.mean() / expected);
    CHECK(mean_p_value(m, expected, 2e-3 * expected) > 1e-4);
    CHECK(mean_p_value(m, 1.02 * expected, 2e-3 * expected) < 1e-4);
}

TEST_CASE("a portal at a window: the mean stays, and the variance falls") {
    const auto in_a_room = [](const std::string& portal, std::uint32_t seed) {
        // A room of 4 × 4 × 3 m, whose only window is 1 m wide.
        const Scene scene = scene_of(
            R"("plaster": {"diffuse": {"color": [0.3, 0.3, 0.3]}})",
            R"({"set": {"phase": "plaster", "of": {"difference": {"from": {"box": {"size": [4.4, 4.4, 3.4]}}, "subtract": [
                {"box": {"size": [4, 4, 3]}}, {"translate": {"by": [2.1, 0, 0.3], "of": {"box": {"size": [1, 1, 1]}}}}]}}}})",
            R"("lights": [{"gradient": {"zenith": [1, 1, 1], "horizon": [2, 2, 2], "ground": [0.5, 0.5, 0.5]}})" +
                portal + "]");
        return radiance_along(World(scene), scene, {-1, 0, 0}, {0.3f, 0.4f, -1}, 60000, seed)[0];
    };
    const std::string portal =
        R"(, {"portal": {"centre": [2, 0, 0.3], "target": [0, 0, 0.3], "width": 1, "height": 1}})";
    const Moments without = in_a_room("", 1), with = in_a_room(portal, 2);
    const double error = std::hypot(without.standard_error(), with.standard_error());
    const auto p_value = [&](double factor) {
        return phasetree::tests::normal_two_sided((factor * with.mean() - without.mean()) / error);
    };
    CAPTURE(with.mean() / without.mean());
    CAPTURE(error / with.mean());
    CHECK(p_value(1.0) > 1e-4);
    CHECK(p_value(1.1) < 1e-4);
    const double ratio = std::pow(with.standard_error() / without.standard_error(), 2);
    CAPTURE(ratio);
    CHECK(ratio < 0.5);
}

}  // namespace test_light_points
