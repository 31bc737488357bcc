#include "glsl/trace.hpp"

#include "evaluation/interpret.hpp"
#include "glsl/traced.hpp"
#include "program/op_traits.hpp"

namespace phasetree::glsl {

using program::gives_point, program::operands;

namespace {

// A single step in the form that interpret() expects. Its point, or its first number, begins at register 0, its second
// number is in register 3, and its result begins at register 4.
class OneStep {
  public:
    OneStep(Op op, std::span<const float> constants)
        : step_{static_cast<std::uint32_t>(op), 4, 0, 3}, constants_(constants) {}
    static std::size_t size() { return 1; }
    static evaluation::StepAction action(std::size_t) { return evaluation::StepAction::run; }
    const kernel::Step& step(std::size_t) const { return step_; }
    const float* constants(std::size_t) const { return constants_.data(); }

  private:
    kernel::Step step_;
    std::span<const float> constants_;
};

Trace with_inputs(std::uint32_t count) {
    Trace trace;
    trace.inputs = count;
    return trace;
}

}  // namespace

Trace trace_of(Op op, std::span<const float> constants) {
    Trace trace = with_inputs(takes_point(op) ? 3 : static_cast<std::uint32_t>(operands(op)));
    trace.data = constants;
    std::array<Traced, 7> registers;
    if (takes_point(op))
        for (std::int32_t i = 0; i < 3; ++i) registers[static_cast<std::size_t>(i)] = Traced(&trace, i);
    else
        registers[0] = Traced(&trace, 0), registers[3] = Traced(&trace, 1);
    evaluation::interpret(
        OneStep(op, constants), registers.data(),
        []<class P>(std::size_t, const float* floats, const Vec3<Traced>& q, Traced& to) {
            to = program::distance_of<P>(floats, q);
        },
        [](const Traced&) {});
    for (std::size_t i = 0; i < (gives_point(op) ? 3u : 1u); ++i) trace.results.push_back(registers[4 + i].operand);
    return trace;
}

Trace trace_of(SharedFunction function) {
    Trace trace = with_inputs(function == SharedFunction::space_noise ? 3 : function == SharedFunction::angle ? 2 : 1);
    const Traced x(&trace, 0), y(&trace, 1), z(&trace, 2);
    const auto result = [&]() -> Traced {
        switch (function) {
            case SharedFunction::sine:
                return phasetree::sine<Traced>(x);
            case SharedFunction::sine_of_pair:
                return phasetree::sine_cosine<Traced>(x).sine;
            case SharedFunction::cosine_of_pair:
                return phasetree::sine_cosine<Traced>(x).cosine;
            case SharedFunction::angle:
                return phasetree::angle_of<Traced>(x, y);
            case SharedFunction::space_noise:
                return phasetree::value_noise<Traced>(Vec3<Traced>{x, y, z});
            case SharedFunction::none:
                break;
        }
        return x;
    }();
    trace.results.push_back(result.operand);
    return trace;
}

}  // namespace phasetree::glsl
