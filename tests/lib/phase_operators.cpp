// Compares phase and hybrid operators with their definitions: the table's equations, equivalent trees of other nodes,
// and limits. labels.cpp compares them, like all nodes, with set algebra.
#include <doctest/doctest.h>

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/merge.hpp"
#include "phasetree/nodes/fields/plane.hpp"
#include "phasetree/nodes/fields/smooth_intersection.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/fields/union.hpp"
#include "phasetree/nodes/phased/change.hpp"
#include "phasetree/nodes/phased/contact.hpp"
#include "phasetree/nodes/phased/contacts.hpp"
#include "phasetree/nodes/phased/interface.hpp"
#include "phasetree/nodes/phased/interfaces.hpp"
#include "phasetree/nodes/phased/intersect_shape.hpp"
#include "phasetree/nodes/phased/layered.hpp"
#include "phasetree/nodes/phased/layered_sequence.hpp"
#include "phasetree/nodes/phased/over.hpp"
#include "phasetree/nodes/phased/remove.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/smooth_intersect_shape.hpp"
#include "phasetree/nodes/phased/smooth_layered.hpp"
#include "phasetree/nodes/phased/smooth_subtract_shape.hpp"
#include "phasetree/nodes/phased/smooth_unite_shape.hpp"
#include "phasetree/nodes/phased/smooth_unite_shape_below.hpp"
#include "phasetree/nodes/phased/subtract_shape.hpp"
#include "phasetree/nodes/phased/under.hpp"
#include "phasetree/nodes/phased/unite_shape_below.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "phasetree/program/program.hpp"
#include "support/random_tree.hpp"
#include "support/set_algebra.hpp"

namespace test_phase_operators {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

constexpr Phase one{1}, two{2}, three{3}, four{4};

/// The largest difference of the same components of two objects; they must have the same.
double difference(const Phased& a, const Phased& b, Random& rng, int points = 200) {
    REQUIRE(phases(a).bits == phases(b).bits);
    const Bounds region = region_of_interest(bounds(a));
    double largest = 0;
    for (int n = 0; n < points; ++n) {
        const glm::vec3 p = rng.in(region);
        const Phases<float> x = distances(a, p), y = distances(b, p);
        REQUIRE(x.present == y.present);
        for_each_phase(x.present,
                       [&](int i) { largest = std::max(largest, std::abs(static_cast<double>(x[i]) - y[i])); });
    }
    return largest;
}
Phased object_of(Random& rng, PhaseSet wanted) {
    for (;;) {
        Phased a = random_object(rng, 4);
        if ((phases(a) & wanted) == wanted) return a;
    }
}

constexpr double rounding = 2e-5;  ///< as in labels.cpp, of points within some 4 m

template <class Node>
std::string error(Node node) {
    try {
        (void)Phased(std::move(node));
    } catch (const ModelError& e) {
        return e.what();
    }
    return "no error";
}

}  // namespace

TEST_CASE("contact of objects of one phase each is the table's equation") {
    Random rng(1);
    for (int tree = 0; tree < 200; ++tree) {
        const Field f = random_field(rng, 2), g = random_field(rng, 2);
        const float alpha = tree % 10 == 0 ? 0.f : tree % 10 == 1 ? 1.f : rng.uniform(0, 1);
        const Phased node = Contact{.a = Set{.phase = two, .of = f},
                                    .phase_a = two,
                                    .b = Set{.phase = one, .of = g},
                                    .phase_b = one,
                                    .alpha = alpha};
        const Bounds region = region_of_interest(bounds(node));
        for (int n = 0; n < 100; ++n) {
            const glm::vec3 p = rng.in(region);
            const double a = distance(f, p), b = distance(g, p), plane = alpha * a - (1 - alpha) * b;
            const Phases<float> phi = distances(node, p);
            REQUIRE(phi[2] == doctest::Approx(std::max(a, plane)).epsilon(rounding));
            REQUIRE(phi[1] == doctest::Approx(std::max(b, -plane)).epsilon(rounding));
            REQUIRE(phi[0] == doctest::Approx(std::max(-a, -b)).epsilon(rounding));
        }
    }
}

