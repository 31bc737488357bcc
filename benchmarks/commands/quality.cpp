// What build qualities gain: cells, time to build and to trace.
//
// Builds cells of the same objects with low and with medium quality (BuildQuality; everything else is measured with
// medium). Measures time and memory, and the rates of camera rays and of random rays that leave their hits and carry
// the hit.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <array>

#include "commands/commands.hpp"
#include "objects/scene_file.hpp"
#include "objects/tentacle.hpp"
#include "rays/camera_rays.hpp"
#include "rays/random_rays.hpp"
#include "trace/field_scene.hpp"

namespace phasetree::bench {

Report quality(const Settings& settings) {
    Report report("quality", "four objects, built with low and with medium quality");
    struct Object {
        std::string name;
        Phased object;
        std::optional<tracer::AnyCameraParameters> camera;
        PhaseSet opaque;
    };
    std::vector<Object> objects;
    for (const std::string name : {"hourglass", "ice_cup", "cable"}) {
        const tracer::Scene scene = scene_file(name);
        objects.push_back({name, scene.object, scene.camera, tracer::opaque_phases(scene.materials)});
    }
    const Phased bumps = tentacle(3000);
    objects.push_back({"3,000 bumps", bumps, std::nullopt, {}});
    objects.push_back({"3,000 bumps, opaque", bumps, std::nullopt, {phases(bumps).bits & ~std::uint64_t{1}}});
    constexpr std::array qualities{BuildQuality::low, BuildQuality::medium};
    constexpr std::array names{"low", "medium"};
    constexpr std::size_t usual = 1;
    const int build_rounds = settings.quick ? 1 : 5;

    report.say("three of the gallery's scenes with their materials, and the tentacle with all phases clear and opaque");
    report.say(
        fmt::format("build: program, cells and Embree's BVH, processor time on one thread, alternately, median of {}; "
                    "relative to medium quality",
                    build_rounds));
    report.say(
        fmt::format("rays to the first interface: {}×{} camera rays, one per pixel, and as many random rays from their "
                    "hits; {} thread(s); rates relative to medium quality",
                    settings.width, settings.height, settings.threads));
    Table table({{"object", "object", ""},
                 {"quality", "quality", ""},
                 {"cells", "cells", "{:.0f}"},
                 {"bytes", "MB", "{:.1f}", 1e-6},
                 {"build_seconds", "build s", "{:.3f}"},
                 {"build_ratio", "build ×", "{:.2f}"},
                 {"primary_rays_per_second", "primary M/s", "{:.2f}", 1e-6},
                 {"random_rays_per_second", "random M/s", "{:.2f}", 1e-6},
                 {"primary_ratio", "primary ×", "{:.2f}"},
                 {"random_ratio", "random ×", "{:.2f}"}});
    std::vector<double> low_seconds;
    for (const Object& o : objects) {
        std::array<std::unique_ptr<FieldScene>, qualities.size()> built;
        std::array<std::vector<double>, qualities.size()> times, ratios;
        {
            const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
            for (int round = 0; round < build_rounds; ++round) {
                for (std::size_t i = 0; i < qualities.size(); ++i) {
                    built[i].reset();
                    const double start = seconds(Clock::thread);
                    built[i] = std::make_unique<FieldScene>(o.object, o.opaque, qualities[i]);
                    times[i].push_back(seconds(Clock::thread) - start);
                }
                for (std::size_t i = 0; i < qualities.size(); ++i)
                    ratios[i].push_back(times[i].back() / times[usual].back());
            }
        }
        const Rays primary = camera_rays(o.camera ? *o.camera : camera_for(built[usual]->cells().bounds()),
                                         settings.width, settings.height);
        std::array<Rays, qualities.size()> random;
        std::vector<Contestant> on_primary, on_random;
        for (std::size_t i = 0; i < qualities.size(); ++i) {
            const FieldScene& scene = *built[i];
            random[i] = rays_from_hits(scene, primary, settings.seed);
            on_primary.push_back({names[i], [&] { return scene.trace(primary, settings.threads); }});
            on_random.push_back({names[i], [&, i] { return scene.trace(random[i], settings.threads); }});
        }
        const Turns first = in_turn(on_primary, settings.timing()), second = in_turn(on_random, settings.timing());
        for (std::size_t i = 0; i < qualities.size(); ++i) {
            const auto rate = [&](const Turns& turns) {
                return static_cast<double>(turns.checksum(i).rays) / turns.seconds(i).median;
            };
            table.row({o.name, names[i], double(built[i]->cells().size()), double(built[i]->bytes()),
                       spread_of(times[i]), spread_of(ratios[i]), rate(first), rate(second), first.ratio(usual, i),
                       second.ratio(usual, i)});
        }
        low_seconds.push_back(spread_of(times[0]).median);
    }
    report.table("objects", table);
    for (std::size_t i = 0; i < objects.size(); ++i)
        if (objects[i].name.starts_with("3,000 bumps"))
            report.at_most("seconds to build " + objects[i].name + " on one thread, low quality", low_seconds[i], 0.25,
                           "{:.3f}");
    return report;
}

}  // namespace phasetree::bench
