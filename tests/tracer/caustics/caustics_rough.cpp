// Pictures with photons that rough interfaces scatter, compared with pictures by paths alone.
#include <doctest/doctest.h>

#include <vector>

#include "tracer/caustics/photons.hpp"
#include "tracer/caustics/rough_scenes.hpp"

namespace test_caustics_rough {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

const std::string grey_floor = R"("meshes": [{"floor": {"material": {"diffuse": {"color": [0.6, 0.6, 0.6]}}}}], )";
const std::string ball = R"({"translate": {"by": [0, 0, 1.1], "of": {"sphere": {"radius": 1}}}})";

// Like check_against_paths(). Also checks that photons contribute a part of the light, but not all.
void check(const Scene& scene, const glm::vec3& origin, const glm::vec3& direction, int passes_of_photons,
           double significance) {
    check_against_paths(scene, origin, direction, passes_of_photons, significance);
    const Moments all = with_photons(scene, origin, direction, 4 * passes);
    const Moments others = with_photons(scene, origin, direction, 4 * passes, false);
    CAPTURE(others.mean() / all.mean());
    CHECK(others.mean() < 0.97 * all.mean());
    CHECK(others.mean() > 0.05 * all.mean());
}

// A ray onto the floor below the ball.
const glm::vec3 above_floor(-2, -2, 0.1f), below_ball(1.9f, 1.9f, -0.1f);

}  // namespace

TEST_CASE("behind a ball of ground glass it is as bright as by paths alone") {
    struct Case {
        std::string light;
        double roughness, photons;
        int times;  // the multiple of `passes` that detects the planted error
    };
    std::vector<Case> cases{{sun, 0.3, 0.04, 10}, {rectangle, 0.1, 0.04, 12}};
    if (long_form) cases.insert(cases.end(), {{sun, 0.8, 0.04, 12}, {point, 0.8, 0.4, 40}});
    const double significance = sidak(1e-4, std::size(cases));
    for (const Case& c : cases) {
        CAPTURE(c.light);
        CAPTURE(c.roughness);
        const Scene scene = scene_of(clear("glass", 1.3, c.roughness), in_phase("glass", ball),
                                     grey_floor + lit_by(c.light, c.photons));
        check(scene, above_floor, below_ball, c.times * passes, significance);
    }
}

TEST_CASE("smooth interfaces and rough ones behind each other: as bright as by paths alone") {
    const double significance = sidak(1e-4, 2);
    const auto check_scene = [&](const std::string& phases, const std::string& first, const std::string& second,
                                 double photons, int passes_of_photons) {
        const Scene scene =
            scene_of(phases, R"({"over": [)" + first + ", " + second + "]}", grey_floor + lit_by(rectangle, photons));
        check(scene, above_floor, below_ball, passes_of_photons, significance);
    };
    // The roughness of an interface is that of its rougher side.
    const std::string core =
        in_phase("core", R"({"translate": {"by": [0.2, 0, 1.2], "of": {"sphere": {"radius": 0.6}}}})");
    SUBCASE("a rough ball within a smooth one") {
        check_scene(clear("shell", 1.3, 0) + ", " + clear("core", 1.6, 0.25), core, in_phase("shell", ball), 0.04,
                    12 * passes);
    }
    SUBCASE("a smooth ball below a rough pane") {
        check_scene(clear("pane", 1.2, 0.1) + ", " + clear("glass", 1.3, 0),
                    in_phase("pane", R"({"translate": {"by": [0, 0, 2.4], "of": {"box": {"size": [3, 3, 0.2]}}}})"),
                    in_phase("glass", ball), 0.15, 12 * passes);
    }
}

TEST_CASE("where the index is not 1, or a medium scatters, behind a rough interface: as bright as by paths alone") {
    const double significance = sidak(1e-4, 2);
    SUBCASE("the ground of rough water") {
        const Scene scene = pool_of_rough_water(sun);
        check(scene, {-0.5f, -0.5f, 0.2f}, {0.5f, 0.5f, -0.7f}, 25 * passes, significance);
    }
    SUBCASE("a medium") {
        const Scene scene =
            scene_of(clear("murk", 1.3, 0.3, R"(, "scattering": [1, 1, 1], "absorption": [0.2, 0.2, 0.2])"),
                     in_phase("murk", ball), lit_by(rectangle));
        check(scene, {-3, -3, 1.1f}, {1, 1, 0.05f}, 6 * passes, significance);
    }
}

}  // namespace test_caustics_rough
