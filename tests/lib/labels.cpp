// Labels equal plain Boolean set algebra (support/set_algebra.hpp), computed without φ. Invariants alone cannot tell a
// wrong operator from a right one: many wrong forms keep every component 1-Lipschitz and at most one of them negative.
//
// Points within rounding errors of an interface are skipped. The margin is checked by a separate measurement: φ in
// float never differs by more than `rounding` from the same φ in double. So a label is certain where the second
// smallest component exceeds twice that.
#include <doctest/doctest.h>

#include <sstream>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/subtract_shape.hpp"
#include "phasetree/nodes/phased/under.hpp"
#include "phasetree/program/program.hpp"
#include "support/random_tree.hpp"
#include "support/set_algebra.hpp"

namespace test_labels {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

/// Float carries 6·10⁻⁸ relative; a point passes through some six transforms and operators, each of which rounds
/// coordinates of about 1 + |p| a few times.
float rounding(const glm::vec3& p) {
    return 4e-6f * (1 + glm::length(p));
}

float interface_distance(const Phases<float>& a) {
    float first = Bounds::infinity, second = Bounds::infinity;
    for_each_phase(a.present, [&](int i) {
        second = std::min(second, std::max(first, a[i]));
        first = std::min(first, a[i]);
    });
    return second;
}

std::string describe(const glm::vec3& p) {
    std::ostringstream s;
    s.precision(9);
    s << "(" << p.x << ", " << p.y << ", " << p.z << ")";
    return s.str();
}

struct Comparison {
    std::size_t points = 0, skipped = 0, wrong = 0, materials = 0, imprecise = 0;
    double largest_error = 0;
    std::string first;  ///< where it went wrong first
};

void compare(const Phased& object, Random& rng, std::size_t points, Comparison& c) {
    const Evaluator evaluator(record(object));
    Evaluator::Workspace workspace;
    const Bounds region = region_of_interest(bounds(object));
    for (std::size_t n = 0; n < points; n += batch_size) {
        BatchOfFloats x, y, z;
        for (std::size_t i = 0; i < batch_size; ++i) {
            const glm::vec3 p = rng.in(region);
            x[i] = p.x;
            y[i] = p.y;
            z[i] = p.z;
        }
        Samples s;
        evaluator.sample(x, y, z, s, workspace);
        for (std::size_t i = 0; i < batch_size; ++i) {
            const glm::vec3 p{x[i], y[i], z[i]};
            const Phases<float> phi = distances(object, p);
            const Components expected = values(object, glm::dvec3(p));
            ++c.points;
            bool present_agree = phi.present == phases(object).bits;
            double error = 0;
            for (std::size_t k = 0; k < Components::size; ++k) {
                const bool there = phi.has(static_cast<int>(k));
                present_agree = present_agree && there == (expected[k] < absent);
                if (there) error = std::max(error, std::abs(phi[static_cast<int>(k)] - expected[k]));
            }
            c.largest_error = std::max(c.largest_error, error / (1 + glm::length(p)));
            if (!present_agree || !(error <= rounding(p))) {
                if (c.imprecise++ == 0) c.first = "φ differs at " + describe(p);
            }
            if (interface_distance(phi) <= 2 * rounding(p)) {
                ++c.skipped;
                continue;
            }
            const Phase truth = tests::label(object, glm::dvec3(p));
            c.materials += truth != vacuum;
            if (phasetree::label(phi) != truth || s.label[i] != static_cast<float>(truth.index)) {
                if (c.wrong++ == 0) c.first = "the label differs at " + describe(p);
            }
        }
    }
}

}  // namespace

