#pragma once

#include <cstring>
#include <optional>

#include "phasetree/nodes/list.hpp"
#include "program/fused.hpp"

namespace phasetree::rewriting {

namespace detail {

template <class... Ms>
std::optional<AffineMap> affine_map_of(TypeList<Ms...>, std::uint32_t index, const float* constants) {
    std::optional<AffineMap> found;
    const auto read_map = [&]<class M>() {
        if constexpr (AffinePointMap<M>) {
            M map;
            std::memcpy(static_cast<void*>(&map), constants, sizeof map);
            found = map.affine();
        }
    };
    std::uint32_t k = 0;
    (void)((k++ == index ? (read_map.template operator()<Ms>(), true) : false) || ...);
    return found;
}

}  // namespace detail

/// The map of an instruction, given its constants; nullopt unless it is an affine map of space.
inline std::optional<AffineMap> affine_map_of(Op op, const float* constants) {
    const auto code = static_cast<std::uint32_t>(op);
    if (code < program::first_map) return std::nullopt;
    return detail::affine_map_of(PointMaps(), code - program::first_map, constants);
}

}  // namespace phasetree::rewriting
