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

/// A kind of infinite light, once its contract has been asked of it. If it does not meet that, the message names the
/// kind and the member.
template <class Kind>
struct CheckedInfiniteLight {
    static_assert(InfiniteLightKind<Kind>);
    using Type = Kind;
};

/// The same of an area light.
template <class Kind>
struct CheckedAreaLight {
    static_assert(AreaLightKind<Kind>);
    using Type = Kind;
};

/// The same of a light without an extent.
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

/// Every kind of light without an extent.
using AnyPointLight = PointLightOf<PointLight, SpotLight, IesLight>;

}  // namespace phasetree::tracer