TEST_CASE("contact goes from under at alpha 0 to over at alpha 1") {
    // Between whole objects; of one phase of several, the rest of B stays in front.
    Random rng(2);
    for (int tree = 0; tree < 60; ++tree) {
        const Phased a = random_object(rng, 4), b = random_object(rng, 4);
        if (phases(a).size() < 2 || phases(b).size() < 2) continue;
        const Phased under = Under{.of = {a, b}}, over = Over{.of = {a, b}};
        const auto contact = [&](float alpha) {
            return Phased(Contacts{.a = a, .phases_a = {}, .b = b, .phases_b = {}, .alpha = alpha});
        };
        const Phased at_0 = contact(0), at_1 = contact(1), half = contact(0.5f);
        const Bounds region = region_of_interest(bounds(under));
        for (int n = 0; n < 200; ++n) {
            const glm::dvec3 p(rng.in(region));
            if (values(half, p).interface_distance() < 1e-4 || values(at_0, p).interface_distance() < 1e-4 ||
                values(at_1, p).interface_distance() < 1e-4)
                continue;
            const glm::vec3 q(p);
            REQUIRE(label(distances(at_0, q)) == label(under, p));
            REQUIRE(label(distances(at_1, q)) == label(over, p));
            const Phase l = label(distances(half, q));
            REQUIRE((l == label(under, p) || l == label(over, p)));
        }
    }
}

TEST_CASE("a contact of equals lies in the middle, and other phases keep their place") {
    const auto ball = [](Phase phase, float x, float radius) {
        return warped(Translate{.by = {x, 0, 0}}, Phased(Set{.phase = phase, .of = Sphere{.radius = radius}}));
    };
    // Two balls with cores, 1.5 apart; the contact is at 0.75.
    const auto at = [](const Phased& a, float x) { return label(distances(a, {x, 0, 0})); };
    const Phased a = Under{.of = {ball(one, 0, 1), ball(three, 0, 0.2f)}};
    const Phased b = Under{.of = {ball(two, 1.5f, 1), ball(four, 1.5f, 0.2f)}};
    const Phased node = Contact{.a = a, .phase_a = one, .b = b, .phase_b = two, .alpha = 0.5f};
    CHECK(at(node, -0.5f) == one);
    CHECK(at(node, 0) == three);
    CHECK(at(node, 0.74f) == one);
    CHECK(at(node, 0.76f) == two);
    CHECK(at(node, 1.5f) == four);
    CHECK(at(node, 2.2f) == two);
    CHECK(at(node, 2.6f) == vacuum);

    // A core that reaches into A replaces it, and makes B's other phase shallow, which moves that contact: a₁ = b₂
    // where x − 1 = −((1.5 − x) − 0.6), which holds nowhere before the core; so A keeps the overlap.
    const Phased large = Under{.of = {ball(two, 1.5f, 1), ball(four, 1.5f, 0.6f)}};
    const Phased pushed = Contact{.a = a, .phase_a = one, .b = large, .phase_b = two, .alpha = 0.5f};
    CHECK(at(pushed, 0.89f) == one);
    CHECK(at(pushed, 0.91f) == four);
    // Between whole objects, the contact stays in the middle, and the core keeps its place.
    const Phased whole = Contacts{.a = a, .phases_a = {}, .b = large, .phases_b = {}, .alpha = 0.5f};
    CHECK(at(whole, 0.74f) == one);
    CHECK(at(whole, 0.76f) == two);
    CHECK(at(whole, 0.91f) == four);
    // Of larger cores that overlap, each gives way in the middle.
    const Phased cored = Under{.of = {ball(one, 0, 1), ball(three, 0, 0.9f)}};
    const Phased cores = Under{.of = {ball(two, 1.5f, 1), ball(four, 1.5f, 0.9f)}};
    const Phased met = Contacts{.a = cored, .phases_a = {}, .b = cores, .phases_b = {}, .alpha = 0.5f};
    CHECK(at(met, 0.74f) == three);
    CHECK(at(met, 0.76f) == four);
}

