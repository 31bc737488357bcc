// Scenes whose paths have wavelengths, and the colours that they should find.
#pragma once

#include <doctest/doctest.h>

#include <cmath>

#include "image/luminance.hpp"
#include "photons.hpp"

namespace phasetree::tracer::tests {

// A scene whose paths have wavelengths. `rest` is as scene_of() has it, without "render".
inline Scene spectral_scene(const std::string& phases, const std::string& tree,
                            const std::string& rest = white_environment) {
    Scene scene = scene_of(phases, tree, rest);
    scene.settings.spectral = true;
    return scene;
}

// The mean of so many samples of one pixel, whose wavelengths are spread evenly over the spectrum.
inline glm::dvec3 mean_of_pixel(const Scene& scene, const glm::vec3& origin, const glm::vec3& direction,
                                int count = 1 << 14) {
    const phasetree::FlushSubnormals flush;
    const World world(scene);
    PathCounters counters;
    const Ray ray{origin, glm::normalize(direction), world.geometry().label(origin), {}};
    glm::dvec3 sum(0.0);
    for (int i = 0; i < count; ++i) {
        Sampler sampler(0, 0, static_cast<std::uint32_t>(i), 3);
        sum += glm::dvec3(trace_path(world, scene, ray, sampler, counters));
    }
    return sum / static_cast<double>(count);
}

// The colour of light that is f(λ) times D65.
template <class F>
glm::dvec3 colour_of(F&& f) {
    constexpr int count = 1 << 16;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < count; ++i) {
        const Wavelength wavelength = sampled_wavelength((static_cast<float>(i) + 0.5f) / count);
        sum += glm::dvec3(wavelength.response) * f(static_cast<double>(wavelength.nanometres), wavelength.primaries);
    }
    return sum / static_cast<double>(count);
}

// That a colour is what was expected within a part of its brightness, which an error of one per cent is not.
inline void check_colour(const glm::dvec3& found, const glm::dvec3& expected, double part = 0.003) {
    const double brightness = std::max({expected.x, expected.y, expected.z});
    const auto is_near = [&](const glm::dvec3& colour) { return glm::length(colour - expected) < part * brightness; };
    CAPTURE(found.x);
    CAPTURE(found.y);
    CAPTURE(found.z);
    CAPTURE(expected.x);
    CAPTURE(expected.y);
    CAPTURE(expected.z);
    CHECK(is_near(found));
    CHECK_FALSE(is_near(1.01 * found));
}

inline const WavelengthDistribution by_response;

inline const std::string ball_of_a = R"({"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}})";
// Between x = 0 and 0.5.
inline const std::string slab_of_a =
    R"({"set": {"phase": "a", "of": {"translate": {"by": [0.25, 0, 0], "of": {"box": {"size": [0.5, 9, 9]}}}}}})";

// That photons find the light which paths alone find, in the picture of a ball on a floor below one lamp. All three are
// given as a scene file has them; the ball is clear and bends what lights the floor.
inline void check_ball_on_floor(const std::string& ball, const std::string& floor, const std::string& lamp) {
    check_pictures(
        [&](bool caustics) {
            Scene scene = spectral_scene(
                R"("a": )" + ball + R"(, "floor": )" + floor,
                R"({"over": [{"set": {"phase": "floor", "of": {"translate": {"by": [0, 0, -1.7], "of": {"box": {"size": [6, 6, 1]}}}}}},
                             )" +
                    ball_of_a + "]}",
                R"("lights": [)" + lamp + R"(],
                   "camera": {"position": [0, -5, 3], "look_at": [0, 0, -1], "fov": 45},
                   "render": {"width": 40, "height": 32, "samples": 128})");
            scene.settings.caustics = caustics;
            return scene;
        },
        1.03, sidak(1e-4, 2), luminance);
}

}  // namespace phasetree::tracer::tests
