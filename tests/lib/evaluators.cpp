// All evaluators give the same Φ, bit for bit: the walk over the tree, the recorded program under every SIMD
// instruction set of the machine, and dual numbers, whose gradients equal central differences.
#include <doctest/doctest.h>

#include <bit>
#include <vector>

#include "math/dual.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/program/program.hpp"
#include "support/dual_distances.hpp"
#include "support/random_tree.hpp"
#include "support/set_algebra.hpp"

namespace test_evaluators {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

bool same_bits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || (std::isnan(a) && std::isnan(b));
}

struct RestoreTarget {
    std::string name = simd_target();
    ~RestoreTarget() { use_simd_target(name); }
};

/// Points around the object, a few with round coordinates, where ties occur, and a few very far away.
glm::vec3 random_point(Random& rng, const Bounds& region) {
    glm::vec3 p = rng.in(region);
    if (rng.chance(0.2)) p = glm::round(p * 4.f) / 4.f;
    if (rng.chance(0.05)) p *= 1e6f;
    if (rng.chance(0.02)) p *= 1e15f;
    return p;
}

struct Points {
    BatchOfFloats x, y, z;
    glm::vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
};
Points random_points(Random& rng, const Bounds& region) {
    Points r;
    for (std::size_t i = 0; i < batch_size; ++i) {
        const glm::vec3 p = random_point(rng, region);
        r.x[i] = p.x;
        r.y[i] = p.y;
        r.z[i] = p.z;
    }
    return r;
}

/// Φ at points by the walk over the tree.
std::vector<Phases<float>> walk(const Phased& object, const Points& points) {
    std::vector<Phases<float>> all;
    for (std::size_t i = 0; i < batch_size; ++i) all.push_back(distances(object, points[i]));
    return all;
}

/// The number of components, labels and interface distances that differ between the walk and the program in use.
int differences(const std::vector<Phases<float>>& walked, const Evaluator& evaluator, const Points& points) {
    Evaluator::Workspace w;
    const auto& outputs = evaluator.program().outputs;
    std::vector<BatchOfFloats> out(outputs.size());
    Samples s;
    evaluator.evaluate(points.x, points.y, points.z, out, w);
    evaluator.sample(points.x, points.y, points.z, s, w);
    int wrong = 0;
    for (std::size_t i = 0; i < batch_size; ++i) {
        const Phases<float>& expected = walked[i];
        std::uint64_t present = 0;
        float first = Bounds::infinity, second = 3.402823466e38f;
        bool nan = false;
        for (std::size_t k = 0; k < outputs.size(); ++k) {
            const int phase = outputs[k].phase.index;
            present |= std::uint64_t{1} << phase;
            wrong += !expected.has(phase) || !same_bits(out[k][i], expected[phase]);
            nan = nan || std::isnan(out[k][i]);
            second = std::min(second, std::max(first, out[k][i]));
            first = std::min(first, out[k][i]);
        }
        wrong += present != expected.present;
        if (nan) continue;
        wrong += s.label[i] != static_cast<float>(phasetree::label(expected).index);
        wrong += s.distance[i] != second;
    }
    const Phases<float> one = evaluator.distances(points[0], w);
    wrong += one.present != walked[0].present;
    wrong += evaluator.label(points[0], w) != phasetree::label(walked[0]);
    return wrong;
}

template <class Check>
void for_many_objects(std::uint64_t seed, int each, Check&& check) {
    for (const NodeKind& kind : node_kinds()) {
        Random rng = random_for(seed, kind);
        for (int n = 0; n < each; ++n) {
            CAPTURE(kind.name);
            CAPTURE(n);
            check(kind.object(rng, 2 + n % 4), rng);
        }
    }
}

}  // namespace

TEST_CASE("the program under every instruction set equals the walk over the tree, bit for bit") {
    const RestoreTarget restore;
    const auto targets = simd_targets();
    REQUIRE(!targets.empty());
    for_many_objects(31, long_tests() ? 1000 : 8, [&](const Phased& object, Random& rng) {
        const Evaluator evaluator(record(object));
        const Bounds region = region_of_interest(bounds(object));
        for (std::size_t n = 0; n < 64; n += batch_size) {
            const Points points = random_points(rng, region);
            const std::vector<Phases<float>> walked = walk(object, points);
            for (const std::string& target : targets) {
                CAPTURE(target);
                use_simd_target(target);
                REQUIRE(differences(walked, evaluator, points) == 0);
            }
        }
    });
}

