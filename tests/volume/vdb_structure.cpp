// What OpenVDB writes is read, however many leaves it has and however they are stored; lies about lengths are rejected.
#include "volume/vdb_structure.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <set>

#include "phasetree/nodes/fields/voxel_grid.hpp"
#include "support/long_tests.hpp"
#include "support/random_tree.hpp"
#include "volume/vdb_folder.hpp"

namespace test_vdb_structure {

using namespace phasetree;
using namespace phasetree::tests;
using phasetree::support::bytes_of;

namespace {

namespace fs = std::filesystem;

// This many leaves in a block of 8 × 8 × 8, and a few whole numbers, which halves can hold, in each of them.
template <class Grid>
typename Grid::Ptr grid_of_leaves(int leaves, const std::string& name, bool is_half) {
    auto grid = Grid::create(0);
    grid->setName(name);
    grid->setSaveFloatAsHalf(is_half);
    Random rng(static_cast<std::uint64_t>(leaves));
    for (int i = 0; i < leaves; ++i)
        for (int k = 0; k < 3; ++k)
            grid->tree().setValue(
                openvdb::Coord(8 * (i % 8) + rng.below(8), 8 * (i / 8 % 8) + rng.below(8), 8 * (i / 64) + rng.below(8)),
                static_cast<typename Grid::ValueType>(1 + rng.below(200)));
    REQUIRE(static_cast<int>(grid->tree().leafCount()) == leaves);
    return grid;
}

// Whether all active voxels have their values.
template <class Grid>
bool is_read_as_numbers(const fs::path& path, const Grid& grid) {
    const VoxelGrid read = tracer::read_number_grid(path, grid.getName()).grid;
    const voxels::Table at(read.table.data());
    const glm::ivec3 first(read.lattice.first);
    for (auto value = grid.cbeginValueOn(); value; ++value) {
        const openvdb::Coord p = value.getCoord();
        if (at(p.x() - first.x, p.y() - first.y, p.z() - first.z) != static_cast<float>(*value)) return false;
    }
    return true;
}
template <class Grid>
bool is_read_as_labels(const fs::path& path, const Grid& grid) {
    const LabelGrid read = tracer::read_label_grid(path, grid.getName());
    const auto [nx, ny, nz] = read.lattice.size;
    const glm::ivec3 first(read.lattice.first);
    for (auto value = grid.cbeginValueOn(); value; ++value) {
        const openvdb::Coord p = value.getCoord();
        const auto at = p.x() - first.x + nx * (p.y() - first.y + ny * (p.z() - first.z));
        if (read.numbers[read.voxels[static_cast<std::size_t>(at)]] != static_cast<std::int32_t>(*value)) return false;
    }
    return true;
}

// Writes grids of all types, with and without halves, to one file, and reads each of them, or only looks at the file's
// structure.
bool are_read(const VdbFolder& folder, int leaves, std::uint32_t compression, bool with_values) {
    const auto floats = grid_of_leaves<openvdb::FloatGrid>(leaves, "float", false);
    const auto floats_as_halves = grid_of_leaves<openvdb::FloatGrid>(leaves, "float half", true);
    const auto doubles = grid_of_leaves<openvdb::DoubleGrid>(leaves, "double", false);
    const auto doubles_as_halves = grid_of_leaves<openvdb::DoubleGrid>(leaves, "double half", true);
    const auto ints = grid_of_leaves<openvdb::Int32Grid>(leaves, "int32", false);
    const auto ints_as_halves = grid_of_leaves<openvdb::Int32Grid>(leaves, "int32 half", true);
    const auto longs = grid_of_leaves<openvdb::Int64Grid>(leaves, "int64", false);
    const auto longs_as_halves = grid_of_leaves<openvdb::Int64Grid>(leaves, "int64 half", true);
    // Of fog volumes OpenVDB drops the flag for zlib.
    if (leaves % 2 == 0) floats->setGridClass(openvdb::GRID_FOG_VOLUME);
    const fs::path path = folder.write(
        "leaves.vdb",
        {floats, floats_as_halves, doubles, doubles_as_halves, ints, ints_as_halves, longs, longs_as_halves},
        compression);
    tracer::check_vdb_structure(path);
    return !with_values || (is_read_as_numbers(path, *floats) && is_read_as_numbers(path, *floats_as_halves) &&
                            is_read_as_numbers(path, *doubles) && is_read_as_numbers(path, *doubles_as_halves) &&
                            is_read_as_labels(path, *ints) && is_read_as_labels(path, *ints_as_halves) &&
                            is_read_as_labels(path, *longs) && is_read_as_labels(path, *longs_as_halves));
}

std::size_t end_of(const std::string& bytes, const std::string& text, std::size_t from = 0) {
    const std::size_t at = bytes.find(text, from);
    REQUIRE(at != std::string::npos);
    return at + text.size();
}
std::uint32_t word_at(const std::string& bytes, std::size_t at) {
    std::uint32_t word = 0;
    std::memcpy(&word, &bytes[at], sizeof word);
    return word;
}
void set_word(std::string& bytes, std::size_t at, std::uint32_t word) {
    std::memcpy(&bytes[at], &word, sizeof word);
}

}  // namespace

TEST_CASE("files of 1 to 300 leaves are read, whatever their values, halves and compression") {
    const VdbFolder folder;
    // OpenVDB pads arrays of 49 to 127 bytes, and leaves have arrays of one byte and of eight bytes each.
    const std::set<int> ends{1, 6, 7, 15, 16, 48, 49, 127, 128, 300};
    const std::array<std::uint32_t, 6> compressions{0, 1, 2, 3, 4, 6};
    const bool all = tests::long_tests();
    for (int leaves = 1; leaves <= 300; ++leaves)
        for (const std::uint32_t compression : compressions) {
            // The short form reads every third number of leaves with OpenVDB's default compression and one other, and
            // the numbers in `ends` with all of them.
            const bool is_default = compression == 6, is_end = ends.contains(leaves);
            if (!all && !is_end && leaves % 3 != 0) continue;
            if (!all && !is_default && !is_end && compressions[static_cast<std::size_t>(leaves % 5)] != compression)
                continue;
            CAPTURE(leaves);
            CAPTURE(compression);
            bool is_right = false;
            CHECK_NOTHROW(is_right = are_read(folder, leaves, compression, is_end));
            CHECK(is_right);
        }
}

TEST_CASE("metadata of a later version that is longer than today's is read") {
    const VdbFolder folder;
    const auto grid = grid_of_leaves<openvdb::FloatGrid>(60, "float", false);
    std::string bytes = bytes_of(folder.write("right.vdb", {grid}));
    const std::size_t length_at = end_of(bytes, "__delayedload"), length = word_at(bytes, length_at);
    set_word(bytes, length_at, static_cast<std::uint32_t>(length + 5));
    bytes.insert(length_at + 4 + length, "later");
    // What is behind it moves: the grid's blocks and its end, whose places are before the grid.
    const std::size_t places = end_of(bytes, "Tree_float_5_4_3") + 4;
    for (const std::size_t place : {places + 8, places + 16}) set_word(bytes, place, word_at(bytes, place) + 5);
    CHECK(is_read_as_numbers(folder.write_bytes("later.vdb", bytes), *grid));
}

// Blosc reads as many bytes as its own header says.
TEST_CASE("values whose Blosc header claims more bytes than there are, are rejected") {
    const VdbFolder folder;
    auto grid = openvdb::FloatGrid::create(0);
    grid->setName("float");
    Random rng(7);
    for (int i = 0; i < 512; ++i) grid->tree().setValue(openvdb::Coord(i % 8, i / 8 % 8, i / 64), rng.uniform(1, 2));
    const std::string bytes = bytes_of(folder.write("right.vdb", {grid}, 4));
    // The header of a leaf: two versions, flags, the size of a value, and the unpacked length.
    std::string header(4, '\0');
    set_word(header, 0, 2048);
    const std::size_t unpacked_at = end_of(bytes, header) - 4;
    REQUIRE(word_at(bytes, unpacked_at + 4) == 2048);  // of a block
    const std::size_t packed_at = unpacked_at + 8;
    REQUIRE(word_at(bytes, packed_at) == word_at(bytes, unpacked_at - 12));
    CHECK(said_of_numbers(folder.write_bytes("copy.vdb", bytes)) == "nothing");
    for (const std::size_t at : {unpacked_at, packed_at}) {
        std::string wrong = bytes;
        set_word(wrong, at, 1 << 30);
        CHECK(said_of_numbers(folder.write_bytes("wrong.vdb", wrong)) == "it is truncated or damaged");
    }
}

}  // namespace test_vdb_structure