TEST_CASE("a sequence of layers equals nested layers") {
    Random rng(3);
    for (int tree = 0; tree < 100; ++tree) {
        const Phased a = random_object(rng, 3);
        Phased nested = a;
        LayeredSequence sequence{.of = a, .layers = {}, .thicknesses = {}};
        for (int n = 1 + rng.below(5); n > 0; --n) {
            const Phase phase{static_cast<std::uint8_t>(1 + rng.below(6))};
            const float thickness = rng.uniform(0.02f, 0.3f);
            nested = Layered{.of = nested, .phase = phase, .thickness = thickness};
            sequence.layers.push_back(phase);
            sequence.thicknesses.push_back(thickness);
        }
        CAPTURE(tree);
        REQUIRE(difference(nested, Phased(sequence), rng) < rounding);
    }
}

TEST_CASE("a sequence of layers takes three instructions a layer") {
    LayeredSequence layers{.of = Set{.phase = one, .of = Sphere{}}, .layers = {}, .thicknesses = {}};
    const std::size_t start = record(layers.of).instructions.size();
    for (int n = 0; n < 20; ++n) {
        layers.layers.push_back(Phase{static_cast<std::uint8_t>(2 + n)});
        layers.thicknesses.push_back(0.1f);
    }
    // Sum, negation and maximum.
    CHECK(record(Phased(layers)).instructions.size() <= start + 3 * 20);
}

TEST_CASE("a union below the other phases is the filled shape under the object") {
    Random rng(4);
    for (int tree = 0; tree < 100; ++tree) {
        const Phased a = random_object(rng, 4);
        const Field f = random_field(rng, 2);
        const Phased below = UniteShapeBelow{.of = a, .phase = two, .shape = f};
        CAPTURE(tree);
        REQUIRE(difference(below, Under{.of = {Set{.phase = two, .of = f}, a}}, rng) < rounding);
    }
}

TEST_CASE("smooth operators tend to the sharp ones as the radius goes to zero") {
    Random rng(5);
    const float r = 1e-6f;
    for (int tree = 0; tree < 100; ++tree) {
        const Phased a = object_of(rng, PhaseSet::of(one) | PhaseSet::of(two) | PhaseSet::of(vacuum));
        const Field f = random_field(rng, 2);
        CAPTURE(tree);
        const Phased below = SmoothUniteShapeBelow{.of = a, .phase = two, .shape = f, .radius = r};
        REQUIRE(difference(below, UniteShapeBelow{.of = a, .phase = two, .shape = f}, rng) < rounding);
        const Phased over = SmoothUniteShape{.of = a, .phase = two, .shape = f, .radius = r};
        const Phased within = SmoothIntersectShape{.of = a, .phase = two, .shape = f, .radius = r};
        const Phased without = SmoothSubtractShape{.of = a, .phase = two, .shape = f, .radius = r};
        const PhaseSet chosen = PhaseSet::of(two);
        REQUIRE(difference(within, IntersectShape{.of = a, .shape = f, .phases_cut = chosen}, rng) < rounding);
        REQUIRE(difference(without, SubtractShape{.of = a, .shape = f, .phases_cut = chosen}, rng) < rounding);
        // Over: the shape and the phase together, over the object. φ₀ differs where a₀ > 0 within the phase.
        const Phased merged = Set{.phase = two, .of = Union{.of = {Merge{.of = a, .phases = chosen}, f}}};
        const Phased sharp = Over{.of = {merged, a}};
        const Bounds region = region_of_interest(bounds(sharp));
        for (int n = 0; n < 100; ++n) {
            const glm::dvec3 p(rng.in(region));
            if (values(over, p).interface_distance() < 1e-4 || values(sharp, p).interface_distance() < 1e-4) continue;
            REQUIRE(label(distances(over, glm::vec3(p))) == label(sharp, p));
        }
    }
}

