// PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES: cells as the application's primitives hit what the one primitive hits.
#include "embree/api/api.hpp"

namespace test_cell_primitives {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

constexpr unsigned promised = PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES | PHASETREE_GEOMETRY_FLAG_NO_FILTERS;

// Both geometries of one tree, each in a scene.
struct Pair {
    explicit Pair(unsigned flags)
        : cells(object_tree(), with_flags(promised | flags)), one(object_tree(), with_flags(flags)) {}
    Placed cells, one;
    float resolution = one.geometry.statistics().resolution;
};

void require_same(const RTCRayHit& a, const RTCRayHit& b, float resolution) {
    REQUIRE(hits(a) == hits(b));
    if (!hits(a)) return;
    REQUIRE(same_place(a.ray.tfar, b.ray.tfar, resolution));
    REQUIRE(a.hit.u == b.hit.u);
    REQUIRE(a.hit.v == b.hit.v);
    REQUIRE(a.hit.geomID == b.hit.geomID);
}

}  // namespace

TEST_CASE("a stock context hits the same, and decodes to the same") {
    const Pair pair(0);
    int hit = 0;
    for (const Ray& ray : rays(3000, 31)) {
        const RTCRayHit a = trace_one(pair.cells.scene, marked(ray)), b = trace_one(pair.one.scene, marked(ray));
        REQUIRE(occluded_one(pair.cells.scene, rayhit(ray)) == hits(b));
        require_same(a, b, pair.resolution);
        if (!hits(a)) {
            REQUIRE(same_bits(a, marked(ray)));
            continue;
        }
        ++hit;
        REQUIRE(a.hit.primID < pair.cells.geometry.statistics().cells);
        const glm::vec3 normal(a.hit.Ng_x, a.hit.Ng_y, a.hit.Ng_z);
        REQUIRE(glm::length(normal) == doctest::Approx(1).epsilon(1e-5));
        REQUIRE(glm::dot(normal, ray.direction) < 0);
        const PhasetreeHit decoded = pair.cells.geometry.decode(a), expected = pair.one.geometry.decode(b);
        REQUIRE(decoded.from == expected.from);
        REQUIRE(decoded.to == expected.to);
        REQUIRE(glm::distance(vec(decoded.pointFrom), vec(expected.pointFrom)) < 4 * pair.resolution);
    }
    CHECK(hit > 1500);
}

namespace {

template <int N>
void check_packets(const Pair& pair) {
    CAPTURE(N);
    const std::vector<Ray> all = rays(60 * N, 32);
    for (std::size_t first = 0; first < all.size(); first += N) {
        alignas(64) int valid[N];
        typename PacketOf<N>::Both packet{};
        typename PacketOf<N>::Rays shadows{};
        for (unsigned i = 0; i < N; ++i) {
            valid[i] = i % 3 == 2 ? 0 : -1;
            const RTCRayHit ray = marked(all[first + i]);
            put<N>(packet, i, ray);
            put_ray<N>(&shadows, i, ray.ray);
        }
        query<N>(pair.cells.scene, valid, packet, {});
        query<N>(pair.cells.scene, valid, shadows, {});
        for (unsigned i = 0; i < N; ++i) {
            const RTCRayHit before = marked(all[first + i]), single = trace_one(pair.cells.scene, before);
            const RTCRayHit after = get<N>(packet, i);
            if (valid[i] == 0 || !hits(single)) {
                REQUIRE(same_bits(after, before));
                continue;
            }
            require_same(after, single, pair.resolution);
            REQUIRE(get_ray<N>(&shadows, i).tfar < 0);
        }
    }
}

}  // namespace

TEST_CASE("packets hit what single rays hit, and leave other lanes alone") {
    const Pair pair(0);
    check_packets<4>(pair);
    check_packets<8>(pair);
    check_packets<16>(pair);
}

TEST_CASE("carried phases go from hit to hit as with one primitive") {
    const Pair pair(PHASETREE_GEOMETRY_FLAG_EXTENDED_CONTEXT);
    constexpr unsigned none = RTC_INVALID_GEOMETRY_ID;
    struct Step {
        unsigned left, entered;
        glm::vec3 at;
    };
    const auto walk = [](const Placed& placed, Ray ray) {
        Carrying carrying{PhasetreeCarriedPhase{placed.id, none, none, placed.geometry.phase(arr(ray.origin))}};
        std::vector<Step> steps;
        for (;;) {
            const RTCRayHit r = trace_one(placed.scene, rayhit(ray), {.context = &carrying.context.context});
            const RTCRayHit shadow = rayhit(ray);
            REQUIRE(occluded_one(placed.scene, shadow, {.context = &carrying.context.context}) == hits(r));
            if (!hits(r)) return steps;
            const PhasetreeHit& hit = carrying.state.hit;
            REQUIRE(hit.from == carrying.carried[0].phase);
            REQUIRE(hit.cell == r.hit.primID);
            REQUIRE(static_cast<float>(hit.to) == r.hit.v);
            steps.push_back({hit.from, hit.to, vec(hit.pointFrom)});
            carrying.carried[0].phase = hit.to;
            ray.origin = vec(hit.pointTo);
            REQUIRE(steps.size() < 100);
        }
    };
    std::size_t crossings = 0;
    for (const Ray& ray : rays(1000, 33)) {
        const std::vector<Step> a = walk(pair.cells, ray), b = walk(pair.one, ray);
        REQUIRE(a.size() == b.size());
        crossings += a.size();
        for (std::size_t i = 0; i < a.size(); ++i) {
            REQUIRE(a[i].left == b[i].left);
            REQUIRE(a[i].entered == b[i].entered);
            REQUIRE(glm::distance(a[i].at, b[i].at) < 4 * pair.resolution);
        }
    }
    CHECK(crossings > 1500);
}

