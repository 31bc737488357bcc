// Pictures of one ray with photons, compared with paths alone.
#pragma once

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "caustics/caustics.hpp"
#include "caustics/trace_photon.hpp"
#include "support/long_tests.hpp"
#include "tracer/support/paths.hpp"

namespace phasetree::tracer::tests {

inline constexpr std::uint32_t paths_a_pass = 64;

// The long form detects an error of 3 %, the short form one of 25 %.
inline const bool long_form = phasetree::tests::long_tests();
inline const int passes = long_form ? 6000 : 40;
inline const double planted = long_form ? 1.03 : 1.25;

// Emits this many photons, and calls use(emitted, photon) for those that fall on surfaces. Each batch has different
// photons.
template <class Use>
void for_each_photon(const World& world, const Scene& scene, const PhotonEmission& emission, std::uint32_t count,
                     Use&& use, const std::optional<Wavelengths>& wavelength = {}, std::uint32_t batch = 0) {
    PathCounters counters;
    for (std::uint32_t i = 0; i < count; ++i) {
        Sampler sampler(i, batch, 0, 5);
        const std::optional<EmittedPhoton> emitted = emission.sample(sampler, 0);
        if (!emitted) continue;
        TracedPhotons traced;
        trace_photon(world, scene, *emitted, 0.1f, sampler, counters, traced, wavelength);
        for (const Photon& photon : traced.on_surfaces) use(*emitted, photon);
    }
}

// The radiance along a ray, by passes that each have their own photons. If the photons are not gathered, the result is
// only the share of the other techniques.
inline Moments with_photons(const Scene& scene, const glm::vec3& origin, const glm::vec3& direction, int count = passes,
                            bool are_gathered = true) {
    const phasetree::FlushSubnormals flush;
    const World world(scene);
    const Caustics caustics(world, scene);
    Moments moments;
    PathCounters counters;
    const Ray ray{origin, glm::normalize(direction), world.geometry().label(origin), {}};
    for (int pass = 0; pass < count; ++pass) {
        auto map = caustics.photons(pass, counters, [] { return false; });
        REQUIRE(map.has_value());
        if (!are_gathered) {
            const double a_photon = std::numbers::pi * caustics.radius(pass) * caustics.radius(pass);
            const auto emitted = static_cast<std::size_t>(std::lround(map->expected() / a_photon));
            map.emplace(TracedPhotons{}, emitted, caustics.radius(pass), map->wavelengths());
        }
        // Paths of one pass see the same photons, so their mean is one independent number.
        double sum = 0;
        for (std::uint32_t path = 0; path < paths_a_pass; ++path) {
            Sampler sampler(static_cast<std::uint32_t>(pass), path, 0, 1);
            sum += static_cast<double>(
                trace_path(world, scene, ray, sampler, counters, nullptr, {.photons = {&caustics.emission(), &*map}})
                    .x);
        }
        moments.add(sum / paths_a_pass);
    }
    return moments;
}

// Checks that the radiance along a ray is the same with photons as with paths alone. Both are estimates, so their
// difference has the errors of both.
inline void check_against_paths(const Scene& scene, const glm::vec3& origin, const glm::vec3& direction,
                                int passes_of_photons, double significance) {
    const World world(scene);
    const Moments paths = radiance_along(world, scene, origin, direction, long_form ? 3000000 : 60000)[0];
    const Moments photons = with_photons(scene, origin, direction, passes_of_photons);
    const double error = std::hypot(paths.standard_error(), photons.standard_error());
    const auto p_value = [&](double factor) {
        return phasetree::tests::normal_two_sided((factor * photons.mean() - paths.mean()) / error);
    };
    CAPTURE(photons.mean() / paths.mean());
    CAPTURE(paths.standard_error() / paths.mean());
    CAPTURE(photons.standard_error() / photons.mean());
    CHECK(p_value(1) > significance);
    CHECK(p_value(planted) < significance);
}

// Checks that a picture has the same mean brightness with photons as without. `made` returns the scene with "caustics"
// on or off, and `planted` is a factor of the brightness that must be detected. Pictures of grey scenes are compared by
// one channel. The blur of photons does not change the mean.
inline float red(const glm::vec3& pixel) {
    return pixel.x;
}
template <class Made, class Brightness = decltype(&red)>
void check_pictures(Made&& made, double planted_factor, double significance, Brightness brightness = red) {
    std::array<Moments, 2> by_paths_and_photons;
    for (const bool caustics : {false, true}) {
        Scene scene = made(caustics);
        const World world(scene);
        for (std::uint32_t seed = 1; seed <= 8; ++seed) {
            scene.settings.seed = seed;
            double sum = 0;
            const Image image = image_of(world, scene);
            for (const glm::vec3& pixel : image.pixels) sum += static_cast<double>(brightness(pixel));
            by_paths_and_photons[caustics].add(sum / static_cast<double>(image.pixels.size()));
        }
    }
    const Moments &paths = by_paths_and_photons[0], &photons = by_paths_and_photons[1];
    const double error = std::hypot(paths.standard_error(), photons.standard_error());
    const auto p_value = [&](double factor) {
        return phasetree::tests::normal_two_sided((factor * photons.mean() - paths.mean()) / error);
    };
    CAPTURE(photons.mean() / paths.mean());
    CAPTURE(error / paths.mean());
    CHECK(p_value(1) > significance);
    CHECK(p_value(planted_factor) < significance);
}

}  // namespace phasetree::tracer::tests
