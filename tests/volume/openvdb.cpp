// Level sets, labels and numbers from OpenVDB files, against OpenVDB's own sampling; and what files are rejected for.
#include "volume/read_volume.hpp"

#include <doctest/doctest.h>

#ifdef PHASETREE_HAS_OPENVDB

#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <cstring>

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/volume.hpp"
#include "phasetree/nodes/phased/labels.hpp"
#include "support/random_voxels.hpp"
#include "volume/vdb_folder.hpp"

// Suppresses a report of the leak sanitizer. OpenVDB 10 leaks the node that it is reading when a file ends too early,
// because RootNode::readTopology() holds it by a plain pointer while it throws.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
    return "leak:readTopology";
}

namespace test_openvdb {

using namespace phasetree;
using namespace phasetree::tests;
using phasetree::support::bytes_of;

namespace {

namespace fs = std::filesystem;

openvdb::FloatGrid::Ptr ball(double radius, const openvdb::Vec3f& at, float voxel, const std::string& name) {
    auto grid = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(static_cast<float>(radius), at, voxel);
    grid->setName(name);
    return grid;
}

}  // namespace

TEST_CASE("a volume has the values that OpenVDB's own sampler has") {
    const VdbFolder folder;
    Random rng(631);
    double worst = 0;
    std::size_t inside = 0, points = 0;
    for (const std::uint32_t compression : {0u, 1u, 2u, 3u, 4u, 6u}) {
        const auto grid = ball(0.8, {0.3f, -0.2f, 1.1f}, 0.04f, "ball");
        // What no ball has: values that were moved.
        for (auto value = grid->beginValueOn(); value; ++value)
            value.setValue(*value + 0.01f * std::sin(static_cast<float>(value.getCoord().x())));
        const fs::path path = folder.write("ball.vdb", {grid}, compression);
        const VoxelGrid read = tracer::read_level_set(path, "");
        const Field volume = Volume{.file = held_content(read)};
        openvdb::tools::GridSampler<openvdb::FloatGrid, openvdb::tools::BoxSampler> sampler(*grid);
        for (int k = 0; k < 20'000; ++k, ++points) {
            const glm::vec3 p = glm::vec3(0.3f, -0.2f, 1.1f) +
                                (rng.chance(0.5) ? rng.uniform(0, 1) : rng.uniform(0.7f, 0.9f)) * rng.direction();
            const auto expected = static_cast<double>(sampler.wsSample(openvdb::Vec3d(p.x, p.y, p.z)));
            const double found = static_cast<double>(distance(volume, p)) * read.divided_by;
            worst = std::max(worst, std::abs(found - expected));
            inside += found < 0;
        }
    }
    MESSAGE(points, " points, ", inside, " inside; the greatest difference is ", worst);
    CHECK(points >= 100'000);
    CHECK(inside > points / 5);
    CHECK(worst < 3e-6);
}

TEST_CASE("grids of doubles and of halves, shifted and scaled") {
    const VdbFolder folder;
    auto doubles = openvdb::tools::createLevelSetSphere<openvdb::DoubleGrid>(0.5f, openvdb::Vec3f(1, 2, 3), 0.05f);
    const Field of_doubles = Volume{.file = held_content(tracer::read_level_set(folder.write("d.vdb", {doubles}), ""))};
    CHECK(distance(of_doubles, {1.5f, 2, 3}) == doctest::Approx(0).epsilon(0.01).scale(1));
    auto halves = ball(0.5, {0, 0, 0}, 0.05f, "h");
    halves->setSaveFloatAsHalf(true);
    const Field of_halves = Volume{.file = held_content(tracer::read_level_set(folder.write("h.vdb", {halves}), ""))};
    CHECK(distance(of_halves, {0.5f, 0, 0}) == doctest::Approx(0).epsilon(0.01).scale(1));
    CHECK(distance(of_halves, {0.42f, 0, 0}) < 0);
}

TEST_CASE("numbers have the values that OpenVDB's own sampler has, of clouds that reach over many blocks") {
    const VdbFolder folder;
    Random rng(633);
    auto cloud = openvdb::FloatGrid::create(0);
    const openvdb::Vec3d spacing(0.1, 0.2, 0.05);
    cloud->setTransform(openvdb::math::Transform::createLinearTransform(1.0));
    cloud->transform().preScale(spacing);
    cloud->transform().postTranslate({3, -1, 0.5});
    cloud->setGridClass(openvdb::GRID_FOG_VOLUME);
    cloud->setName("density");
    for (int i = 0; i < 4000; ++i) {
        const openvdb::Coord at(rng.below(40) - 20, rng.below(17), rng.below(70) + 5);
        cloud->tree().setValueOn(at, rng.uniform(0, 3));
    }
    // A tile of one value, as fill() leaves them.
    cloud->fill({{8, 0, 96}, {23, 15, 111}}, 1.5f);
    // What a solver leaves below 0 is nothing.
    cloud->tree().setValueOn({-20, 0, 5}, -0.25f);
    const VoxelGrid read = tracer::read_number_grid(folder.write("cloud.vdb", {cloud}), "").grid;
    cloud->tree().setValueOn({-20, 0, 5}, 0.0f);
    openvdb::tools::GridSampler<openvdb::FloatGrid, openvdb::tools::BoxSampler> sampler(*cloud);
    const openvdb::Vec3d low = cloud->indexToWorld(openvdb::Vec3d(-20, 0, 5)),
                         high = cloud->indexToWorld(openvdb::Vec3d(23, 16, 111));
    double worst = 0;
    int dense = 0;
    for (int k = 0; k < 50'000; ++k) {
        openvdb::Vec3d p;
        for (int i = 0; i < 3; ++i)
            p[i] = low[i] + (high[i] - low[i]) * static_cast<double>(rng.uniform(-0.02f, 1.02f));
        const auto expected = static_cast<double>(sampler.wsSample(p));
        const Vec3<float> at{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
        worst = std::max(worst, std::abs(static_cast<double>(voxels::linear_at(read.table.data(), at)) - expected));
        dense += expected > 0.01;
    }
    CHECK(dense > 5000);
    CHECK(worst < 1e-4);
    // Around what there is all is 0, so that it has no edge.
    const Bounds box = read.extent();
    for (const float share : {0.0f, 0.3f, 1.0f}) {
        const glm::vec3 p = box.low + glm::vec3(share, 0.5f, share) * box.extent();
        if (share != 0.3f) CHECK(voxels::linear_at(read.table.data(), Vec3<float>{p.x, p.y, p.z}) == 0.0f);
    }
}

TEST_CASE("voxels far apart, and tiles of 128³ voxels, are read where they are") {
    const VdbFolder folder;
    for (const int sign : {1, -1}) {
        auto sparse = openvdb::FloatGrid::create(0);
        // Negative steps mirror the grid.
        sparse->setTransform(openvdb::math::Transform::createLinearTransform(1.0));
        sparse->transform().preScale(openvdb::Vec3d(sign, 1, 1));
        sparse->setGridClass(openvdb::GRID_FOG_VOLUME);
        sparse->tree().setValueOn({0, 0, 0}, 2);
        sparse->tree().setValueOn({500, 300, 400}, 3);
        sparse->tree().addTile(2, {128, 128, 128}, 1.5f, true);
        sparse->tree().addTile(1, {256, 136, 128}, 0.5f, true);  // 8³ voxels next to the large tile
        const VoxelGrid read = tracer::read_number_grid(folder.write("sparse.vdb", {sparse}), "").grid;
        const auto at = sparse->getConstAccessor();
        int wrong = 0, dense = 0;
        const auto compare = [&](int x, int y, int z) {
            const Vec3<float> p{static_cast<float>(sign * x), static_cast<float>(y), static_cast<float>(z)};
            const float expected = at.getValue({x, y, z});
            dense += expected > 0;
            wrong += voxels::linear_at(read.table.data(), p) != expected;
        };
        for (int z = 0; z <= 400; z += 5)
            for (int y = 0; y <= 300; y += 5)
                for (int x = 0; x <= 500; x += 5) compare(x, y, z);
        for (const int edge : {127, 128, 255, 256, 263, 264})
            for (int a = 120; a <= 270; ++a)
                for (int b = 120; b <= 270; b += 7) {
                    compare(edge, a, b);
                    compare(a, edge, b);
                    compare(b, a, edge);
                }
        compare(500, 300, 400);
        CHECK(dense > 10'000);
        CHECK(wrong == 0);
    }
    auto apart = openvdb::FloatGrid::create(0);
    apart->setGridClass(openvdb::GRID_FOG_VOLUME);
    for (const int at : {0, 2000}) apart->tree().setValueOn(openvdb::Coord(at), 1);
    CHECK_THROWS_WITH(tracer::read_number_grid(folder.write("apart.vdb", {apart}), ""),
                      doctest::Contains("the grid spans 2016 × 2016 × 2016 voxels, or 16003008 blocks of 8 × 8 × 8 "
                                        "including empty ones, but the limit is 15000000 blocks"));
}

TEST_CASE("which grids of numbers are taken, and what the others are rejected for") {
    const VdbFolder folder;
    const auto named = [](const char* name, float background = 0) {
        auto grid = openvdb::FloatGrid::create(background);
        grid->tree().setValueOn({0, 0, 0}, 1);
        grid->setName(name);
        return grid;
    };
    const fs::path two = folder.write("two.vdb", {named("density"), named("temperature")});
    CHECK(said_of_numbers(two) ==
          "it has several grids of numbers; choose one with \"grid\": \"density\" (float), \"temperature\" (float)");
    CHECK(said_of_numbers(two, "density") == "nothing");
    CHECK(said_of_numbers(two, "flame") ==
          "it has no grid \"flame\"; it has \"density\" (float), \"temperature\" (float)");
    CHECK(said_of_numbers(folder.write("ball.vdb", {ball(1, {0, 0, 0}, 0.2f, "b")}))
              .starts_with("it is a level set, whose numbers are distances"));
    CHECK(said_of_numbers(folder.write("bg.vdb", {named("d", 0.5f)})) ==
          "its background is not 0, so it would be infinite");
    CHECK(said_of_numbers(folder.write("ints.vdb", {openvdb::Int32Grid::create(0)})) ==
          "it is a grid of int32, but numbers are floats or doubles");
    // A frame of a simulation in which there is nothing yet.
    const VoxelGrid nothing =
        tracer::read_number_grid(folder.write("empty.vdb", {openvdb::FloatGrid::create(0)}), "").grid;
    CHECK(voxels::linear_at(nothing.table.data(), Vec3<float>{0, 0, 0}) == 0.0f);
    const auto doubles = openvdb::DoubleGrid::create(0);
    doubles->tree().setValueOn({2, 1, 0}, 0.75);
    const VoxelGrid of_doubles = tracer::read_number_grid(folder.write("d.vdb", {doubles}), "").grid;
    CHECK(voxels::linear_at(of_doubles.table.data(), Vec3<float>{2, 1, 0}) == 0.75f);
}

TEST_CASE("labels are at OpenVDB's voxels what they are in the file") {
    const VdbFolder folder;
    auto grid = openvdb::Int32Grid::create(0);
    grid->setTransform(openvdb::math::Transform::createLinearTransform(0.1));
    Random rng(632);
    std::vector<std::pair<openvdb::Coord, int>> voxels;
    for (int i = 0; i < 3000; ++i) {
        const openvdb::Coord at(rng.below(20) - 11, rng.below(20), rng.below(20) + 5);
        const int number = 1 + rng.below(3);
        grid->tree().setValue(at, number);
        voxels.emplace_back(at, number);
    }
    const fs::path path = folder.write("labels.vdb", {grid});
    const Phased object = Labels{.file = held_content(tracer::read_label_grid(path, "")),
                                 .of_phases = {Phase{1}, Phase{2}, Phase{3}},
                                 .values = {},
                                 .empty = {},
                                 .grid = {}};
    std::size_t vacuum_around = 0;
    for (int z = 3; z < 28; ++z)
        for (int y = -2; y < 23; ++y)
            for (int x = -14; x < 12; ++x) {
                const openvdb::Vec3d p = grid->transform().indexToWorld(openvdb::Coord(x, y, z));
                const glm::vec3 at(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()));
                const int expected = grid->tree().getValue(openvdb::Coord(x, y, z));
                REQUIRE(label(distances(object, at)).index == expected);
                vacuum_around += expected == 0;
            }
    CHECK(vacuum_around > 1000);
}

TEST_CASE("one of several grids is read by its name") {
    const VdbFolder folder;
    auto fog = openvdb::FloatGrid::create(0);
    fog->setGridClass(openvdb::GRID_FOG_VOLUME);
    fog->setName("fog");
    fog->tree().setValue(openvdb::Coord(1, 2, 3), 1);
    auto whole = openvdb::Int32Grid::create(0);
    whole->setName("whole");
    whole->tree().setValue(openvdb::Coord(1, 2, 3), 1);
    const fs::path two = folder.write("two.vdb", {ball(0.5, {0, 0, 0}, 0.05f, "a"), ball(0.7, {0, 0, 0}, 0.05f, "b")});
    CHECK(tracer::read_level_set(two, "a").bytes() < tracer::read_level_set(two, "b").bytes());
    CHECK(said_of_level_set(two) ==
          "it has several level sets; choose one with \"grid\": \"a\" (float level set), \"b\" (float level set)");
    CHECK(said_of_level_set(two, "c") ==
          "it has no grid \"c\"; it has \"a\" (float level set), \"b\" (float level set)");
    const fs::path one = folder.write("one.vdb", {fog, ball(0.5, {0, 0, 0}, 0.05f, "a"), whole});
    CHECK(said_of_level_set(one) == "nothing");
    CHECK(said_of_labels(one) == "nothing");
    CHECK(said_of_level_set(one, "fog") ==
          "its grid \"fog\": it is a fog volume, not a level set: use it as the \"density_grid\" of a material, or "
          "convert it to a level set with OpenVDB's tools");
    const fs::path alone = folder.write("alone.vdb", {ball(0.5, {0, 0, 0}, 0.05f, "a")});
    CHECK(said_of_level_set(alone, "b") == "it has no grid \"b\"; it has \"a\" (float level set)");
    CHECK(said_of_level_set(one, "whole") ==
          "its grid \"whole\": it is a grid of int32, but a level set has floats or doubles");
    CHECK(said_of_labels(one, "fog") == "its grid \"fog\": it is a grid of float, but labels are int32 or int64");
    // A grid of vectors in a view's pyramid is passed over.
    auto wind = openvdb::Vec3SGrid::create();
    wind->setName("wind");
    wind->setTransform(openvdb::math::Transform::createFrustumTransform(openvdb::BBoxd({0, 0, 0}, {9, 9, 9}), 0.5, 2));
    CHECK(said_of_level_set(folder.write("wind.vdb", {wind, ball(0.5, {0, 0, 0}, 0.05f, "a")})) == "nothing");
    CHECK(said_of_level_set(folder.write("fog.vdb", {fog})).starts_with("it is a fog volume, not a level set"));
}

TEST_CASE("what is no level set is rejected, with what is wrong") {
    const VdbFolder folder;
    CHECK(said_of_level_set(folder.path("none.vdb")) == "no such file");
    CHECK(said_of_level_set(folder.write_bytes("a.obj", "x")) == "its name must end in .vdb");
    CHECK(said_of_level_set(folder.write_bytes("text.vdb", "This is no grid.")) == "it is not an OpenVDB file");
    CHECK(said_of_level_set(folder.write_bytes("empty.vdb", "")) == "it is not an OpenVDB file");
    CHECK(said_of_level_set(folder.write("no_grids.vdb", {})) == "it has no grids");
    auto empty = openvdb::FloatGrid::create(1);
    empty->setGridClass(openvdb::GRID_LEVEL_SET);
    CHECK(said_of_level_set(folder.write("e.vdb", {empty})) == "its grid has no active voxels");
    auto unknown = ball(0.5, {0, 0, 0}, 0.05f, "a");
    unknown->setGridClass(openvdb::GRID_UNKNOWN);
    CHECK(said_of_level_set(folder.write("u.vdb", {unknown})) == "it is not marked as a level set (its \"class\")");
    auto turned = ball(0.5, {0, 0, 0}, 0.05f, "a");
    turned->transform().preRotate(0.5);
    CHECK(said_of_level_set(folder.write("t.vdb", {turned})).starts_with("its voxels are not aligned with the axes"));
    auto negative = ball(0.5, {0, 0, 0}, 0.05f, "a");
    negative->tree().root().setBackground(-1, false);
    CHECK(said_of_level_set(folder.write("n.vdb", {negative})) ==
          "its background is not positive, so it has no outside");
    auto far = ball(0.5, {0, 0, 0}, 0.05f, "a");
    far->tree().setValue(openvdb::Coord(100000, 0, 0), 0.1f);
    CHECK(said_of_level_set(folder.write("f.vdb", {far})).find("voxels along an axis; the limit is 8192") !=
          std::string::npos);
    auto nan = ball(0.5, {0, 0, 0}, 0.05f, "a");
    nan->tree().setValue(openvdb::Coord(3, 2, 1), std::numeric_limits<float>::quiet_NaN());
    CHECK(said_of_level_set(folder.write("nan.vdb", {nan})).find("is too large, or not a number") != std::string::npos);
    auto steep = ball(0.5, {0, 0, 0}, 0.05f, "a");
    steep->tree().setValue(openvdb::Coord(10, 0, 0), 1e6f);
    CHECK(said_of_level_set(folder.write("steep.vdb", {steep})).find("so it is not a level set") != std::string::npos);
    auto many = openvdb::Int32Grid::create(0);
    for (int i = 0; i < 300; ++i) many->tree().setValue(openvdb::Coord(i, 0, 0), i);
    CHECK(said_of_labels(folder.write("m.vdb", {many})) == "it has more than 256 different numbers");
    auto wide = openvdb::Int64Grid::create(0);
    wide->tree().setValue(openvdb::Coord(0, 0, 0), std::int64_t{1} << 40);
    CHECK(said_of_labels(folder.write("w.vdb", {wide})) == "it has a number that does not fit in 32 bits");
    auto spread = openvdb::Int32Grid::create(0);
    spread->tree().setValue(openvdb::Coord(0, 0, 0), 1);
    spread->tree().setValue(openvdb::Coord(4000, 4000, 4000), 1);
    CHECK(said_of_labels(folder.write("spread.vdb", {spread})).find("in total") != std::string::npos);
}

TEST_CASE("a file that is cut off anywhere, or damaged anywhere, is rejected or read, in bounded memory") {
    const VdbFolder folder;
    const auto grid = ball(0.3, {0, 0, 0}, 0.05f, "ball");
    for (const std::uint32_t compression : {0u, 3u, 6u}) {
        const std::string whole = bytes_of(folder.write("whole.vdb", {grid}, compression));
        Random rng(633);
        for (int k = 0; k < 200; ++k) {
            const std::size_t length = k < 100 ? static_cast<std::size_t>(k) * 7
                                               : static_cast<std::size_t>(rng.below(static_cast<int>(whole.size())));
            if (length >= whole.size()) continue;
            CAPTURE(length);
            CHECK(said_of_level_set(folder.write_bytes("cut.vdb", whole.substr(0, length))) != "nothing");
        }
        std::size_t refused = 0;
        for (int k = 0; k < 400; ++k) {
            std::string bytes = whole;
            // Mostly in the head, where claims are; whole words of ones claim most.
            const std::size_t most = k % 3 == 0 ? whole.size() : std::min<std::size_t>(whole.size(), 2000);
            const auto at = static_cast<std::size_t>(rng.below(static_cast<int>(most) - 4));
            if (k % 2 == 0)
                bytes[at] = static_cast<char>(rng.below(256));
            else
                std::memset(&bytes[at], k % 4 == 1 ? 0xff : 0x7f, 4);
            refused += said_of_level_set(folder.write_bytes("damaged.vdb", bytes)) != "nothing";
        }
        MESSAGE("of 400 damaged files ", refused, " were rejected");
        CHECK(refused > 80);
    }
}

// OpenVDB reads four bytes of a float, whatever length the file gives it, and goes on at another place than one who
// believes the length. A file could hide there that it wants gigabytes.
TEST_CASE("a number in a file's metadata has the length of its type") {
    const VdbFolder folder;
    auto grid = ball(0.5, {0, 0, 0}, 0.1f, "ball");
    grid->insertMeta("a_float", openvdb::FloatMetadata(1.5f));
    grid->insertMeta("a_matrix", openvdb::Mat4DMetadata(openvdb::Mat4d::identity()));
    grid->insertMeta("a_vector", openvdb::Vec3DMetadata(openvdb::Vec3d(1, 2, 3)));
    const std::string bytes = bytes_of(folder.write("right.vdb", {grid}));
    REQUIRE(said_of_level_set(folder.write_bytes("copy.vdb", bytes)) == "nothing");
    for (const std::string type : {"float", "mat4d", "vec3d"}) {
        CAPTURE(type);
        std::string wrong = bytes;
        const std::string stored = std::string{static_cast<char>(type.size()), 0, 0, 0} + type;
        const std::size_t at = wrong.find(stored, wrong.find("a_")) + stored.size();
        REQUIRE(at < wrong.size());
        wrong[at] = static_cast<char>(wrong[at] + 4);
        CHECK(said_of_level_set(folder.write_bytes("wrong.vdb", wrong)) == "it is truncated or damaged");
    }
}

}  // namespace test_openvdb

#else

#include <string>

TEST_CASE("without OpenVDB its files are rejected in a sentence that says how they can be read") {
    CHECK_FALSE(phasetree::tracer::can_read_openvdb());
    try {
        (void)phasetree::tracer::read_level_set("ball.vdb", "");
        CHECK(false);
    } catch (const std::runtime_error& e) {
        CHECK(std::string(e.what()) ==
              "cannot use the volume \"ball.vdb\": this phasetree was built without OpenVDB; install libopenvdb-dev, "
              "or the library from openvdb.org, and rebuild");
    }
}

#endif
