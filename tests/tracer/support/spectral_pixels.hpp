// Scenes whose paths have wavelengths, and their expected colours.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "image/luminance.hpp"
#include "tracer/caustics/photons.hpp"

namespace phasetree::tracer::tests {

// A scene whose paths have wavelengths. The arguments are those of scene_of().
inline Scene spectral_scene(const std::string& phases, const std::string& tree,
                            const std::string& rest = white_environment) {
    Scene scene = scene_of(phases, tree, rest);
    scene.settings.spectral = true;
    return scene;
}

// The mean of `count` paths that all begin with the same ray. Their wavelengths are spread evenly over the spectrum.
inline glm::dvec3 mean_along_ray(const Scene& scene, const glm::vec3& origin, const glm::vec3& direction,
                                 int count = 1 << 14) {
    const phasetree::FlushSubnormals flush;
    const World world(scene);
    PathCounters counters;
    const Ray ray{origin, glm::normalize(direction), world.geometry().label(origin), {}};
    glm::dvec3 sum(0.0);
    for (int i = 0; i < count; ++i) {
        Sampler sampler(0, 0, static_cast<std::uint32_t>(i), 3);  // pixel (0, 0), sample i, seed 3
        sum += glm::dvec3(trace_path(world, scene, ray, sampler, counters));
    }
    return sum / static_cast<double>(count);
}

// The colour of light that is f(λ) times D65, with λ in nanometres. It is computed with the tracer's own responses to
// wavelengths, which other tests check (tests/shading).
template <class F>
glm::dvec3 expected_colour(F&& f) {
    constexpr int count = 1 << 16;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < count; ++i) {
        const Wavelength wavelength = sampled_wavelength((static_cast<float>(i) + 0.5f) / count);
        sum += glm::dvec3(wavelength.response) * f(static_cast<double>(wavelength.nanometres), wavelength.primaries);
    }
    return sum / static_cast<double>(count);
}

// Checks a colour against the expected one, within a share of the brightest of red, green and blue.
inline void check_colour(const glm::dvec3& found, const glm::dvec3& expected, double tolerance = 0.003) {
    const double brightest = std::max({expected.x, expected.y, expected.z});
    CAPTURE(found.x);
    CAPTURE(found.y);
    CAPTURE(found.z);
    CAPTURE(expected.x);
    CAPTURE(expected.y);
    CAPTURE(expected.z);
    CHECK(glm::length(found - expected) < tolerance * brightest);
}

// Wavelengths are chosen by the eye's response alone, as where no light has a spectrum.
inline const WavelengthDistribution by_response;

inline const std::string ball_of_a = R"({"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}})";
// The slab lies between x = 0 and 0.5, so a ray along x passes half a metre of it.
inline const std::string slab_of_a =
    R"({"set": {"phase": "a", "of": {"translate": {"by": [0.25, 0, 0], "of": {"box": {"size": [0.5, 9, 9]}}}}}})";

// Checks that photons find the same light as paths alone, in the picture of a ball on a floor below one lamp. All three
// are given as in a scene file; the ball is clear and refracts the light on the floor. An error of 3 % must be
// detected, in the short form one of 6 %.
inline void check_ball_on_floor(const std::string& ball, const std::string& floor, const std::string& lamp,
                                double significance) {
    check_pictures(
        [&](bool caustics) {
            Scene scene = spectral_scene(
                R"("a": )" + ball + R"(, "floor": )" + floor,
                R"({"over": [{"set": {"phase": "floor", "of": {"translate": {"by": [0, 0, -1.7], "of": {"box": {"size": [6, 6, 1]}}}}}},
                             )" +
                    ball_of_a + "]}",
                R"("lights": [)" + lamp + R"(],
                   "camera": {"position": [0, -5, 3], "look_at": [0, 0, -1], "fov": 45},
                   "render": {"width": 40, "height": 32, "samples": )" +
                    std::to_string(samples_of(128)) + "}");
            scene.settings.caustics = caustics;
            return scene;
        },
        detected(1.03), significance, luminance);
}

}  // namespace phasetree::tracer::tests
