// The paper's Figure 20: the same geometry with more and more phases.
//
// 96 overlapping balls and boxes, in 1 to 32 phases, with the same surface. For comparison, it also measures the
// paper's method, which walks the tree at every step with arrays of phases.
#include <fmt/format.h>

#include <cmath>

#include "commands/commands.hpp"
#include "naive/sphere_tracing.hpp"
#include "objects/cluster.hpp"
#include "rays/camera_rays.hpp"
#include "trace/field_scene.hpp"

namespace phasetree::bench {

Report phases(const Settings& settings) {
    Report report("phases", "a cluster of 96 balls and boxes, in 1 to 32 phases");
    const std::vector<int> counts{1, 2, 3, 4, 5, 8, 12, 16, 20, 24, 32};
    const int few = settings.quick ? 24 : 48;  // width in pixels of the image for the paper's method
    std::vector<std::unique_ptr<FieldScene>> cells;
    std::vector<std::unique_ptr<NaiveScene>> naive;
    for (const int n : counts) {
        const Phased object = cluster(n);
        cells.push_back(std::make_unique<FieldScene>(object));
        naive.push_back(std::make_unique<NaiveScene>(object, cells.back()->cells().bounds(),
                                                     cells.back()->cells().resolution(), Step::interface_distance));
    }
    const auto camera = camera_for(cells.front()->cells().bounds());
    const Rays rays = camera_rays(camera, settings.width, settings.height), fewer = camera_rays(camera, few, few);
    report.say(
        fmt::format("camera rays to the surface, one per pixel: {}×{} through cells, {} thread(s); {}×{} by walking "
                    "the tree at every step with arrays of phases, 1 thread",
                    settings.width, settings.height, settings.threads, few, few));
    report.say("T(n)/T(1): the time of an image with n phases relative to one phase, timed alternately");

    std::vector<Contestant> through_cells, by_walking;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const std::string name = fmt::format("{} phases", counts[i]);
        through_cells.push_back({name, [&, i] { return cells[i]->trace(rays, settings.threads); }});
        by_walking.push_back({name, [&, i] { return naive[i]->trace(fewer, 1); }});
    }
    const Turns fast = in_turn(through_cells, settings.timing());
    const Turns slow = in_turn(by_walking, settings.timing_of_one_thread());

    // The same surface, ray by ray.
    std::size_t different = 0;
    const float tolerance = 10 * cells.front()->cells().resolution();
    {
        const FlushSubnormals flush;
        for (const Ray& ray : rays) {
            const auto first = cells.front()->intersect(ray);
            bool same = true;
            for (const auto& other : cells) {
                const auto hit = other->intersect(ray);
                same = same && hit.has_value() == first.has_value() &&
                       (!hit || std::abs(hit->t_from - first->t_from) < tolerance);
            }
            different += same ? 0 : 1;
        }
    }
    Table table({{"phases", "phases", "{:.0f}"},
                 {"instructions", "instructions", "{:.0f}"},
                 {"cells", "cells", "{:.0f}"},
                 {"median_instructions", "median", "{:.0f}"},
                 {"build_seconds", "build s", "{:.3f}"},
                 {"milliseconds", "ms", "{:.2f}"},
                 {"ratio", "T(n)/T(1)", "{:.2f}"},
                 {"naive_milliseconds", "naive ms", "{:.2f}"},
                 {"naive_ratio", "T(n)/T(1)", "{:.2f}"}});
    const auto ms = [](const Spread& s) { return Spread{s.median * 1e3, s.low * 1e3, s.high * 1e3}; };
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const CellStatistics s = cells[i]->statistics();
        table.row({double(counts[i]), double(cells[i]->cells().whole().program().instructions.size()), double(s.cells),
                   double(s.median_instructions), s.build_seconds, ms(fast.seconds(i)), fast.ratio(i, 0),
                   ms(slow.seconds(i)), slow.ratio(i, 0)});
    }
    report.table("counts", table);
    report.check("the surface does not depend on the phases", different <= rays.size() / 2000,
                 fmt::format("{} of {} rays differ", different, rays.size()));
    report.at_most("T(32)/T(1)", fast.ratio(counts.size() - 1, 0).median, 1.5);
    // The excess above the line between the multiples of four on both sides.
    double bump = 0;
    for (std::size_t i = 1; i + 1 < counts.size(); ++i) {
        if (counts[i] % 4 == 0) continue;
        std::size_t below = i, above = i;
        while (below > 0 && counts[below] % 4 != 0) --below;
        while (counts[above] % 4 != 0) ++above;
        const double share = double(counts[i] - counts[below]) / double(counts[above] - counts[below]);
        const double line = (1 - share) * fast.ratio(below, 0).median + share * fast.ratio(above, 0).median;
        bump = std::max(bump, fast.ratio(i, 0).median / line);
    }
    report.at_most("largest excess at 2, 3 and 5 phases above the line between their neighbours", bump, 1.1);
    return report;
}

}  // namespace phasetree::bench
