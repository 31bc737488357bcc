// A number type that records what an equation computes, like program::Recorded for the instructions of a program, but
// down to single additions. Operations on two known numbers are evaluated immediately.
#pragma once

#include <cmath>

#include "glsl/trace.hpp"
#include "phasetree/math/arc_tangent.hpp"
#include "phasetree/math/value_noise.hpp"

namespace phasetree::glsl {

/// A number of a trace that is being recorded.
struct Traced {
    Trace* trace = nullptr;
    Operand operand{};

    Traced() = default;
    explicit Traced(float v) : operand{Operand::number, v} {}
    Traced(Trace* t, std::int32_t value) : trace(t), operand{value, 0} {}

    bool is_number() const { return operand.is_number(); }
    float number() const { return operand.constant; }
};

/// The result of a comparison, which is known only if both sides are.
struct TracedCondition {
    Trace* trace = nullptr;
    Operand operand{};  ///< a nonzero number if it is known to be true
};

inline Operand write_step(Trace* trace, TraceStep step) {
    const auto value = static_cast<std::int32_t>(trace->inputs + trace->steps.size());
    trace->steps.push_back(step);
    return {value, 0};
}
template <class... More>
Trace* trace_among(const Trace* first, const More*... more) {
    const Trace* found = first;
    ((found = found ? found : more), ...);
    return const_cast<Trace*>(found);
}
template <class... In>
Traced write_step(TraceOp op, const In&... in) {
    Trace* const trace = trace_among(in.trace...);
    const Operand result = write_step(trace, {op, SharedFunction::none, sizeof...(In), 0, {in.operand...}});
    return Traced(trace, result.value);
}
template <class... In>
Traced write_call(SharedFunction function, const In&... in) {
    Trace* const trace = trace_among(in.trace...);
    const Operand result = write_step(trace, {TraceOp::call, function, sizeof...(In), 0, {in.operand...}});
    return Traced(trace, result.value);
}

inline Traced operator-(const Traced& a) {
    return a.is_number() ? Traced(-a.number()) : write_step(TraceOp::negate, a);
}
inline Traced operator+(const Traced& a, const Traced& b) {
    if (a.is_number() && b.is_number()) return Traced(a.number() + b.number());
    return write_step(TraceOp::add, a, b);
}
inline Traced operator-(const Traced& a, const Traced& b) {
    if (a.is_number() && b.is_number()) return Traced(a.number() - b.number());
    return write_step(TraceOp::subtract, a, b);
}
inline Traced operator*(const Traced& a, const Traced& b) {
    if (a.is_number() && b.is_number()) return Traced(a.number() * b.number());
    return write_step(TraceOp::multiply, a, b);
}
inline Traced operator/(const Traced& a, const Traced& b) {
    if (a.is_number() && b.is_number()) return Traced(a.number() / b.number());
    return write_step(TraceOp::divide, a, b);
}
inline Traced operator+(const Traced& a, float b) {
    return a + Traced(b);
}
inline Traced operator-(const Traced& a, float b) {
    return a - Traced(b);
}
inline Traced operator*(const Traced& a, float b) {
    return a * Traced(b);
}
inline Traced operator/(const Traced& a, float b) {
    return a / Traced(b);
}
inline Traced operator+(float a, const Traced& b) {
    return Traced(a) + b;
}
inline Traced operator-(float a, const Traced& b) {
    return Traced(a) - b;
}
inline Traced operator*(float a, const Traced& b) {
    return Traced(a) * b;
}

inline TracedCondition less(const Traced& a, const Traced& b) {
    if (a.is_number() && b.is_number()) return {nullptr, {Operand::number, a.number() < b.number() ? 1.f : 0.f}};
    const Traced result = write_step(TraceOp::less, a, b);
    return {result.trace, result.operand};
}
inline Traced select(const TracedCondition& condition, const Traced& yes, const Traced& no) {
    if (condition.operand.is_number()) return condition.operand.constant != 0 ? yes : no;
    return write_step(TraceOp::select, condition, yes, no);
}
inline Traced min(const Traced& a, const Traced& b) {
    if (a.is_number() && b.is_number()) return Traced(phasetree::min(a.number(), b.number()));
    return write_step(TraceOp::minimum, a, b);
}
inline Traced max(const Traced& a, const Traced& b) {
    if (a.is_number() && b.is_number()) return Traced(phasetree::max(a.number(), b.number()));
    return write_step(TraceOp::maximum, a, b);
}
inline Traced abs(const Traced& a) {
    return a.is_number() ? Traced(std::fabs(a.number())) : write_step(TraceOp::absolute, a);
}
inline Traced sqrt(const Traced& a) {
    return a.is_number() ? Traced(std::sqrt(a.number())) : write_step(TraceOp::root, a);
}
inline Traced floor(const Traced& a) {
    return a.is_number() ? Traced(std::floor(a.number())) : write_step(TraceOp::floor, a);
}
inline Traced lookup(const float* table, const Traced& index) {
    if (index.is_number()) return Traced(table[static_cast<int>(index.number())]);
    const auto offset = static_cast<std::uint32_t>(table - index.trace->data.data());
    index.trace->has_lookup = true;
    const Operand result = write_step(index.trace, {TraceOp::lookup, SharedFunction::none, 1, offset, {index.operand}});
    return Traced(index.trace, result.value);
}

// Record calls of these instead of their steps: they are long, and equations use them often.
inline Traced sine(const Traced& x) {
    return x.is_number() ? Traced(phasetree::sine(x.number())) : write_call(SharedFunction::sine, x);
}
inline SineCosine<Traced> sine_cosine(const Traced& x) {
    if (x.is_number()) {
        const auto [s, c] = phasetree::sine_cosine(x.number());
        return {Traced(s), Traced(c)};
    }
    return {write_call(SharedFunction::sine_of_pair, x), write_call(SharedFunction::cosine_of_pair, x)};
}
inline Traced angle_of(const Traced& x, const Traced& y) {
    if (x.is_number() && y.is_number()) return Traced(phasetree::angle_of(x.number(), y.number()));
    return write_call(SharedFunction::angle, x, y);
}
/// A shader has no search.
template <class Search, class Equation, class Otherwise>
Traced found_equation(const Vec3<Traced>& p, const Search&, const Equation&, const Otherwise& otherwise) {
    return otherwise(p);
}
template <std::size_t count, class Search, class Equation, class Otherwise>
Traced gathered_equation(const Vec3<Traced>& p, const Search&, const Equation&, const Otherwise& otherwise) {
    return otherwise(p);
}
inline Traced value_noise(const Vec3<Traced>& p) {
    return write_call(SharedFunction::space_noise, p.x, p.y, p.z);
}

}  // namespace phasetree::glsl
