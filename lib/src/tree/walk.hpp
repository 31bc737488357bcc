#pragma once

#include "tree/node.hpp"

namespace phasetree {

/// Evaluates a tree by walking it, over any number type. This is the definition of what a tree means. Nodes are
/// evaluated in a *domain*, which gives them the values of their children, of primitives and of maps of space; this is
/// one; the others are the recorder (program/record.cpp) and SourceWalk (value_source.cpp). A domain has the members
/// that this one has.
template <class T>
struct Walk {
    using Scalar = T;
    using Point = Vec3<T>;

    T field(const Field& f, const Point& p) const {
        return std::visit(
            [&](const auto& n) {
                using N = std::remove_cvref_t<decltype(n)>;
                if constexpr (Primitive<N> || DataPrimitive<N>)
                    return primitive(n, p);
                else
                    return n.evaluate(*this, p);
            },
            f.node()->node);
    }
    Phases<T> phases(const Phased& a, const Point& p) const {
        return std::visit([&](const auto& n) { return n.evaluate(*this, p); }, a.node()->node);
    }
    template <Primitive P>
    T primitive(const P& primitive, const Point& p) const {
        return primitive.distance(p);
    }
    template <DataPrimitive P>
    T primitive(const P& primitive, const Point& p) const {
        return P::distance(primitive.data().data(), p);
    }
    /// The node vouches that the value is 1-Lipschitz in p, where the recorder would derive a larger bound.
    T one_lipschitz(const T& value, const Point&) const { return value; }
    template <PointMap M>
    Point map(const M& m, const Point& p, float /*lipschitz*/) const {
        return m(p);
    }
};

}  // namespace phasetree
