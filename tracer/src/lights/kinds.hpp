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

template <PointLightKind... Kinds>
using PointLightOf = std::variant<Kinds...>;

template <InfiniteLightKind... Kinds>
using InfiniteLightOf = std::variant<Kinds...>;

template <AreaLightKind... Kinds>
using AreaLightOf = std::variant<Kinds...>;

/// Every kind of infinite light.
using InfiniteLight = InfiniteLightOf<ConstantEnvironment, GradientEnvironment, ImageEnvironment, Sun>;

/// Every kind of area light.
using AreaLight = AreaLightOf<RectangleLight, SphereLight>;

/// Every kind of point light.
using AnyPointLight = PointLightOf<PointLight, SpotLight, IesLight>;

}  // namespace phasetree::tracer
