// The list of all lights.
#pragma once

#include <variant>

#include "lights/constant_environment.hpp"
#include "lights/contract.hpp"
#include "lights/gradient_environment.hpp"
#include "lights/image_environment.hpp"
#include "lights/rectangle_light.hpp"
#include "lights/sphere_light.hpp"
#include "lights/sun.hpp"

namespace phasetree::tracer {

template <InfiniteLightKind... Kinds>
using InfiniteLightOf = std::variant<Kinds...>;

template <AreaLightKind... Kinds>
using AreaLightOf = std::variant<Kinds...>;

/// Every kind of infinite light.
using InfiniteLight = InfiniteLightOf<ConstantEnvironment, GradientEnvironment, ImageEnvironment, Sun>;

/// Every kind of area light.
using AreaLight = AreaLightOf<RectangleLight, SphereLight>;

}  // namespace phasetree::tracer
