// Rays that go from phase to phase through the whole object: none leaks, none meets a crossing twice, none passes a
// thin phase.
#include "embree/api/api.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/trace/tracer.hpp"

namespace test_walks {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

// Goes on from each hit's bracket with the phase that was entered; what was entered, one after another.
std::vector<unsigned> walk(RTCScene scene, unsigned geometry, Ray ray, unsigned phase) {
    Carrying carrying{PhasetreeCarriedPhase{geometry, RTC_INVALID_GEOMETRY_ID, RTC_INVALID_GEOMETRY_ID, phase}};
    auto& [carried, state, context] = carrying;
    PhasetreeCarriedPhase& entry = carried.front();
    std::vector<unsigned> entered;
    for (;;) {
        const RTCRayHit r = trace_one(scene, rayhit(ray), {.context = &context.context});
        if (!hits(r)) return entered;
        REQUIRE(state.hit.from == entry.phase);
        REQUIRE(state.hit.to != entry.phase);
        REQUIRE(state.hit.tFrom == r.ray.tfar);
        REQUIRE(state.hit.tTo >= state.hit.tFrom);
        REQUIRE(state.hit.cell == r.hit.primID);
        entry.phase = state.hit.to;
        ray.origin = vec(state.hit.pointTo);
        entered.push_back(entry.phase);
        REQUIRE(entered.size() < 200);
    }
}

std::vector<unsigned> expected_walk(const InterfaceTracer& tracer, const Ray& ray, Phase phase,
                                    Evaluator::Workspace& workspace) {
    std::vector<unsigned> entered;
    glm::vec3 p = ray.origin;
    while (const auto c = tracer.first_crossing(p, ray.direction, 0, 1e30f, phase, workspace)) {
        p = c->p_to;
        phase = c->to;
        entered.push_back(phase.index);
        REQUIRE(entered.size() < 200);
    }
    return entered;
}

// From within every phase, into all directions.
std::vector<std::pair<Ray, unsigned>> rays_from_within(const embree::Geometry& geometry, int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> coordinate(-1.3f, 1.3f);
    std::normal_distribution<float> normal;
    std::array<int, 5> of_phase{};
    std::vector<std::pair<Ray, unsigned>> all;
    while (all.size() < static_cast<std::size_t>(count)) {
        const glm::vec3 p(coordinate(random), coordinate(random), coordinate(random));
        const unsigned phase = geometry.phase(arr(p));
        // As many from each.
        if (of_phase[phase] > static_cast<int>(all.size()) / 5) continue;
        ++of_phase[phase];
        all.push_back({{p, glm::normalize(glm::vec3(normal(random), normal(random), normal(random)))}, phase});
    }
    return all;
}

}  // namespace

TEST_CASE("rays from inside every phase end in the vacuum: none leaks, in a million with --long") {
    const Placed placed(object_tree(), with_flags(PHASETREE_GEOMETRY_FLAG_EXTENDED_CONTEXT));
    const InterfaceTracer tracer(object());
    Evaluator::Workspace workspace;
    const int count = long_tests() ? 1'000'000 : 50'000;
    long long crossings = 0;
    int differing = 0;
    for (const auto& [ray, phase] : rays_from_within(placed.geometry, count, 31)) {
        const std::vector<unsigned> entered = walk(placed.scene, placed.id, ray, phase);
        REQUIRE((entered.empty() ? phase : entered.back()) == vacuum.index);
        crossings += static_cast<long long>(entered.size());
        // The way there, against the whole object's program; both may see a sliver at an edge that the other passes.
        if (entered != expected_walk(tracer, ray, Phase{static_cast<std::uint8_t>(phase)}, workspace)) ++differing;
    }
    CHECK(crossings > 2LL * count);
    // A ray that meets an edge to within a few resolutions, about 10⁻⁵ of the object, may see a phase there or not: of
    // 10⁵ some ten do. More would be something else.
    CHECK(differing <= 20 + count / 5000);
}

