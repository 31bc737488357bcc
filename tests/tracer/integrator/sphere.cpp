// A sphere of absorbing glass against the closed form with all its internal reflections.
//
// A ray that enters at an impact parameter b meets the surface at the same angle at every bounce, so the sum over
// bounces is a geometric series (closed_form.hpp). A path has a value of at most 1 and at least a; with 2.5·10⁵ of them
// the standard errors are below a quarter of 0.5 %.
#include <doctest/doctest.h>

#include "tracer/support/closed_form.hpp"
#include "tracer/support/paths.hpp"

namespace test_sphere {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;
using phasetree::tests::sphere_in_uniform_light;

TEST_CASE("sphere of absorbing glass: Fresnel and Beer-Lambert, all internal reflections") {
    constexpr std::array<double, 3> absorption{0.1, 0.25, 0.5};
    constexpr double radius = 1.5;
    const auto scene_with = [](const char* a) {
        return scene_of(std::string(R"("glass": {"clear": {"ior": 1.5, "absorption": )") + a + "}}",
                        R"({"set": {"phase": "glass", "of": {"sphere": {"radius": 1.5}}}})");
    };
    const Scene scene = scene_with("[0.1, 0.25, 0.5]");
    const Scene darker = scene_with("[0.101, 0.2525, 0.505]");
    const World world(scene), darker_world(darker);
    constexpr double impacts[] = {0, 0.6, 0.95};
    const double significance = sidak(1e-4, 3 * std::size(impacts));
    for (const double b : impacts) {
        CAPTURE(b);
        // Along a direction parallel to no axis, at b radii from the centre.
        const glm::vec3 direction = glm::normalize(glm::vec3(0.3f, 0.9f, -0.2f));
        const glm::vec3 aside = glm::normalize(glm::cross(direction, glm::vec3(0.1f, 0.2f, 1)));
        const glm::vec3 origin = static_cast<float>(b * radius) * aside - 3.0f * direction;
        const auto right = radiance_along(world, scene, origin, direction, 250000);
        const auto wrong = radiance_along(darker_world, darker, origin, direction, 250000);
        for (std::size_t c = 0; c < 3; ++c) {
            CAPTURE(c);
            const double expected = sphere_in_uniform_light(b, radius, 1.5, absorption[c]);
            CHECK(std::abs(right[c].mean() / expected - 1) < 0.005);
            CHECK(mean_p_value(right[c], expected, 2e-5) > significance);
            // 1 % more absorption changes the result by the remaining light times 0.01 σ d.
            if (b < 0.9) CHECK(mean_p_value(wrong[c], expected, 2e-5) < significance);
        }
    }
}

}  // namespace test_sphere
