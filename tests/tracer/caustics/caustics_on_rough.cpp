// Rough interfaces at which photons are gathered, because no earlier point of a path gathers them. Pictures are
// compared with paths alone.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tracer/caustics/photons.hpp"
#include "tracer/caustics/rough_scenes.hpp"

namespace test_caustics_on_rough {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

// Runs check_against_paths(), and checks that gathered photons contribute at least 3 % of the light.
void check(const Scene& scene, const glm::vec3& origin, const glm::vec3& direction, int times, double significance) {
    check_against_paths(scene, origin, direction, times * passes, significance);
    const Moments all = with_photons(scene, origin, direction, 4 * passes);
    const Moments others = with_photons(scene, origin, direction, 4 * passes, false);
    CAPTURE(others.mean() / all.mean());
    CHECK(others.mean() < 0.97 * all.mean());
}

}  // namespace

TEST_CASE("light that falls through smooth glass onto rough glass is as bright as by paths alone") {
    const double significance = sidak(1e-4, 2);
    const Scene scene = scene_of(
        clear("glass", 1.4, 0) + ", " + clear("pane", 1.5, 0.3),
        R"({"over": [)" +
            in_phase("pane", R"({"translate": {"by": [0, 0, -0.2], "of": {"box": {"size": [4, 4, 0.4]}}}})") + ", " +
            in_phase("glass", R"({"translate": {"by": [0, 0, 1.1], "of": {"sphere": {"radius": 1}}}})") + "]}",
        lit_by(sun, 0.1));
    SUBCASE("from above") {
        check(scene, {-1.9f, -1.9f, 0.1f}, {1.9f, 1.9f, -0.1f}, 6, significance);
    }
    // The rough ball below transmits light, too.
    if (long_form) {
        SUBCASE("from below") {
            check(scene, {-1, -1, -2}, {1, 1, 1.8f}, 10, significance);
        }
    }
}

TEST_CASE("a rough ball within a smooth one, and a rough ball alone: as bright as by paths alone") {
    const double significance = sidak(1e-4, 2);
    const std::string ball = R"({"translate": {"by": [0, 0, 1.1], "of": {"sphere": {"radius": 1}}}})";
    // Absorption dims light that is reflected often inside. Such light is rare and bright, and would need many more
    // photons.
    const std::string absorbing = R"(, "absorption": [1, 1, 1])";
    const glm::vec3 origin(-3, -3, 0.8f), direction(1, 1, 0.1f);
    SUBCASE("within a smooth one") {
        const std::string core =
            in_phase("core", R"({"translate": {"by": [0.1, 0, 1.1], "of": {"sphere": {"radius": 0.6}}}})");
        check(scene_of(clear("shell", 1.3, 0, absorbing) + ", " + clear("core", 1.6, 0.8, absorbing),
                       R"({"over": [)" + core + ", " + in_phase("shell", ball) + "]}", lit_by(sun, 0.1)),
              origin, direction, 26, significance);
    }
    if (long_form) {
        SUBCASE("alone") {
            check(scene_of(clear("glass", 1.5, 0.4, absorbing), in_phase("glass", ball), lit_by(sun, 0.1)), origin,
                  direction, 10, significance);
        }
    }
}

TEST_CASE("light that falls onto rough glass past smooth glass does not count as found by photons") {
    // The pane is nearly black, so that only its reflection is visible.
    const Scene scene = scene_of(
        clear("glass", 1.4, 0) + ", " + clear("pane", 1.5, 0.4, R"(, "absorption": [9, 9, 9])"),
        R"({"over": [)" +
            in_phase("pane", R"({"translate": {"by": [0, 0, -0.2], "of": {"box": {"size": [4, 4, 0.4]}}}})") + ", " +
            in_phase("glass", R"({"translate": {"by": [0, 0, 1.1], "of": {"sphere": {"radius": 0.5}}}})") + "]}",
        lit_by(sun, 2));
    // Seen where the sun is reflected.
    check_against_paths(scene, {1.1f, 1.05f, 2}, {0.2f, 0.3f, -1}, passes, 1e-4);
}

TEST_CASE("a point light shines through smooth glass onto rough glass as a small ball does") {
    // Only photons find the point light. All techniques find the ball.
    constexpr double intensity = 20, radius = 0.2;
    const int times = long_form ? 12 : 4;
    const auto with = [](const std::string& light, int multiple) {
        const Scene scene = scene_of(
            clear("glass", 1.4, 0) + ", " + clear("pane", 1.5, 0.4),
            R"({"over": [)" +
                in_phase("pane", R"({"translate": {"by": [0, 0, -0.2], "of": {"box": {"size": [4, 4, 0.4]}}}})") +
                ", " + in_phase("glass", R"({"translate": {"by": [0, 0, 1.1], "of": {"sphere": {"radius": 1}}}})") +
                "]}",
            lit_by(light, 0.6));
        return with_photons(scene, {-1, -1, -2}, {1, 1, 1.8f}, multiple * passes);
    };
    const Moments of_point =
        with(R"({"point": {"position": [0.3, 0.2, 5], "intensity": )" + std::to_string(intensity) + "}}", times);
    const Moments of_ball =
        with(R"({"sphere": {"centre": [0.3, 0.2, 5], "radius": )" + std::to_string(radius) + R"(, "intensity": )" +
                 std::to_string(intensity / (std::numbers::pi * radius * radius)) + "}}",
             2 * times);
    const double error = std::hypot(of_point.standard_error(), of_ball.standard_error());
    CAPTURE(of_point.mean() / of_ball.mean());
    CAPTURE(of_point.standard_error() / of_point.mean());
    CAPTURE(of_ball.standard_error() / of_ball.mean());
    const auto p_value = [&](double factor) {
        return phasetree::tests::normal_two_sided((factor * of_point.mean() - of_ball.mean()) / error);
    };
    CHECK(p_value(1) > 1e-4);
    // The ball is noisy: detecting an error of a tenth would take minutes.
    CHECK(p_value(long_form ? 1.2 : 1.55) < 1e-4);
}

}  // namespace test_caustics_on_rough
