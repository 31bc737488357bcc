// Finds the type of a primitive from the number of its operation, and converts an instruction's floats to a struct.
#pragma once

#include <cstdint>
#include <cstring>
#include <tuple>
#include <type_traits>

#include "phasetree/nodes/list.hpp"
#include "phasetree/program/program.hpp"

namespace phasetree::program {

template <std::size_t first, std::size_t count, class... Ts, class Run>
[[gnu::always_inline]] inline void dispatch_among(TypeList<Ts...> list, std::uint32_t index, Run& run) {
    if constexpr (count == 1) {
        run.template operator()<std::tuple_element_t<first, std::tuple<Ts...>>>();
    } else {
        constexpr std::size_t half = count / 2;
        if (index < first + half)
            dispatch_among<first, half>(list, index, run);
        else
            dispatch_among<first + half, count - half>(list, index, run);
    }
}
/// Calls run.template operator()<T>() for the type with this index in a list; does nothing if the index is past its
/// end. The type is found by bisection, so that the call can be inlined.
template <class... Ts, class Run>
void dispatch(TypeList<Ts...> list, std::uint32_t index, Run&& run) {
    if (index < sizeof...(Ts)) dispatch_among<0, sizeof...(Ts)>(list, index, run);
}

/// The operation of a primitive, with or without data.
template <class P>
constexpr Op op_of() {
    constexpr auto first = static_cast<std::size_t>(Op::first_primitive);
    if constexpr (DataPrimitive<P>)
        return static_cast<Op>(first + Primitives::size + index_in<P>(DataPrimitives()));
    else
        return static_cast<Op>(first + index_in<P>(Primitives()));
}

template <class Struct>
Struct read(const float* constants) {
    Struct result;
    std::memcpy(static_cast<void*>(&result), constants, sizeof result);
    return result;
}

/// The distance of a primitive P, with or without data, whose floats start at `constants`.
template <class P, class T>
T distance_of(const float* constants, const Vec3<T>& q) {
    if constexpr (DataPrimitive<P>) {
        return P::distance(constants, q);
    } else {
        return read<P>(constants).distance(q);
    }
}

}  // namespace phasetree::program