TEST_CASE("a stock context sees a ray's phase at its start, from inside every phase") {
    const Placed placed;
    for (const auto& [ray, phase] : rays_from_within(placed.geometry, 20'000, 32)) {
        const RTCRayHit r = trace_one(placed.scene, rayhit(ray));
        if (phase != vacuum.index) REQUIRE(hits(r));
        if (hits(r)) REQUIRE(static_cast<unsigned>(r.hit.u) == phase);
    }
}

namespace {

// Shells on shells, of about 29, 8.7 and 5.8 resolutions' thickness.
embree::Tree thin_shells() {
    return embree::Tree::from_text(R"({"phases": {"a": 0, "b": 0, "c": 0, "core": 0}, "tree": {"under": [
        {"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}},
        {"set": {"phase": "b", "of": {"sphere": {"radius": 0.9998}}}},
        {"set": {"phase": "c", "of": {"sphere": {"radius": 0.99974}}}},
        {"set": {"phase": "core", "of": {"sphere": {"radius": 0.9997}}}}]}})");
}

}  // namespace

TEST_CASE("a restart at a hit never meets it again and never passes a thin phase") {
    const embree::Tree tree = thin_shells();
    const Placed carrying(tree, with_flags(PHASETREE_GEOMETRY_FLAG_EXTENDED_CONTEXT)), stock(tree);
    REQUIRE(carrying.geometry.statistics().resolution < 7.2e-6f);
    std::mt19937 random(33);
    std::normal_distribution<float> normal;
    const std::vector<unsigned> through = {1, 2, 3, 4, 3, 2, 1, 0};
    int stock_ok = 0;
    for (int i = 0; i < 5000; ++i) {
        const glm::vec3 d = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
        const float distance = std::uniform_real_distribution<float>(0, 0.95f)(random);
        const glm::vec3 aside = distance * glm::normalize(glm::cross(d, glm::vec3(normal(random), normal(random), 1)));
        const Ray ray{aside - 3.0f * d, d};
        REQUIRE(walk(carrying.scene, carrying.id, ray, 0) == through);
        // On one ray, with nothing but tnear: what a host can do that carries no phases.
        std::vector<unsigned> entered;
        float near = 0;
        for (;;) {
            const RTCRayHit r = trace_one(stock.scene, rayhit(ray, near));
            if (!hits(r)) break;
            const PhasetreeHit hit = stock.geometry.decode(r);
            REQUIRE(hit.tTo >= near);
            entered.push_back(hit.to);
            near = hit.tTo;
            REQUIRE(entered.size() < 100);
        }
        if (entered == through) ++stock_ok;
    }
    CHECK(stock_ok == 5000);
}

TEST_CASE("a carried phase that is not the one at the start is an interface before the next one") {
    const Placed placed(object_tree(), with_flags(PHASETREE_GEOMETRY_FLAG_EXTENDED_CONTEXT));
    Carrying carrying{PhasetreeCarriedPhase{placed.id, RTC_INVALID_GEOMETRY_ID, RTC_INVALID_GEOMETRY_ID, 3}};
    auto& [carried, state, context] = carrying;
    PhasetreeCarriedPhase& entry = carried.front();
    const Ray ray{{0.9f, 0, 0}, {1, 0, 0}};  // within the wall of glass
    const RTCRayHit r = trace_one(placed.scene, rayhit(ray), {.context = &context.context});
    REQUIRE(hits(r));
    CHECK(r.ray.tfar < 0.0999f);  // the wall ends at 0.1
    CHECK(state.hit.from == 3);
    CHECK(state.hit.to == 1);
    entry.phase = PHASETREE_UNKNOWN_PHASE;
    const RTCRayHit unknown = trace_one(placed.scene, rayhit(ray), {.context = &context.context});
    REQUIRE(hits(unknown));
    CHECK(unknown.hit.u == 1);
    CHECK(unknown.hit.v == 0);
}

