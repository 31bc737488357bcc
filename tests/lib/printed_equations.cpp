// Applies the comparison of labels that every node must pass to the equations that are wrong in the printed paper. Each
// is caught; the corrected equation, written here a second time by hand, passes. Both keep every component 1-Lipschitz
// and at most one negative, so nothing but the labels could have told them apart.
#include <doctest/doctest.h>

#include <functional>

#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/fields/box.hpp"
#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/phased/change.hpp"
#include "phasetree/nodes/phased/contact.hpp"
#include "phasetree/nodes/phased/intersect_shape.hpp"
#include "phasetree/nodes/phased/set.hpp"
#include "phasetree/nodes/phased/under.hpp"
#include "phasetree/nodes/phased/unite_shape_below.hpp"
#include "phasetree/nodes/warps/translate.hpp"
#include "phasetree/nodes/warps/warped.hpp"
#include "support/random_tree.hpp"
#include "support/set_algebra.hpp"

namespace test_printed_equations {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

/// Φ, an absent phase being infinite, as it is printed.
using Phi = Components;

Phi phi_of(const Phased& a, const glm::vec3& p) {
    const Phases<float> found = distances(a, p);
    Phi result;
    for_each_phase(found.present, [&](int i) { result[static_cast<std::size_t>(i)] = found[i]; });
    return result;
}

double smallest_but(const Phi& a, std::size_t except) {
    double result = absent;
    for (std::size_t i = 1; i < Phi::size; ++i)
        if (i != except) result = std::min(result, a[i]);
    return result;
}

/// Where the paper prints no φ₀, it is −min over the phases.
Phi with_vacuum(Phi a) {
    a[0] = -smallest_but(a, 0);
    return a;
}

Phase argmin(const Phi& a) {
    return Phase{static_cast<std::uint8_t>(std::min_element(a.phi.begin(), a.phi.end()) - a.phi.begin())};
}

struct Outcome {
    std::size_t compared = 0, wrong = 0, too_steep = 0, overlapping = 0;
    double share_wrong() const { return static_cast<double>(wrong) / static_cast<double>(compared); }
    bool keeps_invariants() const { return too_steep == 0 && overlapping == 0; }
};

using Equation = std::function<Phi(const glm::vec3&)>;

/// One random operator: the node whose meaning, by set algebra, is the reference, and an equation for it.
struct Case {
    Phased node;
    Equation equation;
};

Outcome outcome(std::uint64_t seed, Case (*draw)(Random&)) {
    Random rng(seed);
    Outcome o;
    for (int tree = 0; tree < 150; ++tree) {
        const Case c = draw(rng);
        const Bounds region = region_of_interest(bounds(c.node));
        for (int n = 0; n < 100; ++n) {
            const glm::vec3 p = rng.in(region), q = p + std::exp2(rng.uniform(-10, 1)) * rng.direction();
            const Phi a = c.equation(p), b = c.equation(q);
            const double distance = glm::length(glm::dvec3(p) - glm::dvec3(q)), error = 1e-4;
            double first = absent, second = absent;
            for (std::size_t i = 0; i < Phi::size; ++i) {
                if (a[i] < absent) o.too_steep += !(std::abs(a[i] - b[i]) <= distance + error);
                second = std::min(second, std::max(first, a[i]));
                first = std::min(first, a[i]);
            }
            o.overlapping += !(first + second >= -error);
            if (values(c.node, glm::dvec3(p)).interface_distance() < error) continue;
            ++o.compared;
            o.wrong += argmin(a) != label(c.node, glm::dvec3(p));
        }
    }
    REQUIRE(o.compared > 10'000);
    return o;
}

constexpr Phase one{1}, two{2}, three{3};

// 4.4, contact of objects of one phase each.

template <bool printed>
Case contact(Random& rng) {
    const Phased a = Set{.phase = one, .of = random_field(rng, 2)}, b = Set{.phase = two, .of = random_field(rng, 2)};
    const float alpha = rng.uniform(0.05f, 0.95f);
    const Phased node = Contact{.a = a, .phase_a = one, .b = b, .phase_b = two, .alpha = alpha};
    return {node, [=](const glm::vec3& p) {
                const Phi x = phi_of(a, p), y = phi_of(b, p);
                const double f = alpha * x[1] - (1 - alpha) * y[2];
                Phi r;
                r[1] = std::max(x[1], printed ? -f : f);
                r[2] = std::max(y[2], printed ? f : -f);
                if (printed) return with_vacuum(r);
                r[0] = std::max(x[0], y[0]);
                return r;
            }};
}

// 5.1, the phase-specific intersection.

/// Three phases side by side.
Phased rows(Random& rng) {
    return Under{.of = {Set{.phase = one, .of = Box{.size = {1.5f, 1, 1}}},
                        Set{.phase = two, .of = random_field(rng, 2)},
                        Set{.phase = three, .of = random_field(rng, 1)}}};
}
enum class Form { printed, corrected };
template <Form form>
Case phase_intersection(Random& rng) {
    const Phased a = rows(rng);
    const Field shape = random_field(rng, 2);
    return {IntersectShape{.of = a, .shape = shape, .phases_cut = PhaseSet::of(one)}, [=](const glm::vec3& p) {
                Phi r = phi_of(a, p);
                const double f = distance(shape, p), inner = r[1];
                if (form == Form::printed) {
                    r[1] = std::max(std::min(inner, f), -smallest_but(r, 1));
                    return with_vacuum(r);
                }
                r[1] = std::max(inner, f);
                r[0] = std::min(r[0], std::max(inner, -f));
                return r;
            }};
}
/// The same printed equation, for the sum of sets printed above it: the union below the other phases.
Case union_below(Random& rng) {
    const Phased a = rows(rng);
    const Field shape = random_field(rng, 2);
    return {UniteShapeBelow{.of = a, .phase = one, .shape = shape}, [=](const glm::vec3& p) {
                Phi r = phi_of(a, p);
                r[1] = std::max(std::min(r[1], static_cast<double>(distance(shape, p))), -smallest_but(r, 1));
                return with_vacuum(r);
            }};
}

// 4.3, under with −min over all phases of B.

template <Form form>
Case under(Random& rng) {
    const Phased a = rows(rng), b = rows(rng);
    return {Under{.of = {a, b}}, [=](const glm::vec3& p) {
                const Phi x = phi_of(a, p), y = phi_of(b, p);
                Phi r;
                for (std::size_t i = 1; i <= 3; ++i)
                    r[i] = std::max(std::min(x[i], y[i]), -smallest_but(y, form == Form::printed ? std::size_t{0} : i));
                if (form == Form::printed) return with_vacuum(r);
                r[0] = std::max(x[0], y[0]);
                return r;
            }};
}

// 5.2, local change, with the φᵢ just reduced inside φₖ.

template <Form form>
Case change(Random& rng) {
    const Phased a = rows(rng);
    const Field shape = random_field(rng, 2);
    return {Change{.of = a, .from = one, .to = two, .shape = shape}, [=](const glm::vec3& p) {
                Phi r = phi_of(a, p);
                const double f = distance(shape, p), before = r[1];
                r[1] = std::max(before, -f);
                r[2] = std::min(r[2], std::max(form == Form::printed ? r[1] : before, f));
                return form == Form::printed ? with_vacuum(r) : r;
            }};
}

}  // namespace

TEST_CASE("4.4: the printed contact is caught") {
    const Outcome printed = outcome(441, contact<true>), right = outcome(441, contact<false>);
    CHECK(printed.keeps_invariants());
    CHECK(printed.share_wrong() > 0.1);
    CHECK(right.keeps_invariants());
    CHECK(right.wrong == 0);
}

TEST_CASE("4.4: the printed contact empties most of both objects") {
    const Phased a = Set{.phase = one, .of = Sphere{}};
    const Phased b = warped(Translate{.by = {1.2f, 0, 0}}, Phased(Set{.phase = two, .of = Sphere{}}));
    const Phased node = Contact{.a = a, .phase_a = one, .b = b, .phase_b = two, .alpha = 0.5f};
    Random rng(442);
    int solid = 0, emptied = 0;
    for (int n = 0; n < 20'000; ++n) {
        const glm::vec3 p = rng.in(bounds(node));
        if (label(node, glm::dvec3(p)) == vacuum) continue;
        const double x = distances(a, p)[1], y = distances(b, p)[2], f = (x - y) / 2;
        ++solid;
        emptied += std::min(std::max(x, -f), std::max(y, f)) > 0;
    }
    CHECK(emptied > solid / 2);
}

TEST_CASE("5.1: the printed phase-specific intersection is caught; it is the union below the other phases") {
    const Outcome printed = outcome(511, phase_intersection<Form::printed>);
    const Outcome right = outcome(511, phase_intersection<Form::corrected>), same = outcome(511, union_below);
    CHECK(printed.keeps_invariants());
    CHECK(printed.share_wrong() > 0.1);
    CHECK(right.keeps_invariants());
    CHECK(right.wrong == 0);
    CHECK(same.keeps_invariants());
    CHECK(same.wrong == 0);
}

TEST_CASE("4.3: under with -min over all phases of B is caught") {
    const Outcome printed = outcome(431, under<Form::printed>), right = outcome(431, under<Form::corrected>);
    CHECK(printed.keeps_invariants());
    CHECK(printed.share_wrong() > 0.1);
    CHECK(right.keeps_invariants());
    CHECK(right.wrong == 0);
}

TEST_CASE("5.2: the printed change is caught") {
    const Outcome printed = outcome(521, change<Form::printed>), right = outcome(521, change<Form::corrected>);
    CHECK(printed.keeps_invariants());
    CHECK(printed.share_wrong() > 0.01);
    CHECK(right.keeps_invariants());
    CHECK(right.wrong == 0);
}

}  // namespace test_printed_equations
