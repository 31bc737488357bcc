// The number type of a kernel in double precision: eight doubles, in as many SIMD registers as the instruction set
// needs. Each lane does the same operations in the same order as Precise<0>, so results are the same, bit for bit.
// Everything is in a namespace named after the instruction set, so that the linker cannot mix two of them.
#pragma once

#include <hwy/highway.h>

#include "kernel/precise_kernel.hpp"
#include "phasetree/math/arc_tangent.hpp"
#include "phasetree/math/elementary.hpp"
#include "phasetree/math/found_equation.hpp"
#include "phasetree/math/vec3.hpp"
#include "phasetree/program/batch.hpp"

namespace phasetree::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using PreciseTag = hn::CappedTag<double, batch_size>;
inline constexpr std::size_t precise_width = hn::MaxLanes(PreciseTag());
inline constexpr std::size_t registers_per_precise_batch = batch_size / precise_width;

#define PHASETREE_EACH _Pragma("GCC unroll 8") for (std::size_t i = 0; i < registers_per_precise_batch; ++i)

struct PreciseBatch {
    hn::Vec<PreciseTag> v[registers_per_precise_batch];

    PreciseBatch() = default;
    HWY_INLINE explicit PreciseBatch(double value) { PHASETREE_EACH v[i] = hn::Set(PreciseTag(), value); }
    HWY_INLINE explicit PreciseBatch(float value) : PreciseBatch(static_cast<double>(value)) {}
};

struct PreciseMask {
    hn::Mask<PreciseTag> m[registers_per_precise_batch];
};

/// Reads eight doubles.
HWY_INLINE PreciseBatch load(const double* from) {
    PreciseBatch r;
    PHASETREE_EACH r.v[i] = hn::Load(PreciseTag(), from + i * precise_width);
    return r;
}
HWY_INLINE void store(const PreciseBatch& a, double* to) {
    PHASETREE_EACH hn::Store(a.v[i], PreciseTag(), to + i * precise_width);
}

template <class F>
HWY_INLINE PreciseBatch each_register(F&& f) {
    PreciseBatch r;
    PHASETREE_EACH r.v[i] = f(i);
    return r;
}
/// Applies a scalar function to each lane.
template <class F>
HWY_INLINE PreciseBatch each_lane(const PreciseBatch& a, F&& f) {
    alignas(64) double x[batch_size];
    store(a, x);
    for (std::size_t i = 0; i < batch_size; ++i) x[i] = f(x[i]);
    return load(x);
}

HWY_INLINE PreciseBatch operator+(const PreciseBatch& a, const PreciseBatch& b) {
    return each_register([&](std::size_t i) { return hn::Add(a.v[i], b.v[i]); });
}
HWY_INLINE PreciseBatch operator-(const PreciseBatch& a, const PreciseBatch& b) {
    return each_register([&](std::size_t i) { return hn::Sub(a.v[i], b.v[i]); });
}
HWY_INLINE PreciseBatch operator*(const PreciseBatch& a, const PreciseBatch& b) {
    return each_register([&](std::size_t i) { return hn::Mul(a.v[i], b.v[i]); });
}
HWY_INLINE PreciseBatch operator/(const PreciseBatch& a, const PreciseBatch& b) {
    return each_register([&](std::size_t i) { return hn::Div(a.v[i], b.v[i]); });
}
HWY_INLINE PreciseBatch operator-(const PreciseBatch& a) {
    return each_register([&](std::size_t i) { return hn::Neg(a.v[i]); });
}
HWY_INLINE PreciseBatch operator+(const PreciseBatch& a, float b) {
    return a + PreciseBatch(b);
}
HWY_INLINE PreciseBatch operator-(const PreciseBatch& a, float b) {
    return a - PreciseBatch(b);
}
HWY_INLINE PreciseBatch operator*(const PreciseBatch& a, float b) {
    return a * PreciseBatch(b);
}
HWY_INLINE PreciseBatch operator+(float a, const PreciseBatch& b) {
    return PreciseBatch(a) + b;
}
HWY_INLINE PreciseBatch operator-(float a, const PreciseBatch& b) {
    return PreciseBatch(a) - b;
}
HWY_INLINE PreciseBatch operator*(float a, const PreciseBatch& b) {
    return PreciseBatch(a) * b;
}

HWY_INLINE PreciseMask less(const PreciseBatch& a, const PreciseBatch& b) {
    PreciseMask r;
    PHASETREE_EACH r.m[i] = hn::Lt(a.v[i], b.v[i]);
    return r;
}
HWY_INLINE PreciseBatch select(const PreciseMask& m, const PreciseBatch& yes, const PreciseBatch& no) {
    return each_register([&](std::size_t i) { return hn::IfThenElse(m.m[i], yes.v[i], no.v[i]); });
}
// A comparison followed by a selection, as in batch.hpp.
HWY_INLINE PreciseBatch min(const PreciseBatch& a, const PreciseBatch& b) {
#if HWY_ARCH_X86
    return each_register([&](std::size_t i) { return hn::Min(a.v[i], b.v[i]); });
#else
    return select(less(a, b), a, b);
#endif
}
HWY_INLINE PreciseBatch max(const PreciseBatch& a, const PreciseBatch& b) {
#if HWY_ARCH_X86
    return each_register([&](std::size_t i) { return hn::Max(a.v[i], b.v[i]); });
#else
    return select(less(b, a), a, b);
#endif
}
HWY_INLINE PreciseBatch abs(const PreciseBatch& a) {
    return each_register([&](std::size_t i) { return hn::Abs(a.v[i]); });
}
HWY_INLINE PreciseBatch sqrt(const PreciseBatch& a) {
    return each_register([&](std::size_t i) { return hn::Sqrt(a.v[i]); });
}
HWY_INLINE PreciseBatch floor(const PreciseBatch& a) {
    return each_register([&](std::size_t i) { return hn::Floor(a.v[i]); });
}
HWY_INLINE PreciseBatch lookup(const float* table, const PreciseBatch& index) {
    return each_lane(index, [&](double i) { return static_cast<double>(table[static_cast<int>(i)]); });
}

HWY_INLINE SineCosine<PreciseBatch> sine_cosine(const PreciseBatch& x) {
    return {each_lane(x, precise_sine), each_lane(x, precise_cosine)};
}
HWY_INLINE PreciseBatch sine(const PreciseBatch& x) {
    return each_lane(x, precise_sine);
}
HWY_INLINE PreciseBatch exponential(const PreciseBatch& x) {
    return each_lane(clamp(x, PreciseBatch(-80.f), PreciseBatch(80.f)), precise_exponential);
}
HWY_INLINE PreciseBatch angle_of(const PreciseBatch& x, const PreciseBatch& y) {
    alignas(64) double a[batch_size], b[batch_size];
    store(x, a);
    store(y, b);
    for (std::size_t i = 0; i < batch_size; ++i) a[i] = precise_angle(a[i], b[i]);
    return load(a);
}

// Never called: programs that search do not run in batches (PreciseProgram::runs_in_batches).
template <class Search, class Equation, class Otherwise>
HWY_INLINE PreciseBatch found_equation(const Vec3<PreciseBatch>& p, const Search&, const Equation&, const Otherwise&) {
    return p.x;
}
template <std::size_t count, class Search, class Equation, class Otherwise>
HWY_INLINE PreciseBatch gathered_equation(const Vec3<PreciseBatch>& p, const Search&, const Equation&,
                                          const Otherwise&) {
    return p.x;
}

#undef PHASETREE_EACH

}  // namespace phasetree::kernel::HWY_NAMESPACE
