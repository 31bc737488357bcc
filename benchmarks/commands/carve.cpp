// Sphere Carving: how much smaller carved bounds are than boxes, what they cost, and where they pay off.
//
// Compares convex bounds by Sphere Carving with the library's boxes: volumes, evaluations and time, with the time to
// build cells for comparison. Also compares rays: with the whole program inside either volume, and through cells with a
// test against the planes before Embree.
#include <fmt/format.h>

#include "commands/commands.hpp"
#include "objects/scene_file.hpp"
#include "objects/tentacle.hpp"
#include "phasetree/carving/carve.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/warps/rotate.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/trace/tracer.hpp"
#include "rays/camera_rays.hpp"
#include "trace/field_scene.hpp"

namespace phasetree::bench {

namespace {

double volume_of(const Bounds& box) {
    const glm::dvec3 extent(box.extent());
    return extent.x * extent.y * extent.z;
}

// A diagonal stick of six links, each rotated relative to the previous one: the worst case for boxes around rotated
// boxes.
Phased nested_rotations() {
    const Field link = Box{.size = {0.12f, 0.12f, 1}};
    Field chain = link;
    for (int i = 0; i < 5; ++i)
        chain = Union{.of = {link, warped(Translate{{0, 0, 0.95f}},
                                          warped(Rotate{.axis = {1, 0.5f, 0}, .angle = i % 2 ? -14.f : 14.f}, chain))}};
    return Set{.phase = Phase{1}, .of = warped(Rotate{.axis = {1, -1, 0}, .angle = 54.7f}, chain)};
}

std::vector<glm::dvec3> directions_of_26_dop() {
    std::vector<glm::dvec3> all;
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z)
                if (std::abs(x) + std::abs(y) + std::abs(z) > 1) all.emplace_back(x, y, z);
    return all;
}

struct Object {
    std::string name;
    Phased object;
};

std::vector<Object> objects(bool quick) {
    std::vector<Object> all{{"nested rotations", nested_rotations()}};
    for (const std::string name : {"hourglass", "cable", "ice_cup", "bunny", "two_pears", "kintsugi"})
        all.push_back({name, scene_file(name).object});
    all.push_back({"tentacle, 3,000 bumps", tentacle(quick ? 300 : 3000)});
    return all;
}

Checksum trace_whole(const InterfaceTracer& tracer, const Rays& rays) {
    Evaluator::Workspace workspace;
    return trace_many(rays, 1, [&](const Ray& ray) -> std::optional<float> {
        const auto hit = tracer.first_crossing(ray.origin, ray.direction, 0, 1e6f, vacuum, workspace);
        if (!hit) return std::nullopt;
        return hit->t_from;
    });
}

}  // namespace

Report carve(const Settings& settings) {
    Report report("carve", "carved bounds compared with boxes: volume, time and rays");
    const int few = settings.quick ? 32 : 96;
    report.say(
        "box: the tree's bounds; carved box: the six sides found by carving; 26-DOP: corners and edges cut, too; "
        "convex: up to 40 planes chosen by carving");
    report.say(
        fmt::format("whole program: {0}×{0} camera rays with the program of the whole object, rate within the convex "
                    "bounds relative to within the box; cells: {1}×{2} rays through cells, rate with a test against "
                    "the convex bounds before Embree relative to without; above 1, carving pays off; 1 thread",
                    few, settings.width, settings.height));
    Table table({{"object", "object", ""},
                 {"box", "box", "{:.4g}"},
                 {"carved_box", "carved box", "{:.2f}"},
                 {"dop26", "26-DOP", "{:.2f}"},
                 {"convex", "convex", "{:.2f}"},
                 {"planes", "planes", "{:.0f}"},
                 {"evaluations", "evaluations", "{:.0f}"},
                 {"seconds", "ms", "{:.1f}", 1e3},
                 {"cells_seconds", "cells ms", "{:.0f}", 1e3},
                 {"whole_speedup", "whole program ×", "{:.2f}"},
                 {"cells_speedup", "cells ×", "{:.2f}"}});
    for (const Object& object : objects(settings.quick)) {
        const Bounds box = bounds(object.object);
        CarveOptions dop;
        dop.directions = directions_of_26_dop();
        const CarvedBounds with_26 = phasetree::carve(object.object, {}, dop);
        const double start = seconds(Clock::thread);
        const CarvedBounds convex = phasetree::carve(object.object);
        const double taken = seconds(Clock::thread) - start;

        const FieldScene cells(object.object, {}, settings.quality());
        const auto camera = camera_for(cells.cells().bounds());
        const Rays rays = camera_rays(camera, settings.width, settings.height), fewer = camera_rays(camera, few, few);
        const InterfaceTracer in_box(object.object), in_convex(object.object, convex.planes);
        const Checksum a = trace_whole(in_box, fewer), b = trace_whole(in_convex, fewer);
        report.check(object.name + ": the same hits",
                     a.hits == b.hits && std::abs(a.distance - b.distance) < 1e-5 * static_cast<double>(fewer.size()) *
                                                                                 static_cast<double>(box.diagonal()),
                     fmt::format("{} and {} of {} rays", a.hits, b.hits, a.rays));
        const Turns whole = in_turn({{"box", [&] { return trace_whole(in_box, fewer); }},
                                     {"convex", [&] { return trace_whole(in_convex, fewer); }}},
                                    settings.timing_of_one_thread());
        const auto tested = [&] {
            return trace_many(rays, 1, [&](const Ray& ray) -> std::optional<float> {
                double near = 0, far = 1e9;
                convex.clip(glm::dvec3(ray.origin), glm::dvec3(ray.direction), near, far);
                if (far < near) return std::nullopt;
                const auto crossing = cells.intersect(ray);
                if (!crossing) return std::nullopt;
                return crossing->t_from;
            });
        };
        const Turns through_cells = in_turn({{"alone", [&] { return cells.trace(rays, 1); }}, {"tested", tested}},
                                            settings.timing_of_one_thread());
        const double of_box = volume_of(box);
        table.row({object.name, of_box, volume_of(convex.box) / of_box, with_26.volume / of_box, convex.volume / of_box,
                   double(convex.planes.size()), double(convex.evaluations), taken, cells.statistics().build_seconds,
                   whole.ratio(0, 1), through_cells.ratio(0, 1)});
        report.check(object.name + ": carved bounds are no larger than the box",
                     convex.volume <= of_box * 1.001 && with_26.volume <= of_box * 1.001,
                     fmt::format("{:.3f} of it", convex.volume / of_box));
    }
    report.table("objects", table);
    return report;
}

}  // namespace phasetree::bench
