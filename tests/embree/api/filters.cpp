// Filter functions see every crossing of a ray once, in order, with consecutive phases, for single rays and packets.
// Occlusion agrees, and a rejected crossing has no effect.
#include <map>

#include "embree/api/api.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/trace/tracer.hpp"
#include "source_directory.hpp"

namespace test_filters {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

struct Seen {
    float t;
    unsigned from, to;
};

// The filter's input, by the geometry's user pointer, and what it collects, by the rays' ids.
struct Filter {
    std::map<unsigned, std::vector<Seen>> calls;
    unsigned accept_from = 1000;  // accepts a crossing with this number of its ray and later ones
    int hits_with_wrong_place = 0;
    unsigned expected_geometry = 0;
};

void collect(const RTCFilterFunctionNArguments* args) {
    auto& filter = *static_cast<Filter*>(args->geometryUserPtr);
    const unsigned n = args->N;
    for (unsigned i = 0; i < n; ++i) {
        if (args->valid[i] != -1) continue;
        auto& seen = filter.calls[RTCRayN_id(args->ray, n, i)];
        if (RTCHitN_geomID(args->hit, n, i) != filter.expected_geometry) ++filter.hits_with_wrong_place;
        seen.push_back(
            {RTCRayN_tfar(args->ray, n, i), phasetreeGetHitFrom(args->hit, n, i), phasetreeGetHitTo(args->hit, n, i)});
        if (seen.size() <= filter.accept_from) args->valid[i] = 0;
    }
}

// The crossings of a ray, by the whole object's program.
std::vector<Crossing> crossings(const InterfaceTracer& tracer, const Ray& ray) {
    Evaluator::Workspace workspace;
    std::vector<Crossing> all;
    glm::vec3 p = ray.origin;
    Phase phase = tracer.label(p, workspace);
    while (auto c = tracer.first_crossing(p, ray.direction, 0, 1e30f, phase, workspace)) {
        const float before = glm::distance(ray.origin, p);
        p = c->p_to;
        phase = c->to;
        c->t_from += before;
        all.push_back(*c);
        REQUIRE(all.size() < 100);
    }
    return all;
}

void set_filter(const embree::Geometry& geometry, RTCFilterFunctionN filter) {
    rtcSetGeometryIntersectFilterFunction(geometry.embree(), filter);
    rtcSetGeometryOccludedFilterFunction(geometry.embree(), filter);
    rtcCommitGeometry(geometry.embree());
}

template <int N>
void check_collected(Placed& placed, const InterfaceTracer& tracer, Filter& filter, const std::vector<Ray>& all,
                     bool occlusion) {
    CAPTURE(N);
    CAPTURE(occlusion);
    int crossed = 0;
    for (std::size_t first = 0; first + N <= all.size(); first += N) {
        alignas(64) int valid[N];
        typename PacketOf<N>::Both packet{};
        typename PacketOf<N>::Rays shadow{};
        std::vector<RTCRayHit> before;
        for (unsigned i = 0; i < N; ++i) {
            valid[i] = -1;
            before.push_back(marked(all[first + i]));
            before.back().ray.id = i;
            put<N>(packet, i, before.back());
            put_ray<N>(&shadow, i, before.back().ray);
        }
        filter.calls.clear();
        if (occlusion)
            query<N>(placed.scene, valid, shadow, {});
        else
            query<N>(placed.scene, valid, packet, {});
        for (unsigned i = 0; i < N; ++i) {
            CAPTURE(first + i);
            // All were rejected.
            if (occlusion)
                REQUIRE(same_bits(get_ray<N>(&shadow, i), before[i].ray));
            else
                REQUIRE(same_bits(get<N>(packet, i), before[i]));
            const auto expected = crossings(tracer, all[first + i]);
            const auto& seen = filter.calls[i];
            REQUIRE(seen.size() == expected.size());
            for (std::size_t k = 0; k < seen.size(); ++k) {
                REQUIRE(seen[k].from == expected[k].from.index);
                REQUIRE(seen[k].to == expected[k].to.index);
                REQUIRE(same_place(seen[k].t, expected[k].t_from, 2 * tracer.resolution()));
                if (k > 0) REQUIRE(seen[k].t > seen[k - 1].t);
                if (k > 0) REQUIRE(seen[k].from == seen[k - 1].to);
                ++crossed;
            }
        }
    }
    CHECK(filter.hits_with_wrong_place == 0);
    CHECK(crossed > 500);
}

}  // namespace

