// PhasetreeGeometryOptions::maxBytes: cells keep to the memory that they may take, and what rays find is the same.
#include <atomic>

#include "embree/api/api.hpp"
#include "phasetree/cells/cells.hpp"
#include "phasetree/io/tree.hpp"

namespace test_most_bytes {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

// Blocks in a shell: some thousand cells.
constexpr const char* blocks = R"({
    "phases": {"stone": 0, "glass": 0, "air": 0},
    "tree": {"under": [
        {"thin_shell": {"of": {"sphere": {"radius": 1}}, "shell": "glass", "inside": "air", "half_thickness": 0.03}},
        {"set": {"phase": "stone", "of": {"intersection": {"of": [
            {"voronoi_cells": {"size": 0.3, "gap": 0.03, "rounding": 0.02}}, {"box": {"size": [1, 1, 1]}}]}}}}]}})";

PhasetreeGeometryOptions within(std::size_t bytes) {
    PhasetreeGeometryOptions options = embree::default_options();
    options.maxBytes = bytes;
    return options;
}

// What Embree allocates beyond what it had.
struct Allocated {
    std::atomic<std::ptrdiff_t> bytes{0};

    static bool account(void* user, ssize_t bytes, bool) {
        static_cast<Allocated*>(user)->bytes += bytes;
        return true;
    }
};

}  // namespace

TEST_CASE("cells and Embree's tree over them stay within the bytes that they may take, and rays find the same") {
    const embree::Tree tree = embree::Tree::from_text(blocks, "blocks");
    const Placed whole(tree);
    const PhasetreeGeometryStatistics all = whole.geometry.statistics();
    std::size_t cells_before = all.cells;
    for (const std::size_t bytes : {all.bytes / 2, all.bytes / 8, all.bytes / 64}) {
        CAPTURE(bytes);
        Allocated allocated;
        Device device;
        rtcSetDeviceMemoryMonitorFunction(device, Allocated::account, &allocated);
        const std::ptrdiff_t before = allocated.bytes;
        const embree::Geometry geometry(device, tree, within(bytes));
        const PhasetreeGeometryStatistics less = geometry.statistics();
        const std::ptrdiff_t by_embree = allocated.bytes - before;
        MESSAGE(less.cells, " cells of ", less.bytes, " bytes, ", by_embree, " of Embree's, within ", bytes,
                "; all are ", all.cells, " of ", all.bytes);
        CHECK(less.cells >= 1);
        CHECK(less.cells < cells_before);
        CHECK(less.bytes + static_cast<std::size_t>(by_embree) <= bytes);
        cells_before = less.cells;

        EmbreeScene scene(device);
        scene.add(geometry.embree());
        scene.commit();
        int hit = 0;
        for (const Ray& ray : rays(2000, 91)) {
            const RTCRayHit expected = trace_one(whole.scene, rayhit(ray)), found = trace_one(scene, rayhit(ray));
            REQUIRE(hits(found) == hits(expected));
            if (!hits(expected)) continue;
            ++hit;
            CHECK(same_place(found.ray.tfar, expected.ray.tfar, all.resolution));
            CHECK(found.hit.u == expected.hit.u);
            CHECK(found.hit.v == expected.hit.v);
        }
        CHECK(hit > 500);
        rtcSetDeviceMemoryMonitorFunction(device, nullptr, nullptr);
    }
}

TEST_CASE("the bytes are those of the C++ library, whose cells tell that they are coarser") {
    const Phased object = read_tree(Document::from_text(blocks)).object;
    const embree::Tree tree = embree::Tree::from_text(blocks, "blocks");
    const std::size_t all = InterfaceCells(object).statistics().bytes;
    Device device;
    for (const std::size_t bytes : {std::size_t{0}, 16 * all, all / 8}) {
        CAPTURE(bytes);
        const CellStatistics expected = InterfaceCells(object, {.max_bytes = bytes}).statistics();
        CHECK(expected.is_coarser == (bytes == all / 8));
        const PhasetreeGeometryStatistics found = embree::Geometry(device, tree, within(bytes)).statistics();
        CHECK(found.cells == expected.cells);
        CHECK(found.bytes == expected.bytes);
    }
}

}  // namespace test_most_bytes
