// The number type of a kernel: eight floats, in as many SIMD registers as the instruction set needs. Everything is in a
// namespace named after the instruction set, so that the linker cannot mix two of them.
#pragma once

#include <hwy/highway.h>
#include <array>
#include <cstring>

#include "phasetree/math/vec3.hpp"
#include "phasetree/program/batch.hpp"

namespace phasetree::kernel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<float, batch_size>;
using Register = hn::Vec<Tag>;
using RegisterMask = hn::Mask<Tag>;
inline constexpr std::size_t width = hn::MaxLanes(Tag());
inline constexpr std::size_t registers_per_batch = batch_size / width;

#define PHASETREE_EACH _Pragma("GCC unroll 2") for (std::size_t i = 0; i < registers_per_batch; ++i)

/// The indices of a register's lanes, rotated so that lane `first` comes first.
template <std::size_t first>
HWY_INLINE const std::int32_t* turn_indices() {
    struct Table {
        alignas(64) std::int32_t index[width];
        constexpr Table() : index{} {
            for (std::size_t i = 0; i < width; ++i) index[i] = static_cast<std::int32_t>((i + first) % width);
        }
    };
    static constexpr Table table;
    return table.index;
}

struct Batch {
    Register v[registers_per_batch];

    Batch() = default;
    HWY_INLINE explicit Batch(float value) { PHASETREE_EACH v[i] = hn::Set(Tag(), value); }
};

struct BatchMask {
    RegisterMask m[registers_per_batch];
};

/// Reads eight floats.
HWY_INLINE Batch load(const float* from) {
    Batch r;
    PHASETREE_EACH r.v[i] = hn::Load(Tag(), from + i * width);
    return r;
}
HWY_INLINE void store(const Batch& a, float* to) {
    PHASETREE_EACH hn::Store(a.v[i], Tag(), to + i * width);
}

template <class F>
HWY_INLINE Batch each(F&& f) {
    Batch r;
    PHASETREE_EACH r.v[i] = f(i);
    return r;
}

HWY_INLINE Batch operator+(const Batch& a, const Batch& b) {
    return each([&](std::size_t i) { return hn::Add(a.v[i], b.v[i]); });
}
HWY_INLINE Batch operator-(const Batch& a, const Batch& b) {
    return each([&](std::size_t i) { return hn::Sub(a.v[i], b.v[i]); });
}
HWY_INLINE Batch operator*(const Batch& a, const Batch& b) {
    return each([&](std::size_t i) { return hn::Mul(a.v[i], b.v[i]); });
}
HWY_INLINE Batch operator/(const Batch& a, const Batch& b) {
    return each([&](std::size_t i) { return hn::Div(a.v[i], b.v[i]); });
}
HWY_INLINE Batch operator-(const Batch& a) {
    return each([&](std::size_t i) { return hn::Neg(a.v[i]); });
}
HWY_INLINE Batch operator+(const Batch& a, float b) {
    return a + Batch(b);
}
HWY_INLINE Batch operator-(const Batch& a, float b) {
    return a - Batch(b);
}
HWY_INLINE Batch operator*(const Batch& a, float b) {
    return a * Batch(b);
}
HWY_INLINE Batch operator+(float a, const Batch& b) {
    return Batch(a) + b;
}
HWY_INLINE Batch operator-(float a, const Batch& b) {
    return Batch(a) - b;
}
HWY_INLINE Batch operator*(float a, const Batch& b) {
    return Batch(a) * b;
}

HWY_INLINE BatchMask less(const Batch& a, const Batch& b) {
    BatchMask r;
    PHASETREE_EACH r.m[i] = hn::Lt(a.v[i], b.v[i]);
    return r;
}
HWY_INLINE Batch select(const BatchMask& m, const Batch& yes, const Batch& no) {
    return each([&](std::size_t i) { return hn::IfThenElse(m.m[i], yes.v[i], no.v[i]); });
}
// As in number.hpp, these are a comparison followed by a selection. The x86 instructions do exactly that; other
// instruction sets may differ for equal or unordered operands.
HWY_INLINE Batch min(const Batch& a, const Batch& b) {
#if HWY_ARCH_X86
    return each([&](std::size_t i) { return hn::Min(a.v[i], b.v[i]); });
#else
    return select(less(a, b), a, b);
#endif
}
HWY_INLINE Batch max(const Batch& a, const Batch& b) {
#if HWY_ARCH_X86
    return each([&](std::size_t i) { return hn::Max(a.v[i], b.v[i]); });
#else
    return select(less(b, a), a, b);
#endif
}
HWY_INLINE Batch abs(const Batch& a) {
    return each([&](std::size_t i) { return hn::Abs(a.v[i]); });
}
HWY_INLINE Batch sqrt(const Batch& a) {
    return each([&](std::size_t i) { return hn::Sqrt(a.v[i]); });
}
HWY_INLINE Batch floor(const Batch& a) {
    return each([&](std::size_t i) { return hn::Floor(a.v[i]); });
}
HWY_INLINE Batch multiply_add(const Batch& a, float b, const Batch& c) {
    const Register factor = hn::Set(Tag(), b);
    return each([&](std::size_t i) { return hn::MulAdd(a.v[i], factor, c.v[i]); });
}
HWY_INLINE Batch lookup(const float* table, const Batch& index) {
    return each([&](std::size_t i) {
        return hn::GatherIndex(Tag(), table, hn::ConvertTo(hn::RebindToSigned<Tag>(), index.v[i]));
    });
}

