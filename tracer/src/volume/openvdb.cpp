// Grids in OpenVDB files (Museth, "VDB: High-Resolution Sparse Volumes with Dynamic Topology", 2013), by the OpenVDB
// library. Its headers are heavy, and are included here alone.
//
// A grid's values are in leaves of 8³ voxels and in tiles of one value; blocks of a VoxelGrid are laid on the leaves.
// OpenVDB believes what a file claims, so vdb_structure.hpp looks at the claims first.
#include <fmt/format.h>
#include <openvdb/io/File.h>
#include <openvdb/math/Maps.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "phasetree_support/reading.hpp"
#include "volume/formats.hpp"
#include "volume/label_numbers.hpp"
#include "volume/number_grid.hpp"
#include "volume/vdb_structure.hpp"

namespace phasetree::tracer {

namespace {

using openvdb::CoordBBox, openvdb::GridBase;

// Runs what calls OpenVDB. Its messages quote files, so they are not handed on.
template <class Read>
auto by_openvdb(const Read& read) {
    static const bool is_ready = (openvdb::initialize(), true);
    (void)is_ready;
    try {
        return read();
    } catch (const openvdb::Exception&) {
        throw std::runtime_error("it is damaged, or of a version that this program's OpenVDB does not know");
    }
}

// What one of several kinds of grids is called in sentences.
std::string kind_of(const GridBase& grid) {
    const std::string& type = grid.valueType();
    for (const char* known : {"float", "double", "bool", "int32", "int64", "vec3s", "vec3d", "vec3i", "ptdataidx32"})
        if (type == known) return fmt::format("a grid of {}", known);
    return "a grid of another kind";
}

bool is_level_set(const GridBase& grid) {
    return (grid.isType<openvdb::FloatGrid>() || grid.isType<openvdb::DoubleGrid>()) &&
           grid.getGridClass() == openvdb::GRID_LEVEL_SET;
}
bool has_whole_numbers(const GridBase& grid) {
    return grid.isType<openvdb::Int32Grid>() || grid.isType<openvdb::Int64Grid>();
}

bool has_numbers(const GridBase& grid) {
    return (grid.isType<openvdb::FloatGrid>() || grid.isType<openvdb::DoubleGrid>()) &&
           grid.getGridClass() != openvdb::GRID_LEVEL_SET;
}

std::string why_no_level_set(const GridBase& grid) {
    if (!grid.isType<openvdb::FloatGrid>() && !grid.isType<openvdb::DoubleGrid>())
        return fmt::format("it is {}, but a level set has floats or doubles", kind_of(grid));
    if (grid.getGridClass() == openvdb::GRID_FOG_VOLUME)
        return "it is a fog volume, not a level set: the \"density_grid\" of a material takes it as it is, and "
               "OpenVDB's "
               "tools make a level set of it with the isovalue that is wanted";
    return "it is not marked as a level set (its \"class\")";
}
std::string why_no_labels(const GridBase& grid) {
    return fmt::format("it is {}, but labels are int32 or int64", kind_of(grid));
}
std::string why_no_numbers(const GridBase& grid) {
    if (is_level_set(grid))
        return "it is a level set, whose numbers are distances; OpenVDB's tools make a fog volume of it";
    return fmt::format("it is {}, but numbers are floats or doubles", kind_of(grid));
}

// What wanted grids are called in sentences.
struct GridsCalled {
    const char* one;
    const char* several;
};

// Reads the grid of a name, or the only one that will do.
template <class IsWanted, class WhyNot>
GridBase::Ptr read_grid(const std::filesystem::path& path, const std::string& name, const GridsCalled& called,
                        const IsWanted& is_wanted, const WhyNot& why_not) {
    check_vdb_structure(path);
    openvdb::io::File file(path.string());
    file.setCopyMaxBytes(0);
    file.open(false);
    std::vector<std::string> wanted;
    std::optional<std::string> refused;
    std::size_t all = 0;
    const openvdb::GridPtrVecPtr grids = file.readAllGridMetadata();
    for (const GridBase::Ptr& grid : *grids) {
        ++all;
        if (!name.empty() && grid->getName() != name) continue;
        if (is_wanted(*grid))
            wanted.push_back(grid->getName());
        else if (!refused)
            refused = why_not(*grid);
    }
    if (!name.empty() && wanted.empty())
        throw std::runtime_error(refused    ? fmt::format("of its grid \"{}\": {}", name, *refused)
                                 : all == 1 ? fmt::format("its only grid is not called \"{}\"", name)
                                            : fmt::format("none of its {} grids is called \"{}\"", all, name));
    if (all == 0) throw std::runtime_error("it has no grids");
    if (wanted.empty())
        throw std::runtime_error(all == 1 ? *refused : fmt::format("none of its {} grids is {}", all, called.one));
    if (wanted.size() > 1)
        throw std::runtime_error(
            name.empty() ? fmt::format("{} of its grids are {}: \"grid\" must name one", wanted.size(), called.several)
                         : fmt::format("{} of its grids are called \"{}\"", wanted.size(), name));
    GridBase::Ptr grid = file.readGrid(wanted.front());
    std::error_code ignored;
    support::ReadingPlace().finished(std::filesystem::file_size(path, ignored));
    return grid;
}

// Where a grid's voxels are; they must lie along the axes. `box` are the voxels that are taken of it.
VoxelLattice lattice_of(const GridBase& grid, const CoordBBox& box) {
    const openvdb::math::Transform& map = grid.transform();
    const openvdb::Vec3d origin = map.indexToWorld(openvdb::Vec3d(0, 0, 0));
    VoxelLattice lattice;
    for (int i = 0; i < 3; ++i) {
        openvdb::Vec3d along(0, 0, 0);
        along[i] = 1;
        const openvdb::Vec3d step = map.indexToWorld(along) - origin;
        for (int j = 0; j < 3; ++j)
            if (i == j ? !(step[j] > 0) : std::abs(step[j]) > 1e-9 * std::abs(step[i]))
                throw std::runtime_error(
                    "its voxels do not lie along the axes: a turned grid must be stored as it was before it was "
                    "turned, and be turned in the scene");
        lattice.spacing[i] = step[i];
        const long long size = static_cast<long long>(box.max()[i]) - box.min()[i] + 1;
        if (!map.isLinear()) throw std::runtime_error("its voxels are not of one size");
        if (size > VoxelGrid::most_along_axis)
            throw std::runtime_error(
                fmt::format("it has {} voxels along an axis; at most {} can be", size, VoxelGrid::most_along_axis));
        lattice.size[static_cast<std::size_t>(i)] = static_cast<int>(size);
        lattice.first[i] = origin[i] + step[i] * box.min()[i];
    }
    return lattice;
}

// The active voxels and some around, from and up to whole leaves.
CoordBBox active_leaves(const GridBase& grid, int around) {
    CoordBBox box = grid.evalActiveVoxelBoundingBox();
    if (box.empty()) throw std::runtime_error("its grid has no active voxels");
    constexpr int far = 1 << 30;
    for (int i = 0; i < 3; ++i)
        if (box.min()[i] < -far || box.max()[i] > far) throw std::runtime_error("it has voxels too far away");
    box.expand(around);
    for (int i = 0; i < 3; ++i) {
        box.min()[i] &= ~7;
        box.max()[i] |= 7;
    }
    return box;
}

// The values of the voxels in a box, which all leaves are within, of active_leaves().
template <class Grid, class Value>
VoxelGrid voxels_of(const Grid& grid, const CoordBBox& box, const VoxelLattice& lattice, const char* who,
                    const Value& value) {
    const auto at = grid.getConstAccessor();
    return VoxelGrid::make(who, lattice, [&](const std::array<int, 3>& before, std::span<float, 1000> values) {
        const openvdb::Coord corner = box.min().offsetBy(before[0], before[1], before[2]);
        const float first = value(at.getValue(corner.offsetBy(1)));
        bool is_flat = true;
        for (int i = 0; i < 27 && is_flat; ++i) {
            const openvdb::Coord there =
                corner.offsetBy(1 + 8 * (i % 3 - 1), 1 + 8 * (i / 3 % 3 - 1), 1 + 8 * (i / 9 - 1));
            is_flat = !at.probeConstLeaf(there) && value(at.getValue(there)) == first;
        }
        if (is_flat) {
            std::ranges::fill(values, first);
            return;
        }
        float* to = values.data();
        for (int z = 0; z < 10; ++z)
            for (int y = 0; y < 10; ++y)
                for (int x = 0; x < 10; ++x) *to++ = value(at.getValue(corner.offsetBy(x, y, z)));
    });
}

template <class Grid>
VoxelGrid level_set_of(const Grid& grid) {
    // The background is all around.
    const CoordBBox box = active_leaves(grid, 1);
    const VoxelLattice lattice = lattice_of(grid, box);
    const glm::dvec3& h = lattice.spacing;
    if (std::abs(h.x - h.y) > 1e-6 * h.x || std::abs(h.x - h.z) > 1e-6 * h.x)
        throw std::runtime_error("its voxels are no cubes");
    if (!(static_cast<double>(grid.background()) > 0))
        throw std::runtime_error("its background is not positive, so that it has no outside");
    // What is next to the box is the background.
    return voxels_of(grid, box, lattice, "volume", [](auto v) { return static_cast<float>(v); });
}

template <class Grid>
VoxelGrid numbers_of(const Grid& grid) {
    // A frame of a simulation may have nothing yet.
    if (grid.evalActiveVoxelBoundingBox().empty()) return number_grid({.size = {1, 1, 1}}, {{0.0f}});
    if (static_cast<double>(grid.background()) != 0)
        throw std::runtime_error("its background is not 0, so that it is without end");
    const CoordBBox box = active_leaves(grid, 1);
    return voxels_of(grid, box, lattice_of(grid, box), "voxels",
                     [](auto v) { return number_at_voxel(static_cast<float>(v)); });
}

template <class Grid>
LabelGrid labels_of(const Grid& grid) {
    CoordBBox box = grid.evalActiveVoxelBoundingBox();
    if (box.empty()) throw std::runtime_error("its grid has no active voxels");
    // What is around is the background, so that what is next to it has a surface.
    box.expand(2);
    LabelGrid found;
    found.lattice = lattice_of(grid, box);
    found.has_spacing = true;
    found.voxels.reserve(checked_count(found.lattice.size));
    LabelNumbers numbers(found);
    const auto at = grid.getConstAccessor();
    for (int z = box.min().z(); z <= box.max().z(); ++z)
        for (int y = box.min().y(); y <= box.max().y(); ++y)
            for (int x = box.min().x(); x <= box.max().x(); ++x) {
                const auto number = static_cast<std::int64_t>(at.getValue({x, y, z}));
                if (number != static_cast<std::int32_t>(number))
                    throw std::runtime_error("it has a number that does not fit into 32 bits");
                found.voxels.push_back(numbers.index_of(static_cast<std::int32_t>(number)));
            }
    return found;
}

}  // namespace

VoxelGrid level_set_of_openvdb(const std::filesystem::path& path, const std::string& name) {
    return by_openvdb([&] {
        const GridBase::Ptr grid = read_grid(path, name, {"a level set", "level sets"}, is_level_set, why_no_level_set);
        if (const auto floats = openvdb::gridConstPtrCast<openvdb::FloatGrid>(grid)) return level_set_of(*floats);
        return level_set_of(*openvdb::gridConstPtrCast<openvdb::DoubleGrid>(grid));
    });
}

LabelGrid labels_of_openvdb(const std::filesystem::path& path, const std::string& name) {
    return by_openvdb([&] {
        const GridBase::Ptr grid =
            read_grid(path, name, {"one of whole numbers", "of whole numbers"}, has_whole_numbers, why_no_labels);
        if (const auto ints = openvdb::gridConstPtrCast<openvdb::Int32Grid>(grid)) return labels_of(*ints);
        return labels_of(*openvdb::gridConstPtrCast<openvdb::Int64Grid>(grid));
    });
}

VoxelGrid numbers_of_openvdb(const std::filesystem::path& path, const std::string& name) {
    return by_openvdb([&] {
        const GridBase::Ptr grid = read_grid(path, name, {"one of numbers", "of numbers"}, has_numbers, why_no_numbers);
        if (const auto floats = openvdb::gridConstPtrCast<openvdb::FloatGrid>(grid)) return numbers_of(*floats);
        return numbers_of(*openvdb::gridConstPtrCast<openvdb::DoubleGrid>(grid));
    });
}

bool can_read_openvdb() {
    return true;
}
std::string openvdb_version() {
    return OPENVDB_LIBRARY_VERSION_STRING;
}

}  // namespace phasetree::tracer
