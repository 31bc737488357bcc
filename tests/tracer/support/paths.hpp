// Scenes from text, and estimates of the radiance along one ray: shared by the tests of the integrator.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "integrator/path.hpp"
#include "phasetree/io/document.hpp"
#include "phasetree/math/float_mode.hpp"
#include "render/render.hpp"
#include "scene/scene.hpp"
#include "support/long_tests.hpp"
#include "support/statistics.hpp"

namespace phasetree::tracer::tests {

using phasetree::tests::mean_p_value;
using phasetree::tests::Moments;
using phasetree::tests::sidak;

// The number of samples of a comparison that takes `count` in the long form. The short form takes a quarter: its
// standard error is twice as large, and so is the error that it must detect.
inline std::uint32_t samples_of(std::uint32_t count) {
    return phasetree::tests::long_tests() ? count : count / 4;
}
// The planted factor that this form must detect, given that of the long form.
inline double detected(double factor) {
    return phasetree::tests::long_tests() ? factor : 1 + 2 * (factor - 1);
}

inline constexpr const char* white_environment = R"("lights": [{"constant": {}}])";

// `rest` holds further members of the scene, including "lights".
inline Scene scene_of(const std::string& phases, const std::string& tree, const std::string& rest = white_environment) {
    std::string text = R"({"version": 1, "phases": {)" + phases + R"(}, "tree": )" + tree + ", " + rest;
    if (rest.find("\"camera\"") == std::string::npos)
        text += R"(, "camera": {"position": [0, -5, 0], "look_at": [0, 0, 0]})";
    return read_scene(Document::from_text(text + "}", "test.json"));
}

// The whole picture.
inline Image image_of(const World& world, const Scene& scene) {
    RenderJob job;
    job.pixels = scene.film.whole();
    return render(world, scene, job).image;
}

// The surface that a ray meets, which starts in the phase at its origin; nullopt if it escapes.
inline std::optional<Surface> surface_met(const World& world, const glm::vec3& origin, const glm::vec3& direction) {
    PathCounters counters;
    const Ray ray{origin, glm::normalize(direction), world.geometry().label(origin)};
    const Hit hit = world.geometry().intersect(ray, counters);
    const Surface* surface = std::get_if<Surface>(&hit);
    return surface ? std::optional(*surface) : std::nullopt;
}

// Radiance along a ray, per colour channel: `count` independent paths. Each is the first sample of its own pixel, so
// that nothing is stratified and a z-test applies.
inline std::array<Moments, 3> radiance_along(const World& world, const Scene& scene, const glm::vec3& origin,
                                             const glm::vec3& direction, std::uint32_t count, std::uint32_t seed = 1,
                                             const PathHelp& help = {}) {
    const FlushSubnormals flush;
    std::array<Moments, 3> moments;
    PathCounters counters;
    const Ray ray{origin, glm::normalize(direction), world.geometry().label(origin), {}};
    for (std::uint32_t i = 0; i < count; ++i) {
        Sampler sampler(i & 0xffffu, i >> 16, 0, seed);
        const glm::vec3 radiance = trace_path(world, scene, ray, sampler, counters, nullptr, help);
        for (int c = 0; c < 3; ++c) moments[static_cast<std::size_t>(c)].add(static_cast<double>(radiance[c]));
    }
    return moments;
}

}  // namespace phasetree::tracer::tests
