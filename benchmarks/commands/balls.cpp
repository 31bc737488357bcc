// Ten thousand to ten million balls as data of one node: does their number slow rays down, and how much memory and time
// do they need?
//
// Lists of ten thousand to ten million balls in four phases, on a lattice, with random changes of position and radius.
// Some overlap. They are opaque, like grains. Building includes everything from the list in memory to Embree's BVH.
#include <fmt/format.h>
#include <sys/resource.h>

#include "commands/commands.hpp"
#include "objects/packing.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/phased/particles.hpp"
#include "rays/camera_rays.hpp"
#include "trace/field_scene.hpp"

namespace phasetree::bench {

namespace {

double peak_megabytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<double>(usage.ru_maxrss) * 1024e-6;
}

}  // namespace

Report balls(const Settings& settings) {
    Report report("balls", "lists of balls in four phases");
    std::vector<std::size_t> counts{10'000, 100'000, 1'000'000, 10'000'000};
    if (settings.quick) counts.pop_back();
    struct Object {
        std::unique_ptr<FieldScene> scene;
        double balls, preparing_seconds, seconds;
    };
    // All phases are opaque, like grains, except the vacuum around them.
    const PhaseSet opaque = PhaseSet::of(std::vector{Phase{1}, Phase{2}, Phase{3}, Phase{4}});
    // The largest list comes first, so that the peak memory of the process is that of this list.
    std::vector<Object> objects(counts.size());
    double peak_of_largest = 0;
    for (std::size_t i = counts.size(); i-- > 0;) {
        FromFile<BallList> file{"packing", std::make_shared<const BallList>(packing(counts[i]))};
        const auto balls = static_cast<double>(file.content->centres.size());
        const double start = seconds(Clock::wall);
        const Phased object = Particles{.of_phases = {Phase{1}, Phase{2}, Phase{3}, Phase{4}}, .file = std::move(file)};
        const double prepared = seconds(Clock::wall);
        objects[i] = {std::make_unique<FieldScene>(object, opaque), balls, prepared - start, 0};
        objects[i].seconds = seconds(Clock::wall) - start;
        if (i + 1 == counts.size()) peak_of_largest = peak_megabytes();
    }
    const auto camera = camera_for(objects.front().scene->cells().bounds());
    const Rays rays = camera_rays(camera, settings.width, settings.height);
    report.say(
        fmt::format("build: from the list in memory to Embree's BVH, on all cores, wall-clock time; {}×{} camera rays "
                    "to the first interface, {} thread(s)",
                    settings.width, settings.height, settings.threads));
    report.say(fmt::format("peak memory of the process while the largest list was built: {:.0f} MB", peak_of_largest));
    std::vector<Contestant> contestants;
    for (std::size_t i = 0; i < objects.size(); ++i)
        contestants.push_back({fmt::format("{:.0f}", objects[i].balls),
                               [&, i] { return objects[i].scene->trace(rays, settings.threads); }});
    const Turns turns = in_turn(contestants, settings.timing());
    Table table({{"balls", "balls", "{:.0f}"},
                 {"preparing_seconds", "hierarchy s", "{:.2f}"},
                 {"seconds", "all s", "{:.2f}"},
                 {"cells", "cells", "{:.0f}"},
                 {"megabytes", "cells MB", "{:.0f}"},
                 {"hits", "hits %", "{:.1f}"},
                 {"batches", "batches", "{:.2f}"},
                 {"rays_per_second", "Mrays/s", "{:.3f}", 1e-6},
                 {"ratio", "slower", "{:.2f}"}});
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const CellStatistics s = objects[i].scene->statistics();
        const TraceCounters counters = objects[i].scene->counters(rays);
        const double rate = static_cast<double>(rays.size()) / turns.seconds(i).median;
        const std::vector<double> numbers{objects[i].balls,
                                          objects[i].preparing_seconds,
                                          objects[i].seconds,
                                          double(s.cells),
                                          static_cast<double>(objects[i].scene->bytes()) * 1e-6,
                                          100 * double(turns.checksum(i).hits) / double(turns.checksum(i).rays),
                                          double(counters.batches) / double(rays.size()),
                                          rate,
                                          turns.ratio(i, 0).median};
        table.row({numbers.begin(), numbers.end()});
    }
    report.table("counts", table);
    report.at_most("slowdown of camera rays, most balls relative to fewest", turns.ratio(objects.size() - 1, 0).median,
                   2);
    if (!settings.quick) {
        report.at_most("seconds to build ten million balls", objects.back().seconds, 60, "{:.1f}");
        report.at_most("peak memory, MB", peak_of_largest, 4000, "{:.0f}");
    }
    return report;
}

}  // namespace phasetree::bench
