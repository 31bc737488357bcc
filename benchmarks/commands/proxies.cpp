// What bounding volumes and levels of detail in a tree save: when the tree is walked at every step, as in the paper,
// and with cells, which have already removed what does not matter.
//
// A ball with 2,048 studs: plain, with a bounding volume around every 32 studs, and with two levels of detail.
#include <fmt/format.h>

#include <cmath>

#include "commands/commands.hpp"
#include "naive/sphere_tracing.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/under.hpp"
#include "phasetree/nodes/proxies/bounding_volume.hpp"
#include "phasetree/nodes/proxies/level_of_detail.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "rays/camera_rays.hpp"
#include "trace/field_scene.hpp"

namespace phasetree::bench {

namespace {

constexpr int studs = 2048, in_a_group = 32;
constexpr Phase leather{1}, brass{2};

// A ball with small balls as studs along a Fibonacci spiral. Neighbouring studs are united in groups, and each group
// may have a bounding volume, its box.
Field stud_groups(bool bounded) {
    Union all;
    Union group;
    for (int i = 0; i < studs; ++i) {
        const double z = 1 - (2 * i + 1.0) / studs, a = 2.399963229728653 * i, r = std::sqrt(1 - z * z);
        group.of.push_back(warped(Translate{glm::vec3(r * std::cos(a), r * std::sin(a), z)}, Field(Sphere{0.03f})));
        if (static_cast<int>(group.of.size()) < in_a_group) continue;
        const Field field = std::exchange(group, {});
        all.of.push_back(bounded ? Field(FieldBoundingVolume{{.of = field, .volume = {}, .margin = 0.05f}}) : field);
    }
    return all;
}
Phased ball(const Field& with) {
    return Under{{Set{leather, Sphere{1}}, Set{brass, with}}};
}
// With studs only on the half that is nearer to the camera.
Phased with_levels(const glm::vec3& viewpoint) {
    return PhasedLevelOfDetail{{.of = {ball(stud_groups(false)), Set{leather, Sphere{1}}},
                                .viewpoint = viewpoint,
                                .distances = {glm::length(viewpoint)},
                                .errors = {}}};
}

}  // namespace

Report proxies(const Settings& settings) {
    Report report(
        "proxies",
        "a ball with 2,048 studs: plain, with a bounding volume around every 32 studs, with two levels of detail");
    const int few = settings.quick ? 16 : 32;
    const Phased plain = ball(stud_groups(false));
    const auto camera = camera_for(bounds(plain));
    const std::vector<std::pair<std::string, Phased>> objects{{"plain", plain},
                                                              {"bounding volumes", ball(stud_groups(true))},
                                                              {"levels of detail", with_levels(camera.position)}};
    report.say(
        fmt::format("walked: {0}×{0} camera rays, walking the tree at every step; cells: {1}×{2} rays through cells; "
                    "the time of the plain object divided by that of each object, so above 1 is faster; 1 thread",
                    few, settings.width, settings.height));
    std::vector<std::unique_ptr<FieldScene>> cells;
    std::vector<std::unique_ptr<NaiveScene>> naive;
    for (const auto& [name, object] : objects) {
        cells.push_back(std::make_unique<FieldScene>(object));
        naive.push_back(std::make_unique<NaiveScene>(object, cells.back()->cells().bounds(),
                                                     cells.back()->cells().resolution(), Step::interface_distance));
    }
    const Rays rays = camera_rays(camera, settings.width, settings.height), fewer = camera_rays(camera, few, few);
    std::vector<Contestant> through_cells, by_walking;
    for (std::size_t i = 0; i < objects.size(); ++i) {
        through_cells.push_back({objects[i].first, [&, i] { return cells[i]->trace(rays, 1); }});
        by_walking.push_back({objects[i].first, [&, i] { return naive[i]->trace(fewer, 1); }});
    }
    const Turns fast = in_turn(through_cells, settings.timing_of_one_thread());
    const Turns slow = in_turn(by_walking, settings.timing_of_one_thread());
    Table table({{"object", "object", ""},
                 {"instructions", "instructions", "{:.0f}"},
                 {"cells", "cells", "{:.0f}"},
                 {"median_instructions", "median", "{:.0f}"},
                 {"bytes", "MB", "{:.2f}", 1e-6},
                 {"build_seconds", "build s", "{:.3f}"},
                 {"walked", "walked ×", "{:.2f}"},
                 {"cells_ratio", "cells ×", "{:.2f}"}});
    for (std::size_t i = 0; i < objects.size(); ++i) {
        const CellStatistics s = cells[i]->statistics();
        table.row({objects[i].first, double(cells[i]->cells().whole().program().instructions.size()), double(s.cells),
                   double(s.median_instructions), double(s.bytes), s.build_seconds, slow.ratio(0, i),
                   fast.ratio(0, i)});
    }
    report.table("objects", table);
    report.check("bounding volumes change no hit", fast.checksum(0).hits == fast.checksum(1).hits,
                 fmt::format("{} and {} hits", fast.checksum(0).hits, fast.checksum(1).hits));
    return report;
}

}  // namespace phasetree::bench
