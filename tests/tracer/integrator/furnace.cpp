// The white furnace: in an environment of radiance 1 from everywhere, everything that does not absorb is invisible.
//
// Basic radiance L/η² is invariant along a ray through lossless media, at reflections and refractions alike; the
// environment's is 1 in every direction. So a camera in vacuum sees 1 at every pixel, and a camera within a medium of
// index η sees η². Each path of our estimator is exact by itself: Fresnel's factor cancels the probability of the
// choice, the factors (η/η')² telescope, and roulette never applies. A pixel is wrong only if a path was lost, found
// twice, or followed along the wrong interface. So a few samples are enough: with 16 per pixel, one wrong path changes
// its pixel by 0.06, sixty times the tolerance.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>

#include "support/long_tests.hpp"
#include "tracer/support/paths.hpp"

namespace test_furnace {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

const std::string clear_phases =
    R"("glass": {"clear": {"ior": 1.5}}, "water": {"clear": {"ior": 1.33}}, "air": {"clear": {"ior": 1.0}})";

const std::string sphere = R"({"set": {"phase": "glass", "of": {"sphere": {"radius": 1}}}})";
const std::string box =
    R"({"rotate": {"axis": [1, 2, 3], "angle": 40, "of": {"set": {"phase": "glass", "of": {"box": {"size": [2, 1.6, 1.2]}}}}}})";
std::string bulb(const std::string& inside) {
    return R"({"thin_shell": {"shell": "glass", "inside": ")" + inside + R"(", "half_thickness": 0.04, "of":
        {"smooth_union": {"radius": 0.5, "of": [
            {"translate": {"by": [0, 0, 0.55], "of": {"sphere": {"radius": 0.5}}}},
            {"translate": {"by": [0, 0, -0.55], "of": {"sphere": {"radius": 0.5}}}}]}}}})";
}
const std::string ball_of_water =
    R"({"thin_shell": {"shell": "glass", "inside": "water", "half_thickness": 0.04, "of": {"sphere": {"radius": 1}}}})";
// A half-full glass. Above the tilted surface of the water is vacuum, or air; glass, water and vacuum meet in a line.
const std::string tilted = R"({"plane": {"normal": [0.1, 0.05, 1], "offset": 0.15}})";
const std::string half_full =
    R"({"intersect_shape": {"phases": "water", "shape": )" + tilted + R"(, "of": )" + ball_of_water + "}}";
const std::string half_full_of_air =
    R"({"change": {"from": "water", "to": "air", "shape": {"plane": {"normal": [-0.1, -0.05, -1], "offset": -0.15}}, "of": )" +
    ball_of_water + "}}";

// The long form of the test, which runs overnight, looks for errors of one path in a million. It does not limit the
// length of paths: of a million in lossless glass, about ten are reflected within the wall more than 4,096 times.
const bool long_form = phasetree::tests::long_tests();
const int samples = long_form ? 500 : 16;

std::string view(const std::string& position, const std::string& look_at, int fov, int size) {
    const std::string n = std::to_string(size);
    return std::string(white_environment) + R"(, "camera": {"position": )" + position + R"(, "look_at": )" + look_at +
           R"(, "fov": )" + std::to_string(fov) + R"(}, "render": {"width": )" + n + R"(, "height": )" + n +
           R"(, "samples": )" + std::to_string(samples) + "}";
}
const std::string from_the_front = view("[0, -4, 0.3]", "[0, 0, 0]", 40, 32);
const std::string from_above = view("[1.5, -1.2, 4]", "[0, 0, 0]", 36, 32);
const std::string near_by = view("[-0.3, -1.25, 0.2]", "[0.5, 0, 0.1]", 80, 32);

// The number of pixels that are wrong by more than the tolerance, and the largest error.
struct Off {
    int pixels = 0;
    float most = 0;
};

Off off(Scene scene, float expected) {
    if (long_form) scene.settings.max_depth = 1 << 20;
    const World world(scene);
    const Image image = image_of(world, scene);
    REQUIRE(image.pixels.size() > 0);
    Off result;
    for (const glm::vec3& pixel : image.pixels) {
        float far = 0;
        for (int c = 0; c < 3; ++c) far = std::max(far, std::abs(pixel[c] - expected) / expected);
        if (!(far <= 0.001f)) ++result.pixels;
        result.most = std::max(result.most, far);
    }
    return result;
}

}  // namespace

TEST_CASE("furnace: lossless glass, water and air are invisible from outside") {
    struct Case {
        std::string name;
        std::string tree;
    };
    const Case cases[] = {{"sphere", sphere},
                          {"box", box},
                          {"bulb of air", bulb("air")},
                          {"bulb of water", bulb("water")},
                          {"ball of water", ball_of_water},
                          {"half full", half_full},
                          {"half full, air above", half_full_of_air}};
    for (const Case& c : cases) {
        for (const std::string& camera : {from_the_front, from_above, near_by}) {
            CAPTURE(c.name);
            CAPTURE(camera);
            const Off result = off(scene_of(clear_phases, c.tree, camera), 1.0f);
            CHECK(result.pixels == 0);
            CHECK(result.most < 1e-5f);  // rounding errors of a path with a dozen factors
        }
    }
}

