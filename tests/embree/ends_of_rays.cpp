// A crossing depends neither on where its ray ends nor on the order in which Embree visits cells. Embree shortens a ray
// to each hit that it finds, and its order differs from processor to processor.
#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include "embree/cell_tracer.hpp"
#include "embree_core/cell_callbacks.hpp"
#include "phasetree/io/document.hpp"
#include "phasetree/io/tree.hpp"
#include "source_directory.hpp"
#include "support/random_tree.hpp"

namespace test_ends_of_rays {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

bool are_same(const Crossing& a, const Crossing& b) {
    return a.t_from == b.t_from && a.t_to == b.t_to && a.p_from == b.p_from && a.p_to == b.p_to && a.from == b.from &&
           a.to == b.to;
}

bool is_passed(const Bounds& box, const TracedRay& ray) {
    glm::dvec3 near, far;
    for (int axis = 0; axis < 3; ++axis) {
        const double a = (static_cast<double>(box.low[axis]) - ray.origin[axis]) * ray.inverse[axis],
                     b = (static_cast<double>(box.high[axis]) - ray.origin[axis]) * ray.inverse[axis];
        near[axis] = std::min(a, b);
        far[axis] = std::max(a, b);
    }
    return std::max({near.x, near.y, near.z}) <= std::min({far.x, far.y, far.z});
}

/// Whether Embree may skip a cell because the ray enters its box only behind the hit so far, at `far`.
bool may_be_skipped(const InterfaceCells& cells, unsigned cell, const embree::PreparedRay& ray, float far) {
    return embree::entry(embree::searched_box(cells, cell), ray.traced) >
           static_cast<double>(far) * static_cast<double>(ray.length);
}

/// A hit found by visiting cells in a given order, as Embree would.
struct Visited {
    Crossing crossing;
    unsigned cell = RTC_INVALID_GEOMETRY_ID;
    int ties = 0;  ///< cells with a crossing just as near as the hit before

    Visited(const InterfaceCells& cells, std::span<const unsigned> order, RTCRayHit ray, bool is_packet, bool skips) {
        const embree::PreparedRay prepared(ray.ray);
        embree::Query query;
        query.default_phase = vacuum;
        const int valid = -1;
        RTCIntersectFunctionNArguments arguments{};
        arguments.valid = const_cast<int*>(&valid);
        arguments.context = &query.context;
        arguments.rayhit = reinterpret_cast<RTCRayHitN*>(&ray);
        arguments.N = 1;
        for (const unsigned visited : order) {
            arguments.primID = visited;
            const float far = ray.ray.tfar;
            if (skips && may_be_skipped(cells, visited, prepared, far)) continue;
            if (is_packet)
                embree::intersect_cell_for_packet(
                    cells, arguments, [](unsigned) { return std::optional(vacuum); },
                    [&](unsigned, const Crossing& found, float) { query.crossing = found; });
            else
                embree::intersect_cell_for_query(cells, &arguments);
            RTCRay whole = ray.ray;
            whole.tfar = std::numeric_limits<float>::infinity();
            TraceCounters counters;
            const auto own = embree::search_cell(cells, visited, prepared, whole, vacuum, std::nullopt, counters);
            ties += own && own->t_from / prepared.length == far;
        }
        crossing = query.crossing;
        if (embree::is_hit(ray)) cell = ray.hit.primID;
    }
};

}  // namespace

TEST_CASE("a crossing has the same bits wherever behind it the ray ends") {
    const std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device(rtcNewDevice(nullptr));
    REQUIRE(device);
    Random rng(71);
    int hits = 0, differ = 0, farther = 0;
    for (const char* name : {"cable", "two_pears", "inlaid_spheres"}) {
        const Document document = Document::from_file(source_directory() + "/scenes/" + name + ".json");
        const CellTracer tracer(device.get(), read_tree(document).object, BuildQuality::medium);
        const Bounds bounds = tracer.bounds();
        for (int ray = 0; ray < 2000; ++ray) {
            const glm::vec3 direction = rng.direction(), origin = rng.in(bounds)-bounds.diagonal() * direction;
            TraceCounters counters;
            const float infinity = std::numeric_limits<float>::infinity();
            const auto hit = tracer.first_crossing(origin, direction, infinity, vacuum, nullptr, counters);
            if (!hit) continue;
            ++hits;
            for (int k = 0; k < 4; ++k) {
                const float end = hit->t_to + 0.02f * bounds.diagonal() * rng.uniform(0, 1) * rng.uniform(0, 1);
                const auto other = tracer.first_crossing(origin, direction, end, vacuum, nullptr, counters);
                differ += !other || !are_same(*hit, *other);
            }
            const float before = hit->t_from - 1e-5f * bounds.diagonal();
            farther += tracer.first_crossing(origin, direction, before, vacuum, nullptr, counters).has_value();
        }
    }
    CHECK(hits > 2000);
    CHECK(differ == 0);
    CHECK(farther == 0);
}

TEST_CASE("the hit is the same in whatever order cells are visited") {
    Random rng(72);
    std::mt19937 shuffling(1);
    int hits = 0, ties = 0, differ = 0;
    for (const char* name : {"cable", "two_pears", "wet_sand"}) {
        const Document document = Document::from_file(source_directory() + "/scenes/" + name + ".json");
        const InterfaceCells cells(read_tree(document).object, CellOptions{.quality = BuildQuality::low});
        std::vector<unsigned> all(cells.size());
        std::iota(all.begin(), all.end(), 0u);
        for (int ray = 0; ray < 6000; ++ray) {
            // Ties are where cells meet.
            const Bounds box = cells.bounds(static_cast<std::size_t>(rng.below(static_cast<int>(cells.size()))));
            const glm::vec3 direction = rng.direction();
            glm::vec3 target = rng.in(box);
            const int axis = rng.below(3);
            target[axis] = rng.chance(0.5) ? box.low[axis] : box.high[axis];
            const RTCRayHit start =
                embree::rayhit_of(target - cells.bounds().diagonal() * direction, rng.uniform(0.3f, 3) * direction);
            const TracedRay traced = embree::PreparedRay(start.ray).traced;
            std::vector<unsigned> order;
            std::ranges::copy_if(all, std::back_inserter(order),
                                 [&](unsigned cell) { return is_passed(cells.bounds(cell), traced); });
            for (const bool is_packet : {false, true}) {
                const Visited one(cells, order, start, is_packet, false);
                hits += one.cell != RTC_INVALID_GEOMETRY_ID;
                for (const bool skips : {false, true}) {
                    std::ranges::shuffle(order, shuffling);
                    const Visited other(cells, order, start, is_packet, skips);
                    differ += other.cell != one.cell || !are_same(other.crossing, one.crossing);
                    ties += other.ties;
                }
            }
        }
    }
    MESSAGE(ties, " ties");
    CHECK(hits > 10000);
    CHECK(ties > 100);
    CHECK(differ == 0);
}

}  // namespace test_ends_of_rays