TEST_CASE("points are answered, and edits change the number of primitives") {
    Pair pair(0);
    const std::array<float, 3> p = {0.2f, 0.1f, 0.6f};
    const PhasetreeClosest a = pair.cells.geometry.closest(p, 10), b = pair.one.geometry.closest(p, 10);
    REQUIRE(a.found);
    CHECK(a.distance == b.distance);
    CHECK(pair.cells.geometry.phase(p) == pair.one.geometry.phase(p));
    const RTCRayHit ray = rayhit({{0, -3, 0}, {0, 1, 0}});
    const RTCRayHit before = trace_one(pair.cells.scene, ray);
    const embree::Tree smaller = embree::Tree::from_text(
        R"({"phases": {"a": 0}, "tree": {"set": {"phase": "a", "of": {"sphere": {"radius": 0.25}}}}})");
    pair.cells.geometry.set_tree(smaller);
    rtcCommitGeometry(pair.cells.geometry.embree());
    pair.cells.scene.commit();
    const RTCRayHit after = trace_one(pair.cells.scene, ray);
    CHECK(before.ray.tfar < 2.5f);
    CHECK(after.ray.tfar == doctest::Approx(2.75).epsilon(1e-4));
    CHECK(pair.cells.geometry.closest({0, 0, 0}, 10).distance == doctest::Approx(0.25).epsilon(0.02));
}

TEST_CASE("the application's own callbacks choose a cell by its number; there are no others") {
    const Pair pair(0);
    const std::size_t count = pair.cells.geometry.statistics().cells;
    RTCBounds box{};
    RTCBoundsFunctionArguments arguments{};
    arguments.bounds_o = &box;
    arguments.primID = static_cast<unsigned>(count) - 1;
    phasetreeGetPrimitiveBounds(pair.cells.geometry.get(), &arguments);
    CHECK(box.lower_x < box.upper_x);
    arguments.primID = static_cast<unsigned>(count);
    phasetreeGetPrimitiveBounds(pair.cells.geometry.get(), &arguments);
    CHECK_FALSE(box.lower_x <= box.upper_x);
}

TEST_CASE("what the flag excludes is rejected, and says why") {
    Device device;
    const embree::Tree tree = object_tree();
    const auto refuse = [&](unsigned flags, PhasetreePhaseSet shown, const char* part) {
        PhasetreeGeometryOptions options = with_flags(flags);
        options.shownPhases = shown;
        PhasetreeGeometry geometry = nullptr;
        expect_error(phasetreeNewGeometry(PHASETREE_API_VERSION, device, tree.get(), &options, &geometry),
                     PHASETREE_ERROR_INVALID_ARGUMENT, part);
        CHECK(geometry == nullptr);
    };
    refuse(PHASETREE_GEOMETRY_FLAG_CELL_PRIMITIVES, PHASETREE_ALL_PHASES, "NO_FILTERS");
    refuse(promised | PHASETREE_GEOMETRY_FLAG_POINT_QUERY, PHASETREE_ALL_PHASES, "POINT_QUERY");
    refuse(promised, PHASETREE_ALL_PHASES & ~PhasetreePhaseSet{4}, "phase 2 cannot be hidden");
    // The vacuum never counts as shown.
    const embree::Geometry geometry(device, tree, [] {
        PhasetreeGeometryOptions options = with_flags(promised);
        options.shownPhases = PHASETREE_ALL_PHASES & ~PhasetreePhaseSet{1};
        return options;
    }());
    expect_error(phasetreeSetGeometryShownPhases(geometry.get(), 6), PHASETREE_ERROR_INVALID_OPERATION,
                 "shows all phases");
    const float identity[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    expect_error(phasetreeSetGeometryMotion(geometry.get(), identity, 1, 0, 1), PHASETREE_ERROR_INVALID_OPERATION,
                 "instance");
    PhasetreeGeometryOptions hidden = with_flags(0);
    hidden.shownPhases = 6;
    expect_error(phasetreeSetGeometryTree(geometry.get(), tree.get(), &hidden), PHASETREE_ERROR_INVALID_ARGUMENT,
                 "phase 3");
    CHECK(geometry.phase({0, 0, 0}) != 0);
}

}  // namespace test_cell_primitives
