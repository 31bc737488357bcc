// Which of a file's grids is read.
#include <doctest/doctest.h>

#include "phasetree/nodes/fields/voxel_grid.hpp"
#include "volume/vdb_folder.hpp"

namespace test_vdb_names {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

namespace fs = std::filesystem;

openvdb::FloatGrid::Ptr numbers(const std::string& name, float value) {
    auto grid = openvdb::FloatGrid::create(0);
    grid->tree().setValueOn({0, 0, 0}, value);
    grid->setName(name);
    return grid;
}
float greatest_in(const fs::path& path, const std::string& grid) {
    return tracer::read_number_grid(path, grid).grid.greatest();
}

}  // namespace

TEST_CASE("grids of one name are told apart by their index, as OpenVDB counts them") {
    const VdbFolder folder;
    const fs::path path =
        folder.write("three.vdb", {numbers("smoke", 1), numbers("fire", 2), numbers("smoke", 3), numbers("smoke", 4)});
    CHECK(greatest_in(path, "smoke[0]") == 1);
    CHECK(greatest_in(path, "smoke[1]") == 3);
    CHECK(greatest_in(path, "smoke[2]") == 4);
    CHECK(greatest_in(path, "fire") == 2);
    openvdb::io::File file(path.string());
    file.open(false);
    for (const char* name : {"smoke[0]", "smoke[1]", "smoke[2]"}) {
        const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid(name));
        CHECK(greatest_in(path, name) == grid->tree().getValue({0, 0, 0}));
    }
    CHECK(said_of_numbers(path, "smoke") ==
          "it has several grids called \"smoke\"; choose one by its index: \"smoke[0]\" (float), \"smoke[1]\" (float), "
          "\"smoke[2]\" (float)");
    CHECK(said_of_numbers(path, "smoke[3]") ==
          "it has no grid \"smoke[3]\"; it has \"fire\" (float), \"smoke[0]\" (float), \"smoke[1]\" (float), "
          "\"smoke[2]\" (float)");
}

TEST_CASE("a name with brackets of its own, and grids without a name") {
    const VdbFolder folder;
    const fs::path brackets = folder.write("brackets.vdb", {numbers("smoke[1]", 1), numbers("smoke", 2)});
    CHECK(greatest_in(brackets, "smoke[1]") == 1);
    CHECK(greatest_in(brackets, "smoke") == 2);
    const fs::path unnamed = folder.write("unnamed.vdb", {numbers("", 1), numbers("", 2)});
    CHECK(greatest_in(unnamed, "[1]") == 2);
    CHECK(said_of_numbers(unnamed) ==
          "it has several grids of numbers; choose one with \"grid\": \"[0]\" (float), \"[1]\" (float)");
    CHECK(greatest_in(folder.write("one.vdb", {numbers("", 1)}), "") == 1);
}

TEST_CASE("of two grids with one name the one of the wanted kind is read") {
    const VdbFolder folder;
    auto wind = openvdb::Vec3SGrid::create();
    wind->setName("smoke");
    auto labels = openvdb::Int32Grid::create(0);
    labels->setName("smoke");
    labels->tree().setValueOn({0, 0, 0}, 5);
    const fs::path path = folder.write("kinds.vdb", {wind, labels, numbers("smoke", 3)});
    CHECK(greatest_in(path, "smoke") == 3);
    CHECK(greatest_in(path, "") == 3);
    CHECK(said_of_labels(path, "smoke") == "nothing");
    CHECK(said_of_numbers(path, "smoke[0]") ==
          "its grid \"smoke[0]\": it is a grid of vec3s, but numbers are floats or doubles");
    CHECK(said_of_level_set(path) ==
          "none of its grids is a level set; it has \"smoke[0]\" (vec3s), \"smoke[1]\" (int32), \"smoke[2]\" (float)");
}

TEST_CASE("a long list of grids is cut") {
    const VdbFolder folder;
    openvdb::GridCPtrVec grids;
    for (int i = 0; i < 20; ++i) grids.push_back(numbers(std::to_string(100 + i) + std::string(100, 'x'), 1));
    const std::string said = said_of_numbers(folder.write("many.vdb", grids));
    CHECK(said.starts_with("it has several grids of numbers; choose one with \"grid\": \"100xxx"));
    CHECK(said.ends_with("x…\" (float) and 12 more"));
    CHECK(said.size() < 600);
}

}  // namespace test_vdb_names
