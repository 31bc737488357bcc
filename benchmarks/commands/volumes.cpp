// Compares voxel grids as fields, `volume` and `labels`, with triangles of the same surface in Embree.
//
// The grids have 64³ to 512³ voxels.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>

#include "commands/commands.hpp"
#include "mesh/surface_nets.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/volume.hpp"
#include "phasetree/nodes/phased/labels.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "rays/camera_rays.hpp"
#include "rays/race_with_mesh.hpp"

namespace phasetree::bench {

namespace {

// The signed distance to a ring and two balls on it, about 2 m large.
double distance_to_solid(const glm::dvec3& p) {
    const double ring = glm::length(glm::dvec2(glm::length(glm::dvec2(p.x, p.y)) - 0.62, p.z)) - 0.2;
    const double balls =
        std::min(glm::length(p - glm::dvec3(0.62, 0, 0)), glm::length(p + glm::dvec3(0.62, 0, 0))) - 0.36;
    return std::min(ring, balls);
}

VoxelLattice cube_of(int n) {
    const double h = 2.2 / n;
    return {{n, n, n}, glm::dvec3(-1.1 + 0.5 * h), glm::dvec3(h)};
}

template <class F>
void for_each_voxel(const VoxelLattice& l, F&& f) {
    for (int z = 0; z < l.size[2]; ++z)
        for (int y = 0; y < l.size[1]; ++y)
            for (int x = 0; x < l.size[0]; ++x) f(l.first + l.spacing * glm::dvec3(x, y, z));
}

// A narrow band of three voxels, as OpenVDB's tools make it.
FromFile<VoxelGrid> level_set(int n) {
    const VoxelLattice lattice = cube_of(n);
    const double h = lattice.spacing.x;
    VoxelGrid grid = VoxelGrid::of_voxels("volume", lattice, [&](int x, int y, int z) {
        return std::clamp(distance_to_solid(lattice.first + h * glm::dvec3(x, y, z)), -3 * h, 3 * h);
    });
    grid.divide_by(std::max(grid.steepest_linear(), 1.0) * (1 + 1e-6));
    FromFile<VoxelGrid> file;
    file.content = std::make_shared<const VoxelGrid>(std::move(grid));
    return file;
}

// The same solid in three phases that touch.
FromFile<LabelGrid> labels_of(int n) {
    LabelGrid grid;
    grid.lattice = cube_of(n);
    grid.has_spacing = true;
    grid.numbers = {0, 1, 2, 3};
    for_each_voxel(grid.lattice, [&](const glm::dvec3& p) {
        const int part = p.z > 0.1 ? 1 : p.x > 0 ? 2 : 3;
        grid.voxels.push_back(static_cast<std::uint8_t>(distance_to_solid(p) < 0 ? part : 0));
    });
    FromFile<LabelGrid> file;
    file.content = std::make_shared<const LabelGrid>(std::move(grid));
    return file;
}

// The row of a field, and that of the triangles of its surface.
struct Contest {
    int n;
    const Settings& settings;
    Table& table;

    void row(const std::string& what, double cells, double preparing, double building, std::size_t bytes,
             const RaceWithMesh& race, RaceWithMesh::Runner runner) {
        std::vector<Table::Cell> values{static_cast<double>(n),    what, cells, preparing, building,
                                        static_cast<double>(bytes)};
        std::ranges::copy(race.speeds(runner), std::back_inserter(values));
        table.row(std::move(values));
    }
    void run(const std::string& what, const Phased& object, PhaseSet opaque, double preparing, bool with_triangles) {
        double building = 0, of_triangles = 0;
        const auto field =
            timed([&] { return std::make_unique<FieldScene>(object, opaque, settings.quality()); }, building);
        const Triangles surface = surface_nets(*field, n);
        const auto triangles =
            timed([&] { return std::make_unique<MeshScene>(surface, RTC_BUILD_QUALITY_MEDIUM); }, of_triangles);
        const Rays primary = camera_rays(camera_for(field->cells().bounds()), settings.width, settings.height);
        const RaceWithMesh race = bench::race(*field, *triangles, primary, settings);
        if (with_triangles)
            row(fmt::format("{} triangles", surface.triangles.size()), 0, 0, of_triangles, triangles->bytes(), race,
                RaceWithMesh::triangles);
        row(what, static_cast<double>(field->cells().size()), preparing, building, field->bytes(), race,
            RaceWithMesh::field);
    }
};

}  // namespace

Report volumes(const Settings& settings) {
    Report report("volumes", "grids of voxels as fields, and triangles of the same surface in Embree");
    report.say(
        "a ring with two balls: as a level set with a narrow band of 3 voxels (volume), and as labels of three opaque "
        "phases; triangles by surface nets with as many cubes, Embree's medium build quality, not robust");
    report.say(fmt::format("rays: {}×{} camera rays, one per pixel; as many random rays from their hits; {} thread(s)",
                           settings.width, settings.height, settings.threads));
    report.say(
        "prepare: the slope of the level set, or blur and splines of the labels; build: cells and Embree's BVH, or for "
        "triangles the BVH alone; both are processor time on one thread");
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(settings.threads));
    std::vector<Column> columns{{"voxels", "voxels along an axis", "{:.0f}"},
                                {"what", "", ""},
                                {"cells", "cells", "{:.0f}"},
                                {"prepare_seconds", "prepare s", "{:.2f}"},
                                {"build_seconds", "build s", "{:.2f}"},
                                {"bytes", "MB", "{:.1f}", 1e-6}};
    std::ranges::copy(RaceWithMesh::columns(), std::back_inserter(columns));
    Table table(std::move(columns));
    for (int n = 64; n <= (settings.quick ? 128 : 512); n *= 2) {
        Contest contest{n, settings, table};
        double preparing = 0;
        const FromFile<VoxelGrid> grid = timed([&] { return level_set(n); }, preparing);
        contest.run("volume", Set{.phase = Phase{1}, .of = Volume{.file = grid}}, PhaseSet{0b10}, preparing, true);
        const FromFile<LabelGrid> labels = labels_of(n);
        const Phased object = timed(
            [&] {
                return Phased(Labels{.file = labels,
                                     .of_phases = {Phase{1}, Phase{2}, Phase{3}},
                                     .values = {},
                                     .empty = {},
                                     .grid = {}});
            },
            preparing);
        contest.run("labels", object, PhaseSet{0b1110}, preparing, false);
    }
    report.table("volumes", table);
    return report;
}

}  // namespace phasetree::bench
