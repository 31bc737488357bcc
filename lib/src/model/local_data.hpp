#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

#include "phasetree/math/point_range.hpp"
#include "phasetree/model/concepts.hpp"

namespace phasetree {

/// The equivalent of LocalPrimitive for a primitive with data: in a small box, only few of its floats matter.
/// specialise() receives its data. search_half_instructions is the cost of searching them for eight points; a simple
/// instruction costs 2.
template <class N>
concept LocalDataPrimitive = DataPrimitive<N> &&
    requires(const float* data, const PointRange& range, std::span<const float> of, std::vector<float>& floats) {
    requires CheckedData<typename N::Specialised>;
    { N::specialise(data, range, of, floats) } -> std::same_as<bool>;
    { N::Specialised::floats(floats.data()) } -> std::same_as<std::size_t>;
    { N::Specialised::half_instructions(floats.data()) } -> std::same_as<unsigned>;
    { N::search_half_instructions } -> std::convertible_to<unsigned>;
};
/// A primitive that needs fewer floats if only values up to `farthest` are required. Where its values are larger, those
/// of the specialised primitive are arbitrary but also larger. Specialisation always succeeds if `of` is not empty.
template <class N>
concept RequiredDataPrimitive = LocalDataPrimitive<N> &&
    requires(const float* data, const PointRange& range, double farthest, std::span<const float> of,
             std::vector<float>& floats) {
    { N::specialise(data, range, farthest, of, floats) } -> std::same_as<bool>;
};
/// A primitive whose data are many parts, which are balls or pieces of a mesh, about spacing() apart.
template <class N>
concept PrimitiveOfParts = LocalDataPrimitive<N> && requires(const float* data) {
    { N::spacing(data) } -> std::same_as<float>;
};
template <class N>
concept AnyLocalPrimitive = LocalPrimitive<N> || LocalDataPrimitive<N>;

/// The equivalent of PatternPrimitive for a primitive with data: its features are about as large as period(data).
template <class N>
concept PatternDataPrimitive = DataPrimitive<N> && requires(const float* data) {
    { N::period(data) } -> std::same_as<float>;
};

}  // namespace phasetree
