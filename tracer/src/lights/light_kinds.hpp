// The kinds of lights in scene files: the list from which the reader, the reference and the schema are generated. Each
// kind has its own parameters and those of all lights (grouped.hpp). A kind has made(), which returns one light or
// several, or made(EnvironmentImages&) if it needs images.
#pragma once

#include <variant>

#include "lights/environment_images.hpp"
#include "lights/grouped.hpp"
#include "lights/lights.hpp"
#include "lights/portal.hpp"
#include "lights/sky.hpp"
#include "lights/sphere_lights.hpp"
#include "phasetree/model/concepts.hpp"

namespace phasetree::tracer {

template <class... Kinds>
using GroupedKinds = TypeList<Grouped<Kinds>..., PortalParameters>;

using LightKinds =
    GroupedKinds<ConstantEnvironmentParameters, GradientEnvironmentParameters, ImageEnvironmentParameters,
                 SkyParameters, SunParameters, RectangleLightParameters, SphereLightParameters, SphereLightsParameters,
                 PointLightParameters, SpotLightParameters, IesLightParameters>;

template <class Kind>
auto made_light(const Kind& kind, EnvironmentImages& images) {
    if constexpr (requires { kind.made(images); })
        return kind.made(images);
    else
        return kind.made();
}

template <class Light, class... Kinds>
constexpr bool is_made_by_one_of(TypeList<Kinds...>) {
    return (std::is_same_v<Light, decltype(made_light(std::declval<Kinds>(), std::declval<EnvironmentImages&>()))> ||
            ...);
}
template <class... Lights>
constexpr bool all_are_made(const std::variant<Lights...>*) {
    return (is_made_by_one_of<Lights>(LightKinds()) && ...);
}
static_assert(all_are_made(static_cast<InfiniteLight*>(nullptr)), "every infinite light has a kind in the list");
static_assert(all_are_made(static_cast<AreaLight*>(nullptr)), "every area light has a kind in the list");
static_assert(all_are_made(static_cast<AnyPointLight*>(nullptr)), "every point light has a kind in the list");

}  // namespace phasetree::tracer
