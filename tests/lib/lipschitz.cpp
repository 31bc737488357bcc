// The invariants of every operator: I1, components are 1-Lipschitz; I2, φᵢ + φⱼ ≥ 0 for i ≠ j, vacuum included, so that
// exactly one is negative away from interfaces. They do not tell whether an operator is the right one; labels.cpp does.
#include <doctest/doctest.h>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/list.hpp"
#include "phasetree/program/program.hpp"
#include "support/random_tree.hpp"
#include "support/set_algebra.hpp"

namespace test_lipschitz {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

/// Error of a component in float; checked by labels.cpp.
double rounding(const glm::vec3& p) {
    return 4e-6 * (1 + static_cast<double>(glm::length(p)));
}

/// Pairs of points: far ones, near ones, ones across the surface's kinks (a plane of symmetry, an axis), and ones far
/// outside, where the bound of a local warp takes over.
std::pair<glm::vec3, glm::vec3> random_pair(Random& rng, const Bounds& region) {
    glm::vec3 p = rng.in(region);
    if (rng.chance(0.2)) p *= rng.uniform(1, 20);
    if (rng.chance(0.1)) p[rng.below(3)] = 0;
    if (rng.chance(0.2)) p = glm::round(p * 4.f) / 4.f;
    const float distance = std::exp2(rng.uniform(-12, 3));
    return {p, p + distance * rng.direction()};
}

struct Slopes {
    double steepest = 0;  ///< in double, by the oracle
    std::size_t pairs = 0, too_steep = 0, overlapping = 0, not_one = 0;
    std::string where;
};

void look(const Phased& object, Random& rng, int pairs, Slopes& s) {
    const Bounds region = region_of_interest(bounds(object));
    for (int n = 0; n < pairs; ++n) {
        const auto [p, q] = random_pair(rng, region);
        const double distance = glm::length(glm::dvec3(p) - glm::dvec3(q));
        const double error = rounding(p) + rounding(q);
        const Phases<float> a = distances(object, p), b = distances(object, q);
        const Components exact_a = values(object, glm::dvec3(p)), exact_b = values(object, glm::dvec3(q));
        ++s.pairs;
        int negative = 0;
        double first = absent, second = absent;
        for_each_phase(a.present, [&](int i) {
            const auto k = static_cast<std::size_t>(i);
            s.too_steep += !(std::abs(static_cast<double>(a[i]) - b[i]) <= distance * (1 + 1e-5) + error);
            s.steepest = std::max(s.steepest, std::abs(exact_a[k] - exact_b[k]) / distance);
            negative += a[i] < 0;
            second = std::min(second, std::max(first, static_cast<double>(a[i])));
            first = std::min(first, static_cast<double>(a[i]));
        });
        s.overlapping += !(first + second >= -2 * rounding(p));
        // Exactly one component is negative, except within rounding errors, and where a phase meets itself: there it is
        // zero.
        if (second > 2 * rounding(p)) s.not_one += negative > 1 || first > rounding(p);
    }
}

}  // namespace

