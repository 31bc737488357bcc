// Double precision through the C99 interface: the same numbers as in C++, walks that chain, and wrong arguments.
#include "embree/api/api.hpp"
#include "phasetree/trace/precise_tracer.hpp"
#include "support/random_tree.hpp"

namespace test_precise {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

constexpr auto none = PHASETREE_ERROR_NONE, invalid = PHASETREE_ERROR_INVALID_ARGUMENT;

PhasetreePreciseRay precise_ray(const glm::dvec3& o, const glm::dvec3& d, unsigned carried = PHASETREE_UNKNOWN_PHASE) {
    return {{o.x, o.y, o.z}, {d.x, d.y, d.z}, std::numeric_limits<double>::infinity(), carried};
}
glm::dvec3 vector_of(const double* v) {
    return {v[0], v[1], v[2]};
}

}  // namespace

TEST_CASE("points and rays in double precision are those of C++") {
    const embree::Tree tree = object_tree();
    const PreciseTracer tracer(object());
    tests::Random rng(61);
    std::vector<double> points;
    std::vector<PhasetreePreciseRay> rays;
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 p(rng.in(tracer.bounds()));
        points.insert(points.end(), {p.x, p.y, p.z});
        rays.push_back(precise_ray(p, 2.0 * glm::dvec3(rng.direction())));
    }
    std::vector<unsigned> phases(rays.size());
    std::vector<double> distances(rays.size());
    REQUIRE(phasetreeLocate(tree.get(), points.data(), rays.size(), phases.data()) == none);
    REQUIRE(phasetreeGetSafeDistances(tree.get(), points.data(), rays.size(), distances.data()) == none);
    std::vector<PhasetreePreciseCrossing> found(rays.size());
    REQUIRE(phasetreeFindCrossings(tree.get(), rays.data(), rays.size(), found.data(), nullptr, nullptr) == none);
    std::size_t crossings = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const glm::dvec3 p = vector_of(&points[3 * i]);
        CHECK(phases[i] == tracer.evaluator().label(p).index);
        CHECK(distances[i] == tracer.evaluator().safe_distance(p, tracer.value_error()));
        const auto expected = tracer.first_crossing({.origin = p, .direction = vector_of(rays[i].direction)});
        CHECK(std::isfinite(found[i].tFrom) == expected.has_value());
        CHECK(found[i].from == phases[i]);
        if (!expected) {
            CHECK(found[i].to == phases[i]);
            continue;
        }
        ++crossings;
        CHECK(found[i].tFrom == expected->t_from);
        CHECK(found[i].tTo == expected->t_to);
        CHECK(vector_of(found[i].pointFrom) == expected->p_from);
        CHECK(vector_of(found[i].pointTo) == expected->p_to);
        CHECK(vector_of(found[i].normal) == expected->normal);
        CHECK(found[i].to == expected->to.index);
    }
    CHECK(crossings > 100);
}

TEST_CASE("a walk in double precision chains and ends in the vacuum") {
    const embree::Tree tree = object_tree();
    PhasetreePreciseRay ray = precise_ray({0.1, 0.05, 3}, {0.01, 0.02, -1});
    std::size_t crossings = 0;
    unsigned phase = PHASETREE_VACUUM;
    for (; crossings < 100; ++crossings) {
        PhasetreePreciseCrossing c;
        REQUIRE(phasetreeFindCrossings(tree.get(), &ray, 1, &c, nullptr, nullptr) == none);
        CHECK(c.from == phase);
        if (!std::isfinite(c.tFrom)) break;
        CHECK(c.to != c.from);
        phase = c.to;
        std::copy(c.pointTo, c.pointTo + 3, ray.origin);
        ray.carried = c.to;
    }
    CHECK(crossings >= 4);
    CHECK(crossings < 100);
    CHECK(phase == PHASETREE_VACUUM);
}

TEST_CASE("double precision refuses wrong arguments, writes nothing, and can be cancelled") {
    const embree::Tree tree = object_tree();
    const PhasetreeTree t = tree.get();
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const double good[3] = {0, 0, 0}, bad[6] = {0, 0, 0, 0, nan, 0};
    unsigned phases[2] = {77, 77};
    double distances[2] = {77, 77};
    expect_error(phasetreeLocate(nullptr, good, 1, phases), PHASETREE_ERROR_INVALID_HANDLE, "tree is NULL");
    expect_error(phasetreeLocate(t, nullptr, 1, phases), invalid, "points is NULL");
    expect_error(phasetreeLocate(t, good, 1, nullptr), invalid, "phases is NULL");
    expect_error(phasetreeLocate(t, bad, 2, phases), invalid, "point 1 has a coordinate that is not finite");
    expect_error(phasetreeGetSafeDistances(t, bad, 2, distances), invalid, "point 1");
    expect_error(phasetreeGetSafeDistances(t, good, 1, nullptr), invalid, "distances is NULL");
    CHECK(phasetreeLocate(t, nullptr, 0, nullptr) == none);
    CHECK(phases[0] == 77);
    CHECK(distances[0] == 77);
    PhasetreePreciseCrossing c{};
    c.tFrom = 77;
    const auto find = [&](const PhasetreePreciseRay& ray) {
        return phasetreeFindCrossings(t, &ray, 1, &c, nullptr, nullptr);
    };
    expect_error(find(precise_ray({0, 0, 0}, {0, 0, 0})), invalid, "ray 0 has a direction of length 0");
    expect_error(find(precise_ray({0, nan, 0}, {0, 0, 1})), invalid, "ray 0 has a number that is not finite");
    expect_error(find(precise_ray({0, 0, 0}, {0, 0, 1}, 5)), invalid, "ray 0 carries phase 5, which does not exist");
    PhasetreePreciseRay ray = precise_ray({0, 0, 0}, {0, 0, 1});
    expect_error(phasetreeFindCrossings(t, nullptr, 1, &c, nullptr, nullptr), invalid, "rays is NULL");
    expect_error(phasetreeFindCrossings(t, &ray, 1, nullptr, nullptr, nullptr), invalid, "crossings is NULL");
    const auto cancel = [](void* user) { return *static_cast<bool*>(user); };
    bool is_cancelled = true;
    CHECK(phasetreeFindCrossings(t, &ray, 1, &c, cancel, &is_cancelled) == PHASETREE_ERROR_CANCELLED);
    CHECK(c.tFrom == 77);
    is_cancelled = false;
    CHECK(phasetreeFindCrossings(t, &ray, 1, &c, cancel, &is_cancelled) == none);
    ray.tMax = nan;
    expect_error(find(ray), invalid, "tMax");
    // An unbounded tree has points, but no rays.
    const embree::Tree endless =
        embree::Tree::from_text(R"({"phases": {"a": {}}, "tree": {"set": {"phase": "a", "of": {"plane": {}}}}})");
    const double below[3] = {5, 0, -2};
    CHECK(phasetreeLocate(endless.get(), below, 1, phases) == none);
    CHECK(phases[0] == 1);
    CHECK(phasetreeGetSafeDistances(endless.get(), below, 1, distances) == none);
    CHECK(distances[0] == doctest::Approx(2).epsilon(1e-5));
    const PhasetreePreciseRay up = precise_ray({0, 0, 0}, {0, 0, 1});
    expect_error(phasetreeFindCrossings(endless.get(), &up, 1, &c, nullptr, nullptr), PHASETREE_ERROR_INVALID_TREE,
                 "unbounded");
}

}  // namespace test_precise
