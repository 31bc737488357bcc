#pragma once

#include <array>
#include <cstddef>

#include "phasetree/math/vec3.hpp"

namespace phasetree {

/// An equation whose constants a search finds: equation(search(p), p), where `search` is given plain numbers. It is for
/// data of which so little matters at any one point that no loop should go over all of them. Other number types have
/// functions of their own; one that cannot search calls otherwise(p), which is the same by a loop over all.
template <class Search, class Equation, class Otherwise>
float found_equation(const Vec3<float>& p, const Search& search, const Equation& equation, const Otherwise&) {
    return equation(search(p), p);
}

/// The same where the equation is one for all points, and the search finds its numbers alone: search(p, to, stride)
/// writes them to to[0], to[stride] …, and equation(numbers, p) is given an array of them. So batches need not evaluate
/// it lane by lane.
template <std::size_t count, class Search, class Equation, class Otherwise>
float gathered_equation(const Vec3<float>& p, const Search& search, const Equation& equation, const Otherwise&) {
    std::array<float, count> numbers;
    search(p, numbers.data(), std::size_t{1});
    return equation(numbers, p);
}

/// Where a loop is no hardship, but its derivatives are: it is otherwise(p) for all number types but those that carry
/// derivatives, which are given equation(search(p), p).
template <class T, class Search, class Equation, class Otherwise>
T equation_for_derivatives(const Vec3<T>& p, const Search&, const Equation&, const Otherwise& otherwise) {
    return otherwise(p);
}

}  // namespace phasetree
