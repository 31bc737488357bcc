// The list of all lights.
#pragma once

#include <variant>

#include "lights/constant_environment.hpp"
#include "lights/contract.hpp"
#include "lights/gradient_environment.hpp"
#include "lights/ies_light.hpp"
#include "lights/image_environment.hpp"
#include "lights/point_light.hpp"
#include "lights/rectangle_light.hpp"
#include "lights/sphere_light.hpp"
#include "lights/spot_light.hpp"
#include "lights/sun.hpp"

namespace phasetree::tracer {

/// Checks a kind of infinite light against its concept. If the check fails, the compiler's message names the kind and
/// the member.
template <class Kind>
struct CheckedInfiniteLight {
    static_assert(InfiniteLightKind<Kind>);
    using Type = Kind;
};

/// As above, for an area light.
template <class Kind>
struct CheckedAreaLight {
    static_assert(AreaLightKind<Kind>);
    using Type = Kind;
};

/// As above, for a point light.
template <class Kind>
struct CheckedPointLight {
    static_assert(PointLightKind<Kind>);
    using Type = Kind;
};

template <class... Kinds>
using PointLightOf = std::variant<typename CheckedPointLight<Kinds>::Type...>;

template <class... Kinds>
using InfiniteLightOf = std::variant<typename CheckedInfiniteLight<Kinds>::Type...>;

template <class... Kinds>
using AreaLightOf = std::variant<typename CheckedAreaLight<Kinds>::Type...>;

/// Every kind of infinite light.
using InfiniteLight = InfiniteLightOf<ConstantEnvironment, GradientEnvironment, ImageEnvironment, Sun>;

/// Every kind of area light.
using AreaLight = AreaLightOf<RectangleLight, SphereLight>;

/// Every kind of point light.
using AnyPointLight = PointLightOf<PointLight, SpotLight, IesLight>;

}  // namespace phasetree::tracer
