// A field against the triangles that would replace it, at grids from 64³ to 1024³: the cost of a mesh depends on how
// close to the surface it has to be, whereas a field is the surface.
//
// Measures rays, memory, building time, and the distance of the mesh's hits from the surface.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <optional>

#include "commands/commands.hpp"
#include "mesh/surface_nets.hpp"
#include "objects/scene_file.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "rays/beside_mesh.hpp"
#include "rays/camera_rays.hpp"

namespace phasetree::bench {

namespace {

// The distance of the mesh's hits from the surface, relative to the object's diagonal: the mean and the 99th
// percentile. |φ| bounds the distance from below; a field of the benchmark's scenes is within a few per cent of it near
// the surface.
struct Error {
    double mean = 0, most = 0;
};
Error error_of(const FieldScene& field, const MeshScene& mesh, const Rays& rays) {
    const FlushSubnormals flush;
    Evaluator::Workspace workspace;
    const double diagonal = static_cast<double>(field.cells().bounds().diagonal());
    std::vector<double> errors;
    for (const Ray& ray : rays) {
        const auto hit = mesh.intersect(ray);
        if (!hit) continue;
        const Phases<float> phi =
            field.cells().whole().distances(ray.origin + hit->distance * ray.direction, workspace);
        errors.push_back(std::abs(static_cast<double>(phi[1])) / diagonal);
    }
    if (errors.empty()) return {};
    double sum = 0;
    for (const double e : errors) sum += e;
    const auto at = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() * 99 / 100);
    std::nth_element(errors.begin(), at, errors.end());
    return {sum / static_cast<double>(errors.size()), *at};
}

}  // namespace

Report resolution(const Settings& settings) {
    Report report("resolution", "a field compared with its triangles, by the mesh's resolution");
    const std::vector<int> grids =
        settings.quick ? std::vector<int>{64, 128, 256} : std::vector<int>{64, 128, 256, 512, 1024};
    report.say(
        fmt::format("{}×{} camera rays, and as many random rays from their hits; Embree triangles of medium quality, "
                    "not robust; 1 thread",
                    settings.width, settings.height));
    report.say(
        "error: distance of the mesh's hits from the surface, mean and 99th percentile, relative to the object's "
        "diagonal; missed: rays that hit only one of the two");
    report.say("ratios: the time with triangles divided by the time with the field, above 1 where the field is faster");
    Table table({{"scene", "scene", ""},
                 {"cubes", "cubes", "{:.0f}"},
                 {"triangles", "triangles", "{:.0f}"},
                 {"bytes", "MB", "{:.2f}", 1e-6},
                 {"build_seconds", "build s", "{:.3f}"},
                 {"error", "error 10⁻⁶", "{:.2f}", 1e6},
                 {"error99", "99 %", "{:.2f}", 1e6},
                 {"missed", "missed %", "{:.3f}", 100},
                 {"primary_ratio", "primary ×", "{:.2f}"},
                 {"random_ratio", "random ×", "{:.2f}"}});
    Table fields({{"scene", "scene", ""},
                  {"cells", "cells", "{:.0f}"},
                  {"bytes", "MB", "{:.2f}", 1e-6},
                  {"build_seconds", "build s", "{:.3f}"},
                  {"resolution", "bracket 10⁻⁶", "{:.2f}", 1e6}});
    for (const std::string name : {"hourglass", "cable"}) {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
        const tracer::Scene scene = scene_file("benchmark/" + name + "_monophase");
        const double start = seconds(Clock::thread);
        const FieldScene field(scene.object, PhaseSet{phases(scene.object).bits & ~std::uint64_t{1}});
        const double field_seconds = seconds(Clock::thread) - start;
        const double diagonal = static_cast<double>(field.cells().bounds().diagonal());
        fields.row({name, double(field.cells().size()), double(field.bytes()), field_seconds,
                    static_cast<double>(field.cells().resolution()) / diagonal});
        const Rays primary = camera_rays(scene.camera, settings.width, settings.height);
        double coarser = 1;
        for (const int cubes : grids) {
            const double before = seconds(Clock::thread);
            std::optional<Triangles> triangles = surface_nets(field, cubes);
            const MeshScene mesh(*triangles, RTC_BUILD_QUALITY_MEDIUM);
            const auto count = static_cast<double>(triangles->triangles.size());
            triangles.reset();  // the scene has its own
            const double taken = seconds(Clock::thread) - before;
            const SurfaceRays random = leaving(field, mesh, primary, settings.seed);
            const auto contest = [&](const Rays& of_field, const Rays& of_mesh) {
                return in_turn({{"triangles", [&] { return mesh.trace(of_mesh, 1); }},
                                {"field", [&] { return field.trace(of_field, 1); }}},
                               settings.timing_of_one_thread());
            };
            const Turns on_primary = contest(primary, primary), on_random = contest(random.of_field, random.of_mesh);
            const Agreement agreement = compare(field, mesh, primary);
            const Error error = error_of(field, mesh, primary);
            table.row({name, double(cubes), count, double(mesh.bytes()), taken, error.mean, error.most,
                       1 - agreement.share(), on_primary.ratio(0, 1), on_random.ratio(0, 1)});
            report.check(fmt::format("{} at {}³: the finer mesh is nearer to the surface", name, cubes),
                         error.mean < coarser, fmt::format("{:.3g} of the diagonal", error.mean));
            coarser = error.mean;
        }
    }
    report.table("fields", fields);
    report.table("meshes", table);
    return report;
}

}  // namespace phasetree::bench
