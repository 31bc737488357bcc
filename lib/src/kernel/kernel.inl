/// The interpreter, compiled once for each instruction set with that set's compiler flags (see lib/CMakeLists.txt).
/// The including file names the kernel: #define PHASETREE_KERNEL kernel_avx2

#define HWY_COMPILE_ONLY_STATIC
#include <cstring>
#include <utility>

#include "kernel/batch.hpp"
#include "kernel/kernel.hpp"
#include "phasetree/nodes/list.hpp"

namespace phasetree {
namespace HWY_NAMESPACE {
namespace {

HWY_INLINE float* at(float* registers, std::uint32_t slot) {
    return registers + std::size_t{slot} * batch_size;
}

template <class Struct>
HWY_INLINE Struct constants_of(const Step& s, const float* constants) {
    Struct result;
    std::memcpy(static_cast<void*>(&result), constants + s.data, sizeof(Struct));
    return result;
}

HWY_INLINE Vec3<Batch> load_point(float* registers, std::uint32_t slot) {
    const float* p = at(registers, slot);
    return {load(p), load(p + batch_size), load(p + 2 * batch_size)};
}

using Handler = void (*)(const Step&, const float* constants, float* registers);

template <class P>
HWY_FLATTEN void run_primitive(const Step& s, const float* constants, float* registers) {
    store(constants_of<P>(s, constants).distance(load_point(registers, s.a)), at(registers, s.to));
}

template <class P>
HWY_FLATTEN void run_data_primitive(const Step& s, const float* constants, float* registers) {
    store(P::distance(constants + s.data, load_point(registers, s.a)), at(registers, s.to));
}

template <class M>
HWY_FLATTEN void run_map(const Step& s, const float* constants, float* registers) {
    const Vec3<Batch> q = constants_of<M>(s, constants)(load_point(registers, s.a));
    float* to = at(registers, s.to);
    store(q.x, to);
    store(q.y, to + batch_size);
    store(q.z, to + 2 * batch_size);
}

template <class PrimitiveList, class DataPrimitiveList, class MapList>
struct Table;
template <class... Ps, class... Ds, class... Ms>
struct Table<TypeList<Ps...>, TypeList<Ds...>, TypeList<Ms...>> {
    static constexpr Handler handlers[] = {run_primitive<Ps>..., run_data_primitive<Ds>..., run_map<Ms>...};
};
using Handlers = Table<Primitives, DataPrimitives, PointMaps>;

HWY_FLATTEN void run(const Routine& routine, float* registers) {
    const float* constants = routine.constants;
    for (const Step *s = routine.steps, *end = s + routine.count; s != end; ++s) {
        float* to = at(registers, s->to);
        const float* a = at(registers, s->a);
        const float* b = at(registers, s->b);
        switch (static_cast<Op>(s->op)) {
            case Op::input:
                break;
            case Op::negate:
                store(-load(a), to);
                break;
            case Op::add:
                store(load(a) + load(b), to);
                break;
            case Op::subtract:
                store(load(a) - load(b), to);
                break;
            case Op::minimum:
                store(min(load(a), load(b)), to);
                break;
            case Op::maximum:
                store(max(load(a), load(b)), to);
                break;
            case Op::absolute:
                store(abs(load(a)), to);
                break;
            case Op::add_constant:
                store(load(a) + constants[s->data], to);
                break;
            case Op::constant_minus:
                store(constants[s->data] - load(a), to);
                break;
            case Op::multiply_constant:
                store(load(a) * constants[s->data], to);
                break;
            case Op::smooth_minimum:
                store(smooth_min(load(a), load(b), constants[s->data]), to);
                break;
            case Op::guarded:
                store(guarded(load(a), load(b), constants[s->data]), to);
                break;
            case Op::falloff:
                store(falloff(load(a), constants[s->data]), to);
                break;
            case Op::corner:
                store(corner(load(a), load(b)), to);
                break;
            default:
                Handlers::handlers[s->op - static_cast<std::uint32_t>(Op::first_primitive)](*s, constants, registers);
        }
    }
}

HWY_INLINE void place(const Batch& x, const Batch& y, const Batch& z, float* registers) {
    store(x, registers);
    store(y, registers + batch_size);
    store(z, registers + 2 * batch_size);
}

/// The smallest component's phase and the second smallest component.
HWY_INLINE void classify(const Routine& routine, float* registers, float* label, float* distance) {
    const auto component = [&](std::size_t i) {
        return load(at(registers, routine.outputs[i].slot)) * routine.outputs[i].sign;
    };
    Batch lowest = component(0);
    Batch second(3.402823466e38f);
    Batch phase(routine.outputs[0].phase);
    for (std::size_t i = 1; i < routine.output_count; ++i) {
        const Batch v = component(i);
        const BatchMask lower = less(v, lowest);
        second = min(second, max(v, lowest));
        phase = select(lower, Batch(routine.outputs[i].phase), phase);
        lowest = min(v, lowest);
    }
    store(phase, label);
    store(second, distance);
}

void evaluate(const Routine& routine, const float* x, const float* y, const float* z, float* registers, float* out) {
    place(load(x), load(y), load(z), registers);
    run(routine, registers);
    for (std::size_t i = 0; i < routine.output_count; ++i)
        store(load(at(registers, routine.outputs[i].slot)) * routine.outputs[i].sign, out + i * batch_size);
}

void sample(const Routine& routine, const float* x, const float* y, const float* z, float* registers, float* label,
            float* distance) {
    place(load(x), load(y), load(z), registers);
    run(routine, registers);
    classify(routine, registers, label, distance);
}

void sample_ray(const Routine& routine, const float* o, const float* d, const float* t, float* registers, float* label,
                float* distance) {
    const Batch along = load(t);
    place(Batch(o[0]) + along * d[0], Batch(o[1]) + along * d[1], Batch(o[2]) + along * d[2], registers);
    run(routine, registers);
    classify(routine, registers, label, distance);
}

}  // namespace
}  // namespace HWY_NAMESPACE

const Kernel PHASETREE_KERNEL = {HWY_NAMESPACE::evaluate, HWY_NAMESPACE::sample, HWY_NAMESPACE::sample_ray};

}  // namespace phasetree
