#pragma once

#include <concepts>

#include "phasetree/nodes/fields/sphere.hpp"
#include "phasetree/nodes/warps/translate.hpp"

namespace phasetree {

/// A domain is the context in which nodes are evaluated. It provides the values of their children, of primitives and of
/// maps of space. There are three domains: Walk (walk.hpp) computes with numbers of any type, the recorder
/// (program/record.cpp) writes instructions, and SourceWalk (value_source.cpp) records which primitive each value comes
/// from.
///
/// * Scalar and Point: a value, and a point in space.
/// * field(f, p), phases(a, p): the value of a field and the components of an object at a point.
/// * primitive(s, p): the value of a solid or pattern that is a single instruction; of any Primitive or DataPrimitive.
/// * map(m, p, lipschitz): the image of a point under a PointMap, and an upper bound on the factor by which it
///   lengthens distances.
/// * one_lipschitz(v, p): the value v. The node guarantees that it is 1-Lipschitz in p, where the domain would derive a
///   larger bound.
///
/// A sphere and a translation represent all primitives and maps here.
template <class D>
concept EvaluationDomain = requires(D& domain, const Field& field, const Phased& object, const typename D::Point& p,
                                    const typename D::Scalar& value, const Sphere& primitive,
                                    const Translate::Map& map) {
    { domain.field(field, p) } -> std::same_as<typename D::Scalar>;
    { domain.phases(object, p) } -> std::same_as<Phases<typename D::Scalar>>;
    { domain.primitive(primitive, p) } -> std::same_as<typename D::Scalar>;
    { domain.map(map, p, 1.f) } -> std::same_as<typename D::Point>;
    { domain.one_lipschitz(value, p) } -> std::same_as<typename D::Scalar>;
};

}  // namespace phasetree
