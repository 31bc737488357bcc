// Shared code of operators on any number of fields.
#pragma once

#include <vector>

#include "phasetree/model/concepts.hpp"

namespace phasetree {

namespace detail {
/// The values of the children at p, combined from the first to the last.
template <class D, class Combine>
typename D::Scalar fold(D& d, const std::vector<Field>& children, const typename D::Point& p, Combine&& combine) {
    typename D::Scalar result = d.field(children.front(), p);
    for (std::size_t i = 1; i < children.size(); ++i) result = combine(result, d.field(children[i], p));
    return result;
}
inline Bounds united(BoundsQuery& q, const std::vector<Field>& children, float level) {
    Bounds b;
    for (const Field& c : children) b = unite(b, q(c, level));
    return b;
}
inline Bounds intersected(BoundsQuery& q, const std::vector<Field>& children, float level) {
    return q.cut([&] {
        Bounds b = Bounds::everything();
        for (const Field& c : children) b = intersect(b, q(c, level));
        return b;
    });
}
inline constexpr Parameter children{"of", "", "The fields, at least one."};
inline constexpr Parameter blend{
    "radius", "m", "Blending radius: surfaces blend where they are closer to each other than this.", limits::positive};
}  // namespace detail

}  // namespace phasetree