TEST_CASE("samples along a ray are the samples at origin + t · direction") {
    const RestoreTarget restore;
    for_many_objects(32, long_tests() ? 10 : 4, [&](const Phased& object, Random& rng) {
        const Evaluator evaluator(record(object));
        Evaluator::Workspace w;
        const glm::vec3 o = rng.in(Bounds::centred(glm::vec3(2))), d = rng.direction();
        BatchOfFloats t;
        Points at;
        for (std::size_t i = 0; i < batch_size; ++i) {
            t[i] = rng.uniform(0, 4);
            const glm::vec3 p = o + t[i] * d;
            at.x[i] = p.x;
            at.y[i] = p.y;
            at.z[i] = p.z;
        }
        for (const std::string& target : simd_targets()) {
            use_simd_target(target);
            Samples along, apart;
            evaluator.sample_ray(o, d, t, along, w);
            evaluator.sample(at.x, at.y, at.z, apart, w);
            REQUIRE(along.label.lane == apart.label.lane);
            REQUIRE(along.distance.lane == apart.distance.lane);
        }
    });
}

TEST_CASE("an unknown instruction set is rejected") {
    CHECK_THROWS_AS(use_simd_target("MMX"), std::invalid_argument);
}

TEST_CASE("dual numbers carry the same values, and the program's gradients are theirs") {
    for_many_objects(33, long_tests() ? 30 : 8, [](const Phased& object, Random& rng) {
        const Evaluator evaluator(record(object));
        const Bounds region = region_of_interest(bounds(object));
        for (int n = 0; n < 10; ++n) {
            const glm::vec3 p = random_point(rng, region);
            const Phases<float> plain = distances(object, p);
            const Phases<Dual> dual = dual_distances(object, p);
            REQUIRE(plain.present == dual.present);
            for_each_phase(plain.present, [&](int i) {
                REQUIRE(same_bits(plain[i], dual[i].value()));
                const glm::vec3 g = evaluator.gradient(p, Phase{static_cast<std::uint8_t>(i)});
                const glm::vec3 own = dual[i].gradient();
                const bool same = same_bits(g.x, own.x) && same_bits(g.y, own.y) && same_bits(g.z, own.z);
                REQUIRE(same);
            });
            REQUIRE(evaluator.gradient(p, Phase{63}) == glm::vec3(0));  // absent
        }
    });
}

TEST_CASE("gradients equal central differences away from kinks") {
    // Differences of the oracle's Φ in double, h = 10⁻⁵: they are off by h² and 10⁻¹⁶/h, about 10⁻¹⁰. Kinks are
    // recognised by one-sided differences that disagree. So is curvature above 50/m, whose share must stay small.
    constexpr double h = 1e-5;
    std::size_t compared = 0, skipped = 0, ties = 0;
    double worst = 0;
    for_many_objects(34, long_tests() ? 1000 : 12, [&](const Phased& object, Random& rng) {
        const Evaluator evaluator(record(object));
        const Bounds region = region_of_interest(bounds(object));
        for (int n = 0; n < 10; ++n) {
            const glm::vec3 p = rng.in(region);
            const glm::dvec3 q(p);
            const Components at = values(object, q);
            Components before[3], after[3];
            for (int axis = 0; axis < 3; ++axis) {
                glm::dvec3 e(0);
                e[axis] = h;
                before[axis] = values(object, q - e);
                after[axis] = values(object, q + e);
            }
            for_each_phase(phases(object).bits, [&](int i) {
                const auto k = static_cast<std::size_t>(i);
                glm::dvec3 central;
                for (int axis = 0; axis < 3; ++axis) {
                    const double back = (at[k] - before[axis][k]) / h, on = (after[axis][k] - at[k]) / h;
                    if (std::abs(back - on) > 50 * h) {
                        ++skipped;
                        return;
                    }
                    central[axis] = 0.5 * (back + on);
                }
                const glm::dvec3 g(evaluator.gradient(p, Phase{static_cast<std::uint8_t>(i)}));
                const double error = glm::length(g - central);
                ++compared;
                worst = std::max(worst, error);
                CAPTURE(i);
                CAPTURE(p.x);
                CAPTURE(p.y);
                CAPTURE(p.z);
                // Rounding of a position, some 10⁻⁷, turns the gradient by up to curvature times that: below 10⁻⁴. But
                // if two points of a surface are equally near within rounding, the direction to either may be returned.
                // A point that is displaced sideways by a fraction δ of the distance is farther by a fraction δ²/2.
                // Examples are a point above a face of a box and beside that of its copy, and a curve's place near the
                // end of a piece of it. The differences of coordinates, their squares and their sum round, by 2·2⁻²⁴ of
                // the distance together, to either place: δ²/2 < 4·2⁻²⁴, so that δ < 7·10⁻⁴.
                ties += error > 1e-4;
                REQUIRE(error < 1e-4 + 7e-4);
            });
        }
    });
    MESSAGE(compared, " gradients, ", skipped, " at kinks, ", ties, " at ties; largest error ", worst);
    CHECK(ties < compared / 10000);
    CHECK(skipped < compared / 20);
}

}  // namespace test_evaluators
