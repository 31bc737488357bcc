// Files without cells, or with other cells than those requested, are rejected with this reason.
#include <sys/stat.h>

#include "cells/cells_files.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/set.hpp"

namespace test_foreign_files {

using namespace phasetree;
using namespace phasetree::tests;

TEST_CASE("a file of other cells is rejected, and says in what it differs") {
    const Written w;
    std::string message;
    const auto expect = [&](const Phased& object, const CellOptions& options, const char* part) {
        CHECK(refusal(w.path, object, options, &message) == Reason::differing);
        CAPTURE(message);
        CHECK(message.find(part) != std::string::npos);
    };
    CHECK_FALSE(refusal(w.path, w.object, few));
    expect(Set{.phase = Phase{1}, .of = Sphere{.radius = 1}}, few, "another tree");
    expect(w.object, {}, "divisions");
    expect(w.object, {.max_depth = 3, .quality = BuildQuality::low}, "quality");
    expect(w.object, {.max_depth = 3, .opaque = {0b10}}, "opaque");
    expect(w.object, {.resolution = 1e-4f, .max_depth = 3}, "resolution");

    const auto with = [&](auto&& change, const char* part) {
        Bytes file = w.bytes;
        CellsFileHeader h = header_of(file);
        change(h);
        set_header(file, h);
        put(w.folder / "other", file);
        CHECK(refusal(w.folder / "other", w.object, few, &message) == Reason::differing);
        CAPTURE(message);
        CHECK(message.find(part) != std::string::npos);
    };
    with([](CellsFileHeader& h) { h.library = {'9', '.', '9', '\n'}; }, "written by build 9.9?, but this is build ");
    with([](CellsFileHeader& h) { h.machine = {'p', 'd', 'p', '1', '1'}; }, "written for pdp11");
    with([](CellsFileHeader& h) { h.layout += 1; }, "a different list of nodes");
    with([](CellsFileHeader& h) { h.format += 1; }, "format is version 3");
    with([](CellsFileHeader& h) { h.byte_order = 0x04030201; }, "byte order");
}

TEST_CASE("cells that have all the memory they want are those that more of it gives; others are not") {
    const CellOptions roomy{.max_bytes = 1 << 28}, tight{.max_bytes = 1 << 18};
    const auto with = [](std::size_t bytes) { return CellOptions{.max_bytes = bytes}; };
    const Written all(roomy), less(tight);
    REQUIRE_FALSE(all.cells.statistics().is_coarser);
    REQUIRE(less.cells.statistics().is_coarser);
    CHECK_FALSE(refusal(all.path, all.object, roomy));
    CHECK_FALSE(refusal(all.path, all.object, with(1 << 29)));
    CHECK(refusal(all.path, all.object, with((1 << 28) - 1)) == Reason::differing);
    CHECK_FALSE(refusal(less.path, less.object, tight));
    CHECK(read_cells(less.path, less.object, tight)->statistics().is_coarser);
    for (const std::size_t bytes : {(1 << 18) + 1, (1 << 18) - 1, 1 << 28})
        CHECK(refusal(less.path, less.object, with(bytes)) == Reason::differing);
}

TEST_CASE("what is no file of cells") {
    const Written w;
    CHECK(refusal(w.folder / "nothing", w.object) == Reason::missing);
    CHECK(refusal(w.folder / "cells/below", w.object) == Reason::missing);
    CHECK(refusal(w.folder / ".", w.object) == Reason::unusable);
    CHECK(refusal("/dev/zero", w.object) == Reason::unusable);
    REQUIRE(::mkfifo((w.folder / "pipe").c_str(), 0600) == 0);
    CHECK(refusal(w.folder / "pipe", w.object) == Reason::unusable);
    put(w.folder / "empty", {});
    CHECK(refusal(w.folder / "empty", w.object) == Reason::foreign);
    put(w.folder / "text", Bytes(5000, 'x'));
    CHECK(refusal(w.folder / "text", w.object) == Reason::foreign);
    Bytes more = w.bytes;
    more.push_back(0);
    put(w.folder / "more", more);
    CHECK(refusal(w.folder / "more", w.object) == Reason::damaged);
}

}  // namespace test_foreign_files
