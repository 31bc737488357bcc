// The tentacle with 30 to 30,000 bumps: does the number of primitives slow rays down?
//
// A tentacle of four phases with 30 to 30,000 bumps (objects/tentacle.hpp). Traces camera rays, and random rays from
// points distributed evenly over the inside. The build time includes the program, the cells and Embree's BVH, on one
// thread. The memory of the cells and that requested by Embree are shown separately.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include "commands/commands.hpp"
#include "objects/tentacle.hpp"
#include "rays/camera_rays.hpp"
#include "rays/random_rays.hpp"
#include "trace/field_scene.hpp"

namespace phasetree::bench {

Report scaling(const Settings& settings) {
    Report report("scaling", "the tentacle with 30 to 30,000 bumps, four phases");
    const std::vector<int> counts{30, 300, 3000, 30000};
    const int build_rounds = settings.quick ? 1 : 5;

    struct Object {
        std::unique_ptr<FieldScene> scene;
        Spread build_seconds, opaque_build_seconds;
        Rays primary, random;
    };
    std::vector<Object> objects;
    for (const int bumps : counts) {
        const Phased object = tentacle(bumps);
        Object o;
        {
            // Everything from the tree to Embree's BVH, on this thread.
            const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
            const auto time_builds = [&](PhaseSet opaque) {
                std::vector<double> times;
                for (int i = 0; i < build_rounds; ++i) {
                    o.scene.reset();
                    const double start = seconds(Clock::thread);
                    o.scene = std::make_unique<FieldScene>(object, opaque, settings.quality());
                    times.push_back(seconds(Clock::thread) - start);
                }
                return spread_of(times);
            };
            o.opaque_build_seconds = time_builds({phases(object).bits & ~std::uint64_t{1}});
            o.build_seconds = time_builds({});
        }
        objects.push_back(std::move(o));
    }
    // One camera for all, although the bounds grow slightly with the largest bump.
    const auto camera = camera_for(objects.back().scene->cells().bounds());
    std::vector<Contestant> primary, random;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        Object& o = objects[i];
        o.primary = camera_rays(camera, settings.width, settings.height);
        o.random = rays_from_inside(*o.scene, settings.pixels(), settings.seed);
        const std::string name = fmt::format("{} bumps", counts[i]);
        primary.push_back({name, [&o, &settings] { return o.scene->trace(o.primary, settings.threads); }});
        random.push_back({name, [&o, &settings] { return o.scene->trace(o.random, settings.threads); }});
    }
    report.say(
        fmt::format("rays to the first interface: {}×{} camera rays, one per pixel; {} random rays from points inside "
                    "the object; {} thread(s)",
                    settings.width, settings.height, settings.pixels(), settings.threads));
    report.say(fmt::format("build: program, cells and Embree's BVH, processor time on one thread, median of {}",
                           build_rounds));
    report.say("opaque: the same with all phases declared opaque; everything else is measured with clear phases");
    const Turns on_primary = in_turn(primary, settings.timing());
    const Turns on_random = in_turn(random, settings.timing());

    Table table({{"bumps", "bumps", "{:.0f}"},
                 {"instructions", "instructions", "{:.0f}"},
                 {"cells", "cells", "{:.0f}"},
                 {"median_instructions", "median", "{:.0f}"},
                 {"percentile90_instructions", "90 %", "{:.0f}"},
                 {"max_instructions", "most", "{:.0f}"},
                 {"build_seconds", "build s", "{:.3f}"},
                 {"opaque_build_seconds", "opaque s", "{:.3f}"},
                 {"cell_bytes", "cells MB", "{:.2f}", 1e-6},
                 {"embree_bytes", "Embree MB", "{:.2f}", 1e-6},
                 {"primary_rays_per_second", "primary M/s", "{:.2f}", 1e-6},
                 {"primary_hits", "hits %", "{:.0f}", 100},
                 {"random_rays_per_second", "random M/s", "{:.2f}", 1e-6},
                 {"primary_batches_per_ray", "batches/primary", "{:.2f}"},
                 {"random_batches_per_ray", "batches/random", "{:.2f}"},
                 {"primary_slowdown", "primary slower ×", "{:.2f}"},
                 {"random_slowdown", "random slower ×", "{:.2f}"}});
    double slowest_primary = 0, slowest_random = 0;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const Object& o = objects[i];
        const CellStatistics s = o.scene->statistics();
        const auto rate = [&](const Turns& turns) {
            return static_cast<double>(turns.checksum(i).rays) / turns.seconds(i).median;
        };
        const auto batches = [&](const Rays& rays) {
            return static_cast<double>(o.scene->counters(rays).batches) / static_cast<double>(rays.size());
        };
        const Spread slower_primary = on_primary.ratio(i, 0), slower_random = on_random.ratio(i, 0);
        slowest_primary = std::max(slowest_primary, slower_primary.median);
        slowest_random = std::max(slowest_random, slower_random.median);
        table.row({double(counts[i]), double(o.scene->cells().whole().program().instructions.size()), double(s.cells),
                   double(s.median_instructions), double(s.percentile90_instructions), double(s.max_instructions),
                   o.build_seconds, o.opaque_build_seconds, double(s.bytes), double(o.scene->embree_bytes()),
                   rate(on_primary), double(on_primary.checksum(i).hits) / double(on_primary.checksum(i).rays),
                   rate(on_random), batches(o.primary), batches(o.random), slower_primary, slower_random});
    }
    report.table("counts", table);
    report.at_most("slowdown of primary rays, most bumps relative to fewest", slowest_primary, 2);
    report.at_most("slowdown of random rays, most bumps relative to fewest", slowest_random, 2);
    report.at_most("seconds to build 3,000 bumps on one thread", objects[2].build_seconds.median, 0.25, "{:.3f}");
    report.at_most("MB of 3,000 bumps, cells and Embree's BVH", static_cast<double>(objects[2].scene->bytes()) * 1e-6,
                   40);
    return report;
}

}  // namespace phasetree::bench
