#pragma once

#include "program/dispatch.hpp"

namespace phasetree::rewriting {

/// Calls f<P>() if the operation is a primitive P with data.
template <class F>
void with_data_primitive(Op op, F&& f) {
    const auto first = static_cast<std::uint32_t>(Op::first_primitive) + static_cast<std::uint32_t>(Primitives::size);
    program::dispatch(DataPrimitives(), static_cast<std::uint32_t>(op) - first, f);
}

}  // namespace phasetree::rewriting
