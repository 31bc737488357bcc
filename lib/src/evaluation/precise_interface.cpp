// The interface of two phases as an implicit surface: its derivatives, and the primitive that it comes from.
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "evaluation/interpret.hpp"
#include "evaluation/precise_program.hpp"
#include "math/precise.hpp"
#include "phasetree/evaluation/precise_evaluator.hpp"
#include "phasetree/math/float_mode.hpp"
#include "program/op_traits.hpp"

namespace phasetree {

using evaluation::PreciseProgram;
using kernel::OutputSlot, kernel::Routine, kernel::Step;

namespace {

using Slope = Precise<3>;

// What happens during a run with slopes.
class Watch {
  public:
    virtual ~Watch() = default;
    virtual void before(std::size_t /*step*/, Slope* /*registers*/) {}
    virtual void at_primitive(std::size_t /*step*/, const Vec3<Slope>& /*q*/) {}
};

class WatchedSteps : public evaluation::RoutineSteps {
  public:
    WatchedSteps(const Routine& routine, Watch& watch, Slope* registers)
        : RoutineSteps(routine), watch_(watch), registers_(registers) {}
    evaluation::StepAction action(std::size_t i) const {
        watch_.before(i, registers_);
        return evaluation::StepAction::run;
    }

  private:
    Watch& watch_;
    Slope* registers_;
};

// Runs a program at a point with slopes, which are those by the point unless the watch changes them.
Slope* run_with_slopes(const PreciseProgram& program, const glm::dvec3& p, Watch& watch) {
    thread_local std::vector<Slope> registers;
    if (registers.size() < program.assembly.slots) registers.resize(program.assembly.slots);
    for (std::size_t axis = 0; axis < 3; ++axis) registers[axis] = Slope::coordinate(axis, p[static_cast<int>(axis)]);
    const Routine routine = program.routine();
    evaluation::interpret(
        WatchedSteps(routine, watch, registers.data()), registers.data(),
        [&]<class P>(std::size_t i, const float* constants, const Vec3<Slope>& q, Slope& to) {
            watch.at_primitive(i, q);
            to = program::distance_of<P>(constants, q);
        },
        [](const Slope&) {});
    return registers.data();
}

Slope with_slope(const Slope& v, std::size_t axis) {
    return Slope::coordinate(axis, v.value());
}

// Finds the derivatives of each step's result by its operands: the operands get the slopes of coordinates just before.
class StepDerivatives : public Watch {
  public:
    explicit StepDerivatives(const Routine& routine) : routine_(routine), rows_(routine.count) {}

    void before(std::size_t i, Slope* registers) override {
        if (i > 0) keep(i - 1, registers);
        const Step& s = routine_.steps[i];
        if (takes_point(s)) {
            for (std::size_t k = 0; k < 3; ++k) registers[s.a + k] = with_slope(registers[s.a + k], k);
        } else {
            if (has_two(s)) registers[s.b] = with_slope(registers[s.b], 1);
            registers[s.a] = with_slope(registers[s.a], 0);  // last: both may be the same
        }
    }
    void end(const Slope* registers) {
        if (routine_.count > 0) keep(routine_.count - 1, registers);
    }

    // Propagates the derivatives of a number by the slots back to the point, which is in the first three slots. Calls
    // primitive(step, derivative by its distance).
    template <class Primitive>
    void propagate(std::vector<double>& by_slot, Primitive&& primitive) const {
        for (std::size_t i = routine_.count; i-- > 0;) {
            const Step& s = routine_.steps[i];
            if (static_cast<Op>(s.op) == Op::input) continue;
            const std::size_t results = gives_point(s) ? 3 : 1;
            std::array<double, 3> by_result{};
            for (std::size_t k = 0; k < results; ++k) by_result[k] = std::exchange(by_slot[s.to + k], 0.0);
            if (takes_point(s) && results == 1) primitive(i, by_result[0]);
            const std::size_t operands = takes_point(s) ? 3 : 1;
            const auto by_operand = [&](std::size_t j) {
                double sum = 0;
                for (std::size_t k = 0; k < results; ++k)
                    if (by_result[k] != 0) sum += by_result[k] * rows_[i][k][j];
                return sum;
            };
            for (std::size_t j = 0; j < operands; ++j) by_slot[s.a + j] += by_operand(j);
            if (has_two(s) && s.a != s.b) by_slot[s.b] += by_operand(1);
        }
    }

  private:
    static bool takes_point(const Step& s) { return s.op >= static_cast<std::uint32_t>(Op::first_primitive); }
    static bool gives_point(const Step& s) { return program::gives_point(static_cast<Op>(s.op)); }
    static bool has_two(const Step& s) { return !takes_point(s) && program::operands(static_cast<Op>(s.op)) == 2; }
    void keep(std::size_t i, const Slope* registers) {
        const Step& s = routine_.steps[i];
        for (std::size_t k = 0; k < (gives_point(s) ? 3 : 1); ++k) rows_[i][k] = registers[s.to + k].slopes();
    }

    Routine routine_;
    std::vector<std::array<Slope::Slopes, 3>> rows_;
};

// Keeps the point at which a primitive is evaluated.
class PointOfPrimitive : public Watch {
  public:
    explicit PointOfPrimitive(std::size_t step) : step_(step) {}
    void at_primitive(std::size_t step, const Vec3<Slope>& q) override {
        if (step == step_) point = q;
    }
    Vec3<Slope> point{};

  private:
    std::size_t step_;
};

const OutputSlot* slot_of(const PreciseProgram& program, Phase phase) {
    for (const OutputSlot& o : program.assembly.outputs)
        if (o.phase == static_cast<float>(phase.index)) return &o;
    return nullptr;
}

}  // namespace

InterfaceSample PreciseEvaluator::interface_sample(const glm::dvec3& p, Phase inside, Phase outside) const {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const OutputSlot* first = slot_of(*program_, inside);
    const OutputSlot* second = slot_of(*program_, outside);
    if (!first || !second) return {nan, glm::dvec3(nan), nan, glm::dvec3(nan), glm::dmat3(nan)};
    const FlushSubnormals flush;
    StepDerivatives derivatives(program_->routine());
    const Slope* registers = run_with_slopes(*program_, p, derivatives);
    derivatives.end(registers);
    InterfaceSample result;
    std::vector<double> by_slot(program_->assembly.slots, 0.0);
    for (const auto& [output, factor] : {std::pair(first, 0.5), std::pair(second, -0.5)}) {
        const double signed_factor = factor * static_cast<double>(output->sign);
        result.value += signed_factor * registers[output->slot].value();
        by_slot[output->slot] += signed_factor;
    }
    std::size_t heaviest = 0;
    derivatives.propagate(by_slot, [&](std::size_t step, double weight) {
        if (std::abs(weight) <= std::abs(result.weight)) return;
        result.weight = weight;
        heaviest = step;
    });
    result.gradient = {by_slot[0], by_slot[1], by_slot[2]};
    if (result.weight == 0) return result;
    PointOfPrimitive primitive(heaviest);
    run_with_slopes(*program_, p, primitive);
    const Slope* const inner[] = {&primitive.point.x, &primitive.point.y, &primitive.point.z};
    for (int row = 0; row < 3; ++row) {
        result.inner[row] = inner[row]->value();
        for (int column = 0; column < 3; ++column)
            result.inner_by_point[column][row] = inner[row]->slopes()[static_cast<std::size_t>(column)];
    }
    return result;
}

}  // namespace phasetree
