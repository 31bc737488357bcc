// The number type used to record an equation. Each operation emits an instruction and returns the computed value, with
// a Lipschitz bound derived from those of its operands.
#pragma once

#include <algorithm>
#include <cmath>

#include "phasetree/math/number.hpp"
#include "program/instruction_list.hpp"

namespace phasetree::program {

/// A number of a program that is being recorded.
struct Recorded {
    InstructionList* list = nullptr;
    std::uint32_t value = 0;

    float lipschitz() const { return list->lipschitz(value); }
};

/// A point of a program that is being recorded; 0 is the input.
struct RecordedPoint {
    std::uint32_t value = 0;
};

inline Recorded emit(Op op, Recorded a, float lipschitz) {
    return {a.list, a.list->emit(op, a.value, 0, {}, lipschitz)};
}
inline Recorded emit(Op op, Recorded a, float constant, float lipschitz) {
    return {a.list, a.list->emit(op, a.value, 0, {&constant, 1}, lipschitz)};
}
inline Recorded emit(Op op, Recorded a, Recorded b, float lipschitz) {
    return {a.list, a.list->emit(op, a.value, b.value, {}, lipschitz)};
}
inline Recorded emit(Op op, Recorded a, Recorded b, float constant, float lipschitz) {
    return {a.list, a.list->emit(op, a.value, b.value, {&constant, 1}, lipschitz)};
}
inline float steeper(Recorded a, Recorded b) {
    return std::max(a.lipschitz(), b.lipschitz());
}

inline Recorded operator-(Recorded a) {
    const Instruction& in = (*a.list)[a.value];
    if (in.op == Op::negate) return {a.list, in.a};
    return emit(Op::negate, a, a.lipschitz());
}
inline Recorded operator+(Recorded a, Recorded b) {
    return emit(Op::add, a, b, a.lipschitz() + b.lipschitz());
}
inline Recorded operator-(Recorded a, Recorded b) {
    return emit(Op::subtract, a, b, a.lipschitz() + b.lipschitz());
}
inline Recorded operator+(Recorded a, float b) {
    return emit(Op::add_constant, a, b, a.lipschitz());
}
inline Recorded operator-(Recorded a, float b) {
    return a + -b;
}
inline Recorded operator-(float a, Recorded b) {
    return emit(Op::constant_minus, b, a, b.lipschitz());
}
inline Recorded operator*(Recorded a, float b) {
    return emit(Op::multiply_constant, a, b, a.lipschitz() * std::abs(b));
}
inline Recorded min(Recorded a, Recorded b) {
    return a.value == b.value ? a : emit(Op::minimum, a, b, steeper(a, b));
}
inline Recorded max(Recorded a, Recorded b) {
    return a.value == b.value ? a : emit(Op::maximum, a, b, steeper(a, b));
}
inline Recorded far_bound(Recorded f, Recorded bound) {
    return emit(Op::far_bound, f, bound, steeper(f, bound));
}
inline Recorded far_bound_inside(Recorded f, Recorded bound) {
    return emit(Op::far_bound_inside, f, bound, steeper(f, bound));
}
inline Recorded abs(Recorded a) {
    return emit(Op::absolute, a, a.lipschitz());
}
inline Recorded smooth_min(Recorded a, Recorded b, float r) {
    return emit(Op::smooth_minimum, a, b, r, steeper(a, b));
}
inline Recorded smooth_max(Recorded a, Recorded b, float r) {
    return -smooth_min(-a, -b, r);
}
inline Recorded nearer(Recorded a, Recorded b) {
    return emit(Op::nearer, a, b, steeper(a, b));
}
/// The result is only as steep as the bound, because it equals the bound wherever f is steeper (math/number.hpp).
inline Recorded guarded(Recorded bound, Recorded f, float far) {
    return emit(Op::guarded, bound, f, far, bound.lipschitz());
}
inline Recorded falloff(Recorded d, float radius) {
    return emit(Op::falloff, d, radius, d.lipschitz() * (steepest_falloff / radius));
}
/// The result is no steeper than the steeper operand, because a and b vary along orthogonal directions.
inline Recorded corner(Recorded a, Recorded b) {
    return emit(Op::corner, a, b, steeper(a, b));
}

}  // namespace phasetree::program
