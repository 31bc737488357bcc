// The same rays with every instruction set of this machine, and with more threads.
//
// All results must be equal to the last bit. On a loaded machine, wall-clock time says little about the efficiency of
// threads. Their processor time, which is also shown, shows how much they slow each other down.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <fstream>
#include <thread>

#include "commands/commands.hpp"
#include "objects/scene_file.hpp"
#include "objects/tentacle.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "rays/camera_rays.hpp"
#include "rays/random_rays.hpp"
#include "trace/field_scene.hpp"

namespace phasetree::bench {

namespace {

// Restores the instruction set that was in use.
struct RestoredTarget {
    std::string before = simd_target();
    ~RestoredTarget() { use_simd_target(before); }
};

double load() {
    double value = 0;
    std::ifstream("/proc/loadavg") >> value;
    return value;
}

}  // namespace

Report simd(const Settings& settings) {
    const int threads = std::max(2, settings.threads);
    Report report("simd", fmt::format("instruction sets, and 1 thread against {}", threads));
    const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
    const tracer::Scene hourglass = scene_file("hourglass");
    struct Scene {
        std::string name;
        std::unique_ptr<FieldScene> cells;
        Rays primary, random;
    };
    std::vector<Scene> scenes;
    const auto add = [&](const std::string& name, const Phased& object,
                         const std::optional<tracer::AnyCameraParameters>& camera) {
        Scene scene{name, std::make_unique<FieldScene>(object, PhaseSet{}, settings.quality()), {}, {}};
        const InterfaceCells& cells = scene.cells->cells();
        scene.primary = camera_rays(camera ? *camera : camera_for(cells.bounds()), settings.width, settings.height);
        scene.random = rays_from_inside(*scene.cells, settings.pixels(), settings.seed);
        scenes.push_back(std::move(scene));
    };
    add("hourglass", hourglass.object, hourglass.camera);
    add("tentacle, 3,000 bumps", tentacle(3000), std::nullopt);
    report.say(
        fmt::format("rays to the first interface: {}×{} camera rays, one per pixel, and {} random rays from inside",
                    settings.width, settings.height, settings.pixels()));
    report.say("speed: on one thread, by processor time, relative to the slowest instruction set");
    report.say(
        fmt::format("threads: wall clock: time on 1 thread / ({0} × time on {0} threads); processors: processor time "
                    "on 1 thread / processor time on {0} threads, which other load does not affect",
                    threads));
    if (threads > static_cast<int>(cores))
        report.say(fmt::format("there are {} cores: {} threads cannot be {} times as fast", cores, threads, threads));
    const double busy = load();
    if (busy + 0.1 * cores > static_cast<double>(cores) - threads + 1)
        report.say(fmt::format(
            "the machine is loaded ({:.1f} on {} cores): the wall clock's efficiency is a lower bound", busy, cores));

    const RestoredTarget restored;
    const std::vector<std::string> targets = simd_targets();
    Table table({{"scene", "scene", ""},
                 {"rays", "rays", ""},
                 {"target", "instructions", ""},
                 {"rays_per_second", "M/s", "{:.2f}", 1e-6},
                 {"speed", "× slowest", "{:.2f}"},
                 {"thread_efficiency", "wall clock %", "{:.0f}", 100},
                 {"processor_efficiency", "processors %", "{:.0f}", 100}});
    double least_wall = 1e30, least_processor = 1e30;
    bool same = true;
    for (const Scene& scene : scenes) {
        for (const auto& [name, traced] : {std::pair<std::string, const Rays&>{"primary", scene.primary},
                                           std::pair<std::string, const Rays&>{"random", scene.random}}) {
            const Rays& rays = traced;  // Clang 14 cannot capture a binding
            std::vector<Contestant> of_targets;
            for (const std::string& target : targets)
                of_targets.push_back(
                    {target, [&] { return scene.cells->trace(rays, 1); }, [&target] { use_simd_target(target); }});
            const Turns turns = in_turn(of_targets, settings.timing_of_one_thread());
            for (std::size_t i = 0; i < targets.size(); ++i) {
                use_simd_target(targets[i]);
                same = same && turns.checksum(i) == turns.checksum(0);
                const std::vector<Contestant> of_threads{
                    {"1 thread", [&] { return scene.cells->trace(rays, 1); }},
                    {fmt::format("{} threads", threads), [&] { return scene.cells->trace(rays, threads); }}};
                Timing timing = settings.timing();
                timing.clock = Clock::wall;
                const Turns both = in_turn(of_threads, timing);
                same = same && both.checksum(1) == both.checksum(0);
                const Spread gain = both.ratio(0, 1), processor = both.ratio(0, 1, Clock::process);
                const Spread efficiency{gain.median / threads, gain.low / threads, gain.high / threads};
                table.row({scene.name, name, targets[i],
                           static_cast<double>(turns.checksum(i).rays) / turns.seconds(i).median,
                           turns.ratio(targets.size() - 1, i), efficiency, processor});
                least_wall = std::min(least_wall, efficiency.median);
                least_processor = std::min(least_processor, processor.median);
            }
        }
    }
    report.table("instruction_sets", table);
    report.check("the same results with every instruction set and number of threads", same,
                 same ? "hits and distances are equal to the last bit" : "they differ");
    report.at_least(fmt::format("efficiency of {} threads, wall clock, worst", threads), least_wall, 0.95);
    report.at_least(fmt::format("efficiency of {} threads, processor time, worst", threads), least_processor, 0.95);
    return report;
}

}  // namespace phasetree::bench
