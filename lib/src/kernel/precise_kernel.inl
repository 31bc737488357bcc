// The interpreter of routines in double precision, eight points at a time. This file is compiled once for each
// instruction set, like kernel.inl. The including file names the function: #define PHASETREE_RUN run_precisely_avx2
#define HWY_COMPILE_ONLY_STATIC
#include <type_traits>
#include <utility>

#include "kernel/precise_batch.hpp"
#include "phasetree/nodes/list.hpp"
#include "program/fused.hpp"

namespace phasetree::kernel {

using program::placed_floats, program::PlacedPrimitive;

namespace HWY_NAMESPACE {
namespace {

HWY_INLINE double* at(double* registers, std::uint32_t slot) {
    return registers + std::size_t{slot} * batch_size;
}
// Views an instruction's constants as their struct, in place, as in kernel.inl.
template <class Struct>
HWY_INLINE const Struct& constants_of(const float* constants) {
    static_assert(std::is_trivially_copyable_v<Struct> && alignof(Struct) <= alignof(float));
    return *reinterpret_cast<const Struct*>(constants);
}
HWY_INLINE Vec3<PreciseBatch> load_point(double* registers, std::uint32_t slot) {
    const double* p = at(registers, slot);
    return {load(p), load(p + batch_size), load(p + 2 * batch_size)};
}

template <Op op>
struct Simple {
    HWY_INLINE static void run(const Step& s, const float* constants, double* registers) {
        double* to = at(registers, s.to);
        const double* a = at(registers, s.a);
        const double* b = at(registers, s.b);
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

template <class P>
struct OfPrimitive {
    HWY_INLINE static void run(const Step& s, const float* constants, double* registers) {
        store(constants_of<P>(constants).distance(load_point(registers, s.a)), at(registers, s.to));
    }
};

template <class M>
struct OfMap {
    HWY_INLINE static void run(const Step& s, const float* constants, double* registers) {
        const Vec3<PreciseBatch> q = constants_of<M>(constants)(load_point(registers, s.a));
        double* to = at(registers, s.to);
        store(q.x, to);
        store(q.y, to + batch_size);
        store(q.z, to + 2 * batch_size);
    }
};

using Handler = void (*)(const Step&, const float* constants, double* registers);

template <class Work>
HWY_FLATTEN void run_step(const Step& s, const float* constants, double* registers) {
    Work::run(s, constants, registers);
}

template <class Ops, class PrimitiveList, class MapList>
struct PreciseTable;
template <std::size_t... ops, class... Ps, class... Ms>
struct PreciseTable<std::index_sequence<ops...>, TypeList<Ps...>, TypeList<Ms...>> {
    static constexpr Handler simple[] = {run_step<Simple<static_cast<Op>(ops)>>...};
    static constexpr Handler primitives[] = {run_step<OfPrimitive<Ps>>...};
    static constexpr Handler maps[] = {run_step<OfMap<Ms>>..., run_step<OfMap<AffineMap>>};
};

}  // namespace
}  // namespace HWY_NAMESPACE

void PHASETREE_RUN(const Routine& routine, double* registers) {
    using namespace HWY_NAMESPACE;
    constexpr auto first_primitive = static_cast<std::uint32_t>(Op::first_primitive);
    using Handlers = PreciseTable<std::make_index_sequence<first_primitive>, Primitives, PointMaps>;
    for (std::size_t i = 0; i < routine.count; ++i) {
        const Step& s = routine.steps[i];
        const Handler handler = s.op < first_primitive      ? Handlers::simple[s.op]
                                : s.op < program::first_map ? Handlers::primitives[s.op - first_primitive]
                                                            : Handlers::maps[s.op - program::first_map];
        handler(s, routine.constants + routine.data[i], registers);
    }
}

}  // namespace phasetree::kernel