TEST_CASE("smooth intersection and difference are the same over and under the other phases") {
    Random rng(6);
    for (int tree = 0; tree < 100; ++tree) {
        const Phased a = object_of(rng, PhaseSet::of(one) | PhaseSet::of(two));
        const Field f = random_field(rng, 2);
        const float r = rng.uniform(0.05f, 0.5f);
        const Field worn = SmoothIntersection{.of = {Merge{.of = a, .phases = PhaseSet::of(two)}, f}, .radius = r};
        const Phased rest = Remove{.of = a, .gone = PhaseSet::of(two)}, part = Set{.phase = two, .of = worn};
        const Phased over = Over{.of = {part, rest}}, under = Under{.of = {part, rest}};
        const Phased node = SmoothIntersectShape{.of = a, .phase = two, .shape = f, .radius = r};
        const Bounds region = region_of_interest(bounds(a));
        for (int n = 0; n < 100; ++n) {
            const glm::dvec3 p(rng.in(region));
            if (values(node, p).interface_distance() < 1e-4) continue;
            REQUIRE(label(over, p) == label(under, p));
            REQUIRE(label(distances(node, glm::vec3(p))) == label(over, p));
        }
    }
}

TEST_CASE("smooth cuts see no interface where a phase meets itself deep inside the shape") {
    // Two halves of one phase: a₁ is zero on x = 0, where no label changes.
    const Phased halves = Change{.of = Under{.of = {Set{.phase = one, .of = Box{.size = {2, 2, 2}}},
                                                    Set{.phase = two, .of = Plane{.normal = {1, 0, 0}, .offset = 0}}}},
                                 .from = two,
                                 .to = one,
                                 .shape = Box{.size = {3, 3, 3}}};
    const Phased node =
        SmoothIntersectShape{.of = halves, .phase = one, .shape = Box{.size = {1.8f, 1.8f, 1.8f}}, .radius = 0.1f};
    const Phases<float> phi = distances(node, {0, 0, 0});
    CHECK(std::abs(phi[1]) < 1e-6f);
    CHECK(phi[0] >= 0.7f);
}

TEST_CASE("a smooth layer of one phase is a plain layer, and fills the groove between two") {
    Random rng(7);
    for (int tree = 0; tree < 50; ++tree) {
        const Phased a = Set{.phase = one, .of = random_field(rng, 3)};
        const Phased smooth = SmoothLayered{.of = a, .phase = two, .thickness = 0.2f, .radius = 0.3f};
        REQUIRE(difference(smooth, Layered{.of = a, .phase = two, .thickness = 0.2f}, rng) < rounding);
    }
    const auto ball = [](Phase phase, float x) {
        return warped(Translate{.by = {x, 0, 0}}, Phased(Set{.phase = phase, .of = Sphere{.radius = 1}}));
    };
    const Phased pair = Under{.of = {ball(one, -1), ball(two, 1)}};
    const Phased smooth = SmoothLayered{.of = pair, .phase = three, .thickness = 0.2f, .radius = 0.6f};
    const Phased plain = Layered{.of = pair, .phase = three, .thickness = 0.2f};
    // At (0, y, 0) both balls are √(1 + y²) − 1 away: the plain layer ends at y = √0.44, the smooth one, r/6 = 0.1
    // further, at √0.69.
    CHECK(label(distances(plain, {0, 0.66f, 0})) == three);
    CHECK(label(distances(plain, {0, 0.67f, 0})) == vacuum);
    CHECK(label(distances(smooth, {0, 0.83f, 0})) == three);
    CHECK(label(distances(smooth, {0, 0.84f, 0})) == vacuum);
    CHECK(label(distances(smooth, {0, 0, 0})) != three);
}

