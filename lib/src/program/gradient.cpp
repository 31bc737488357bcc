#include <cstring>

#include "phasetree/math/dual.hpp"
#include "phasetree/nodes/list.hpp"
#include "program/assemble.hpp"

namespace phasetree {

namespace {

constexpr std::uint32_t first_primitive = static_cast<std::uint32_t>(Op::first_primitive);

/// Calls run.template operator()<T>() for the index-th type of a list.
template <class... Ts, class Run>
void dispatch(TypeList<Ts...>, std::uint32_t index, Run&& run) {
    std::uint32_t k = 0;
    (void)((k++ == index ? (run.template operator()<Ts>(), true) : false) || ...);
}

template <class Struct>
Struct constants_of(const Step& s, const float* constants) {
    Struct result;
    std::memcpy(static_cast<void*>(&result), constants + s.data, sizeof result);
    return result;
}

}  // namespace

glm::vec3 gradient(const Routine& routine, std::uint32_t slots, const glm::vec3& p, Phase phase) {
    const OutputSlot* output = nullptr;
    for (std::size_t i = 0; i < routine.output_count; ++i)
        if (routine.outputs[i].phase == static_cast<float>(phase.index)) output = &routine.outputs[i];
    if (!output) return glm::vec3(0);

    thread_local std::vector<Dual> registers;
    if (registers.size() < slots) registers.resize(slots);
    registers[0] = Dual(p.x, 1, 0, 0);
    registers[1] = Dual(p.y, 0, 1, 0);
    registers[2] = Dual(p.z, 0, 0, 1);
    for (std::size_t i = 0; i < routine.count; ++i) {
        const Step& s = routine.steps[i];
        const Dual a = registers[s.a], b = registers[s.b];
        Dual& to = registers[s.to];
        const float* c = routine.constants + s.data;
        switch (static_cast<Op>(s.op)) {
            case Op::input:
                break;
            case Op::negate:
                to = -a;
                break;
            case Op::add:
                to = a + b;
                break;
            case Op::subtract:
                to = a - b;
                break;
            case Op::minimum:
                to = min(a, b);
                break;
            case Op::maximum:
                to = max(a, b);
                break;
            case Op::absolute:
                to = abs(a);
                break;
            case Op::add_constant:
                to = a + *c;
                break;
            case Op::constant_minus:
                to = *c - a;
                break;
            case Op::multiply_constant:
                to = a * *c;
                break;
            case Op::smooth_minimum:
                to = smooth_min(a, b, *c);
                break;
            case Op::guarded:
                to = guarded(a, b, *c);
                break;
            case Op::falloff:
                to = falloff(a, *c);
                break;
            case Op::corner:
                to = corner(a, b);
                break;
            default: {
                const Vec3<Dual> point{registers[s.a], registers[s.a + 1], registers[s.a + 2]};
                const std::uint32_t index = s.op - first_primitive;
                if (index < Primitives::size) {
                    dispatch(Primitives(), index,
                             [&]<class P>() { to = constants_of<P>(s, routine.constants).distance(point); });
                } else if (index < Primitives::size + DataPrimitives::size) {
                    dispatch(DataPrimitives(), index - static_cast<std::uint32_t>(Primitives::size),
                             [&]<class P>() { to = P::distance(c, point); });
                } else {
                    constexpr auto before = static_cast<std::uint32_t>(Primitives::size + DataPrimitives::size);
                    dispatch(PointMaps(), index - before, [&]<class M>() {
                        const Vec3<Dual> q = constants_of<M>(s, routine.constants)(point);
                        registers[s.to] = q.x;
                        registers[s.to + 1] = q.y;
                        registers[s.to + 2] = q.z;
                    });
                }
            }
        }
    }
    const Dual& g = registers[output->slot];
    return glm::vec3(g.dx, g.dy, g.dz) * output->sign;
}

}  // namespace phasetree
