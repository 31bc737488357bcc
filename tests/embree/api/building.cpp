// Building: progress, and cells stored in files.
#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>

#include "embree/api/api.hpp"
#include "phasetree_support/temporary_directory.hpp"

namespace test_building {

using namespace phasetree;
using namespace phasetree::tests;
using phasetree::support::TemporaryDirectory;

namespace {

struct Told {
    std::vector<double> fractions;
    std::atomic<int> inside{0};
    int at_once = 0;
    int last = 1 << 30;  // this many calls say go on
};
bool tell(void* user, double fraction) {
    auto& told = *static_cast<Told*>(user);
    told.at_once = std::max(told.at_once, ++told.inside);
    told.fractions.push_back(fraction);
    const bool goes_on = static_cast<int>(told.fractions.size()) < told.last;
    --told.inside;
    return goes_on;
}

PhasetreeGeometryOptions telling(Told& told) {
    PhasetreeGeometryOptions options = embree::default_options();
    options.progress = tell;
    options.progressUserPtr = &told;
    return options;
}

}  // namespace

TEST_CASE("a build reports progress, by one thread at a time") {
    Device device;
    Told told;
    const embree::Geometry geometry(device, object_tree(), telling(told));
    REQUIRE(told.fractions.size() > 10);
    CHECK(std::is_sorted(told.fractions.begin(), told.fractions.end()));
    CHECK(told.fractions.front() > 0);
    CHECK(told.fractions.back() == 1);
    CHECK(told.at_once == 1);
    // Edits tell, too.
    Told of_edit;
    embree::Geometry edited(device, object_tree());
    edited.set_tree(object_tree(), telling(of_edit));
    CHECK(of_edit.fractions.back() == 1);
}

TEST_CASE("a build that its progress ends is cancelled, and leaves what was there") {
    Device device;
    const embree::Tree tree = object_tree();
    PhasetreeGeometry geometry = nullptr;
    for (const int last : {1, 2, 10}) {
        Told told;
        told.last = last;
        const PhasetreeGeometryOptions options = telling(told);
        expect_error(phasetreeNewGeometry(PHASETREE_API_VERSION, device, tree.get(), &options, &geometry),
                     PHASETREE_ERROR_CANCELLED, "cancelled");
        CHECK(geometry == nullptr);
        CHECK(told.fractions.size() == static_cast<std::size_t>(last));  // and not once more
    }
    Placed placed;
    const RTCRayHit ray = rayhit({{0, -3, 0}, {0, 1, 0}}), before = trace_one(placed.scene, ray);
    Told told;
    told.last = 3;
    CHECK_THROWS_AS(placed.geometry.set_tree(tree, telling(told)), embree::Error);
    CHECK(same_bits(trace_one(placed.scene, ray), before));
}

TEST_CASE("a geometry with cells from a file is the one that was written") {
    const TemporaryDirectory folder;
    const std::string path = folder / "cells";
    PhasetreeGeometryOptions options = with_flags(PHASETREE_GEOMETRY_FLAG_EXTENDED_CONTEXT);
    options.opaquePhases = 0b11000;
    const Placed built(object_tree(), options);
    built.geometry.write_cells(path);
    Told told;
    PhasetreeGeometryOptions reading = options;
    reading.progress = tell;
    reading.progressUserPtr = &told;
    const embree::Geometry read = embree::Geometry::from_cells(built.device, built.tree, path, reading);
    CHECK(told.fractions.empty());
    CHECK(read.statistics().cells == built.geometry.statistics().cells);
    CHECK(read.statistics().bytes == built.geometry.statistics().bytes);
    CHECK(read.statistics().resolution == built.geometry.statistics().resolution);
    EmbreeScene scene(built.device);
    scene.add(read.embree());
    scene.commit();
    int hit = 0;
    for (const Ray& ray : rays(3000, 95)) {
        Carrying a{}, b{};
        const RTCRayHit x = trace_one(built.scene, marked(ray), {.context = &a.context.context}),
                        y = trace_one(scene, marked(ray), {.context = &b.context.context});
        REQUIRE(same_bits(x, y));
        if (!hits(x)) continue;
        ++hit;
        REQUIRE(std::memcmp(&a.state.hit, &b.state.hit, sizeof a.state.hit) == 0);
        const PhasetreeHit p = built.geometry.decode(x), q = read.decode(y);
        REQUIRE(std::memcmp(&p, &q, sizeof p) == 0);
    }
    CHECK(hit > 1000);
}

TEST_CASE("files of cells that cannot be used") {
    const TemporaryDirectory folder;
    const std::string path = folder / "cells";
    Device device;
    const embree::Tree tree = object_tree();
    const embree::Geometry built(device, tree);
    const auto wrong = PHASETREE_ERROR_CELLS_FILE, invalid = PHASETREE_ERROR_INVALID_ARGUMENT,
               no_handle = PHASETREE_ERROR_INVALID_HANDLE;
    PhasetreeGeometry geometry = nullptr;
    const auto read = [&](const std::string& name, const embree::Tree& of, const PhasetreeGeometryOptions* o) {
        return phasetreeNewGeometryFromCells(PHASETREE_API_VERSION, device, of.get(), o, name.c_str(), &geometry);
    };
    expect_error(phasetreeWriteGeometryCells(nullptr, path.c_str()), no_handle, "geometry is NULL");
    expect_error(phasetreeWriteGeometryCells(built.get(), nullptr), invalid, "path is NULL");
    expect_error(phasetreeWriteGeometryCells(built.get(), (folder / "no/cells").c_str()), wrong, "no such directory");
    expect_error(phasetreeWriteGeometryCells(built.get(), (folder / "").c_str()), wrong, "directory");
    expect_error(read(path, tree, nullptr), wrong, "No such file");
    built.write_cells(path);

    const auto call = [&](unsigned version, RTCDevice d, PhasetreeTree t, const char* p, PhasetreeGeometry* g) {
        return phasetreeNewGeometryFromCells(version, d, t, nullptr, p, g);
    };
    const unsigned v = PHASETREE_API_VERSION;
    expect_error(call(v - 100, device, tree.get(), path.c_str(), &geometry), PHASETREE_ERROR_VERSION, "apiVersion is");
    expect_error(call(v, nullptr, tree.get(), path.c_str(), &geometry), invalid, "device");
    expect_error(call(v, device, nullptr, path.c_str(), &geometry), no_handle, "tree");
    expect_error(call(v, device, tree.get(), nullptr, &geometry), invalid, "path");
    expect_error(call(v, device, tree.get(), path.c_str(), nullptr), invalid, "geometry");
    PhasetreeGeometryOptions options = embree::default_options();
    options.cellDivisions = 99;
    expect_error(read(path, tree, &options), invalid, "cellDivisions");

    options = embree::default_options();
    options.buildQuality = RTC_BUILD_QUALITY_LOW;
    expect_error(read(path, tree, &options), wrong, "another quality");
    options = embree::default_options();
    options.opaquePhases = 0b100;
    expect_error(read(path, tree, &options), wrong, "opaque");
    options = embree::default_options();
    options.resolution = 1e-4f;
    expect_error(read(path, tree, &options), wrong, "resolution");
    options = embree::default_options();
    options.cellDivisions = 5;
    expect_error(read(path, tree, &options), wrong, "divisions");
    expect_error(read(path, tree.edited("/tree/under/2/set/of/translate/by/2", "-1.2"), nullptr), wrong,
                 "another tree");
    // Names and materials are nothing to the cells; nor what only rays want to know.
    options = embree::default_options();
    options.shownPhases = 0b10;
    CHECK(read(path, tree.edited("/phases/glass", "{\"clear\": {\"ior\": 1.5}}"), &options) == PHASETREE_ERROR_NONE);
    CHECK(phasetreeReleaseGeometry(geometry) == PHASETREE_ERROR_NONE);
    geometry = nullptr;

    std::ofstream(path, std::ios::binary | std::ios::in | std::ios::out).seekp(5000).put('\x55').put('\xaa');
    expect_error(read(path, tree, nullptr), wrong, "damaged");
    std::ofstream(folder / "text") << std::string(1000, ' ');
    expect_error(read(folder / "text", tree, nullptr), wrong, "not a cell file");
    CHECK(geometry == nullptr);
    // A file that could not be read can still be written.
    built.write_cells(path);
    CHECK(read(path, tree, nullptr) == PHASETREE_ERROR_NONE);
    CHECK(phasetreeReleaseGeometry(geometry) == PHASETREE_ERROR_NONE);
}

TEST_CASE("empty and unbounded trees are rejected with a message") {
    Device device;
    PhasetreeGeometry geometry = nullptr;
    const auto make = [&](const char* tree) {
        const embree::Tree t = embree::Tree::from_text(std::string(R"({"phases": {"a": 0}, "tree": )") + tree + "}");
        return phasetreeNewGeometry(PHASETREE_API_VERSION, device, t.get(), nullptr, &geometry);
    };
    expect_error(make(R"({"set": {"phase": "a", "of": {"plane": {}}}})"), PHASETREE_ERROR_INVALID_TREE,
                 "unbounded because of its \"plane\" (at set.of.plane)");
    expect_error(
        make(R"({"set": {"phase": "a", "of": {"offset": {"of": {"sphere": {"radius": 1}}, "distance": -2}}}})"),
        PHASETREE_ERROR_INVALID_TREE, "empty");
    CHECK(geometry == nullptr);
}

}  // namespace test_building
