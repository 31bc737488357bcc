#pragma once

#include <array>
#include <cstddef>

#include "phasetree/math/vec3.hpp"

namespace phasetree {

/// Evaluate an equation whose constants are found by a search: equation(search(p), p). `search` receives plain numbers.
/// Use it for large data of which only a small part matters at any one point, where a loop over all of it would be too
/// slow. Other number types overload this function. A number type that cannot search calls otherwise(p), which gives
/// the same result by a loop over everything.
template <class Search, class Equation, class Otherwise>
float found_equation(const Vec3<float>& p, const Search& search, const Equation& equation, const Otherwise&) {
    return equation(search(p), p);
}

/// The same for an equation that has the same form at all points: the search supplies only its `count` constants, never
/// a choice of equation. search(p, to, stride) writes them to to[0], to[stride], …, and equation(numbers, p) receives
/// an array of them. This lets batches evaluate the equation for all lanes at once.
template <std::size_t count, class Search, class Equation, class Otherwise>
float gathered_equation(const Vec3<float>& p, const Search& search, const Equation& equation, const Otherwise&) {
    std::array<float, count> numbers;
    search(p, numbers.data(), std::size_t{1});
    return equation(numbers, p);
}

/// Evaluate otherwise(p), except for number types that carry derivatives: those evaluate equation(search(p), p). Use it
/// where a loop is fast enough for values, but not for derivatives.
template <class T, class Search, class Equation, class Otherwise>
T equation_for_derivatives(const Vec3<T>& p, const Search&, const Equation&, const Otherwise& otherwise) {
    return otherwise(p);
}

}  // namespace phasetree
