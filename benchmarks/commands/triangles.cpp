// Compares a closed mesh as a field with the same triangles in Embree: the cost of being able to offset, hollow and
// fill a mesh.
//
// The mesh is scenes/assets/spot.ply, then the same mesh with each triangle divided into 4 and 16. Camera rays check
// that field and triangles are the same surface. Two more fields, an offset and a smooth union with a small ball, show
// the cost of rays where the distance to the mesh is needed.
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
#include "phasetree/nodes/fields/offset.hpp"
#include "phasetree/nodes/fields/smooth_union.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"
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

// What is made of a mesh. Rays meet the triangles of the mesh itself; the other two need its distance. Their surfaces
// are less than a thousandth of the mesh's size from the mesh's, except at the ball.
struct Solid {
    std::string name;
    Field field;
};

std::vector<Solid> solids_of(const TriangleMesh& mesh) {
    FromFile<TriangleMesh> file;
    file.content = std::make_shared<const TriangleMesh>(mesh);
    const Field field = Mesh{.file = file};
    const float size = bounds(field).diagonal();
    const Field ball = warped(Translate{.by = mesh.vertices[mesh.triangles[0].x]}, Sphere{.radius = 0.01f * size});
    return {{"field", field},
            {"field, offset", Offset{.of = field, .amount = 0.0005f * size}},
            {"field, smooth union", SmoothUnion{.of = {field, ball}, .radius = 0.01f * size}}};
}

void compare_both(const TriangleMesh& mesh, const Settings& settings, Report& report, Table& table) {
    double triangles_seconds = 0, preparing_seconds = 0;
    const std::vector<Solid> solids = timed([&] { return solids_of(mesh); }, preparing_seconds);
    const auto triangles = timed(
        [&] {
            return std::make_unique<MeshScene>(Triangles{mesh.vertices, mesh.triangles}, RTC_BUILD_QUALITY_MEDIUM);
        },
        triangles_seconds);
    const auto count = static_cast<double>(mesh.triangles.size());
    const auto row = [&](const RaceWithMesh& race, RaceWithMesh::Runner runner, const std::string& what, double cells,
                         double checks, double build, std::size_t bytes) {
        std::vector<Table::Cell> values{count, what, cells, checks, build, static_cast<double>(bytes)};
        std::ranges::copy(race.speeds(runner), std::back_inserter(values));
        table.row(std::move(values));
    };
    for (const Solid& solid : solids) {
        double field_seconds = 0;
        const Phased object = Set{.phase = Phase{1}, .of = solid.field};
        const auto field = timed(
            [&] { return std::make_unique<FieldScene>(object, PhaseSet{0b10}, settings.quality()); }, field_seconds);
        const Rays primary = camera_rays(camera_for(field->cells().bounds()), settings.width, settings.height);
        const RaceWithMesh race = bench::race(*field, *triangles, primary, settings);
        const bool is_mesh = &solid == &solids.front();
        if (is_mesh) {
            const Agreement agreement = compare(*field, *triangles, primary);
            const auto resolution = static_cast<double>(field->cells().resolution());
            report.check(fmt::format("{:.0f} triangles: field and triangles are the same surface", count),
                         agreement.share() > 0.999 && agreement.mean() < 2 * resolution,
                         fmt::format("{:.3f} % of rays hit both, {:.2f} resolutions apart on average",
                                     100 * agreement.share(), agreement.mean() / resolution));
            row(race, RaceWithMesh::triangles, "triangles", 0, 0, triangles_seconds, triangles->bytes());
        }
        row(race, RaceWithMesh::field, solid.name, static_cast<double>(field->cells().size()), preparing_seconds,
            field_seconds, field->bytes());
    }
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
