// Tracing in double precision: no crossing is lost above the resolution and none is found twice, along plain, tangent,
// coincident and re-entrant rays; against analytic roots and Boolean set algebra (support/precise_walks.hpp).
#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <bit>
#include <cstdlib>
#include <cstring>
#include <functional>

#include "phasetree/trace/precise_tracer.hpp"
#include "support/long_tests.hpp"
#include "support/precise_walks.hpp"
#include "support/random_tree.hpp"
#include "support/traced_scenes.hpp"

namespace test_precise_crossings {

using namespace phasetree;
using namespace phasetree::tests;
using analytic::exact_pieces;
using glm::dvec3;
using traced::filled, traced::moved, traced::phase, traced::Scene;
using walks::exact_scene, walks::Tolerance, walks::Totals, walks::Walk;

namespace {

// Rays from a crossing: on from its far end, reflected, back through it (re-entrant), along the interface (tangent or
// coincident), with and without the phase that they are in.
PreciseRay from_crossing(Random& rng, const PreciseCrossing& c, const dvec3& d) {
    const bool is_far = rng.chance(0.5);
    PreciseRay ray{is_far ? c.p_to : c.p_from, dvec3(rng.direction())};
    switch (rng.below(4)) {
        case 0:
            ray.direction = is_far ? d : -d;
            break;
        case 1:
            ray.direction = is_far ? -d : d;
            break;
        case 2:
            ray.direction = glm::cross(c.normal, dvec3(rng.direction()));
            break;
        default:
            break;
    }
    if (!(glm::length(ray.direction) > 1e-3)) ray.direction = dvec3(0, 0, 1);
    ray.direction = glm::normalize(ray.direction);
    if (rng.chance(0.7)) ray.carried = is_far ? c.to : c.from;
    return ray;
}

// Checks rays in one batch, and returns their walks.
std::vector<Walk> check_rays(const Phased& object, const PreciseTracer& tracer, std::span<const PreciseRay> rays,
                             const Tolerance& tolerance, double exactness, Totals& totals) {
    const double size = double{tracer.bounds().diagonal()};
    const std::vector<Walk> walks = walks::walked(tracer, rays), again = walks::restarted(tracer, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const dvec3 &o = rays[i].origin, &d = rays[i].direction;
        const double length = glm::distance(o, dvec3(tracer.bounds().centre())) + size;
        const std::vector<analytic::Piece> exact = exact_pieces(object, o, d, length);
        ++totals.rays;
        for (const Walk& w : {std::cref(walks[i]), std::cref(again[i])}) {
            walks::check_brackets(tracer, w, o, d, totals);
            walks::compare(object, w, exact, o, d, length, tolerance, totals);
        }
        // A phase counts as left where another is deeper by η, so that is how far a crossing may be from the face.
        walks::compare_isolated(object, walks[i], exact, o, d, size, std::max(exactness, tracer.value_error()), totals);
    }
    return walks;
}

void check_scene(const Scene& scene, Random& rng, int rays, bool is_exact, Totals& totals) {
    std::optional<InterfaceTracer> floats;
    try {
        floats.emplace(scene.object);
    } catch (const ModelError&) {
        return;  // cut to nothing
    }
    const PreciseTracer tracer(scene.object);
    const double size = double{tracer.bounds().diagonal()};
    // Constants in floats move interfaces by some of their units where the oracle has its own.
    const double exactness =
        is_exact ? 1e-12 * size : 1e-6 * std::max(size, double{glm::length(tracer.bounds().centre())});
    const Tolerance tolerance{std::max(4 * tracer.resolution(), exactness),
                              std::max(100 * tracer.value_error(), exactness)};
    const auto check = [&](std::span<const PreciseRay> some) {
        return check_rays(scene.object, tracer, some, tolerance, exactness, totals);
    };
    constexpr int block = 64;
    for (int begin = 0; begin < rays; begin += block) {
        std::vector<PreciseRay> first, second;
        for (int k = begin; k < std::min(begin + block, rays); ++k) {
            const traced::Probe probe = traced::random_probe(rng, scene, *floats);
            first.push_back({dvec3(probe.o), glm::normalize(dvec3(probe.d))});
        }
        const std::vector<Walk> walks = check(first);
        for (std::size_t i = 0; i < first.size(); ++i)
            if (!walks[i].crossings.empty())
                second.push_back(from_crossing(rng, walks[i].crossings[0], first[i].direction));
        check(second);
    }
}

int number_from_environment(const char* name, int otherwise) {
    const char* const text = std::getenv(name);
    return text ? std::max(0, std::atoi(text)) : otherwise;
}

// Checks rays through 100 scenes, which scene(number, random numbers) makes.
template <class MakeScene>
Totals check_scenes(std::uint64_t seed, int rays_in_short_form, bool is_exact, MakeScene&& scene) {
    const int rays = number_from_environment("PHASETREE_RAYS_PER_TREE", long_tests() ? 120'000 : rays_in_short_form);
    const auto part = static_cast<std::uint64_t>(number_from_environment("PHASETREE_PART_OF_RAYS", 0));
    std::vector<Totals> each(100);
    tbb::parallel_for(std::size_t{0}, each.size(), [&](std::size_t n) {
        Random for_scene(1000 * seed + n), for_rays(1'000'000'007 * part + 2000 * seed + n);
        check_scene(scene(static_cast<int>(n), for_scene), for_rays, rays, is_exact, each[n]);
    });
    Totals all;
    for (const Totals& t : each) all.add(t);
    return all;
}

void report(const char* what, const Totals& t) {
    for (const std::string& c : t.complaints) MESSAGE(c);
    MESSAGE(std::string(what), ": ", t.rays, " rays, ", t.crossings, " crossings, ", t.normals, " normals; ", t.wrong,
            " wrong, ", t.unchained, " not chained, ", t.uncertified, " not certified, ", t.wide, " wide, ",
            t.bad_normals, " normals or places off");
}

}  // namespace

// The long form has 10⁸ crossings in 200 trees, counting those of restarted walks. CTest ends tests after an hour, so
// run it by itself:
//
//     PHASETREE_LONG_TESTS=1 build/release/tests/test-lib -sf='*/precise_crossings.cpp' -tc='no crossing*,nor in*'
//
// It can also be run in parts: PHASETREE_RAYS_PER_TREE=N takes N rays per tree instead of 120,000, and
// PHASETREE_PART_OF_RAYS=K takes other rays through the same trees for each K.
TEST_CASE("no crossing is lost or found twice in trees with exact constants") {
    const Totals totals = check_scenes(401, 50, true, [](int, Random& rng) { return exact_scene(rng); });
    report("exact constants", totals);
    CHECK(totals.errors() == 0);
    CHECK(totals.crossings > totals.rays);
    CHECK(totals.normals > totals.rays / 4);
}

TEST_CASE("nor in trees with rotations, scales, junctions, thin walls and vessels") {
    const Totals totals = check_scenes(402, 40, false, [](int n, Random& rng) {
        return n % 10 == 0   ? traced::junction(rng, false)
               : n % 10 == 1 ? traced::junction(rng, true)
               : n % 10 == 2 ? traced::abutting(rng, false)
               : n % 10 == 3 ? traced::abutting(rng, true)
               : n % 10 == 4 ? traced::thin(rng)
               : n % 10 == 5 ? traced::vessel(rng)
                             : traced::random_scene(rng);
    });
    report("rounded constants", totals);
    CHECK(totals.errors() == 0);
    CHECK(totals.crossings > totals.rays);
}

TEST_CASE("the comparison sees lost, repeated and mislabelled crossings") {
    const Phased object = filled(1, Difference{.from = Sphere{.radius = 1}, .subtract = {Sphere{.radius = 0.5f}}});
    const PreciseTracer tracer(object);
    const PreciseRay ray{{-3, 0.1, 0.2}, {1, 0, 0}};
    const std::vector<analytic::Piece> exact = exact_pieces(object, ray.origin, ray.direction, 6);
    const Walk right = walks::walked(tracer, ray);
    REQUIRE(right.crossings.size() == 4);
    const auto errors = [&](const Walk& w) {
        Totals totals;
        walks::check_brackets(tracer, w, ray.origin, ray.direction, totals);
        walks::compare(object, w, exact, ray.origin, ray.direction, 6, {1e-8, 1e-11}, totals);
        walks::compare_isolated(object, w, exact, ray.origin, ray.direction, 2, 1e-11, totals);
        return totals.errors();
    };
    CHECK(errors(right) == 0);
    Walk skipped = right;  // a re-entrance
    skipped.crossings.erase(skipped.crossings.begin() + 1, skipped.crossings.begin() + 3);
    CHECK(errors(skipped) > 0);
    Walk repeated = right;
    repeated.crossings.insert(repeated.crossings.begin(), repeated.crossings[0]);
    CHECK(errors(repeated) > 0);
    Walk mislabelled = right;
    mislabelled.crossings[1].to = phase(1);
    CHECK(errors(mislabelled) > 0);
    Walk moved_by_little = right;
    moved_by_little.crossings[2].t_to += 1e-9;
    moved_by_little.crossings[2].t_from += 1e-9;
    CHECK(errors(moved_by_little) > 0);
}

// Random trees of all nodes by dense marching: at points along a ray, Boolean set algebra says which phase it is.
TEST_CASE("walks through trees of all kinds of nodes are in the phases of set algebra") {
    Random rng(403);
    const std::size_t trees = 200;
    const int rays = long_tests() ? 1000 : 12, points = 24;
    std::size_t traced_trees = 0, crossings = 0, compared = 0, wrong = 0, unchained = 0;
    for (int n = 0; traced_trees < trees; ++n) {
        const Phased object = random_object(rng, 2 + rng.below(3));
        std::optional<PreciseTracer> tracer;
        try {
            tracer.emplace(object);
        } catch (const ModelError&) {
            continue;  // empty, unbounded, or too long
        }
        ++traced_trees;
        const double size = double{tracer->bounds().diagonal()};
        for (int k = 0; k < rays; ++k) {
            const dvec3 o(rng.in(tracer->bounds())), d = glm::normalize(dvec3(rng.direction()));
            const Walk walk = walks::walked(*tracer, {.origin = o, .direction = d});
            Totals totals;
            walks::check_brackets(*tracer, walk, o, d, totals);
            crossings += totals.crossings;
            unchained += totals.unchained + totals.uncertified;
            for (int i = 0; i < points; ++i) {
                const double t = size * rng.unit();
                const dvec3 p = o + t * d;
                // The oracle has its own constants, and approximations of its own for noise.
                if (values(object, p).interface_distance() < 1e-4 * size) continue;
                ++compared;
                if (tests::label(object, p) != walk.at(t) && wrong++ < 5)
                    MESSAGE("tree ", n, ", ray ", k, ": phase ", int(tests::label(object, p).index), " expected, ",
                            int(walk.at(t).index), " found at t = ", t, " of ", size);
            }
        }
    }
    MESSAGE(traced_trees, " trees, ", crossings, " crossings, ", compared, " points");
    CHECK(wrong == 0);
    CHECK(unchained == 0);
    CHECK(crossings > trees * 5);
    CHECK(compared > trees * 100);
}

TEST_CASE("a ray that starts on a face, runs along one or touches a ball") {
    const Phased box = filled(1, Box{.size = {2, 2, 2}}), ball = filled(1, Sphere{.radius = 1});
    const PreciseTracer in_box(box), at_ball(ball);
    // On the face: the label there is the lowest phase of equal components, the vacuum.
    CHECK(in_box.evaluator().label({0, 0, 1}) == vacuum);
    const auto inward = in_box.first_crossing({.origin = {0, 0, 1}, .direction = {0, 0, -1}});
    REQUIRE(inward);
    CHECK(inward->from == vacuum);
    CHECK(inward->t_to < 1e-15);
    CHECK(inward->normal.z == doctest::Approx(-1));
    CHECK_FALSE(in_box.first_crossing({.origin = {0, 0, 1}, .direction = {0, 0, 1}}));
    // In the phase that the ray comes from, it starts beyond the face.
    const auto on = in_box.first_crossing({.origin = {0, 0, 1}, .direction = {0, 0, -1}, .carried = phase(1)});
    REQUIRE(on);
    CHECK(on->t_from == doctest::Approx(2));
    // Along the face, and along an edge.
    CHECK_FALSE(in_box.first_crossing({.origin = {-5, 0, 1}, .direction = {1, 0, 0}}));
    CHECK_FALSE(in_box.first_crossing({.origin = {-5, 1, 1}, .direction = {1, 0, 0}}));
    // A tangent touches; a millionth of a millionth below it is a chord of known length.
    CHECK_FALSE(at_ball.first_crossing({.origin = {-3, 0, 1}, .direction = {1, 0, 0}}));
    const PreciseRay chord{.origin = {-3, 0, 1 - 1e-12}, .direction = {1, 0, 0}};
    const auto found = at_ball.crossings(std::span(&chord, 1));
    REQUIRE(found->crossings.size() == 2);
    CHECK(found->crossings[1].t_from - found->crossings[0].t_to == doctest::Approx(2 * std::sqrt(2e-12)).epsilon(1e-3));
    // A carried phase that is nowhere near is a crossing at the start, of zero length.
    const auto mistaken = in_box.first_crossing({.origin = {0, 0, 0}, .carried = phase(3)});
    REQUIRE(mistaken);
    CHECK(mistaken->t_to == 0);
    CHECK(mistaken->from == phase(3));
    CHECK(mistaken->to == phase(1));
}

TEST_CASE("distances are in units of the direction, and t_max ends the search") {
    const PreciseTracer tracer(filled(1, Sphere{.radius = 1}));
    const auto hit = tracer.first_crossing({.origin = {-3, 0, 0}, .direction = {4, 0, 0}});
    REQUIRE(hit);
    CHECK(hit->t_from == doctest::Approx(0.5).epsilon(1e-14));
    CHECK(hit->p_to.x == doctest::Approx(-1).epsilon(1e-14));
    CHECK_FALSE(tracer.first_crossing({.origin = {-3, 0, 0}, .direction = {4, 0, 0}, .t_max = 0.4999}));
    CHECK(tracer.first_crossing({.origin = {-3, 0, 0}, .direction = {4, 0, 0}, .t_max = 0.5001}));
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    for (const double bad : {0.0, nan, infinity, 1e-320}) {
        CHECK_FALSE(tracer.first_crossing({.origin = {-3, 0, 0}, .direction = {bad, 0, 0}}));
        if (bad != 0.0 && bad != 1e-320) CHECK_FALSE(tracer.first_crossing({.origin = {bad, 0, 0}}));
    }
    CHECK_FALSE(tracer.first_crossing({.origin = {-3, 0, 0}, .direction = {4, 0, 0}, .t_max = nan}));
    // From far away, the ray is only rounded where it enters the bounds.
    const auto far = tracer.first_crossing({.origin = {-1e9, 0.25, 0}, .direction = {1, 0, 0}});
    REQUIRE(far);
    CHECK(glm::length(far->p_to) == doctest::Approx(1).epsilon(1e-14));
}

TEST_CASE("results do not depend on threads, and batches can be cancelled") {
    Random rng(404);
    const Scene scene = exact_scene(rng);
    const PreciseTracer tracer(scene.object);
    std::vector<PreciseRay> rays;
    for (int i = 0; i < 1000; ++i)
        rays.push_back({.origin = dvec3(rng.in(tracer.bounds())), .direction = dvec3(rng.direction())});
    const auto bytes = [&] {
        const auto all = tracer.crossings(rays);
        std::vector<std::optional<PreciseCrossing>> first(rays.size());
        CHECK(tracer.first_crossings(rays, first));
        std::vector<double> numbers;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            CHECK(first[i].has_value() == (all->offsets[i + 1] > all->offsets[i]));
            if (first[i]) CHECK(first[i]->t_to == all->crossings[all->offsets[i]].t_to);
        }
        for (const PreciseCrossing& c : all->crossings)
            numbers.insert(numbers.end(), {c.t_from, c.t_to, c.p_from.x, c.normal.z, double(c.to.index)});
        return numbers;
    };
    const std::vector<double> several = bytes();
    tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    CHECK(bytes() == several);
    std::atomic<int> polls{0};
    CHECK_FALSE(tracer.crossings(rays, [&] { return ++polls > 2; }));
    std::vector<std::optional<PreciseCrossing>> first(rays.size());
    CHECK_FALSE(tracer.first_crossings(rays, first, [] { return true; }));
    CHECK_THROWS_AS(tracer.first_crossings(rays, std::span(first).first(3)), std::invalid_argument);
}

TEST_CASE("objects that cannot be traced, and resolutions") {
    CHECK_THROWS_AS(PreciseTracer(filled(1, Plane{})), ModelError);
    const Phased ball = filled(1, Sphere{.radius = 1});
    const double size = double{PreciseTracer(ball).bounds().diagonal()};
    CHECK(PreciseTracer(ball).resolution() == doctest::Approx(size * 0x1p-30));
    CHECK(PreciseTracer(ball, 1e-6).resolution() == 1e-6);
    CHECK(PreciseTracer(ball, 100).resolution() == doctest::Approx(0.01 * size));
    CHECK(PreciseTracer(ball, 1e-30).resolution() > 1e-14);
    // A wall thinner than float tracing can see.
    const Phased wall = filled(1, Box{.size = {2, 2, 1e-7f}});
    const PreciseRay ray{.origin = {0.3, 0.2, 1}, .direction = {0, 0, -1}};
    const auto found = PreciseTracer(wall).crossings(std::span(&ray, 1));
    REQUIRE(found->crossings.size() == 2);
    CHECK(found->crossings[1].t_from - found->crossings[0].t_to == doctest::Approx(double{1e-7f}).epsilon(1e-7));
}

}  // namespace test_precise_crossings
