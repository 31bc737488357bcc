// Fingerprints of everything that the project computes, for every scene. A change that should not affect results (new
// names, moved files, a faster algorithm for the same bits) leaves all of them unchanged. Two builds are compared by
// their JSON files.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "commands/commands.hpp"
#include "measure/fingerprint.hpp"
#include "objects/scene_file.hpp"
#include "phasetree/trace/tracer.hpp"
#include "rays/camera_rays.hpp"
#include "rays/random.hpp"
#include "rays/random_rays.hpp"
#include "render/render.hpp"

namespace phasetree::bench {

namespace {

std::string hexadecimal(const Fingerprint& fingerprint) {
    return fmt::format("{:016x}", fingerprint.value());
}

glm::vec3 random_point(Random& random, const Bounds& box) {
    return box.low + random.in_cube() * box.extent();
}

// The whole object's phase and interface distance at random points of the bounds.
Fingerprint labels(const InterfaceCells& cells, std::size_t count, std::uint64_t seed) {
    Random random(seed);
    Fingerprint found;
    Samples samples;
    BatchOfFloats x, y, z;
    for (std::size_t i = 0; i < count; i += batch_size) {
        for (std::size_t lane = 0; lane < batch_size; ++lane) {
            const glm::vec3 p = random_point(random, cells.bounds());
            x[lane] = p.x;
            y[lane] = p.y;
            z[lane] = p.z;
        }
        cells.whole().sample(x, y, z, samples, Evaluator::thread_workspace());
        found.add(samples);
    }
    return found;
}

// Every cell's box, and its program's phase and distance along a line across it.
Fingerprint cells_of(const InterfaceCells& cells) {
    Fingerprint found;
    const CellStatistics statistics = cells.statistics();
    found.add(statistics.cells);
    found.add(statistics.routines);
    found.add(statistics.bytes);
    found.add(statistics.max_instructions);
    Samples samples;
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        const Bounds box = cells.bounds(cell);
        found.add(box.low);
        found.add(box.high);
        const float length = box.diagonal();
        BatchOfFloats t;
        for (std::size_t lane = 0; lane < batch_size; ++lane)
            t[lane] = length * (static_cast<float>(lane) + 0.5f) / static_cast<float>(batch_size);
        cells.sample_ray(cell, box.low, box.extent() / length, t, samples, Evaluator::thread_workspace());
        found.add(samples);
    }
    return found;
}

void add(Fingerprint& found, const std::optional<Crossing>& crossing) {
    found.add(crossing.has_value());
    if (!crossing) return;
    found.add(crossing->t_from);
    found.add(crossing->t_to);
    found.add(crossing->p_from);
    found.add(crossing->p_to);
    found.add(crossing->from.index);
    found.add(crossing->to.index);
}

// For each ray, a path from phase to phase through Embree and the cells, with at most eight crossings and their
// normals. Rays that leave a crossing carry their phase, as in a path tracer. Half of the rays start inside, half at
// the camera.
Fingerprint crossings(const FieldScene& scene, Rays rays) {
    Fingerprint found;
    for (Ray ray : rays) {
        for (int i = 0; i < 8; ++i) {
            const auto hit = scene.intersect_with_normal(ray);
            found.add(hit.has_value());
            if (!hit) break;
            add(found, hit->crossing);
            found.add(hit->cell);
            found.add(hit->normal.unit);
            found.add(hit->normal.gradient);
            ray.origin = hit->crossing.p_to;
            ray.carried = hit->crossing.to;
            ray.cell = hit->cell;
            ray.from = hit->crossing.from;
            ray.gradient = hit->normal.gradient;
        }
    }
    return found;
}

// With the program of the whole object, without cells. This is much slower, so there are fewer rays.
Fingerprint whole_crossings(const Phased& object, std::span<const Ray> rays) {
    const InterfaceTracer tracer(object);
    Fingerprint found;
    for (const Ray& ray : rays) {
        const auto crossing = tracer.first_crossing(ray.origin, ray.direction, 0, 3 * tracer.bounds().diagonal(),
                                                    std::nullopt, Evaluator::thread_workspace());
        add(found, crossing);
        if (crossing) found.add(tracer.normal(*crossing, ray.direction));
    }
    return found;
}

Fingerprint image(tracer::Scene scene, int width, int height, int samples) {
    scene.settings.samples = samples;
    scene.film.width = width;
    scene.film.height = height;
    const tracer::World world(scene);
    const tracer::Rendering rendering = tracer::render(world, scene, {.pixels = scene.film.whole()});
    Fingerprint found;
    found.add_all(std::span<const glm::vec3>(rendering.image.pixels));
    return found;
}

std::vector<std::string> all_scenes() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(PHASETREE_SCENES))
        if (entry.path().extension() == ".json" && entry.path().stem().extension() != ".schema")
            names.push_back(entry.path().stem());
    std::sort(names.begin(), names.end());
    return names;
}

}  // namespace

Report fingerprint(const Settings& settings) {
    const std::size_t count = settings.quick ? 4096 : 1'000'000;
    Report report("fingerprint", "hashes of all results, to the last bit");
    report.say(
        fmt::format("{} random points and ray paths through the cells, and fewer with the whole program", count));
    Table table({{"scene", "scene", ""},
                 {"labels", "labels", ""},
                 {"cells", "cells", ""},
                 {"crossings", "crossings", ""},
                 {"whole", "whole", ""},
                 {"image", "image", ""}});
    const FlushSubnormals flush;
    for (const std::string& name : settings.scenes.empty() ? all_scenes() : settings.scenes) {
        const tracer::Scene scene = scene_file(name);
        const FieldScene field(scene.object, tracer::opaque_phases(scene.materials));
        const auto side = static_cast<int>(std::sqrt(static_cast<double>(count) / 2));
        Rays rays = camera_rays(scene.camera, side, side);
        // Some of the rays from both ends of the list: camera rays from its beginning, rays from inside from its end.
        const Rays inside = rays_from_inside(field, count - rays.size(), settings.seed);
        rays.insert(rays.end(), inside.begin(), inside.end());
        Rays few;
        for (std::size_t i = 0; i < rays.size(); i += settings.quick ? 64 : 1024) few.push_back(rays[i]);
        table.row({name, hexadecimal(labels(field.cells(), settings.quick ? count : count / 4, settings.seed)),
                   hexadecimal(cells_of(field.cells())), hexadecimal(crossings(field, rays)),
                   hexadecimal(whole_crossings(scene.object, few)),
                   hexadecimal(image(scene, 64, 48, settings.quick ? 1 : 8))});
    }
    report.table("scenes", table);
    return report;
}

}  // namespace phasetree::bench