TEST_CASE("packets carry a phase for each ray, by its id") {
    const Placed placed(object_tree(), with_flags(PHASETREE_GEOMETRY_FLAG_EXTENDED_CONTEXT));
    const auto all = rays_from_within(placed.geometry, 16 * 50, 34);
    for (std::size_t first = 0; first < all.size(); first += 16) {
        std::array<PhasetreeCarriedPhase, 16> carried{};
        std::array<PhasetreeRay, 16> states{};
        RTCRayHit16 packet{};
        alignas(64) int valid[16];
        for (unsigned i = 0; i < 16; ++i) {
            const auto& [ray, phase] = all[first + i];
            carried[i] = {placed.id, RTC_INVALID_GEOMETRY_ID, RTC_INVALID_GEOMETRY_ID, phase};
            states[i].carried = &carried[i];
            states[i].carriedCount = 1;
            valid[i] = -1;
            RTCRayHit r = rayhit(ray);
            r.ray.id = 15 - i;  // the order of ids is the application's
            put<16>(packet, i, r);
        }
        std::array<PhasetreeRay, 16> by_id{};
        for (unsigned i = 0; i < 16; ++i) by_id[15 - i] = states[i];
        PhasetreeRayContext context;
        phasetreeInitRayContext(&context);
        context.rays = by_id.data();
        context.rayCount = 16;
        query<16>(placed.scene, valid, packet, {.context = &context.context});
        for (unsigned i = 0; i < 16; ++i) {
            const RTCRayHit r = get<16>(packet, i);
            if (all[first + i].second != 0) REQUIRE(hits(r));
            if (!hits(r)) continue;
            REQUIRE(by_id[15 - i].hit.from == all[first + i].second);
            REQUIRE(by_id[15 - i].hit.tFrom == r.ray.tfar);
        }
    }
}

TEST_CASE("within an instance rays that carry phases go through it and out, though world coordinates round") {
    Device device;
    const embree::Tree tree = thin_shells();
    const embree::Geometry geometry(device, tree, with_flags(PHASETREE_GEOMETRY_FLAG_EXTENDED_CONTEXT));
    EmbreeScene inner(device), outer(device);
    inner.add(geometry.embree());
    inner.commit();
    // Turned by 30° about z, three times as large, and a few sizes away.
    const float c = 3 * 0.8660254f, s = 3 * 0.5f;
    const float m[12] = {c, s, 0, -s, c, 0, 0, 0, 3, 4, -5, 6};
    const RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(instance, inner);
    rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, m);
    const unsigned id = outer.add(instance);
    rtcReleaseGeometry(instance);
    outer.commit();
    const auto to_world = [&](const glm::vec3& p) {
        return glm::vec3(m[0] * p.x + m[3] * p.y + m[9], m[1] * p.x + m[4] * p.y + m[10], m[8] * p.z + m[11]);
    };
    std::mt19937 random(35);
    std::normal_distribution<float> normal;
    const std::vector<unsigned> through = {1, 2, 3, 4, 3, 2, 1, 0};
    for (int i = 0; i < 5000; ++i) {
        const glm::vec3 d = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
        const float distance = std::uniform_real_distribution<float>(0, 0.9f)(random);
        const glm::vec3 aside = distance * glm::normalize(glm::cross(d, glm::vec3(normal(random), normal(random), 1)));
        const glm::vec3 from = to_world(aside - 3.0f * d);
        Ray ray{from, glm::normalize(to_world(aside) - from)};
        Carrying carrying{PhasetreeCarriedPhase{0, id, RTC_VERSION_MAJOR >= 4 ? 0 : RTC_INVALID_GEOMETRY_ID, 0}};
        auto& [carried, state, context] = carrying;
        PhasetreeCarriedPhase& entry = carried.front();
        std::vector<unsigned> entered;
        while (hits(trace_one(outer, rayhit(ray), {.context = &context.context}))) {
            REQUIRE(state.hit.from == entry.phase);
            entry.phase = state.hit.to;
            entered.push_back(entry.phase);
            ray.origin = to_world(vec(state.hit.pointTo));
            REQUIRE(entered.size() < 50);
        }
        REQUIRE(entered == through);
    }
}

}  // namespace test_walks
