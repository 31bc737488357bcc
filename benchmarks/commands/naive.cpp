// Compares cells with the paper's method on the CPU: the same rays, the same hits.
//
// In the paper's method (naive/), the whole object is one primitive of Embree, and each step of sphere tracing walks
// the tree. Both trace the same few camera rays, chosen at random, and the positions of the first change of label are
// compared ray by ray. Few rays favour cells, because the caches hold them. The rate of cells over the whole image is
// therefore measured, too, and the lower rate counts.
#include <fmt/format.h>

#include <cmath>

#include "commands/commands.hpp"
#include "naive/sphere_tracing.hpp"
#include "objects/scene_file.hpp"
#include "objects/tentacle.hpp"
#include "rays/camera_rays.hpp"
#include "rays/random.hpp"
#include "trace/field_scene.hpp"

namespace phasetree::bench {

namespace {

// A random subset, in the order of the image: few rays, but all kinds of rays in the same proportions as in the image.
Rays some_of(const Rays& all, std::size_t count, std::uint64_t seed) {
    Random random(seed);
    Rays chosen;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto left = static_cast<float>(all.size() - i);
        if (random.next() * left < static_cast<float>(count - chosen.size())) chosen.push_back(all[i]);
    }
    return chosen;
}

struct Disagreement {
    std::size_t hits = 0, other = 0;
    float farthest = 0;
};

// `other` counts rays of which only one hits, which enter different phases, or whose hits are farther apart than both
// resolutions explain. A grazing ray crosses the surface slowly, and within a resolution of the surface, rounding
// decides the label.
Disagreement compare(const FieldScene& cells, const NaiveScene& naive, const Rays& rays, float tolerance) {
    const FlushSubnormals flush;
    Disagreement d;
    for (const Ray& ray : rays) {
        const auto a = cells.intersect(ray);
        const auto b = naive.intersect(ray);
        d.hits += a ? 1 : 0;
        const float apart = a && b ? std::abs(a->t_from - b->distance) : 0;
        d.farthest = std::max(d.farthest, apart);
        d.other += a.has_value() != b.has_value() || (a && a->to != b->to) || apart > tolerance ? 1 : 0;
    }
    return d;
}

}  // namespace

Report naive(const Settings& settings) {
    Report report(
        "naive",
        "interface cells compared with the paper's method: the tree is walked at every step, in one user primitive");
    struct Scene {
        std::string name;
        Phased object;
        std::optional<tracer::AnyCameraParameters> camera;
        std::size_t rays;
        double wanted;
    };
    const std::size_t part = settings.quick ? 1 : 8;
    const tracer::Scene hourglass = scene_file("hourglass");
    const std::vector<Scene> scenes{{"hourglass", hourglass.object, hourglass.camera, 2000 * part, 10},
                                    {"tentacle, 3,000 bumps", tentacle(3000), std::nullopt, 60 * part, 500}};
    report.say(
        fmt::format("the same camera rays to the first interface for both, chosen at random from {}×{}; 1 thread",
                    settings.width, settings.height));
    report.say(
        "\"all\": the rate of cells for the whole image, where fewer of them are in the caches; the lower rate counts");
    report.say("the paper's method steps by min |φᵢ|, or by the second smallest component; the faster one counts");

    Table table({{"scene", "scene", ""},
                 {"rays", "rays", "{:.0f}"},
                 {"disagreements", "different hits", "{:.0f}"},
                 {"least_magnitude_rays_per_second", "min |φ| k/s", "{:.3f}", 1e-3},
                 {"interface_distance_rays_per_second", "s(p) k/s", "{:.3f}", 1e-3},
                 {"cells_rays_per_second", "cells k/s", "{:.0f}", 1e-3},
                 {"cells_all_rays_per_second", "all k/s", "{:.0f}", 1e-3},
                 {"ratio", "×", "{:.0f}"},
                 {"ratio_all", "× all", "{:.0f}"}});
    struct Target {
        std::string scene;
        double measured, wanted;
    };
    std::vector<Target> targets;
    for (const Scene& scene : scenes) {
        const FieldScene cells(scene.object);
        const float resolution = cells.cells().resolution();
        const NaiveScene least(scene.object, cells.cells().bounds(), resolution, Step::least_magnitude);
        const NaiveScene second(scene.object, cells.cells().bounds(), resolution, Step::interface_distance);
        const Rays all = camera_rays(scene.camera ? *scene.camera : camera_for(cells.cells().bounds()), settings.width,
                                     settings.height);
        const Rays rays = some_of(all, scene.rays, settings.seed);
        const Turns turns = in_turn({{"min |φ|", [&] { return least.trace(rays, 1); }},
                                     {"s(p)", [&] { return second.trace(rays, 1); }},
                                     {"cells", [&] { return cells.trace(rays, 1); }},
                                     {"cells, all rays", [&] { return cells.trace(all, 1); }}},
                                    settings.timing_of_one_thread());
        const std::size_t better = turns.seconds(0).median < turns.seconds(1).median ? 0 : 1;
        const auto rate = [&](std::size_t i) {
            return static_cast<double>(turns.checksum(i).rays) / turns.seconds(i).median;
        };
        const Disagreement a = compare(cells, least, rays, 10 * resolution);
        const Disagreement b = compare(cells, second, rays, 10 * resolution);
        report.check(scene.name + ": the same hits", a.other + b.other <= 2 + rays.size() / 500,
                     fmt::format("{} rays, {} hit; different from the cells: {} by min |φ|, {} by s(p)", rays.size(),
                                 a.hits, a.other, b.other));
        const Spread ratio = turns.ratio(better, 2);
        Spread on_all = turns.ratio(better, 3);
        const double scale = static_cast<double>(all.size()) / static_cast<double>(rays.size());
        on_all = {on_all.median * scale, on_all.low * scale, on_all.high * scale};
        table.row({scene.name, double(rays.size()), double(std::max(a.other, b.other)), rate(0), rate(1), rate(2),
                   rate(3), ratio, on_all});
        targets.push_back({scene.name, std::min(ratio.median, on_all.median), scene.wanted});
    }
    report.table("scenes", table);
    for (const Target& t : targets) report.at_least("times as fast, " + t.scene, t.measured, t.wanted, "{:.0f}");
    return report;
}

}  // namespace phasetree::bench