TEST_CASE("labels of random trees equal set algebra") {
    Random rng(20251);
    Comparison c;
    const int trees = long_tests() ? 40000 : 600;
    for (int tree = 0; tree < trees && c.wrong + c.imprecise == 0; ++tree) {
        const Phased object = random_object(rng, 3 + tree % 4);
        compare(object, rng, 256, c);
        CAPTURE(tree);
        REQUIRE_MESSAGE(c.wrong + c.imprecise == 0, c.first);
    }
    MESSAGE(c.points, " points, ", c.skipped, " too near an interface, ", c.materials,
            " in a material; largest error of φ over 1 + |p|: ", c.largest_error);
    CHECK(c.points >= (long_tests() ? 10'000'000 : 150'000));
    // Few points are skipped: those that happen to be near a surface, and those of trees that consist of phantom zeros.
    CHECK(c.skipped < c.points / 50);
    CHECK(c.materials > c.points / 10);
}

TEST_CASE("labels equal set algebra with each kind of node at the root") {
    for (const NodeKind& kind : node_kinds()) {
        Random rng = random_for(4, kind);
        Comparison c;
        CAPTURE(kind.name);
        for (int tree = 0; tree < (long_tests() ? 60 : 10); ++tree) {
            compare(kind.object(rng, 2 + tree % 3), rng, 256, c);
            CAPTURE(tree);
            REQUIRE_MESSAGE(c.wrong + c.imprecise == 0, c.first);
        }
        CHECK(c.materials > c.points / 100);
        CHECK(c.skipped < c.points / 20);
    }
}

// The comparison can fail: operators that look right and keep the invariants, compared in the same way.

namespace {

using Combine = Phases<float> (*)(const Phases<float>&, const Phases<float>&);
using Cut = Phases<float> (*)(const Phases<float>&, float f, PhaseSet chosen);

float least(const Phases<float>& a, int except) {
    float r = Bounds::infinity;
    for_each_phase(a.materials(), [&](int i) {
        if (i != except) r = std::min(r, a[i]);
    });
    return r;
}

/// Section 4.3, with −min over the phases of B; `leaves_out` excludes the phase itself.
template <bool leaves_out, bool carries_vacuum, bool keeps_a>
Phases<float> under(const Phases<float>& a, const Phases<float>& b) {
    Phases<float> r;
    r.set(0, carries_vacuum ? std::max(a[0], b[0]) : a[0]);
    for_each_phase(a.materials() | b.materials(), [&](int i) {
        const float ai = a.has(i) ? a[i] : Bounds::infinity, bi = b.has(i) ? b[i] : Bounds::infinity;
        r.set(i, std::max(keeps_a ? std::min(ai, bi) : bi, -least(b, leaves_out ? i : -1)));
    });
    return r;
}

/// Section 5.1, difference of the chosen phases.
enum class Gone { within_the_phase, anywhere, nowhere };
template <Gone gone, int sign>
Phases<float> subtract(const Phases<float>& a, float f, PhaseSet chosen) {
    Phases<float> r = a;
    for_each_phase(a.materials() & chosen.bits, [&](int i) {
        if (gone == Gone::within_the_phase) r.set(0, std::min(r[0], std::max(a[i], f)));
        if (gone == Gone::anywhere) r.set(0, std::min(r[0], f));
        r.set(i, std::max(a[i], -static_cast<float>(sign) * f));
    });
    return r;
}

/// The forms compared below carry a vacuum.
Phased object_with_vacuum(Random& rng) {
    for (;;)
        if (Phased a = random_object(rng, 3); phases(a).contains(vacuum)) return a;
}

double share_of_wrong_labels(Combine combine) {
    Random rng(77);
    int wrong = 0, compared = 0;
    for (int tree = 0; tree < 200; ++tree) {
        const Phased a = object_with_vacuum(rng), b = object_with_vacuum(rng);
        const Phased truth = Under{.of = {a, b}};
        const Bounds region = region_of_interest(bounds(truth));
        for (int n = 0; n < 100; ++n) {
            const glm::vec3 p = rng.in(region);
            if (interface_distance(distances(truth, p)) <= 2 * rounding(p)) continue;
            ++compared;
            wrong += phasetree::label(combine(distances(a, p), distances(b, p))) != tests::label(truth, glm::dvec3(p));
        }
    }
    return static_cast<double>(wrong) / compared;
}

double share_of_wrong_labels(Cut cut) {
    Random rng(78);
    int wrong = 0, compared = 0;
    for (int tree = 0; tree < 200; ++tree) {
        // Two phases side by side, one of which is cut, so that the phase-specific form is compared.
        const Phased a = Under{.of = {Set{.phase = Phase{1}, .of = Box{.size = {1, 1, 1}}},
                                      Set{.phase = Phase{2}, .of = random_field(rng, 2)}}};
        const Field shape = random_field(rng, 2);
        const PhaseSet chosen = PhaseSet::of(Phase{1});
        const Phased truth = SubtractShape{.of = a, .shape = shape, .phases_cut = chosen};
        const Bounds region = Bounds::centred(glm::vec3(0.75f));  // about the box: what is cut is there
        for (int n = 0; n < 100; ++n) {
            const glm::vec3 p = rng.in(region);
            if (interface_distance(distances(truth, p)) <= 2 * rounding(p)) continue;
            ++compared;
            wrong += phasetree::label(cut(distances(a, p), distance(shape, p), chosen)) !=
                     tests::label(truth, glm::dvec3(p));
        }
    }
    return static_cast<double>(wrong) / compared;
}

}  // namespace

TEST_CASE("the comparison tells right operators from wrong ones") {
    CHECK(share_of_wrong_labels(under<true, true, true>) == 0);
    CHECK(share_of_wrong_labels(under<false, true, true>) > 0.01);  // −min φ_B over all j, as printed
    CHECK(share_of_wrong_labels(under<true, false, true>) > 0.01);  // forgets B's part of φ₀
    CHECK(share_of_wrong_labels(under<true, true, false>) > 0.01);  // loses A
    CHECK(share_of_wrong_labels(subtract<Gone::within_the_phase, 1>) == 0);
    CHECK(share_of_wrong_labels(subtract<Gone::anywhere, 1>) > 0.01);  // vacuum in the uncut phases
    CHECK(share_of_wrong_labels(subtract<Gone::nowhere, 1>) > 0.01);   // vacuum keeps its old shape
    CHECK(share_of_wrong_labels(subtract<Gone::within_the_phase, -1>) > 0.01);
}

}  // namespace test_labels
