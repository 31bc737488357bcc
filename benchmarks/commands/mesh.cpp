// A field against the mesh that would replace it: four scenes' outer surfaces and the same surfaces as triangles.
//
// The surfaces are fields of one phase, or of four for the tentacle (opaque, like a mesh). The triangles are made by
// surface nets (mesh/) with 512 cubes along the longest side, in an Embree scene of their own that is not robust, which
// is faster. Random rays start at the hits of camera rays. For the mesh they start at its own hit, raised by 10⁻⁵ of
// the object, in the same direction. A triangle's normal comes with the hit and a field's is computed separately, so
// rays are timed with and without it. Camera rays check that both surfaces are the same.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <bit>
#include <cmath>

#include "commands/commands.hpp"
#include "mesh/surface_nets.hpp"
#include "objects/outer.hpp"
#include "objects/scene_file.hpp"
#include "objects/tentacle.hpp"
#include "rays/beside_mesh.hpp"
#include "rays/camera_rays.hpp"

namespace phasetree::bench {

namespace {

struct NamedScene {
    std::string name;
    Phased object;
    std::optional<tracer::AnyCameraParameters> camera;
};

std::vector<NamedScene> scenes_to_compare() {
    std::vector<NamedScene> scenes;
    for (const std::string name : {"hourglass", "cable", "cake"}) {
        const tracer::Scene scene = scene_file("benchmark/" + name + "_monophase");
        scenes.push_back({name, scene.object, scene.camera});
    }
    // With all of its phases. They are opaque, so only the outer surface is left.
    scenes.push_back({"tentacle, 3,000 bumps", tentacle(3000), std::nullopt});
    return scenes;
}

void say_what_is_compared(Report& report, const Settings& settings, int cubes) {
    report.say(
        fmt::format("field: one phase, four for the tentacle; mesh: {}³ cubes{}, Embree triangles of medium and high "
                    "build quality, not robust",
                    cubes, settings.quick ? " (512³ without --quick)" : ""));
    report.say(fmt::format(
        "rays: {}×{} camera rays, one per pixel; as many random rays outwards from their hits; {} thread(s)",
        settings.width, settings.height, settings.threads));
    report.say(
        "rays of the field carry their phase and their last hit, as in a path tracer; those of the mesh start at a "
        "small offset");
    report.say(
        "build: processor time on one thread, from the tree for the field; meshing and Embree's build for the mesh");
    report.say(
        "field + normal: with the normal at the hit, which a field computes separately; a triangle's comes with the "
        "hit");
}

}  // namespace

Report mesh(const Settings& settings) {
    Report report("mesh", "four scenes' outer surfaces, as fields and as triangles by surface nets");
    const int cubes = settings.quick ? 256 : 512;
    say_what_is_compared(report, settings, cubes);
    Table table({{"scene", "scene", ""},
                 {"what", "", ""},
                 {"primitives", "primitives", "{:.0f}"},
                 {"build_seconds", "build s", "{:.2f}"},
                 {"bytes", "MB", "{:.1f}", 1e-6},
                 {"primary_rays_per_second", "primary M/s", "{:.2f}", 1e-6},
                 {"random_rays_per_second", "random M/s", "{:.2f}", 1e-6},
                 {"primary_ratio", "primary ×", "{:.2f}"},
                 {"random_ratio", "random ×", "{:.2f}"}});
    Table agreements({{"scene", "scene", ""},
                      {"rays", "rays that hit either", "{:.0f}"},
                      {"both", "both %", "{:.3f}", 100},
                      {"difference", "mean |Δt| in cubes", "{:.4f}"},
                      {"largest", "largest", "{:.2f}"}});
    double least_primary = 1e30, least_random = 1e30, most_memory = 0;
    for (const NamedScene& scene : scenes_to_compare()) {
        const tbb::global_control one(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(settings.threads));
        const auto timed = [](auto&& make, double& taken) {
            const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
            return bench::timed(make, taken);
        };
        double field_seconds = 0, meshing_seconds = 0, medium_seconds = 0, high_seconds = 0;
        // No ray is inside either surface.
        const PhaseSet opaque{phases(scene.object).bits & ~std::uint64_t{1}};
        const auto field = timed([&] { return std::make_unique<FieldScene>(scene.object, opaque, settings.quality()); },
                                 field_seconds);
        // Cells know nothing of places where several opaque phases meet, and lines of the grid may pass through these.
        // Such an object is therefore meshed from its outer surface.
        const bool is_one = std::popcount(opaque.bits) == 1;
        const auto surface =
            is_one ? nullptr : std::make_unique<FieldScene>(outer(scene.object), PhaseSet{0b10}, settings.quality());
        const Triangles triangles =
            timed([&] { return surface_nets(is_one ? *field : *surface, cubes); }, meshing_seconds);
        const auto medium =
            timed([&] { return std::make_unique<MeshScene>(triangles, RTC_BUILD_QUALITY_MEDIUM); }, medium_seconds);
        const auto high =
            timed([&] { return std::make_unique<MeshScene>(triangles, RTC_BUILD_QUALITY_HIGH); }, high_seconds);

        const Rays primary = camera_rays(scene.camera ? *scene.camera : camera_for(field->cells().bounds()),
                                         settings.width, settings.height);
        const SurfaceRays random = leaving(*field, *medium, primary, settings.seed);
        const auto with_normals = [&](const Rays& rays) {
            return trace_many(rays, settings.threads, [&](const Ray& ray) -> std::optional<float> {
                const auto hit = field->intersect_with_normal(ray);
                if (!hit) return std::nullopt;
                return hit->crossing.t_from + glm::dot(hit->normal.unit, ray.direction);
            });
        };
        const auto contest = [&](const Rays& of_field, const Rays& of_mesh) {
            return in_turn({{"triangles", [&] { return medium->trace(of_mesh, settings.threads); }},
                            {"triangles, high", [&] { return high->trace(of_mesh, settings.threads); }},
                            {"field", [&] { return field->trace(of_field, settings.threads); }},
                            {"field + normal", [&] { return with_normals(of_field); }}},
                           settings.timing());
        };
        const Turns on_primary = contest(primary, primary), on_random = contest(random.of_field, random.of_mesh);

        const double cube = [&] {
            const glm::vec3 extent = field->cells().bounds().extent();
            return static_cast<double>(std::max({extent.x, extent.y, extent.z})) / cubes;
        }();
        const Agreement agreement = compare(*field, *medium, primary);
        agreements.row({scene.name, double(agreement.either), agreement.share(), agreement.mean() / cube,
                        agreement.largest / cube});
        // A cube is about as large as a pixel, so silhouettes affect a few thousandths of the rays.
        report.check(scene.name + ": field and mesh are the same surface",
                     agreement.share() > 0.98 && agreement.mean() < 0.5 * cube,
                     fmt::format("{:.2f} % of rays hit both, {:.3f} cubes apart on average", 100 * agreement.share(),
                                 agreement.mean() / cube));

        const auto row = [&](std::size_t i, const std::string& what, double primitives, double build, double bytes) {
            const auto rate = [&](const Turns& turns) {
                return static_cast<double>(turns.checksum(i).rays) / turns.seconds(i).median;
            };
            table.row({scene.name, what, primitives, build, bytes, rate(on_primary), rate(on_random),
                       on_primary.ratio(0, i), on_random.ratio(0, i)});
        };
        const double count = static_cast<double>(triangles.triangles.size());
        row(0, "triangles", count, meshing_seconds + medium_seconds, double(medium->bytes()));
        row(1, "triangles, high quality", count, meshing_seconds + high_seconds, double(high->bytes()));
        row(2, "field", double(field->cells().size()), field_seconds, double(field->bytes()));
        row(3, "field + normal", double(field->cells().size()), field_seconds, double(field->bytes()));
        least_primary = std::min(least_primary, on_primary.ratio(0, 2).median);
        least_random = std::min(least_random, on_random.ratio(0, 2).median);
        most_memory = std::max(most_memory, static_cast<double>(field->bytes()) / static_cast<double>(medium->bytes()));
    }
    report.table("scenes", table);
    report.table("agreement", agreements);
    report.at_least("rate of the field relative to triangles, primary rays, worst scene", least_primary, 0.7);
    report.at_least("rate of the field relative to triangles, random rays from the surface, worst scene", least_random,
                    0.7);
    report.at_most("memory of the field relative to triangles, worst scene", most_memory, 1);
    return report;
}

}  // namespace phasetree::bench
