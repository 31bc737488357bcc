#pragma once

#include <cstring>

#include "phasetree/nodes/list.hpp"
#include "program/assemble.hpp"

/// A routine run with any number type, one number at a time: for gradients and enclosures. Kernels have their own.
namespace phasetree {

namespace detail {

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

/// The distance of a primitive of either kind, whose floats are at `constants`.
template <class P, class T>
T distance_of(const float* constants, const Vec3<T>& q) {
    if constexpr (DataPrimitive<P>) {
        return P::distance(constants, q);
    } else {
        P primitive;
        std::memcpy(static_cast<void*>(&primitive), constants, sizeof primitive);
        return primitive.distance(q);
    }
}

}  // namespace detail

/// What it means to a number type that f, computed from q, is a convex function of it: mostly nothing.
template <class T>
T known_to_be_convex(const T& f, const Vec3<T>& q) {
    (void)q;
    return f;
}

/// Registers 0 … 2 hold the point. `long_primitive.template operator()<P>(constants, point)` evaluates those;
/// `done(number)` is called with each number that a step has made.
template <class T, class LongPrimitiveOf, class Done>
void interpret(const Routine& routine, T* registers, LongPrimitiveOf&& long_primitive, Done&& done) {
    constexpr auto first_primitive = static_cast<std::uint32_t>(Op::first_primitive);
    for (std::size_t i = 0; i < routine.count; ++i) {
        const Step& s = routine.steps[i];
        const T& a = registers[s.a];
        const T& b = registers[s.b];
        T& to = registers[s.to];
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
            case Op::farther:
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
                const Vec3<T> point{registers[s.a], registers[s.a + 1], registers[s.a + 2]};
                const std::uint32_t index = s.op - first_primitive;
                const auto primitive = [&]<class P>() {
                    if constexpr (LongPrimitive<P>)
                        to = long_primitive.template operator()<P>(c, point);
                    else if constexpr (ConvexPrimitive<P>)
                        to = known_to_be_convex(detail::distance_of<P>(c, point), point);
                    else
                        to = detail::distance_of<P>(c, point);
                };
                if (index < Primitives::size) {
                    detail::dispatch(Primitives(), index, primitive);
                } else if (index < Primitives::size + DataPrimitives::size) {
                    detail::dispatch(DataPrimitives(), index - static_cast<std::uint32_t>(Primitives::size), primitive);
                } else {
                    constexpr auto before = static_cast<std::uint32_t>(Primitives::size + DataPrimitives::size);
                    detail::dispatch(PointMaps(), index - before, [&]<class M>() {
                        const Vec3<T> q = detail::constants_of<M>(s, routine.constants)(point);
                        registers[s.to] = q.x;
                        registers[s.to + 1] = q.y;
                        registers[s.to + 2] = q.z;
                    });
                    done(registers[s.to + 1]);
                    done(registers[s.to + 2]);
                }
            }
        }
        done(to);
    }
}

}  // namespace phasetree
