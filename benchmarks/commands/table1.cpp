// The paper's Table 1: what do phases cost?
//
// Compares seven objects that have phases with trees of one phase for the same outer surfaces. The latter are written
// by hand as for a library of distance fields (scenes/benchmark/*_monophase.json): unions, differences and offsets,
// without invisible parts. The multiphase trees are scenes of the gallery, except for the cake. It has a tree of its
// own, because the glaze of the entremet blends everything below it, which no tree of one phase can do. Random points,
// half of them near the surface, and camera rays check that both surfaces are the same. "primary" is one ray per pixel;
// "bounce" adds a ground plane of two triangles, and one diffuse ray from each hit.
#include <fmt/format.h>

#include "commands/commands.hpp"
#include "objects/scene_file.hpp"
#include "rays/camera_rays.hpp"
#include "rays/random.hpp"
#include "rays/same_surface.hpp"
#include "trace/field_scene.hpp"

namespace phasetree::bench {

namespace {

struct Object {
    std::string name, multiphase, monophase;
};

const std::vector<Object>& objects() {
    static const std::vector<Object> all{
        {"bunny", "bunny", "benchmark/bunny_monophase"},
        {"cables", "cable", "benchmark/cable_monophase"},
        {"hourglass", "hourglass", "benchmark/hourglass_monophase"},
        {"geology", "land_block", "benchmark/land_block_monophase"},
        {"cake", "benchmark/cake_multiphase", "benchmark/cake_monophase"},
        {"blob", "blob", "benchmark/blob_monophase"},
        {"ice cup", "ice_cup", "benchmark/ice_cup_monophase"},
    };
    return all;
}

// The ray of a pixel, and from its hit on the object or the ground another one in a random direction, with a cosine
// distribution as for a diffuse surface. The random numbers depend only on the pixel.
Checksum trace_with_bounce(const FieldScene& scene, const Rays& rays, const std::vector<glm::vec3>& sphere,
                           int threads) {
    return trace_many(rays, threads, [&](const Ray& ray) -> std::optional<float> {
        const auto first = scene.surface(ray);
        if (!first) return std::nullopt;
        const glm::vec3 scattered = first->normal + sphere[static_cast<std::size_t>(&ray - rays.data())];
        const float length = glm::length(scattered);
        const glm::vec3 direction = length > 1e-4f ? scattered / length : first->normal;
        const auto second = scene.surface({first->point, direction, vacuum, first->cell, first->from, first->gradient});
        return first->distance + (second ? second->distance : 0.f);
    });
}

}  // namespace

Report table1(const Settings& settings) {
    Report report("table1",
                  "seven objects with phases, and their outer surfaces as hand-written trees of one phase (Table 1)");
    const std::size_t points = settings.quick ? 20'000 : 200'000;
    report.say(
        fmt::format("primary: {0}×{1} camera rays to the first interface, one per pixel; bounce: with a ground plane, "
                    "and one diffuse bounce from each hit; {2} thread(s)",
                    settings.width, settings.height, settings.threads));
    report.say("cells as in a render: the scene files determine which phases are opaque");
    report.say("overhead: the time with phases relative to that without, minus one; all four are timed alternately");
    report.say(fmt::format("the same surface: {} points, half of them near it, and the camera rays", points));

    Table table({{"object", "object", ""},
                 {"monophase_nodes", "#N mono", "{:.0f}"},
                 {"multiphase_nodes", "#N multi", "{:.0f}"},
                 {"monophase_instructions", "instr.", "{:.0f}"},
                 {"multiphase_instructions", "instr.", "{:.0f}"},
                 {"monophase_cells", "cells", "{:.0f}"},
                 {"multiphase_cells", "cells", "{:.0f}"},
                 {"monophase_primary_ms", "primary ms", "{:.2f}"},
                 {"multiphase_primary_ms", "primary ms", "{:.2f}"},
                 {"primary_overhead", "%", "{:+.1f}", 100},
                 {"monophase_bounce_ms", "bounce ms", "{:.2f}"},
                 {"multiphase_bounce_ms", "bounce ms", "{:.2f}"},
                 {"bounce_overhead", "%", "{:+.1f}", 100}});
    double sum = 0, worst = -1e30;
    for (const Object& object : objects()) {
        const tracer::Scene multi = scene_file(object.multiphase), mono = scene_file(object.monophase);
        const FieldScene with(multi.object, tracer::opaque_phases(multi.materials), settings.quality()),
            without(mono.object, tracer::opaque_phases(mono.materials), settings.quality());
        const float ground = std::min(with.cells().bounds().low.z, without.cells().bounds().low.z);
        const FieldScene with_ground(with, ground), without_ground(without, ground);
        const Rays rays = camera_rays(multi.camera, settings.width, settings.height);
        std::vector<glm::vec3> sphere;
        Random random(settings.seed);
        for (std::size_t i = 0; i < rays.size(); ++i) sphere.push_back(random.direction());

        const Sameness same = same_surface(with, without, rays, points, settings.seed);
        report.check(object.name + ": the same outer surface",
                     same.hits > rays.size() / 20 && same.points_apart == 0 && same.rays_apart <= same.rays / 1000,
                     fmt::format("{} of {} points differ, {} of {} rays", same.points_apart, same.points,
                                 same.rays_apart, same.rays));
        const Turns turns = in_turn(
            {{"monophase", [&] { return without.trace(rays, settings.threads); }},
             {"multiphase", [&] { return with.trace(rays, settings.threads); }},
             {"monophase, bounce", [&] { return trace_with_bounce(without_ground, rays, sphere, settings.threads); }},
             {"multiphase, bounce", [&] { return trace_with_bounce(with_ground, rays, sphere, settings.threads); }}},
            settings.timing());
        const auto overhead = [](const Spread& s) { return Spread{s.median - 1, s.low - 1, s.high - 1}; };
        const auto ms = [&](std::size_t i) {
            const Spread s = turns.seconds(i);
            return Spread{s.median * 1e3, s.low * 1e3, s.high * 1e3};
        };
        const auto instructions = [](const FieldScene& scene) {
            return static_cast<double>(scene.cells().whole().program().instructions.size());
        };
        const Spread primary = overhead(turns.ratio(1, 0)), bounce = overhead(turns.ratio(3, 2));
        table.row({object.name, double(statistics(mono.object).nodes), double(statistics(multi.object).nodes),
                   instructions(without), instructions(with), double(without.cells().size()),
                   double(with.cells().size()), ms(0), ms(1), primary, ms(2), ms(3), bounce});
        sum += primary.median + bounce.median;
        worst = std::max({worst, primary.median, bounce.median});
    }
    report.table("objects", table);
    const double mean = sum / static_cast<double>(2 * objects().size());
    report.at_most("mean overhead of phases, %", 100 * mean, 0, "{:+.1f}");
    report.at_most("largest overhead of phases, %", 100 * worst, 10, "{:+.1f}");
    return report;
}

}  // namespace phasetree::bench