TEST_CASE("filters see every crossing once, in order, and phases follow on each other") {
    Placed placed;
    Filter filter;
    filter.expected_geometry = placed.id;
    placed.geometry.set_user_data(&filter);
    set_filter(placed.geometry, collect);
    placed.scene.commit();
    const InterfaceTracer tracer(object());
    const std::vector<Ray> all = rays(480, 11);
    for (const bool occlusion : {false, true}) {
        check_collected<1>(placed, tracer, filter, all, occlusion);
        check_collected<4>(placed, tracer, filter, all, occlusion);
        check_collected<8>(placed, tracer, filter, all, occlusion);
        check_collected<16>(placed, tracer, filter, all, occlusion);
    }
}

TEST_CASE("so they do where cells are many, which reach into each other") {
    for (const char* scene : {"hourglass", "reinforced_pipe", "box_of_operators"}) {
        CAPTURE(scene);
        const std::string path = source_directory() + "/scenes/" + scene + ".json";
        Placed placed(embree::Tree::from_file(path));
        Filter filter;
        filter.expected_geometry = placed.id;
        placed.geometry.set_user_data(&filter);
        set_filter(placed.geometry, collect);
        placed.scene.commit();
        REQUIRE(placed.geometry.statistics().cells > 500);
        const InterfaceTracer tracer(read_tree(Document::from_file(path)).object);
        const Bounds box = tracer.bounds();
        std::mt19937 random(13);
        std::uniform_real_distribution<float> unit(0, 1);
        const auto inside = [&] {
            return box.low + box.extent() * glm::vec3(unit(random), unit(random), unit(random));
        };
        int crossed = 0, differing = 0, count = long_tests() ? 20'000 : 1500;
        for (int i = 0; i < count; ++i) {
            const glm::vec3 a = inside(), b = inside();
            const Ray ray{a, glm::normalize(b - a)};
            filter.calls.clear();
            REQUIRE(same_bits(trace_one(placed.scene, marked(ray)), marked(ray)));
            const auto& seen = filter.calls[77];
            const auto expected = crossings(tracer, ray);
            bool same = seen.size() == expected.size();
            for (std::size_t k = 0; k < seen.size(); ++k) {
                if (k > 0) REQUIRE(seen[k].from == seen[k - 1].to);
                if (k > 0) REQUIRE(seen[k].t >= seen[k - 1].t);
                same = same && seen[k].from == expected[k].from.index && seen[k].to == expected[k].to.index &&
                       same_place(seen[k].t, expected[k].t_from, 4 * tracer.resolution());
            }
            crossed += static_cast<int>(seen.size());
            // The last one leaves the object.
            if (!seen.empty()) REQUIRE(seen.back().to == 0);
            if (!same) ++differing;
        }
        CHECK(crossed > count);
        // Rays that graze an edge to within a few resolutions may see a phase there or not.
        CHECK(differing <= count / 500);
    }
}

TEST_CASE("the crossing that a filter accepts is the hit, and occludes") {
    Placed placed;
    Filter filter;
    filter.expected_geometry = placed.id;
    placed.geometry.set_user_data(&filter);
    set_filter(placed.geometry, collect);
    placed.scene.commit();
    const InterfaceTracer tracer(object());
    for (unsigned wanted = 0; wanted < 4; ++wanted) {
        CAPTURE(wanted);
        filter.accept_from = wanted;
        int accepted = 0;
        for (const Ray& ray : rays(400, 12 + wanted)) {
            const auto expected = crossings(tracer, ray);
            filter.calls.clear();
            const RTCRayHit r = trace_one(placed.scene, marked(ray));
            REQUIRE(hits(r) == (expected.size() > wanted));
            filter.calls.clear();
            REQUIRE(occluded_one(placed.scene, marked(ray)) == hits(r));
            if (!hits(r)) continue;
            ++accepted;
            REQUIRE(same_place(r.ray.tfar, expected[wanted].t_from, 2 * tracer.resolution()));
            REQUIRE(r.hit.u == expected[wanted].from.index);
            REQUIRE(r.hit.v == expected[wanted].to.index);
        }
        CHECK(accepted > 20);
    }
}

namespace {

void come_nearer(const RTCFilterFunctionNArguments* args) {
    for (unsigned i = 0; i < args->N; ++i) {
        if (args->valid[i] != -1) continue;
        RTCRayN_tfar(args->ray, args->N, i) *= 0.5f;
        RTCHitN_u(args->hit, args->N, i) = 42;
    }
}

void reject(const RTCFilterFunctionNArguments* args) {
    for (unsigned i = 0; i < args->N; ++i) args->valid[i] = 0;
}

}  // namespace

TEST_CASE("what an accepting filter changes of the hit and its distance stays") {
    Placed placed;
    const Ray ray{{0.01f, -3, 0.02f}, {0, 1, 0}};
    const RTCRayHit plain = trace_one(placed.scene, rayhit(ray));
    REQUIRE(hits(plain));
    set_filter(placed.geometry, come_nearer);
    placed.scene.commit();
    const RTCRayHit changed = trace_one(placed.scene, rayhit(ray));
    CHECK(changed.ray.tfar == 0.5f * plain.ray.tfar);
    CHECK(changed.hit.u == 42);
    CHECK(changed.hit.v == plain.hit.v);
}

