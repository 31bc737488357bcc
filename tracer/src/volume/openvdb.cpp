// Reads grids from and writes them to OpenVDB files (Museth, "VDB: High-Resolution Sparse Volumes with Dynamic
// Topology", 2013) with the OpenVDB library. Its headers are large, so only this file includes them.
//
// A grid stores values in leaves of 8³ voxels and in constant tiles; blocks of a VoxelGrid are aligned with the leaves.
// OpenVDB trusts files, so vdb_structure.hpp checks them first.
#include <fmt/format.h>
#include <openvdb/io/File.h>
#include <openvdb/math/Maps.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "phasetree_support/reading.hpp"
#include "volume/formats.hpp"
#include "volume/label_numbers.hpp"
#include "volume/label_volume.hpp"
#include "volume/number_grid.hpp"
#include "volume/vdb_choice.hpp"
#include "volume/vdb_lattice.hpp"
#include "volume/vdb_structure.hpp"

namespace phasetree::tracer {

namespace {

using openvdb::CoordBBox, openvdb::GridBase;

// Runs code that calls OpenVDB. Its messages quote files, so they are replaced.
template <class Read>
auto by_openvdb(const Read& read) {
    static const bool is_ready = (openvdb::initialize(), true);
    (void)is_ready;
    try {
        return read();
    } catch (const openvdb::Exception&) {
        throw std::runtime_error("it is damaged, or written by a newer version of OpenVDB than this build supports");
    }
}

std::string kind_of(const GridBase& grid) {
    return fmt::format("a grid of {}", grid.valueType());
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
        return "it is a fog volume, not a level set: use it as the \"density_grid\" of a material, or convert it to a "
               "level set with OpenVDB's tools";
    return "it is not marked as a level set (its \"class\")";
}
std::string why_no_labels(const GridBase& grid) {
    return fmt::format("it is {}, but labels are int32 or int64", kind_of(grid));
}
std::string why_no_numbers(const GridBase& grid) {
    if (is_level_set(grid))
        return "it is a level set, whose numbers are distances; convert it to a fog volume with OpenVDB's tools";
    return fmt::format("it is {}, but numbers are floats or doubles", kind_of(grid));
}

// Reads the grid with this name, or the only suitable one.
template <class IsWanted, class WhyNot>
GridBase::Ptr read_grid(const std::filesystem::path& path, const std::string& name, const GridsCalled& called,
                        const IsWanted& is_wanted, const WhyNot& why_not) {
    check_vdb_structure(path);
    openvdb::io::File file(path.string());
    file.setCopyMaxBytes(0);
    file.open(false);
    GridBase::Ptr grid = file.readGrid(chosen_grid(grids_of(file), name, called, is_wanted, why_not));
    // Names in a damaged file may lead to another grid.
    if (!is_wanted(*grid)) throw std::runtime_error("it is damaged: two of its grids have the same name and index");
    std::error_code ignored;
    support::ReadingPlace().finished(std::filesystem::file_size(path, ignored));
    return grid;
}

// The bounding box of the active voxels, enlarged by `around`.
CoordBBox active_voxels(const GridBase& grid, int around) {
    CoordBBox box = grid.evalActiveVoxelBoundingBox();
    if (box.empty()) throw std::runtime_error("its grid has no active voxels");
    constexpr int far = 1 << 30;
    for (int i = 0; i < 3; ++i)
        if (box.min()[i] < -far || box.max()[i] > far) throw std::runtime_error("it has voxels too far away");
    box.expand(around);
    return box;
}

// As active_voxels(), extended to whole leaves.
CoordBBox active_leaves(const GridBase& grid, int around) {
    CoordBBox box = active_voxels(grid, around);
    for (int i = 0; i < 3; ++i) {
        box.min()[i] &= ~7;
        box.max()[i] |= 7;
    }
    return box;
}

// Whether the blocks from that of voxel `low` to that of voxel `high`, at most 16 voxels apart along each axis, lie in
// constant tiles of 128³ voxels or more that have this value. A grid whose voxels are far apart consists mostly of
// them.
template <class Accessor, class Value>
bool are_in_tiles_of(float wanted, const Accessor& at, const openvdb::Coord& low, const openvdb::Coord& high,
                     const Value& value) {
    constexpr int depth_of_tiles = 1;
    for (int corner = 0; corner < 8; ++corner) {
        openvdb::Coord there = low;
        bool is_repeated = false;  // in the same tile as another corner
        for (int i = 0; i < 3; ++i) {
            if (!(corner >> i & 1)) continue;
            there[i] = high[i];
            is_repeated = is_repeated || low[i] >> 7 == high[i] >> 7;
        }
        if (is_repeated) continue;
        if (at.getValueDepth(there) > depth_of_tiles || value(at.getValue(there)) != wanted) return false;
    }
    return true;
}

// The values of voxels in the order of a lattice whose blocks coincide with leaves, like those of active_leaves().
template <class Grid, class Value>
VoxelGrid voxels_of(const Grid& grid, const OrderedLattice& voxels, const char* who, const Value& value) {
    const auto at = grid.getConstAccessor();
    return VoxelGrid::make(who, voxels.lattice, [&](const std::array<int, 3>& before, std::span<float, 1000> values) {
        const auto voxel = [&](int x, int y, int z) {
            return voxels.order(before[0] + x, before[1] + y, before[2] + z);
        };
        const float first = value(at.getValue(voxel(1, 1, 1)));
        const bool is_in_tiles = are_in_tiles_of(first, at, voxel(-7, -7, -7), voxel(9, 9, 9), value);
        bool is_flat = true;
        for (int i = 0; i < 27 && is_flat && !is_in_tiles; ++i) {
            const openvdb::Coord there = voxel(1 + 8 * (i % 3 - 1), 1 + 8 * (i / 3 % 3 - 1), 1 + 8 * (i / 9 - 1));
            is_flat = !at.probeConstLeaf(there) && value(at.getValue(there)) == first;
        }
        if (is_flat) {
            std::ranges::fill(values, first);
            return;
        }
        float* to = values.data();
        for (int z = 0; z < 10; ++z)
            for (int y = 0; y < 10; ++y)
                for (int x = 0; x < 10; ++x) *to++ = value(at.getValue(voxel(x, y, z)));
    });
}

template <class Grid>
VoxelGrid level_set_of(const Grid& grid) {
    // Include a layer of background all around.
    const CoordBBox box = active_leaves(grid, 1);
    if (!(static_cast<double>(grid.background()) > 0))
        throw std::runtime_error("its background is not positive, so it has no outside");
    // The background surrounds the box.
    return voxels_of(grid, lattice_of(grid, box), "volume", [](auto v) { return static_cast<float>(v); });
}

// Grids of numbers may be rotated or sheared. The grid's own space then has axes along those of the index space, with
// the world's unit of length.
OrderedLattice lattice_of_own_space(const GridBase& grid, const CoordBBox& box, PlacedVoxels& placed) {
    if (auto found = lattice_along_axes(grid, box)) return *std::move(found);
    OrderedLattice own{{.size = size_of(box)}, VoxelOrder(box)};
    placed.linear = steps_of(grid);
    for (int i = 0; i < 3; ++i) {
        own.lattice.spacing[i] = glm::length(placed.linear[i]);
        placed.linear[i] /= own.lattice.spacing[i];
    }
    placed.translation = centre_of(grid, box.min());
    return own;
}

template <class Grid>
PlacedVoxels numbers_of(const Grid& grid) {
    PlacedVoxels placed;
    // The grid may be empty, for example in the first frame of a simulation.
    if (grid.evalActiveVoxelBoundingBox().empty()) {
        placed.grid = number_grid({.size = {1, 1, 1}}, {0.0f});
        return placed;
    }
    if (static_cast<double>(grid.background()) != 0)
        throw std::runtime_error("its background is not 0, so it would be infinite");
    const OrderedLattice lattice = lattice_of_own_space(grid, active_leaves(grid, 1), placed);
    placed.grid = voxels_of(grid, lattice, "voxels", [](auto v) { return number_at_voxel(static_cast<float>(v)); });
    return placed;
}

template <class Grid>
LabelGrid labels_of(const Grid& grid) {
    // The surrounding background gives the outermost voxels a surface.
    const auto [lattice, order] = lattice_of(grid, active_voxels(grid, 2));
    LabelGrid found;
    found.lattice = lattice;
    found.has_spacing = true;
    found.voxels.reserve(checked_count(lattice.size));
    LabelNumbers numbers(found);
    const auto at = grid.getConstAccessor();
    for (int z = 0; z < lattice.size[2]; ++z)
        for (int y = 0; y < lattice.size[1]; ++y)
            for (int x = 0; x < lattice.size[0]; ++x) {
                const auto number = static_cast<std::int64_t>(at.getValue(order(x, y, z)));
                if (number != static_cast<std::int32_t>(number))
                    throw std::runtime_error("it has a number that does not fit in 32 bits");
                found.voxels.push_back(numbers.index_of(static_cast<std::int32_t>(number)));
            }
    return found;
}

// The leaf of 8³ voxels with this first voxel; voxels outside the volume are vacuum. Nothing if all labels are equal;
// then `all` is set.
std::optional<std::array<std::uint8_t, 512>> leaf_at(const LabelVolume& volume, const std::array<std::size_t, 3>& first,
                                                     std::uint8_t& all) {
    std::array<std::uint8_t, 512> labels{};
    for (std::size_t z = 0; z < std::min<std::size_t>(8, volume.size[2] - first[2]); ++z)
        for (std::size_t y = 0; y < std::min<std::size_t>(8, volume.size[1] - first[1]); ++y) {
            const std::size_t row = ((first[2] + z) * volume.size[1] + first[1] + y) * volume.size[0] + first[0];
            for (std::size_t x = 0; x < std::min<std::size_t>(8, volume.size[0] - first[0]); ++x)
                labels[(z * 8 + y) * 8 + x] = volume.labels[row + x];
        }
    all = labels.front();
    if (std::ranges::all_of(labels, [&](std::uint8_t label) { return label == all; })) return std::nullopt;
    return labels;
}

// Writes what openvdb::io::File would write, with an index of the grids, which openvdb::io::Stream leaves out.
struct FileInMemory : openvdb::io::Archive {
    void write_to(std::ostream& file, const openvdb::GridCPtrVec& grids) {
        setCompression(openvdb::io::COMPRESS_ACTIVE_MASK | openvdb::io::COMPRESS_ZIP);
        constexpr bool has_index = true;
        write(file, grids, has_index);
    }
};

openvdb::Int32Grid::Ptr grid_of(const LabelVolume& volume, const std::function<bool()>& cancelled) {
    const openvdb::Int32Grid::Ptr grid = openvdb::Int32Grid::create(0);
    openvdb::Int32Tree& tree = grid->tree();
    std::array<std::size_t, 3> first{};
    for (first[2] = 0; first[2] < volume.size[2]; first[2] += 8) {
        if (cancelled()) throw LabelsCancelled();
        for (first[1] = 0; first[1] < volume.size[1]; first[1] += 8)
            for (first[0] = 0; first[0] < volume.size[0]; first[0] += 8) {
                const openvdb::Coord at(static_cast<int>(first[0]), static_cast<int>(first[1]),
                                        static_cast<int>(first[2]));
                std::uint8_t all = 0;
                const auto leaf = leaf_at(volume, first, all);
                if (!leaf && all != 0) tree.addTile(1, at, all, true);
                if (!leaf) continue;
                openvdb::Int32Tree::LeafNodeType& there = *tree.touchLeaf(at);
                for (int i = 0; i < 512; ++i)
                    if (const std::uint8_t label = (*leaf)[static_cast<std::size_t>(i)])
                        there.setValueOn(at.offsetBy(i % 8, i / 8 % 8, i / 64), label);
            }
    }
    openvdb::tools::prune(tree);
    grid->setName("labels");
    openvdb::math::Transform::Ptr transform = openvdb::math::Transform::createLinearTransform(volume.spacing);
    transform->postTranslate({volume.origin.x, volume.origin.y, volume.origin.z});
    grid->setTransform(transform);
    for (std::size_t label = 0; label < volume.phases.size(); ++label)
        grid->insertMeta(fmt::format("phase_{}", label), openvdb::StringMetadata(volume.phases[label].name));
    if (!volume.unit.empty()) grid->insertMeta("unit", openvdb::StringMetadata(volume.unit));
    return grid;
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
            read_grid(path, name, {"a grid of integers", "grids of integers"}, has_whole_numbers, why_no_labels);
        if (const auto ints = openvdb::gridConstPtrCast<openvdb::Int32Grid>(grid)) return labels_of(*ints);
        return labels_of(*openvdb::gridConstPtrCast<openvdb::Int64Grid>(grid));
    });
}

PlacedVoxels numbers_of_openvdb(const std::filesystem::path& path, const std::string& name) {
    return by_openvdb([&] {
        const GridBase::Ptr grid =
            read_grid(path, name, {"a grid of numbers", "grids of numbers"}, has_numbers, why_no_numbers);
        if (const auto floats = openvdb::gridConstPtrCast<openvdb::FloatGrid>(grid)) return numbers_of(*floats);
        return numbers_of(*openvdb::gridConstPtrCast<openvdb::DoubleGrid>(grid));
    });
}

std::string labels_as_openvdb(const LabelVolume& volume, const std::function<bool()>& cancelled) {
    return by_openvdb([&] {
        const openvdb::Int32Grid::Ptr grid = grid_of(volume, cancelled);
        std::ostringstream file(std::ios::binary);
        FileInMemory().write_to(file, {grid});
        return std::move(file).str();
    });
}

bool can_read_openvdb() {
    return true;
}
std::string openvdb_version() {
    return OPENVDB_LIBRARY_VERSION_STRING;
}

}  // namespace phasetree::tracer
