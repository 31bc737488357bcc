// Pruning by required intervals is tested on random programs in which every operation is an operand of every other one:
// what is left of a program in a ball must have the same sign there. Trees contain few of these pairs of operations,
// and rarely one of which something can be pruned.

#include <doctest/doctest.h>

#include <array>
#include <bit>
#include <cstring>

#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/nodes/list.hpp"
#include "phasetree/program/program.hpp"
#include "pruning/prune.hpp"
#include "support/random_tree.hpp"

namespace test_required_intervals {

using namespace phasetree;
using namespace phasetree::tests;

using program::ProgramOutput;
using pruning::prune, pruning::RangesInBall;
using rewriting::Arena, rewriting::ArenaScope, rewriting::ProgramContext, rewriting::WorkingProgram;

namespace {

template <class P>
constexpr Op op_of() {
    return static_cast<Op>(static_cast<std::size_t>(Op::first_primitive) + index_in<P>(Primitives()));
}

/// A program with one number, from whose sign two phases follow.
struct RandomProgram {
    std::vector<Instruction> code{Instruction{}};
    std::vector<float> constants, lipschitz{1};
    std::vector<ProgramOutput> outputs;

    RandomProgram() = default;
    explicit RandomProgram(Random& rng) {
        const int leaves = 3 + rng.below(8), inner = 2 + rng.below(20);
        for (int i = 0; i < leaves; ++i) {
            if (rng.chance(0.5))
                add_leaf(Plane{.normal = rng.direction(), .offset = rng.uniform(-1, 1)});
            else
                add_leaf(Capsule{.from = place(rng), .to = place(rng), .radius = rng.uniform(0.1f, 0.5f)});
        }
        for (int i = 0; i < inner; ++i) add_operation(rng);
        const auto last = static_cast<std::uint32_t>(code.size() - 1);
        outputs = {{Phase{0}, last, true}, {Phase{1}, last, false}};
    }

    /// nearer(a, b) of two unions of balls, as particles of two phases are.
    static RandomProgram of_particles(Random& rng) {
        RandomProgram result;
        std::array<std::uint32_t, 2> unions{};
        for (std::uint32_t& all : unions) {
            const int balls = 1 + rng.below(5);
            for (int i = 0; i < balls; ++i) {
                const glm::vec3 at = place(rng);
                result.add_leaf(Capsule{.from = at, .to = at, .radius = rng.uniform(0.3f, 0.8f)});
                const auto ball = static_cast<std::uint32_t>(result.code.size() - 1);
                if (i > 0) result.add(Op::minimum, all, ball, {}, 1);
                all = static_cast<std::uint32_t>(result.code.size() - 1);
            }
        }
        result.add(Op::nearer, unions[0], unions[1], {}, 1);
        const auto last = static_cast<std::uint32_t>(result.code.size() - 1);
        result.outputs = {{Phase{0}, last, true}, {Phase{1}, last, false}};
        return result;
    }

    /// A guard whose field may be steeper than its bound, as that of a fold may be. It is declared not to be steeper,
    /// as a node would declare it.
    static RandomProgram of_guard(Random& rng, float steepness) {
        RandomProgram result;
        result.add_leaf(Plane{.normal = rng.direction(), .offset = rng.uniform(-1, 1)});
        result.add_leaf(Plane{.normal = rng.direction(), .offset = rng.uniform(-1, 1)});
        result.add(Op::multiply_constant, 2, 0, std::array{steepness}, steepness);
        result.add(Op::guarded, 1, 3, std::array{4.f}, 1);
        result.outputs = {{Phase{0}, 4, true}, {Phase{1}, 4, false}};
        return result;
    }

    WorkingProgram working() const { return {code, lipschitz, outputs}; }

  private:
    static glm::vec3 place(Random& rng) { return rng.in({glm::vec3(-1), glm::vec3(1)}); }