TEST_CASE("filters of queries") {
    const Ray ray{{0.01f, -3, 0.02f}, {0, 1, 0}};
#if PHASETREE_EMBREE_MAJOR == 3
    SUBCASE("Embree 3: of the context") {
        Device device;
        const embree::Geometry geometry(device, object_tree());
        const RTCScene scene = new_scene(device, RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
        rtcCommitGeometry(geometry.embree());
        rtcAttachGeometry(scene, geometry.embree());
        rtcCommitScene(scene);
        CHECK(hits(trace_one(scene, rayhit(ray))));
        CHECK(same_bits(trace_one(scene, marked(ray), {.filter = reject}), marked(ray)));
        CHECK(occluded_one(scene, rayhit(ray)));
        CHECK_FALSE(occluded_one(scene, rayhit(ray), {.filter = reject}));
        rtcReleaseScene(scene);
    }
#endif
    SUBCASE("of an extended context") {
        const Placed placed(object_tree(), with_flags(PHASETREE_GEOMETRY_FLAG_EXTENDED_CONTEXT));
        PhasetreeRayContext context;
        phasetreeInitRayContext(&context);
        CHECK(hits(trace_one(placed.scene, rayhit(ray), {.context = &context.context})));
        context.filter = reject;
        CHECK(same_bits(trace_one(placed.scene, marked(ray), {.context = &context.context}), marked(ray)));
        CHECK_FALSE(occluded_one(placed.scene, rayhit(ray), {.context = &context.context}));
    }
}

TEST_CASE("crossings that involve no shown phase are passed") {
    const embree::Tree tree = object_tree();
    const InterfaceTracer tracer(object());
    for (const std::uint64_t shown : {0b00010u, 0b01100u, 0b10000u, 0b00001u, 0b11111u}) {
        CAPTURE(shown);
        PhasetreeGeometryOptions options = embree::default_options();
        options.shownPhases = shown;
        const Placed placed(tree, options);
        options.flags = PHASETREE_GEOMETRY_FLAG_NO_FILTERS;
        const Placed without_filters(tree, options);
        int passed = 0;
        for (const Ray& ray : rays(600, 21)) {
            const auto all = crossings(tracer, ray);
            const auto is_shown = [&](const Crossing& c) {
                const PhaseSet set{shown & ~std::uint64_t{1}};
                return set.contains(c.from) || set.contains(c.to);
            };
            const auto expected = std::find_if(all.begin(), all.end(), is_shown);
            if (expected != all.begin()) ++passed;
            for (const Placed* p : {&placed, &without_filters}) {
                const RTCRayHit r = trace_one(p->scene, marked(ray));
                REQUIRE(hits(r) == (expected != all.end()));
                REQUIRE(occluded_one(p->scene, marked(ray)) == hits(r));
                if (!hits(r)) continue;
                REQUIRE(same_place(r.ray.tfar, expected->t_from, 2 * tracer.resolution()));
                REQUIRE(r.hit.u == expected->from.index);
                REQUIRE(r.hit.v == expected->to.index);
            }
        }
        if (shown != 0b11111u) CHECK(passed > 20);
    }
}

TEST_CASE("rays end where they enter an opaque phase as they would if it were not known to be") {
    const embree::Tree tree = object_tree();
    const InterfaceTracer tracer(object());
    int entered = 0;
    for (const std::uint64_t opaque : {0b01000u, 0b11000u, 0b11110u}) {
        CAPTURE(opaque);
        PhasetreeGeometryOptions options = embree::default_options();
        options.opaquePhases = opaque;
        const Placed placed(tree, options);
        for (const Ray& ray : rays(600, 22)) {
            const PhaseSet set{opaque};
            if (set.contains(tracer.label(ray.origin, Evaluator::thread_workspace()))) continue;
            const auto expected = crossings(tracer, ray);
            const RTCRayHit r = trace_one(placed.scene, marked(ray));
            REQUIRE(hits(r) == !expected.empty());
            REQUIRE(occluded_one(placed.scene, marked(ray)) == hits(r));
            if (!hits(r)) continue;
            REQUIRE(same_place(r.ray.tfar, expected[0].t_from, 2 * tracer.resolution()));
            REQUIRE(r.hit.u == expected[0].from.index);
            REQUIRE(r.hit.v == expected[0].to.index);
            entered += set.contains(expected[0].to);
        }
    }
    CHECK(entered > 100);
}

}  // namespace test_filters
