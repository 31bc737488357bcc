// Cells with a memory limit are coarser and slower, but as correct as all others.
#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <memory>

#include "phasetree/cells/cells.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/intersect_shape.hpp"
#include "phasetree/nodes/phased/voronoi.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/compared_crossings.hpp"
#include "support/compared_labels.hpp"

namespace test_budget {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

/// Three phases in blocks within a ball. There are many cells, because the blocks are small.
Phased blocks(float size) {
    return IntersectShape{.of = Voronoi{.of_phases = {Phase{1}, Phase{2}, Phase{3}}, .size = size},
                          .shape = Sphere{.radius = 1}};
}

bool are_equal(const InterfaceCells& a, const InterfaceCells& b) {
    const CellStatistics s = a.statistics(), t = b.statistics();
    if (s.cells != t.cells || s.routines != t.routines || s.bytes != t.bytes || s.is_coarser != t.is_coarser)
        return false;
    for (std::size_t i = 0; i < a.size(); ++i)
        if (a.bounds(i).low != b.bounds(i).low || a.bounds(i).high != b.bounds(i).high) return false;
    return true;
}

std::unique_ptr<const InterfaceCells> with_threads(int threads, const Phased& object, const CellOptions& options) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    return arena.execute([&] { return std::make_unique<const InterfaceCells>(object, options); });
}

std::vector<Phased> objects() {
    Random rng(34);
    std::vector<Phased> all{blocks(0.5f)};
    while (all.size() < 8) {
        const Phased object =
            IntersectShape{.of = random_object(rng, 3), .shape = Box{.size = glm::vec3(3)}, .phases_cut = {}};
        if (!bounds(object).empty() && InterfaceCells(object).size() > 1) all.push_back(object);
    }
    return all;
}

}  // namespace

TEST_CASE("cells with any limit of memory give the labels and crossings of the whole object") {
    Random rng(35);
    Evaluator::Workspace w;
    Compared all;
    Disagreements labels;
    for (const Phased& object : objects()) {
        const InterfaceTracer tracer(object);
        const InterfaceCells unlimited(object);
        std::size_t fewer = unlimited.size();
        for (const std::size_t bytes : {std::size_t{100'000}, std::size_t{20'000}, std::size_t{1}}) {
            const InterfaceCells cells(object, {.max_bytes = bytes});
            const CellsAlongRay boxes(cells);
            CHECK(cells.size() <= fewer);
            fewer = cells.size();
            for (int i = 0; i < 60; ++i)
                compare_ray(object, boxes, tracer, {}, compared_ray(tracer, i % 3 == 2, rng, w), w, all);
            const Disagreements d = compare_labels(cells, 20);
            labels.points += d.points;
            labels.wrong += d.wrong;
        }
        CHECK(fewer == 1);
    }
    MESSAGE(all.rays, " rays, ", all.crossings, " crossings, ", all.different, " different; ", labels.points,
            " labels, ", labels.wrong, " wrong");
    CHECK(all.crossings > all.rays / 2);
    CHECK(all.different == 0);
    CHECK(labels.wrong == 0);
}

TEST_CASE("cells within a budget take about that much, say that they are coarser, and do not depend on the threads") {
    const Phased object = blocks(0.25f);
    const InterfaceCells unlimited(object);
    CHECK(!unlimited.statistics().is_coarser);
    CHECK(are_equal(unlimited, InterfaceCells(object, {.max_bytes = std::size_t{1} << 40})));
    std::size_t most = unlimited.statistics().bytes;
    for (const std::size_t bytes : std::initializer_list<std::size_t>{10'000'000, 3'000'000, 300'000}) {
        const CellOptions options{.max_bytes = bytes};
        const auto one = with_threads(1, object, options);
        const CellStatistics s = one->statistics();
        MESSAGE(bytes, " bytes allowed: ", s.cells, " cells of ", s.bytes, " bytes, where ", unlimited.size(), " of ",
                unlimited.statistics().bytes, " would be best");
        CHECK(s.is_coarser);
        CHECK(s.bytes < most);
        CHECK(s.bytes < bytes);
        CHECK(s.bytes > bytes / 30);  // Embree's tree, and what is gone when all are found, is the rest
        most = s.bytes;
        for (const int threads : {2, 3, 8}) CHECK(are_equal(*one, *with_threads(threads, object, options)));
    }
}

TEST_CASE("a build reports its progress one call at a time, each time more than before, and 1 at the end") {
    for (const std::size_t bytes : {std::size_t{0}, std::size_t{1'000'000}}) {
        std::vector<float> reports;
        std::atomic<int> inside{0};
        bool is_alone = true;
        const InterfaceCells cells(blocks(0.25f), {.progress =
                                                       [&](float done) {
                                                           is_alone = is_alone && ++inside == 1;
                                                           reports.push_back(done);
                                                           --inside;
                                                       },
                                                   .max_bytes = bytes});
        CHECK(is_alone);
        REQUIRE(reports.size() > 10);
        CHECK(std::ranges::is_sorted(reports, std::less_equal<>()));  // each more than the one before
        CHECK(reports.front() > 0);
        CHECK(reports.front() < 0.5f);
        CHECK(reports.back() == 1);
    }
}

TEST_CASE("a build that is cancelled ends, also within a budget") {
    for (const std::size_t bytes : {std::size_t{0}, std::size_t{1'000'000}}) {
        std::atomic<int> asked{0};
        const int enough = 500;
        const CellOptions options{.cancelled = [&] { return ++asked > enough; }, .max_bytes = bytes};
        CHECK_THROWS_AS(InterfaceCells(blocks(0.25f), options), BuildCancelled);
        CHECK(asked < enough + 100);
    }
}

}  // namespace test_budget
