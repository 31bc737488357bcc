// Compares a closed mesh as a field with the same triangles in Embree: the cost of being able to offset, hollow and
// fill a mesh.
//
// The mesh is scenes/assets/spot.ply, then the same mesh with each triangle divided into 4 and 16. Camera rays check
// that field and triangles are the same surface.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include "commands/commands.hpp"
#include "phasetree/io/mesh.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/mesh.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "rays/beside_mesh.hpp"
#include "rays/camera_rays.hpp"
#include "rays/race_with_mesh.hpp"

namespace phasetree::bench {

namespace {

// Divides each triangle into four at the midpoints of its edges.
TriangleMesh divided(const TriangleMesh& mesh) {
    TriangleMesh result{mesh.vertices, {}};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [at, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)}, result.vertices.size());
        if (is_new) result.vertices.push_back(0.5f * (mesh.vertices[a] + mesh.vertices[b]));
        return at->second;
    };
    for (const glm::uvec3& t : mesh.triangles) {
        const std::uint32_t a = middle(t.x, t.y), b = middle(t.y, t.z), c = middle(t.z, t.x);
        for (const glm::uvec3& part : {glm::uvec3(t.x, a, c), {a, t.y, b}, {c, b, t.z}, {a, b, c}})
            result.triangles.push_back(part);
    }
    return result;
}

void compare_both(const TriangleMesh& mesh, const Settings& settings, Report& report, Table& table) {
    double field_seconds = 0, triangles_seconds = 0, preparing_seconds = 0;
    FromFile<TriangleMesh> file;
    file.content = std::make_shared<const TriangleMesh>(mesh);
    const Phased object =
        timed([&] { return Phased(Set{.phase = Phase{1}, .of = Mesh{.file = file}}); }, preparing_seconds);
    const auto field = timed([&] { return std::make_unique<FieldScene>(object, PhaseSet{0b10}); }, field_seconds);
    const auto triangles = timed(
        [&] {
            return std::make_unique<MeshScene>(Triangles{mesh.vertices, mesh.triangles}, RTC_BUILD_QUALITY_MEDIUM);
        },
        triangles_seconds);
    const Rays primary = camera_rays(camera_for(field->cells().bounds()), settings.width, settings.height);
    const RaceWithMesh race = bench::race(*field, *triangles, primary, settings);

    const auto count = static_cast<double>(mesh.triangles.size());
    const Agreement agreement = compare(*field, *triangles, primary);
    const auto resolution = static_cast<double>(field->cells().resolution());
    report.check(fmt::format("{:.0f} triangles: field and triangles are the same surface", count),
                 agreement.share() > 0.999 && agreement.mean() < 2 * resolution,
                 fmt::format("{:.3f} % of rays hit both, {:.2f} resolutions apart on average", 100 * agreement.share(),
                             agreement.mean() / resolution));
    const auto row = [&](RaceWithMesh::Runner runner, const std::string& what, double cells, double checks,
                         double build, std::size_t bytes) {
        std::vector<Table::Cell> values{count, what, cells, checks, build, static_cast<double>(bytes)};
        std::ranges::copy(race.speeds(runner), std::back_inserter(values));
        table.row(std::move(values));
    };
    row(RaceWithMesh::triangles, "triangles", 0, 0, triangles_seconds, triangles->bytes());
    row(RaceWithMesh::field, "field", static_cast<double>(field->cells().size()), preparing_seconds, field_seconds,
        field->bytes());
}

}  // namespace

Report triangles(const Settings& settings) {
    Report report("triangles", "a closed mesh as a field, and the same triangles in Embree");
    report.say(
        fmt::format("scenes/assets/spot.ply, and the same with each triangle divided into 4 {}; Embree triangles of "
                    "medium build quality, not robust",
                    settings.quick ? "once" : "once and twice"));
    report.say(fmt::format(
        "rays: {}×{} camera rays, one per pixel; as many random rays outwards from their hits; {} thread(s)",
        settings.width, settings.height, settings.threads));
    report.say(
        "checks: checking that the mesh is a solid, and the field's own hierarchy; build: cells and Embree's BVH, or "
        "for triangles the BVH alone; both are processor time on one thread");
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(settings.threads));
    std::vector<Column> columns{{"triangles", "triangles", "{:.0f}"},   {"what", "", ""},
                                {"cells", "cells", "{:.0f}"},           {"checks_seconds", "checks s", "{:.2f}"},
                                {"build_seconds", "build s", "{:.2f}"}, {"bytes", "MB", "{:.1f}", 1e-6}};
    std::ranges::copy(RaceWithMesh::columns(), std::back_inserter(columns));
    Table table(std::move(columns));
    TriangleMesh mesh = read_mesh(PHASETREE_SCENES "/assets/spot.ply");
    for (int times = 0; times <= (settings.quick ? 1 : 2); ++times) {
        if (times > 0) mesh = divided(mesh);
        compare_both(mesh, settings, report, table);
    }
    report.table("meshes", table);
    return report;
}

}  // namespace phasetree::bench
