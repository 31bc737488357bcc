// The interpreter of routines. This file is compiled once for each instruction set, with that set's compiler flags (see
// lib/CMakeLists.txt). The including file names the kernel: #define PHASETREE_KERNEL kernel_avx2
#define HWY_COMPILE_ONLY_STATIC
#include <cstring>
#include <type_traits>
#include <utility>

#include "kernel/batch.hpp"
#include "kernel/kernel.hpp"
#include "program/fused.hpp"

namespace phasetree::kernel {

using program::placed_floats, program::PlacedPrimitive;

namespace HWY_NAMESPACE {
namespace {

HWY_INLINE float* at(float* registers, std::uint32_t slot) {
    return registers + std::size_t{slot} * batch_size;
}

// Views an instruction's constants as their struct, in place. A copy would have to be written and read back before its
// numbers could be used. This file is therefore compiled without strict aliasing.
template <class Struct>
HWY_INLINE const Struct& constants_of(const float* constants) {
    static_assert(std::is_trivially_copyable_v<Struct> && alignof(Struct) <= alignof(float));
    return *reinterpret_cast<const Struct*>(constants);
}

HWY_INLINE Vec3<Batch> load_point(float* registers, std::uint32_t slot) {
    const float* p = at(registers, slot);
    return {load(p), load(p + batch_size), load(p + 2 * batch_size)};
}

// Each step of a routine does one of the following, with its own constants. First, operations on numbers:
template <Op op>
struct Simple {
    HWY_INLINE static void run(const Step& s, const float* constants, float* registers) {
        float* to = at(registers, s.to);
        const float* a = at(registers, s.a);
        const float* b = at(registers, s.b);
        if constexpr (op == Op::negate)
            store(-load(a), to);
        else if constexpr (op == Op::add)
            store(load(a) + load(b), to);
        else if constexpr (op == Op::subtract)
            store(load(a) - load(b), to);
        else if constexpr (op == Op::minimum || op == Op::far_bound_inside)
            store(min(load(a), load(b)), to);
        else if constexpr (op == Op::maximum || op == Op::far_bound)
            store(max(load(a), load(b)), to);
        else if constexpr (op == Op::absolute)
            store(abs(load(a)), to);
        else if constexpr (op == Op::add_constant)
            store(load(a) + *constants, to);
        else if constexpr (op == Op::constant_minus)
            store(*constants - load(a), to);
        else if constexpr (op == Op::multiply_constant)
            store(load(a) * *constants, to);
        else if constexpr (op == Op::smooth_minimum)
            store(smooth_min(load(a), load(b), *constants), to);
        else if constexpr (op == Op::guarded)
            store(guarded(load(a), load(b), *constants), to);
        else if constexpr (op == Op::falloff)
            store(falloff(load(a), *constants), to);
        else if constexpr (op == Op::corner)
            store(corner(load(a), load(b)), to);
        else if constexpr (op == Op::nearer)
            store(nearer(load(a), load(b)), to);
        else
            static_assert(op == Op::input, "the kernel does not run this operation");
    }
};

// A primitive whose parameters are the constants.
template <class P>
struct OfPrimitive {
    HWY_INLINE static void run(const Step& s, const float* constants, float* registers) {
        store(constants_of<P>(constants).distance(load_point(registers, s.a)), at(registers, s.to));
    }
};

// A primitive with data.
template <class P>
struct OfDataPrimitive {
    HWY_INLINE static void run(const Step& s, const float* constants, float* registers) {
        store(P::distance(constants, load_point(registers, s.a)), at(registers, s.to));
    }
};

// A map of space.
template <class M>
struct OfMap {
    HWY_INLINE static void run(const Step& s, const float* constants, float* registers) {
        const Vec3<Batch> q = constants_of<M>(constants)(load_point(registers, s.a));
        float* to = at(registers, s.to);
        store(q.x, to);
        store(q.y, to + batch_size);
        store(q.z, to + 2 * batch_size);
    }
};

// A primitive together with the affine maps before and after it (program/fused.hpp).
template <class P>
struct Placed {
    HWY_INLINE static void run(const Step& s, const float* constants, float* registers) {
        if constexpr (!LongPrimitive<P>) {
            const auto& frame = constants_of<PlacedPrimitive>(constants);
            const Batch d = constants_of<P>(constants + placed_floats).distance(frame.map(load_point(registers, s.a)));
            store(d * frame.scale + frame.offset, at(registers, s.to));
        }
    }
};

// Runs a step and then all following steps. Each step ends with a jump to the next one (threaded code). So there is no
// loop, and the processor's branch predictor learns which step follows which.
using Handler = void (*)(const Step*, const std::uint32_t* data, const float* constants, float* registers,
                         const Step* end);
HWY_INLINE Handler handler(std::uint32_t op);

template <class Work>
HWY_FLATTEN void run_from(const Step* s, const std::uint32_t* data, const float* constants, float* registers,
                          const Step* end) {
    Work::run(*s, constants + *data, registers);
    if (++s == end) return;
    handler(s->op)(s, data + 1, constants, registers, end);
}

template <class Ops, class PrimitiveList, class DataPrimitiveList, class MapList>
struct Table;
template <std::size_t... ops, class... Ps, class... Ds, class... Ms>
struct Table<std::index_sequence<ops...>, TypeList<Ps...>, TypeList<Ds...>, TypeList<Ms...>> {
    static constexpr Handler handlers[] = {run_from<Simple<static_cast<Op>(ops)>>...,
                                           run_from<OfPrimitive<Ps>>...,
                                           run_from<OfDataPrimitive<Ds>>...,
                                           run_from<OfMap<Ms>>...,
                                           run_from<OfMap<AffineMap>>,
                                           run_from<Placed<Ps>>...};
};
HWY_INLINE Handler handler(std::uint32_t op) {
    constexpr std::size_t simple = static_cast<std::size_t>(Op::first_primitive);
    return Table<std::make_index_sequence<simple>, Primitives, DataPrimitives, PointMaps>::handlers[op];
}

// Runs the first `count` steps of a routine for the point in slots 0 … 2.
HWY_INLINE void run(const Routine& routine, std::size_t count, float* registers) {
    const Step* first = routine.steps;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || HWY_IS_ASAN || HWY_IS_TSAN  // GCC, Clang
    // With a sanitizer, the compiler does not turn tail calls into jumps, and the stack would overflow. So run one step
    // at a time.
    for (std::size_t i = 0; i < count; ++i)
        handler(first[i].op)(first + i, routine.data + i, routine.constants, registers, first + i + 1);
#else
    if (count > 0) handler(first->op)(first, routine.data, routine.constants, registers, first + count);
#endif
}

// Stores the points of a batch in slots 0 … 2.
HWY_INLINE void set_points(const Batch& x, const Batch& y, const Batch& z, float* registers) {
    store(x, registers);
    store(y, registers + batch_size);
    store(z, registers + 2 * batch_size);
}

// What a batch of samples says about each point. The kernel's s(p), a lower bound on the distance to a change of label,
// is one of these:
//  - the second smallest component;
//  - minus the smallest component, which is no larger (Routine::uses_own_component);
//  - the absolute value of the first component, if that alone was evaluated.
struct Classified {
    Batch label;     // the phase of the smallest component
    Batch distance;  // s(p)
};

// The label of a sample if only the first component was evaluated, and it is positive.
constexpr float another_phase = -2;

// Whether there are two components, and each is the negative of the other.
HWY_INLINE bool is_shared(const Routine& routine) {
    return routine.output_count == 2 && routine.outputs[0].slot == routine.outputs[1].slot;
}

// The values of output i.
HWY_INLINE Batch component(const Routine& routine, std::size_t i, float* registers) {
    return load(at(registers, routine.outputs[i].slot)) * routine.outputs[i].sign;
}

// Label and distance from the first component alone.
HWY_INLINE Classified classify_first(const Routine& routine, float* registers) {
    const Batch first = component(routine, 0, registers), zero(0.f);
    return {select(less(first, zero), Batch(routine.outputs[0].phase), Batch(another_phase)), max(first, -first)};
}

// Label and distance from all components. For `uses_own_component`, see Routine.
HWY_INLINE Classified classify(const Routine& routine, bool uses_own_component, float* registers) {
    Batch lowest = component(routine, 0, registers);
    if (is_shared(routine)) {
        const Batch other = -lowest;
        return {select(less(other, lowest), Batch(routine.outputs[1].phase), Batch(routine.outputs[0].phase)),
                max(other, lowest)};
    }
    Batch second(3.402823466e38f);
    Batch phase(routine.outputs[0].phase);
    for (std::size_t i = 1; i < routine.output_count; ++i) {
        const Batch v = component(routine, i, registers);
        const BatchMask lower = less(v, lowest);
        second = min(second, max(v, lowest));
        phase = select(lower, Batch(routine.outputs[i].phase), phase);
        lowest = min(v, lowest);
    }
    return {phase, uses_own_component ? -lowest : second};
}

// Stores the points o + t·d of a ray in slots 0 … 2.
HWY_INLINE void set_points_along(const float* o, const float* d, const Batch& t, float* registers) {
    set_points(Batch(o[0]) + t * d[0], Batch(o[1]) + t * d[1], Batch(o[2]) + t * d[2], registers);
}

// The functions of Kernel; see kernel.hpp.

void evaluate(const Routine& routine, const float* x, const float* y, const float* z, float* registers, float* out) {
    set_points(load(x), load(y), load(z), registers);
    run(routine, routine.count, registers);
    for (std::size_t i = 0; i < routine.output_count; ++i)
        store(load(at(registers, routine.outputs[i].slot)) * routine.outputs[i].sign, out + i * batch_size);
}

void sample(const Routine& routine, const float* x, const float* y, const float* z, float* registers, float* label,
            float* distance) {
    set_points(load(x), load(y), load(z), registers);
    run(routine, routine.count, registers);
    const Classified c = classify(routine, routine.uses_own_component, registers);
    store(c.label, label);
    store(c.distance, distance);
}

void sample_ray(const Routine& routine, const float* o, const float* d, const float* t, float* registers, float* label,
                float* distance) {
    set_points_along(o, d, load(t), registers);
    run(routine, routine.count, registers);
    const Classified c = classify(routine, routine.uses_own_component, registers);
    store(c.label, label);
    store(c.distance, distance);
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace phasetree::kernel

#include "kernel/sign_certificate.inl"

#include "kernel/sample_positions.inl"

#include "kernel/frame.inl"

#include "kernel/march.inl"

#include "kernel/visit.inl"

#include "kernel/network_layer.inl"

namespace phasetree::kernel {

const Kernel PHASETREE_KERNEL = {HWY_NAMESPACE::evaluate, HWY_NAMESPACE::sample, HWY_NAMESPACE::sample_ray,
                                 HWY_NAMESPACE::visit, HWY_NAMESPACE::network_layer};

}  // namespace phasetree::kernel