TEST_CASE("all interfaces are the interfaces of all pairs") {
    Random rng(8);
    for (int tree = 0; tree < 40; ++tree) {
        const Phased a = object_of(rng, PhaseSet::of(one) | PhaseSet::of(two) | PhaseSet::of(three));
        const float half = rng.uniform(0.03f, 0.3f);
        const Phased all = Interfaces{.of = a, .half_thickness = half};
        std::vector<Phased> pairs;
        const std::uint64_t there = phases(a).bits & ~std::uint64_t{1};
        for_each_phase(there, [&](int i) {
            for_each_phase(there, [&](int j) {
                if (i < j)
                    pairs.push_back(Interface{.of = a,
                                              .phase_a = Phase{static_cast<std::uint8_t>(i)},
                                              .phase_b = Phase{static_cast<std::uint8_t>(j)},
                                              .half_thickness = half});
            });
        });
        const Bounds region = region_of_interest(bounds(a));
        for (int n = 0; n < 200; ++n) {
            const glm::dvec3 p(rng.in(region));
            if (values(all, p).interface_distance() < 1e-4) continue;
            REQUIRE(label(distances(all, glm::vec3(p))) == label(Under{.of = pairs}, p));
        }
    }
}

TEST_CASE("what an operator cannot mean is rejected in words") {
    const Phased ball = Set{.phase = one, .of = Sphere{}}, other = Set{.phase = two, .of = Box{}};
    CHECK(error(Contact{.a = ball, .phase_a = one, .b = ball, .phase_b = one, .alpha = 0.5f}) ==
          "contact: a phase cannot be in contact with itself");
    CHECK(error(Contact{.a = ball, .phase_a = three, .b = other, .phase_b = two, .alpha = 0.5f}) ==
          "contact: \"a\" does not contain \"phase_a\"");
    CHECK(error(Contact{.a = ball, .phase_a = one, .b = other, .phase_b = three, .alpha = 0.5f}) ==
          "contact: \"b\" does not contain \"phase_b\"");
    CHECK(error(Contact{.a = ball, .phase_a = one, .b = other, .phase_b = two, .alpha = 1.5f}) ==
          "contact: \"alpha\" must be at least 0 and at most 1, but is 1.5");
    CHECK(error(Contacts{.a = ball, .phases_a = PhaseSet::of(two), .b = other, .phases_b = {}, .alpha = 0.5f}) ==
          "contacts: \"a\" contains none of \"phases_a\"");
    CHECK(error(Interface{.of = ball, .phase_a = one, .phase_b = one, .half_thickness = 0.1f}) ==
          "interface: a phase has no interface with itself");
    CHECK(error(Interface{.of = ball, .phase_a = one, .phase_b = two, .half_thickness = 0.1f}) ==
          "interface: the object does not contain \"phase_b\"");
    CHECK(error(Interfaces{.of = ball, .half_thickness = 0.1f}) ==
          "interfaces: the object must have at least two phases");
    CHECK(error(LayeredSequence{.of = ball, .layers = {two, three}, .thicknesses = {0.1f}}) ==
          "layered_sequence: 2 phases, but 1 thicknesses");
    CHECK(error(LayeredSequence{.of = ball, .layers = {two}, .thicknesses = {0.f}}) ==
          "layered_sequence: \"thicknesses\" must be positive, but is 0");
    CHECK(error(LayeredSequence{.of = ball, .layers = {vacuum}, .thicknesses = {0.1f}}) ==
          "layered_sequence: \"phases\" must be a phase other than the vacuum");
    CHECK(error(LayeredSequence{.of = ball, .layers = {}, .thicknesses = {}}) ==
          "layered_sequence: \"phases\" must not be empty");
}

}  // namespace test_phase_operators
