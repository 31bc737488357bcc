#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <vector>

#include "phasetree/math/point_range.hpp"
#include "phasetree/model/concepts.hpp"

namespace phasetree {

/// What LocalPrimitive is, of a primitive with data: of all that it has, few floats matter in a small box. Its
/// specialise() is given its data. search_half_instructions is the cost of a search in them for eight points, in halves
/// of that of a simple instruction.
template <class N>
concept LocalDataPrimitive = DataPrimitive<N> &&
    requires(const float* data, const PointRange& range, std::span<const float> of, std::vector<float>& floats) {
    requires CheckedData<typename N::Specialised>;
    { N::specialise(data, range, of, floats) } -> std::same_as<bool>;
    { N::Specialised::floats(floats.data()) } -> std::same_as<std::size_t>;
    { N::Specialised::half_instructions(floats.data()) } -> std::same_as<unsigned>;
    { N::search_half_instructions } -> std::convertible_to<unsigned>;
};
/// One that can do with fewer floats where only values up to `farthest` are required: above it, the specialised
/// primitive's are any others above it. It never refuses if `of` is not empty.
template <class N>
concept RequiredDataPrimitive = LocalDataPrimitive<N> &&
    requires(const float* data, const PointRange& range, double farthest, std::span<const float> of,
             std::vector<float>& floats) {
    { N::specialise(data, range, farthest, of, floats) } -> std::same_as<bool>;
};
/// One whose data are many parts, which are balls or pieces of a mesh, about spacing() apart from each other.
template <class N>
concept PrimitiveOfParts = LocalDataPrimitive<N> && requires(const float* data) {
    { N::spacing(data) } -> std::same_as<float>;
};
template <class N>
concept AnyLocalPrimitive = LocalPrimitive<N> || LocalDataPrimitive<N>;

/// What PatternPrimitive is, of a primitive with data: its features are about as large as period(data).
template <class N>
concept PatternDataPrimitive = DataPrimitive<N> && requires(const float* data) {
    { N::period(data) } -> std::same_as<float>;
};

}  // namespace phasetree
