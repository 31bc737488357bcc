// Samples and crossings in double precision, computed several at a time, have the same bits as if computed one at a
// time, with every instruction set.
#include <doctest/doctest.h>

#include <cstring>

#include "evaluation/precise_program.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/math/float_mode.hpp"
#include "phasetree/trace/precise_tracer.hpp"
#include "support/precise_walks.hpp"
#include "support/random_tree.hpp"
#include "support/traced_scenes.hpp"

namespace test_precise_batches {

using namespace phasetree;
using namespace phasetree::tests;
using evaluation::answer, evaluation::CarriedSample, evaluation::sample_for, evaluation::SampleQuery;
using glm::dvec3;

namespace {

// Runs f with each instruction set of this machine.
template <class F>
void with_each_target(F&& f) {
    const std::string before = simd_target();
    for (const std::string& name : simd_targets()) {
        use_simd_target(name);
        f(name);
    }
    use_simd_target(before);
}

bool are_same(double a, double b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}
bool are_same(const dvec3& a, const dvec3& b) {
    return are_same(a.x, b.x) && are_same(a.y, b.y) && are_same(a.z, b.z);
}
bool are_same(const CarriedSample& a, const CarriedSample& b) {
    return a.phase == b.phase && are_same(a.own, b.own) && are_same(a.interface_distance, b.interface_distance) &&
           are_same(a.component, b.component);
}
bool are_same(const PreciseCrossing& a, const PreciseCrossing& b) {
    return a.from == b.from && a.to == b.to && are_same(a.t_from, b.t_from) && are_same(a.t_to, b.t_to) &&
           are_same(a.p_from, b.p_from) && are_same(a.p_to, b.p_to) && are_same(a.normal, b.normal);
}

}  // namespace

TEST_CASE("samples of random trees in batches equal single samples, bit for bit") {
    const FlushSubnormals flush;
    std::size_t batches = 0, trees = 0;
    with_each_target([&](const std::string& target) {
        Random rng(411);
        for (int n = 0; n < 400; ++n) {
            const PreciseEvaluator object(random_object(rng, 2 + rng.below(3)));
            const evaluation::PreciseProgram& program = object.program();
            ++trees;
            if (program.runs_in_batches) ++batches;
            std::vector<SampleQuery> queries(1 + static_cast<std::size_t>(rng.below(8)));
            for (SampleQuery& q : queries)
                q = {2.0 * dvec3(rng.direction()) * double{rng.unit()}, traced::phase(rng.below(4)), {}};
            answer(program, queries);
            for (const SampleQuery& q : queries)
                CHECK_MESSAGE(are_same(q.result, sample_for(program, q.point, q.carried)), target, ", tree ", n);
        }
    });
    CHECK(batches > trees / 4);
}

TEST_CASE("crossings of many rays equal those of single rays, bit for bit") {
    std::size_t crossings = 0;
    with_each_target([&](const std::string& target) {
        Random rng(412);
        for (int n = 0; n < 30; ++n) {
            const traced::Scene scene = n % 3 == 0   ? walks::exact_scene(rng)
                                        : n % 3 == 1 ? traced::random_scene(rng)
                                                     : traced::Scene{"any", random_object(rng, 2 + rng.below(3)), {}};
            std::optional<PreciseTracer> tracer;
            std::optional<InterfaceTracer> floats;
            try {
                tracer.emplace(scene.object);
                floats.emplace(scene.object);
            } catch (const ModelError&) {
                continue;  // empty, unbounded, or too long
            }
            std::vector<PreciseRay> rays;
            for (int k = 0; k < 40; ++k) {
                const traced::Probe probe = traced::random_probe(rng, scene, *floats);
                rays.push_back({dvec3(probe.o), dvec3(probe.d)});
                if (k % 5 == 0) rays.back().carried = traced::phase(rng.below(3));
                if (k % 7 == 0) rays.back().direction = dvec3(0);  // ends at once
                if (k % 7 == 1) rays.back().t_max = double{rng.unit()};
            }
            const auto all = tracer->crossings(rays);
            std::vector<std::optional<PreciseCrossing>> first(rays.size());
            tracer->first_crossings(rays, first);
            for (std::size_t i = 0; i < rays.size(); ++i) {
                std::vector<PreciseCrossing> one;
                PreciseRay ray = rays[i];
                const auto alone = tracer->crossings(std::span(&ray, 1));
                CHECK(alone->start[0] == all->start[i]);
                const std::size_t begin = all->offsets[i], count = all->offsets[i + 1] - begin;
                REQUIRE(alone->crossings.size() == count);
                for (std::size_t k = 0; k < count; ++k)
                    CHECK_MESSAGE(are_same(alone->crossings[k], all->crossings[begin + k]), target, ", tree ", n);
                const auto single = tracer->first_crossing(ray);
                REQUIRE(single.has_value() == first[i].has_value());
                CHECK(single.has_value() == (count > 0));
                if (single) CHECK(are_same(*single, *first[i]));
                crossings += count;
            }
        }
    });
    CHECK(crossings > 500);
}

}  // namespace test_precise_batches