// Within a radius R/η of a sphere's centre no ray is caught: it meets the surface at sin θ = r sin θ₀/R < 1/η.
TEST_CASE("furnace: from within, radiance is that of the medium, η²") {
    const std::string camera = view("[0.3, -0.2, 0.3]", "[1, 0.4, 0]", 100, 32);
    CHECK(off(scene_of(clear_phases, sphere, camera), 1.5f * 1.5f).pixels == 0);
    CHECK(off(scene_of(clear_phases, ball_of_water, camera), 1.33f * 1.33f).pixels == 0);
}

TEST_CASE("furnace: a loss of 1 % is seen") {
    // 1 % over the mean chord of a sphere, 4r/3.
    const std::string lossy = R"("glass": {"clear": {"ior": 1.5, "absorption": [0.0075, 0.0075, 0.0075]}})";
    const Off result = off(scene_of(lossy, sphere, from_the_front), 1.0f);
    CHECK(result.pixels > 250);  // a sphere of 1 m at 4 m fills 370 of the 1,024
    CHECK(result.most > 0.005f);
    // Also a glass that is half full of water, where one part in a hundred is lost.
    const std::string murky =
        R"("glass": {"clear": {"ior": 1.5}}, "water": {"clear": {"ior": 1.33, "absorption": [0.0075, 0.0075, 0.0075]}})";
    CHECK(off(scene_of(murky, half_full, from_the_front), 1.0f).pixels > 100);
}

TEST_CASE("furnace: white paint and varnish, by next-event estimation and BSDF samples together") {
    const std::string convex = R"({"set": {"phase": "paint", "of": {"sphere": {"radius": 1}}}})";
    // Light is reflected between the two balls, and enters the gap between them.
    const std::string concave = R"({"set": {"phase": "paint", "of": {"union": [
        {"translate": {"by": [1, 0, 0], "of": {"sphere": {"radius": 0.98}}}},
        {"translate": {"by": [-1, 0, 0], "of": {"sphere": {"radius": 0.98}}}}]}}})";
    const auto paint = [](const char* kind, const char* white) {
        return std::string(R"("paint": {")") + kind + R"(": {"color": [)" + white + ", " + white + ", " + white + "]}}";
    };
    struct Case {
        std::string name;
        std::string kind, tree;
        glm::vec3 direction;
        // Bare paint of albedo ρ shows ρ; under varnish the change is a little smaller. Between the balls, it applies
        // at every bounce.
        double rounding;
    };
    const Case cases[] = {{"diffuse", "diffuse", convex, {0.05f, 1, 0.1f}, 1e-6},
                          {"diffuse, concave", "diffuse", concave, {0.05f, 1, 0.02f}, 1e-6},
                          // The table of a smooth coating's albedo is accurate to 1e-4 (tests/shading).
                          {"coated", "coated", convex, {0.1f, 1, 0.05f}, 3e-4},
                          {"coated, concave", "coated", concave, {0.05f, 1, 0.02f}, 6e-4}};
    const double significance = sidak(1e-4, std::size(cases));
    for (const Case& c : cases) {
        CAPTURE(c.name);
        const auto test = [&](const char* white) {
            const Scene scene = scene_of(paint(c.kind.c_str(), white), c.tree);
            const World world(scene);
            const Moments m = radiance_along(world, scene, {0, -5, 0}, c.direction, 60000)[0];
            CAPTURE(m.mean());
            CAPTURE(m.standard_error());
            return mean_p_value(m, 1.0, c.rounding);
        };
        CHECK(test("1.0") > significance);
        CHECK(test("0.99") < significance);
    }
}

TEST_CASE("furnace: rough glass gives back what it got") {
    // Between equal indices, only the film reflects.
    for (const char* const surface : {R"("ior": 1.5, "roughness": 0.1)", R"("ior": 1.5, "roughness": 0.3)",
                                      R"("ior": 1, "roughness": 0.2, "film_thickness": 300, "film_ior": 1.5)"}) {
        const std::string rough = std::string(R"("glass": {"clear": {)") + surface + "}}";
        const Scene scene = scene_of(rough, sphere);
        const World world(scene);
        for (const glm::vec3& direction : {glm::vec3(0, 1, 0), glm::vec3(0.1f, 1, 0.05f), glm::vec3(0, 1, 0.17f)}) {
            const Moments m = radiance_along(world, scene, {0, -5, 0}, direction, 40000)[0];
            CAPTURE(surface);
            CAPTURE(direction.z);
            CAPTURE(m.mean());
            CAPTURE(m.standard_error());
            // The tables of the losses are accurate to a few thousandths, and a path meets two or more surfaces.
            CHECK(std::abs(m.mean() - 1.0) < 0.005 + 4 * m.standard_error());
        }
    }
}

}  // namespace test_furnace