TEST_CASE("components of every node are 1-Lipschitz and do not overlap") {
    const int trees = long_tests() ? 50 : 20, pairs = long_tests() ? 20'000 : 200;
    std::size_t total = 0;
    for (const NodeKind& kind : node_kinds()) {
        Random rng = random_for(51, kind);
        Slopes s;
        CAPTURE(kind.name);
        // A bound that is far too large would be safe but slow, so some pair must have a slope close to 1. A periodic
        // sheet has the slope 1 only at single points, which have separate tests (fractal_noise.cpp), and Voronoi
        // phases only between two sites. Nodes that displace space by noise are steep only where the displacement is
        // small. Not every set of trees contains such a place, so the test draws more trees until it finds one.
        const bool sheet =
            kind.name == "gyroid" || kind.name == "schwarz_p" || kind.name == "schwarz_d" || kind.name == "voronoi";
        const double wanted = sheet ? 0.8 : 0.99;
        for (int tree = 0; tree < trees || (tree < 200 && s.steepest <= wanted); ++tree) {
            CAPTURE(tree);
            look(kind.object(rng, 2 + tree % 3), rng, pairs, s);
            REQUIRE(s.too_steep == 0);
            REQUIRE(s.overlapping == 0);
            REQUIRE(s.not_one == 0);
            // In double, rounding is no excuse, except for parameters that are floats themselves: the length of a
            // plane's normal and the inverse of a scale's factor are accurate to 10⁻⁷, times the depth of the tree.
            REQUIRE(s.steepest <= 1 + 2e-6);
        }
        total += s.pairs;
        CHECK(s.steepest > wanted);
    }
    MESSAGE(total, " pairs");
    CHECK(total >= (long_tests() ? 100'000'000 : 400'000));
}

TEST_CASE("a twist's slope stays below one far outside and at the corners of its bounds") {
    Random rng(52);
    for (int n = 0; n < 300; ++n) {
        const Phased object = object_kind("twist").object(rng, 3);
        const Bounds b = bounds(object);
        const float d = b.diagonal();
        for (int pair = 0; pair < 200; ++pair) {
            // About the corners, and about the shell where bound and warped field take turns.
            const glm::vec3 p = b.corner(rng.below(8)) + d * rng.uniform(0, 1) * rng.direction();
            const glm::vec3 q = p + d * std::exp2(rng.uniform(-14, 2)) * rng.direction();
            const Components x = values(object, glm::dvec3(p)), y = values(object, glm::dvec3(q));
            const double distance = glm::length(glm::dvec3(p) - glm::dvec3(q));
            for_each_phase(phases(object).bits, [&](int i) {
                const auto k = static_cast<std::size_t>(i);
                REQUIRE(std::abs(x[k] - y[k]) <= distance * (1 + 2e-6));
            });
        }
    }
}

namespace {

/// The largest slope of any scalar of the program above its recorded bound, as a ratio.
double steepest_instruction(const Program& program, const Bounds& region, Random& rng, int pairs) {
    Program all = program;
    all.outputs.clear();
    const auto first_map = static_cast<std::uint16_t>(Op::first_primitive) + Primitives::size;
    for (std::uint32_t i = 1; i < program.instructions.size(); ++i)
        if (static_cast<std::uint16_t>(program.instructions[i].op) < first_map) all.outputs.push_back({Phase{}, i});
    const Evaluator evaluator(all);
    Evaluator::Workspace w;
    std::vector<BatchOfFloats> out(all.outputs.size());
    double worst = 0;
    for (int n = 0; n < pairs; n += static_cast<int>(batch_size) - 1) {
        // Points that are each paired with the point in lane 0.
        BatchOfFloats x, y, z;
        for (std::size_t i = 0; i < batch_size; ++i) {
            const glm::vec3 p = rng.in(region);
            x[i] = p.x;
            y[i] = p.y;
            z[i] = p.z;
        }
        evaluator.evaluate(x, y, z, out, w);
        const glm::vec3 p{x[0], y[0], z[0]};
        for (std::size_t i = 1; i < batch_size; ++i) {
            const glm::vec3 q{x[i], y[i], z[i]};
            const double distance = glm::length(glm::dvec3(p) - glm::dvec3(q));
            for (std::size_t k = 0; k < out.size(); ++k) {
                const double bound = program.lipschitz[all.outputs[k].value];
                const double slope = std::abs(static_cast<double>(out[k][0]) - out[k][i]);
                worst =
                    std::max(worst, (slope - std::max(bound, 1.0) * (rounding(p) + rounding(q))) / (bound * distance));
            }
        }
    }
    return worst;
}

}  // namespace

TEST_CASE("every value of a program respects its recorded Lipschitz bound") {
    Random rng(53);
    for (int tree = 0; tree < 400; ++tree) {
        const Phased object = random_object(rng, 3 + tree % 3);
        const Program program = record(object);
        REQUIRE(program.lipschitz.size() == program.instructions.size());
        for (const Output& o : program.outputs) REQUIRE(program.lipschitz[o.value] < 1 + 1e-5f);
        CAPTURE(tree);
        const Bounds region = region_of_interest(bounds(object));
        REQUIRE(steepest_instruction(program, region, rng, 300) <= 1 + 1e-5);
        REQUIRE(steepest_instruction(program, region.inflated(10 * region.diagonal()), rng, 75) <= 1 + 1e-5);
    }
    for (int tree = 0; tree < 200; ++tree) {
        const Program program = record(object_kind("twist").object(rng, 3));
        CAPTURE(tree);
        REQUIRE(steepest_instruction(program, Bounds::centred(glm::vec3(1)), rng, 300) <= 1 + 1e-5);
        REQUIRE(steepest_instruction(program, Bounds::centred(glm::vec3(20)), rng, 300) <= 1 + 1e-5);
    }
}

}  // namespace test_lipschitz
