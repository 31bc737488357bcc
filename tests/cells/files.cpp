// Cell files: reading returns what was written, with any instruction set, and a file appears complete or not at all.
#include "phasetree/cells/file.hpp"

#include <sys/resource.h>

#include <cmath>
#include <csignal>

#include "cells/cells_files.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/crossing.hpp"
#include "phasetree/model/ray.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/set.hpp"

namespace test_files {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

bool are_equal(const CrossingNormal& a, const CrossingNormal& b) {
    return a.unit == b.unit && a.gradient == b.gradient;
}

int differing_cells(const InterfaceCells& a, const InterfaceCells& b) {
    REQUIRE(a.size() == b.size());
    Random rng(7);
    TraceCounters counted_a, counted_b;
    int differing = 0, crossings = 0;
    for (std::size_t c = 0; c < a.size(); ++c) {
        const Bounds box = a.bounds(c);
        if (box.low != b.bounds(c).low || box.high != b.bounds(c).high) ++differing;
        for (int i = 0; i < 4; ++i) {
            const glm::vec3 d = rng.direction(), o = box.centre() - 2 * box.diagonal() * d;
            const TracedRay ray(o, d);
            const auto x = a.first_crossing(c, ray, 0, 100, {}, {}, counted_a);
            const auto y = b.first_crossing(c, ray, 0, 100, {}, {}, counted_b);
            if (x.has_value() != y.has_value()) ++differing;
            if (!x || !y) continue;
            ++crossings;
            if (x->t_from != y->t_from || x->t_to != y->t_to || x->p_from != y->p_from || x->from != y->from ||
                x->to != y->to)
                ++differing;
            if (!are_equal(a.normal(c, *x, d), b.normal(c, *y, d))) ++differing;
        }
    }
    CHECK(counted_a.batches == counted_b.batches);
    CHECK(crossings > static_cast<int>(a.size()) / 4);
    return differing;
}

}  // namespace

TEST_CASE("cells from a file are those that were written") {
    for (const CellOptions& options :
         {CellOptions{}, few, CellOptions{.quality = BuildQuality::low, .opaque = {0b10110}}}) {
        const Written w(options);
        const auto read = read_cells(w.path, w.object, options);
        CHECK(differing_cells(w.cells, *read) == 0);
        const CellStatistics a = w.cells.statistics(), b = read->statistics();
        CHECK(a.bytes == b.bytes);
        CHECK(a.routines == b.routines);
        CHECK(a.median_instructions == b.median_instructions);
        CHECK(read->resolution() == w.cells.resolution());
        CHECK(read->reach() == w.cells.reach());
        CHECK(read->opaque() == w.cells.opaque());
        // And written again they are the same file.
        write_cells(w.folder / "again", *read);
        CHECK(contents(w.folder / "again") == w.bytes);
        CHECK(w.folder.size() == 2);
    }
}

TEST_CASE("random trees come back from files") {
    Random rng(17);
    const TemporaryDirectory folder;
    int read = 0;
    // Trees without bounds, or without an interface, are drawn again.
    for (int drawn = 0; drawn < 200 && read < 25; ++drawn) {
        const Phased object = random_object(rng, 3);
        try {
            const InterfaceCells cells(object, few);
            write_cells(folder / "cells", cells);
            if (cells.size() == 0) continue;
            ++read;
            const auto again = read_cells(folder / "cells", object, few);
            CHECK(again->size() == cells.size());
            write_cells(folder / "again", *again);
            CHECK(contents(folder / "cells") == contents(folder / "again"));
        } catch (const ModelError&) {
        }
    }
    CHECK(read == 25);
}

TEST_CASE("cells are known to be those of an object, or of another one or of other options") {
    const CellOptions options{.quality = BuildQuality::low, .opaque = {0b10}, .max_bytes = 50'000'000};
    const InterfaceCells cells(various(), options);
    CHECK(are_cells_of(cells, various(), options));
    const auto with = [&](auto&& change) {
        CellOptions other = options;
        change(other);
        return are_cells_of(cells, various(), other);
    };
    CHECK_FALSE(with([](CellOptions& o) { o.quality = BuildQuality::medium; }));
    CHECK_FALSE(with([](CellOptions& o) { o.opaque = {}; }));
    CHECK_FALSE(with([](CellOptions& o) { o.resolution = 0.01f; }));
    CHECK_FALSE(with([](CellOptions& o) { o.max_depth = 13; }));
    // Those that are not coarser because of the limit are the same with a higher one.
    CHECK(with([](CellOptions& o) { o.max_bytes = 60'000'000; }));
    CHECK_FALSE(with([](CellOptions& o) { o.max_bytes = 1; }));
    const auto ball = [](float radius) -> Phased { return Set{.phase = Phase{1}, .of = Sphere{radius}}; };
    const InterfaceCells of_ball(ball(1));
    CHECK(are_cells_of(of_ball, ball(1)));
    CHECK_FALSE(are_cells_of(of_ball, ball(std::nextafter(1.0f, 2.0f))));
    CHECK_FALSE(are_cells_of(of_ball, Set{.phase = Phase{2}, .of = Sphere{1}}));
    CellOptions tight;
    tight.max_bytes = 20'000;
    const InterfaceCells coarser(various(), tight);
    REQUIRE(coarser.statistics().is_coarser);
    CHECK(are_cells_of(coarser, various(), tight));
    tight.max_bytes = 20'001;
    CHECK_FALSE(are_cells_of(coarser, various(), tight));
}

TEST_CASE("every instruction set writes the same file") {
    const std::string usual = simd_target();
    std::optional<Bytes> first;
    for (const std::string& name : simd_targets()) {
        use_simd_target(name);
        const Written w;
        if (!first) first = w.bytes;
        CHECK(w.bytes == *first);
    }
    use_simd_target(usual);
}

TEST_CASE("a file that cannot be written leaves nothing behind") {
    const Written w;
    const auto reason = [&](const fs::path& path) -> std::optional<Reason> {
        try {
            write_cells(path, w.cells);
        } catch (const CellsFileError& e) {
            return e.reason();
        }
        return std::nullopt;
    };
    CHECK(reason(w.folder / "no/such/folder") == Reason::unusable);
    CHECK(reason(w.folder / ".") == Reason::unusable);
    CHECK(reason("/dev/null") == Reason::unusable);
    // No room for all of it, as on a full disk.
    rlimit before{};
    REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit little{20000, before.rlim_max};
    REQUIRE(::setrlimit(RLIMIT_FSIZE, &little) == 0);
    const auto full = reason(w.path), full_elsewhere = reason(w.folder / "other");
    ::setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    CHECK(full == Reason::unusable);
    CHECK(full_elsewhere == Reason::unusable);
    CHECK(w.folder.size() == 1);
    CHECK(contents(w.path) == w.bytes);
    fs::create_symlink(w.path, w.folder / "link");
    put(w.path, {});
    CHECK_FALSE(reason(w.folder / "link"));
    CHECK(fs::is_symlink(w.folder / "link"));
    CHECK(contents(w.path) == w.bytes);
}

}  // namespace test_files