    template <class P>
    void add_leaf(const P& primitive) {
        const auto floats = std::bit_cast<std::array<float, sizeof(P) / sizeof(float)>>(primitive);
        add(op_of<P>(), 0, 0, floats, 1);
    }
    void add(Op op, std::uint32_t a, std::uint32_t b, std::span<const float> floats, float slope) {
        code.push_back({op, a, b, static_cast<std::uint32_t>(constants.size())});
        constants.insert(constants.end(), floats.begin(), floats.end());
        lipschitz.push_back(slope);
    }
    void add_operation(Random& rng) {
        // One operand is mostly a late value, so that few values have no use.
        const auto size = static_cast<int>(code.size());
        const auto any = [&] { return static_cast<std::uint32_t>(1 + rng.below(size - 1)); };
        const std::uint32_t late = static_cast<std::uint32_t>(size - 1 - rng.below(std::min(size - 1, 3)));
        const std::uint32_t other = any(), a = rng.chance(0.5) ? late : other, b = a == late ? other : late;
        const float of_a = lipschitz[a], of_b = lipschitz[b], steeper = std::max(of_a, of_b);
        const auto constant = [&](float low, float high) { return std::array{rng.uniform(low, high)}; };
        switch (rng.below(17)) {
            case 0:
                return add(Op::negate, late, 0, {}, lipschitz[late]);
            case 1:
                return add(Op::add, a, b, {}, of_a + of_b);
            case 2:
                return add(Op::subtract, a, b, {}, of_a + of_b);
            case 3:
                return add(Op::absolute, late, 0, {}, lipschitz[late]);
            case 4:
                return add(Op::add_constant, late, 0, constant(-0.5f, 0.5f), lipschitz[late]);
            case 5:
                return add(Op::constant_minus, late, 0, constant(-0.5f, 0.5f), lipschitz[late]);
            case 6: {
                const auto factor = constant(-1.5f, 1.5f);
                return add(Op::multiply_constant, late, 0, factor, std::abs(factor[0]) * lipschitz[late]);
            }
            case 7:
            case 8:
                return add(Op::smooth_minimum, a, b, constant(0.01f, 0.6f), steeper);
            case 9:
                return add(Op::guarded, a, b, constant(0.1f, 2), steeper);
            case 10: {
                const auto reach = constant(0.3f, 2);
                return add(Op::falloff, late, 0, reach, steepest_falloff / reach[0] * lipschitz[late]);
            }
            case 11:
            case 12:
                return add(Op::corner, a, b, {}, of_a + of_b);
            case 13:
                return add(Op::maximum, a, b, {}, steeper);
            case 14:
                return add(Op::nearer, a, b, {}, steeper);
            default:
                return add(Op::minimum, a, b, {}, steeper);
        }
    }
};

/// The values of a program at a point, by the equations of its operations.
std::vector<float> values(std::span<const Instruction> code, std::span<const float> constants, const glm::vec3& p) {
    const Vec3<float> at{p.x, p.y, p.z};
    std::vector<float> v(code.size());
    for (std::size_t i = 1; i < code.size(); ++i) {
        const Instruction& in = code[i];
        const float a = v[in.a], b = v[in.b], *const c = constants.data() + in.data;
        const auto distance = [&]<class P>(P primitive) {
            std::memcpy(static_cast<void*>(&primitive), c, sizeof primitive);
            return primitive.distance(at);
        };
        if (in.op == op_of<Plane>()) v[i] = distance(Plane());
        if (in.op == op_of<Capsule>()) v[i] = distance(Capsule());
        if (in.op == Op::negate) v[i] = -a;
        if (in.op == Op::add) v[i] = a + b;
        if (in.op == Op::subtract) v[i] = a - b;
        if (in.op == Op::minimum) v[i] = std::min(a, b);
        if (in.op == Op::maximum) v[i] = std::max(a, b);
        if (in.op == Op::absolute) v[i] = std::abs(a);
        if (in.op == Op::add_constant) v[i] = a + *c;
        if (in.op == Op::constant_minus) v[i] = *c - a;
        if (in.op == Op::multiply_constant) v[i] = a * *c;
        if (in.op == Op::smooth_minimum) v[i] = smooth_min(a, b, *c);
        if (in.op == Op::guarded) v[i] = guarded(a, b, *c);
        if (in.op == Op::falloff) v[i] = falloff(a, *c);
        if (in.op == Op::corner) v[i] = corner(a, b);
        if (in.op == Op::nearer) v[i] = nearer(a, b);
    }
    return v;
}

constexpr float rounding = 1e-4f;

std::optional<WorkingProgram> pruned_in_ball(const RandomProgram& program, const glm::vec3& centre, float radius,
                                             Arena& results, Arena& scratch) {
    const std::vector<float> at_centre = values(program.code, program.constants, centre);
    std::vector<BatchOfFloats> registers(program.code.size());
    std::vector<std::uint32_t> slot(program.code.size());
    for (std::size_t i = 0; i < slot.size(); ++i) {
        registers[i].lane[0] = at_centre[i];
        slot[i] = static_cast<std::uint32_t>(i);
    }
    const RangesInBall ranges{{registers.data(), slot, 0}, program.lipschitz, radius, rounding};
    const WorkingProgram whole = program.working();
    const ProgramContext context(whole, program.constants, {}, rounding);
    return prune(whole, ranges, context, {results, scratch});
}

/// Totals of the comparisons of programs with what is left of them in balls.
struct Outcome {
    std::size_t shortened = 0, gone = 0, points = 0, wrong = 0, too_steep = 0;
    int first_wrong = -1, first_too_steep = -1;  ///< numbers of programs
    Arena results{}, scratch{};

