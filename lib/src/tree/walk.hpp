#pragma once

#include "tree/domain.hpp"
#include "tree/node.hpp"

namespace phasetree {

/// Evaluates a tree by walking it, for any number type. This defines the meaning of a tree. Nodes are evaluated in a
/// *domain* (EvaluationDomain), of which this is one.
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
    T one_lipschitz(const T& value, const Point&) const { return value; }
    template <PointMap M>
    Point map(const M& m, const Point& p, float /*lipschitz*/) const {
        return m(p);
    }
};
static_assert(EvaluationDomain<const Walk<float>>);

}  // namespace phasetree
