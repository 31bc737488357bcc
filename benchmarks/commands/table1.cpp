// The paper's Table 1: does it cost anything that an object has phases?
//
// Seven objects with their phases, and the same outer surfaces as trees of one phase that were written by hand as a
// library of distance fields would have them (scenes/benchmark/*_monophase.json): unions, differences and offsets,
// without what nobody can see. The multiphase trees are the gallery's scenes; only the cake has one of its own,
// because the entremet's glaze blends all that is below it, which no other tree can. That two surfaces are one is
// checked at random points, half of them near it, and along the camera's rays. primary is one ray a pixel, bounce adds
// a ground plane of two triangles and one diffuse ray more from what was met.
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

// A pixel's ray, and from what it meets, object or ground, another one into a random direction, more often along the
// normal (by the cosine, as a diffuse surface scatters). The random numbers are the pixel's.
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
                  "seven objects with phases, and their surfaces alone as hand-made trees of one phase (Table 1)");
    const std::size_t points = settings.quick ? 20'000 : 200'000;
    report.say(fmt::format(
        "primary: {0}×{1} camera rays to the first interface, one a pixel; bounce: with a ground plane, and "
        "from what they meet one diffuse bounce more; {2} thread(s)",
        settings.width, settings.height, settings.threads));
    report.say("cells as a render makes them: which phases are opaque is the scene files' to say");
    report.say("overhead: the time with phases over that without, less one; both of both trees timed in turn");
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
        const FieldScene with(multi.object, tracer::opaque_phases(multi.materials)),
            without(mono.object, tracer::opaque_phases(mono.materials));
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
