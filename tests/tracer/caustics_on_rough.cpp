// Rough interfaces that are lit by photons themselves, because the camera sees them before anything else that scatters:
// held against paths alone.
#include <doctest/doctest.h>

#include "photons.hpp"
#include "rough_scenes.hpp"

namespace test_caustics_on_rough {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

// As check_against_paths(), and that what is gathered is a part of the light that is worth testing.
void check(const Scene& scene, const glm::vec3& origin, const glm::vec3& direction, int times, double significance) {
    check_against_paths(scene, origin, direction, times * passes, significance);
    const Moments all = with_photons(scene, origin, direction, 4 * passes);
    const Moments others = with_photons(scene, origin, direction, 4 * passes, false);
    CAPTURE(others.mean() / all.mean());
    CHECK(others.mean() < 0.97 * all.mean());
}

}  // namespace

TEST_CASE("what falls through smooth glass onto rough glass is as bright as by paths alone") {
    const double significance = sidak(1e-4, 2);
    const Scene scene = scene_of(
        clear("glass", 1.4, 0) + ", " + clear("pane", 1.5, 0.3),
        R"({"over": [)" +
            in_phase("pane", R"({"translate": {"by": [0, 0, -0.2], "of": {"box": {"size": [4, 4, 0.4]}}}})") + ", " +
            in_phase("glass", R"({"translate": {"by": [0, 0, 1.1], "of": {"sphere": {"radius": 1}}}})") + "]}",
        lit_by(sun, 0.1));
    // From above, aside of the ball; and from below, through the pane's other side.
    SUBCASE("from above") {
        check(scene, {-1.9f, -1.9f, 0.1f}, {1.9f, 1.9f, -0.1f}, 6, significance);
    }
    SUBCASE("from below") {
        check(scene, {-1, -1, -2}, {1, 1, 1.8f}, 10, significance);
    }
}

TEST_CASE("a rough ball within a smooth one, and a rough ball alone: as bright as by paths alone") {
    const double significance = sidak(1e-4, 2);
    const std::string ball = R"({"translate": {"by": [0, 0, 1.1], "of": {"sphere": {"radius": 1}}}})";
    // What is reflected often within is rare and bright, and would need many more photons.
    const std::string absorbing = R"(, "absorption": [1, 1, 1])";
    const glm::vec3 origin(-3, -3, 0.8f), direction(1, 1, 0.1f);
    SUBCASE("within a smooth one") {
        const std::string core =
            in_phase("core", R"({"translate": {"by": [0.1, 0, 1.1], "of": {"sphere": {"radius": 0.6}}}})");
        check(scene_of(clear("shell", 1.3, 0, absorbing) + ", " + clear("core", 1.6, 0.8, absorbing),
                       R"({"over": [)" + core + ", " + in_phase("shell", ball) + "]}", lit_by(sun, 0.1)),
              origin, direction, 26, significance);
    }
    SUBCASE("alone") {
        check(scene_of(clear("glass", 1.5, 0.4, absorbing), in_phase("glass", ball), lit_by(sun, 0.1)), origin,
              direction, 10, significance);
    }
}

}  // namespace test_caustics_on_rough
