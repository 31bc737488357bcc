// The content and the size of recorded programs.
#include <doctest/doctest.h>

#include <chrono>
#include <set>
#include <tuple>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/list.hpp"
#include "phasetree/program/program.hpp"
#include "support/random_tree.hpp"

namespace test_program {

using namespace phasetree;
using namespace phasetree::tests;

namespace {

std::size_t count(const Program& p, Op op) {
    return static_cast<std::size_t>(
        std::count_if(p.instructions.begin(), p.instructions.end(), [&](const Instruction& i) { return i.op == op; }));
}
template <class P>
Op op_of() {
    return static_cast<Op>(static_cast<std::size_t>(Op::first_primitive) + index_in<P>(Primitives()));
}
Phased filled(int phase, Field f) {
    return Set{.phase = Phase{static_cast<std::uint8_t>(phase)}, .of = std::move(f)};
}
Field ball_at(float x) {
    return warped(Translate{.by = {x, 0, 0}}, Field(Sphere{.radius = 0.3f}));
}

}  // namespace

TEST_CASE("a primitive is one instruction, its vacuum another") {
    const Program p = record(Field(Sphere{}));
    REQUIRE(p.instructions.size() == 3);
    CHECK(p.instructions[0].op == Op::input);
    CHECK(p.instructions[1].op == op_of<Sphere>());
    CHECK(p.instructions[2].op == Op::negate);
    REQUIRE(p.outputs.size() == 2);
    CHECK(p.outputs[0].phase == vacuum);
    CHECK(p.outputs[1].phase == Phase{1});
}

TEST_CASE("shared and equal subtrees are recorded once") {
    const Field ball = ball_at(1);
    CHECK(record(Field(Union{.of = {ball, ball}})).instructions.size() == record(ball).instructions.size());
    // Equal, though not the same node.
    CHECK(record(Field(Union{.of = {ball_at(1), ball_at(1)}})).instructions.size() == record(ball).instructions.size());
    const Program two = record(Field(Union{.of = {ball_at(1), ball_at(2)}}));
    CHECK(count(two, op_of<Sphere>()) == 2);
    CHECK(count(two, Op::minimum) == 1);
    // A shape that cuts three phases is evaluated once.
    const Field cut = Box{};
    const Phased layers = Layered{.of = Layered{.of = filled(1, Sphere{}), .phase = Phase{2}, .thickness = 0.1f},
                                  .phase = Phase{3},
                                  .thickness = 0.1f};
    CHECK(count(record(Phased(SubtractShape{.of = layers, .shape = cut, .phases_cut = {}})), op_of<Box>()) == 1);
}

TEST_CASE("no two instructions of a program are the same") {
    Random rng(71);
    for (int tree = 0; tree < 300; ++tree) {
        const Program p = record(random_object(rng, 3 + tree % 4));
        std::set<std::tuple<int, std::uint32_t, std::uint32_t, std::vector<std::uint32_t>>> seen;
        for (std::size_t i = 0; i < p.instructions.size(); ++i) {
            const Instruction& in = p.instructions[i];
            const std::size_t end = i + 1 < p.instructions.size() ? p.instructions[i + 1].data : p.constants.size();
            std::vector<std::uint32_t> data;
            for (std::size_t k = in.data; k < end; ++k) data.push_back(std::bit_cast<std::uint32_t>(p.constants[k]));
            REQUIRE(seen.emplace(static_cast<int>(in.op), in.a, in.b, data).second);
            // Instructions use only earlier results.
            REQUIRE((i == 0 || (in.a < i && in.b < i)));
        }
    }
}

TEST_CASE("an absent phase is neither an instruction nor an output") {
    const Phased a = filled(40, Sphere{});
    CHECK(record(a).instructions.size() == record(filled(1, Sphere{})).instructions.size());
    const Program p = record(a);
    REQUIRE(p.outputs.size() == 2);
    CHECK(p.outputs[1].phase == Phase{40});
    const Program removed = record(Phased(Remove{.of = a, .gone = PhaseSet::of(Phase{40})}));
    REQUIRE(removed.outputs.size() == 1);
    CHECK(removed.outputs[0].phase == vacuum);
    // Turning or cutting a phase that is not there costs nothing.
    const Phased change = Change{.of = a, .from = Phase{3}, .to = Phase{4}, .shape = {}};
    CHECK(record(change).instructions.size() == p.instructions.size());
}

TEST_CASE("objects put one under the other cost linearly many instructions") {
    const auto size = [](int n, int phases) {
        std::vector<Phased> all;
        for (int i = 0; i < n; ++i) all.push_back(filled(1 + i % phases, ball_at(static_cast<float>(i))));
        return record(Phased(Under{.of = all})).instructions.size();
    };
    for (const int phases : {1, 2, 4, 8}) {
        CAPTURE(phases);
        const std::size_t small = size(100, phases), large = size(200, phases), larger = size(400, phases);
        CHECK(larger - large == 2 * (large - small));
        // A ball, where it is, its vacuum; the vacuum and each phase are updated by one maximum, its own phase by a
        // minimum as well; a further negation is shared.
        CHECK(large - small <= 100 * (3 + 3 + static_cast<std::size_t>(phases)));
    }
}

TEST_CASE("every instruction serves an output") {
    // Of sixty-four phases, one is kept: instructions that only the others need must not be run.
    std::vector<Phased> all;
    for (int i = 1; i < Phase::capacity; ++i) all.push_back(filled(i, ball_at(static_cast<float>(i))));
    const Phased many = Under{.of = all};
    const auto dead = [](const Program& p) {
        std::vector<bool> used(p.instructions.size(), false);
        used[0] = true;
        for (const Output& o : p.outputs) used[o.value] = true;
        for (std::size_t i = p.instructions.size(); i-- > 0;)
            if (used[i]) used[p.instructions[i].a] = used[p.instructions[i].b] = true;
        return std::count(used.begin(), used.end(), false);
    };
    CHECK(dead(record(many)) == 0);
    CHECK(dead(record(Phased(Under{.of = {many, many}}))) == 0);
    CHECK(dead(record(Field(Merge{.of = many, .phases = PhaseSet::of(Phase{5})}))) == 0);
    Random rng(72);
    for (int tree = 0; tree < 300; ++tree) {
        CAPTURE(tree);
        REQUIRE(dead(record(random_object(rng, 3 + tree % 4))) == 0);
    }
}

TEST_CASE("registers are used again") {
    // A union of a thousand balls needs the point, a moved point, a ball and the minimum so far.
    std::vector<Field> balls;
    for (int i = 0; i < 1000; ++i) balls.push_back(ball_at(static_cast<float>(i)));
    const Evaluator evaluator(record(Field(Union{.of = balls})));
    Evaluator::Workspace w;
    (void)evaluator.label({0, 0, 0}, w);
    // The size of the workspace: registers() never shrinks it, so request growing sizes until its memory moves.
    const float* base = w.registers(0);
    std::size_t slots = 0;
    while (w.registers(slots + 1) == base && slots < 4096) ++slots;
    CHECK(slots < 20);
    CHECK(evaluator.program().instructions.size() > 3000);
}

TEST_CASE("a tree that unfolds exponentially is rejected early") {
    // Thirty levels of two uses each under different transforms: 2³⁰ balls.
    Field f = Sphere{};
    for (int i = 0; i < 30; ++i) f = Union{.of = {warped(Translate{.by = {std::ldexp(0.001f, i), 0, 0}}, f), f}};
    const auto start = std::chrono::steady_clock::now();
    CHECK_THROWS_WITH_AS(
        record(f, 100'000),
        "the object needs more than 100000 instructions, because every use of a shape repeats it; use fewer "
        "copies in the tree, or place copies of the whole object with \"instances\" of the scene",
        ModelError);
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(5));
    CHECK(statistics(f).nodes == 61);
    // Without transforms between, shared subtrees stay shared.
    Field g = Sphere{};
    for (int i = 0; i < 30; ++i) g = Union{.of = {Offset{.of = g, .amount = 0.1f}, g}};
    CHECK(record(g).instructions.size() < 100);
}

TEST_CASE("the limit is exact") {
    const Field f = Union{.of = {ball_at(1), ball_at(2)}};
    const std::size_t n = record(f).instructions.size();
    CHECK(record(f, n).instructions.size() == n);
    CHECK_THROWS_AS(record(f, n - 1), ModelError);
}

TEST_CASE("bytes are counted") {
    const Program p = record(ball_at(1));
    CHECK(p.bytes() >= p.instructions.size() * sizeof(Instruction));
    CHECK(Evaluator(p).bytes() > p.bytes());
}

}  // namespace test_program