/// Evaluates lane by lane, because each lane has its own search and its own equation.
template <class Search, class Equation, class Otherwise>
HWY_INLINE Batch found_equation(const Vec3<Batch>& p, const Search& search, const Equation& equation,
                                const Otherwise&) {
    alignas(Batch) float x[batch_size], y[batch_size], z[batch_size];
    store(p.x, x);
    store(p.y, y);
    store(p.z, z);
    for (std::size_t i = 0; i < batch_size; ++i) {
        const Vec3<float> q{x[i], y[i], z[i]};
        x[i] = equation(search(q), q);
    }
    return load(x);
}

template <std::size_t count, class Search, class Equation, class Otherwise>
HWY_INLINE Batch gathered_equation(const Vec3<Batch>& p, const Search& search, const Equation& equation,
                                   const Otherwise&) {
    alignas(Batch) float x[batch_size], y[batch_size], z[batch_size], found[count][batch_size];
    store(p.x, x);
    store(p.y, y);
    store(p.z, z);
    for (std::size_t i = 0; i < batch_size; ++i) search(Vec3<float>{x[i], y[i], z[i]}, &found[0][i], batch_size);
    std::array<Batch, count> numbers;
    for (std::size_t k = 0; k < count; ++k) numbers[k] = load(found[k]);
    return equation(numbers, p);
}

/// The lane numbers 0 … 7.
HWY_INLINE Batch lanes() {
    alignas(Batch) static constexpr float numbers[batch_size] = {0, 1, 2, 3, 4, 5, 6, 7};
    return load(numbers);
}
/// Lane i gets the value of lane i − 1; the first lane gets `before`.
HWY_INLINE Batch shifted(const Batch& a, float before) {
    Batch r;
    Register carry = hn::Set(Tag(), before);
    const auto back = hn::SetTableIndices(Tag(), turn_indices<width - 1>());
    const RegisterMask first = hn::FirstN(Tag(), 1);
    PHASETREE_EACH {
        const Register turned = hn::TableLookupLanes(a.v[i], back);  // the last lane comes first
        r.v[i] = hn::IfThenElse(first, carry, turned);
        carry = turned;
    }
    return r;
}
/// Lane i gets the value of lane i + 1; the last lane gets `after`.
HWY_INLINE Batch shifted_back(const Batch& a, float after) {
    Batch r;
    Register carry = hn::Set(Tag(), after);
    const auto on = hn::SetTableIndices(Tag(), turn_indices<1>());
    const RegisterMask others = hn::FirstN(Tag(), width - 1);
    for (std::size_t i = registers_per_batch; i-- > 0;) {
        const Register turned = hn::TableLookupLanes(a.v[i], on);  // the first lane comes last
        r.v[i] = hn::IfThenElse(others, turned, carry);
        carry = turned;
    }
    return r;
}
/// A mask whose bit i says whether lane i is true.
HWY_INLINE std::uint32_t bits(const BatchMask& m) {
    std::uint32_t all = 0;
    PHASETREE_EACH {
        std::uint8_t bytes[8] = {};
        hn::StoreMaskBits(Tag(), m.m[i], bytes);
        std::uint16_t some;
        std::memcpy(&some, bytes, sizeof some);
        all |= (some & ((1u << width) - 1u)) << (i * width);
    }
    return all;
}

/// Numbers in nearly equal ratios. The bits of a float are nearly its logarithm, so lane i gets the float whose bits
/// are those of a plus i times `step`.
HWY_INLINE Batch geometric(const Batch& lane, std::uint32_t a, std::uint32_t step) {
    const hn::RebindToSigned<Tag> whole;
    return each([&](std::size_t i) {
        const auto k = hn::ConvertTo(whole, lane.v[i]);
        return hn::BitCast(
            Tag(), hn::Set(whole, static_cast<std::int32_t>(a)) + k * hn::Set(whole, static_cast<std::int32_t>(step)));
    });
}

#undef PHASETREE_EACH

}  // namespace phasetree::kernel::HWY_NAMESPACE