    /// Whether a value differs between two points by more than its recorded slope allows.
    static bool is_too_steep(const WorkingProgram& program, std::span<const float> constants, const glm::vec3& p,
                             const glm::vec3& q) {
        const std::vector<float> at_p = values(program.code, constants, p), at_q = values(program.code, constants, q);
        for (std::size_t i = 1; i < program.code.size(); ++i) {
            const float allowed = program.lipschitz[i] * glm::distance(p, q) * (1 + 1e-5f) + rounding;
            if (std::abs(at_p[i] - at_q[i]) > allowed + 1e-5f * std::abs(at_p[i])) return true;
        }
        return false;
    }

    void compare(const RandomProgram& program, const glm::vec3& centre, float radius, Random& rng, int number) {
        const ArenaScope results_of_this(results), scratch_of_this(scratch);
        const auto left = pruned_in_ball(program, centre, radius, results, scratch);
        if (!left) ++gone;
        if (left && left->code.size() < program.code.size()) ++shortened;
        float only = 0;
        glm::vec3 before = centre;
        for (int k = 0; k < 40; ++k) {
            const glm::vec3 p = centre + radius * std::cbrt(rng.uniform(0, 1)) * rng.direction();
            if (left && k < 4 && is_too_steep(*left, program.constants, before, p)) {
                ++too_steep;
                if (first_too_steep < 0) first_too_steep = number;
            }
            before = p;
            const float expected = values(program.code, program.constants, p).back();
            if (std::abs(expected) < rounding) continue;
            // Where nothing is left, there is one sign: that of the first point, for the centre's value may be zero.
            if (only == 0) only = expected;
            float found = only;
            if (left) {
                const ProgramOutput& o = left->outputs[0].phase == Phase{1} ? left->outputs[0] : left->outputs[1];
                found = values(left->code, program.constants, p)[o.value] * (o.negate ? -1.f : 1.f);
            }
            ++points;
            if ((found < 0) == (expected < 0)) continue;
            ++wrong;
            if (first_wrong < 0) first_wrong = number;
        }
    }
    void tell(int programs) const {
        MESSAGE(programs, " programs, ", shortened, " shortened, ", gone, " without a change of sign; ", points,
                " points");
    }
};

}  // namespace

TEST_CASE("what is left of a program in a ball has its sign there, whatever stands below what") {
    const int programs = long_tests() ? 2'000'000 : 200'000;
    Outcome outcome;
    for (int n = 0; n < programs; ++n) {
        Random rng(51'000 + static_cast<unsigned>(n));
        const RandomProgram program(rng);
        const glm::vec3 centre = rng.in({glm::vec3(-1), glm::vec3(1)});
        const float off = std::abs(values(program.code, program.constants, centre).back());
        const float steep = program.lipschitz.back();
        if (!(steep > 0 && steep < 50)) continue;
        // The ball is so large that the sign may change in it.
        outcome.compare(program, centre, std::min(off / steep * std::exp2(rng.uniform(0, 3)) + 0.01f, 1.f), rng, n);
    }
    outcome.tell(programs);
    CAPTURE(outcome.first_wrong);
    CAPTURE(outcome.first_too_steep);
    CHECK(outcome.wrong == 0);
    CHECK(outcome.too_steep == 0);
    CHECK(outcome.shortened > static_cast<std::size_t>(programs / 4));
    CHECK(outcome.points > 10 * static_cast<std::size_t>(programs));
}

TEST_CASE("the maximum that takes the place of a guard is as steep as the field may be") {
    Outcome outcome;
    int maxima = 0;
    for (int n = 0; n < 1000; ++n) {
        Random rng(53'000 + static_cast<unsigned>(n));
        const RandomProgram program = RandomProgram::of_guard(rng, 1.75f);
        const auto left =
            pruned_in_ball(program, rng.in({glm::vec3(-1), glm::vec3(1)}), 0.5f, outcome.results, outcome.scratch);
        if (!left || left->code.back().op != Op::maximum) continue;
        ++maxima;
        CHECK(left->lipschitz.back() == 1.75f);
    }
    CHECK(maxima > 50);
}

// Where balls of two phases and the vacuum meet, both operands are almost 0, and what is required of them ends at 0.
TEST_CASE("what is left of particles in a ball at the edge of two phases has their sign there") {
    const int programs = long_tests() ? 400'000 : 40'000;
    Outcome outcome;
    for (int n = 0; n < programs; ++n) {
        Random rng(52'000 + static_cast<unsigned>(n));
        const RandomProgram program = RandomProgram::of_particles(rng);
        const Instruction& last = program.code.back();
        // By Newton's steps towards the one surface and the other in turn.
        glm::vec3 centre = rng.in({glm::vec3(-1), glm::vec3(1)});
        for (int step = 0; step < 12; ++step) {
            const std::uint32_t of = step % 2 == 0 ? last.a : last.b;
            const float value = values(program.code, program.constants, centre)[of];
            glm::vec3 slope(0);
            for (int axis = 0; axis < 3; ++axis) {
                glm::vec3 beside = centre;
                beside[axis] += 1e-3f;
                slope[axis] = (values(program.code, program.constants, beside)[of] - value) / 1e-3f;
            }
            centre -= value * slope;
        }
        const std::vector<float> v = values(program.code, program.constants, centre);
        if (!(std::max(std::abs(v[last.a]), std::abs(v[last.b])) < 0.04f)) continue;  // They do not meet.
        centre += rng.uniform(0, 0.03f) * rng.direction();
        outcome.compare(program, centre, 0.1f * std::exp2(rng.uniform(-5, 0)), rng, n);
    }
    outcome.tell(programs);
    CAPTURE(outcome.first_wrong);
    CAPTURE(outcome.first_too_steep);
    CHECK(outcome.wrong == 0);
    CHECK(outcome.too_steep == 0);
    CHECK(outcome.shortened > static_cast<std::size_t>(programs / 8));
    CHECK(outcome.points > 10 * static_cast<std::size_t>(programs));
}

}  // namespace test_required_intervals
