// Light that mirrors and rough metal reflect onto other surfaces: photons compared with the light of a lamp's mirror
// image, and with paths alone.
#include <doctest/doctest.h>

#include <cmath>

#include "tracer/caustics/photons.hpp"

namespace test_mirrors {

using namespace phasetree::tracer;
using namespace phasetree::tracer::tests;

namespace {

const std::string floor_below =
    R"({"set": {"phase": "floor", "of": {"translate": {"by": [0, 0, -0.5], "of": {"box": {"size": [8, 8, 1]}}}}}})";

// The numbers of samples and passes of photons of a picture, and the gathering radius.
struct Effort {
    std::uint32_t samples;
    float photons, photon_radius;
};
Scene with(Scene scene, bool caustics, const Effort& effort) {
    scene.settings.caustics = caustics;
    scene.settings.samples = effort.samples;
    scene.settings.photons = effort.photons;
    scene.settings.photon_radius = effort.photon_radius;
    return scene;
}

const std::string white_metal = R"("conductor": {"eta": [1, 1, 1], "k": [100000, 100000, 100000])";

}  // namespace

TEST_CASE("a point light before a flat mirror lights the floor twice, the second time from its image") {
    // The mirror's face is the plane x = -1, and albedos are small, so that nothing is reflected twice.
    const Scene scene = scene_of(
        R"("floor": {"diffuse": {"color": [0.001, 0.001, 0.001]}}, "mirror": {)" + white_metal + "}}",
        R"({"over": [{"set": {"phase": "mirror", "of": {"translate": {"by": [-1.1, 0, 1], "of": {"box": {"size": [0.2, 5, 2]}}}}}}, )" +
            floor_below + "]}",
        R"("lights": [{"point": {"position": [0.5, 0, 1], "intensity": 30}}],
           "render": {"width": 32, "height": 32, "photons": 8, "caustics": true})");
    const glm::dvec3 at(0.2, 0.1, 0);
    const auto lit_by = [&](const glm::dvec3& light) {
        const glm::dvec3 way = light - at;
        const double squared = glm::dot(way, way);
        return 30 * 0.001 / std::numbers::pi * way.z / (squared * std::sqrt(squared));
    };
    const double direct = lit_by({0.5, 0, 1}), mirrored = lit_by({-2.5, 0, 1});
    const glm::vec3 from(0.3f, -1.0f, 0.8f);
    const Moments found = with_photons(scene, from, glm::vec3(at) - from);
    const double significance = sidak(1e-4, 2);
    CAPTURE((found.mean() - direct) / mirrored);
    CAPTURE(found.standard_error() / mirrored);
    CHECK(mean_p_value(found, direct + mirrored, 2e-3 * mirrored) > significance);
    CHECK(mean_p_value(found, direct + planted * mirrored, 2e-3 * mirrored) < significance);
}

TEST_CASE("photons and paths find the same light by mirrors, rough and brushed metal, bumps, and glass on the way") {
    // Two lamps, one on each side. The probability of sampling each depends on the normal where shadow rays start.
    struct Case {
        std::string name;
        std::string metal;
        std::string glass;
    };
    // Slopes of one half, where some of the light is scattered into the metal, and then again.
    const std::string bumps =
        R"(, "bump": {"field": {"of": {"translate": {"by": [0, 0, -50], "of": {"box": {"size": [100, 100, 100]}}}},
             "ramp": [[-1, [0, 0, 0]], [1, [1, 1, 1]]]}}, "bump_height": 1)";
    const std::string rough = R"(, "roughness": 0.25)";
    const std::string brushed = R"(, "grain_around": [0, 0, 1], "grain_aspect": 0.3)";
    std::vector<Case> cases{{"brushed metal", rough + brushed, ""},
                            {"rough metal with bumps", rough + bumps, ""},
                            {"glass", "", R"("ior": 1.5)"}};
    if (long_form)
        cases.insert(cases.end(), {{"a mirror", "", ""},
                                   {"rough metal", rough, ""},
                                   {"bumps", bumps, ""},
                                   {"rough glass", "", R"("ior": 1.5, "roughness": 0.3)"}});
    for (const Case& c : cases) {
        CAPTURE(c.name);
        const std::string ball =
            c.glass.empty()
                ? ""
                : R"(, {"set": {"phase": "glass", "of": {"translate": {"by": [0, 0, 0.45], "of": {"sphere": {"radius": 0.4}}}}}})";
        check_pictures(
            [&](bool caustics) {
                const Scene scene = scene_of(
                    R"("floor": {"diffuse": {"color": [0.6, 0.6, 0.6]}}, "metal": {)" + white_metal + c.metal + "}}" +
                        (c.glass.empty() ? "" : R"(, "glass": {"clear": {)" + c.glass + "}}"),
                    R"({"over": [{"set": {"phase": "metal", "of": {"translate": {"by": [0, 0, 0.3], "of": {"tube": {"radius": 1, "inner_radius": 0.9, "height": 0.6}}}}}})" +
                        ball + ", " + floor_below + "]}",
                    R"("lights": [{"sphere": {"centre": [-2, 0.5, 2], "radius": 0.4, "radiance": [20, 20, 20]}},
                                   {"sphere": {"centre": [2.5, -0.5, 0.8], "radius": 0.3, "radiance": [15, 15, 15]}}],
                       "camera": {"position": [0, -0.1, 5], "look_at": [0, 0, 0], "fov": 30},
                       "render": {"width": 24, "height": 24})");
                // The gathering radius is small, so that no photons from beyond the wall of the tube are gathered.
                return with(scene, caustics, long_form ? Effort{500, 16, 0.15f} : Effort{20, 6, 0.3f});
            },
            planted, sidak(1e-4, 2 * cases.size()));
    }
}

TEST_CASE("photons and paths find the same light by brushed metal, whichever way its strokes run") {
    // Vertical strokes reflect the lamp's light to both sides, horizontal ones up and down. Without the grain, both
    // pictures would be the same.
    for (const std::string along : {"[0, 1, 0]", "[0, 0, 1]"}) {
        CAPTURE(along);
        check_pictures(
            [&](bool caustics) {
                const Scene scene = scene_of(
                    R"("floor": {"diffuse": {"color": [0.1, 0.1, 0.1]}}, "wall": {)" + white_metal +
                        R"(, "roughness": 0.3, "grain_aspect": 0.2, "grain_along": )" + along + "}}",
                    R"({"over": [{"set": {"phase": "wall", "of": {"translate": {"by": [-1.1, 0, 1], "of": {"box": {"size": [0.2, 5, 2]}}}}}}, )" +
                        floor_below + "]}",
                    R"("lights": [{"spot": {"position": [0.5, 0, 1.5], "target": [-1, 0, 0.7], "cone": 30, "intensity": 30}}],
                       "camera": {"position": [2.5, 2.5, 2.5], "look_at": [0.2, 0.9, 0], "fov": 12},
                       "render": {"width": 16, "height": 16})");
                return with(scene, caustics, long_form ? Effort{4000, 32, 0.1f} : Effort{60, 8, 0.2f});
            },
            long_form ? 1.05 : 1.36, sidak(1e-4, 2 * 2));
    }
}

}  // namespace test_mirrors
