// What a light must provide. There are three sorts: infinite lights, which are the same from everywhere, area lights,
// which have a place and hide what is behind them, and lights without an extent, which no ray meets. kinds.hpp has the
// list of all kinds.
//
// Radiance is linear Rec.709 in W/(sr m²), and intensity in W/sr, up to one factor that is the same for a whole scene.
// Directions are of unit length and point from the place that is lit towards the light. Densities are per steradian,
// and those of an infinite or area light over all directions integrate to 1.
//
// `u` is in [0, 1)²; points that are stratified in the square should give stratified directions.
#pragma once

#include <concepts>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "lights/bounding_sphere.hpp"
#include "lights/cap.hpp"
#include "lights/direction_sample.hpp"
#include "lights/emission_bounds.hpp"
#include "lights/surface_point.hpp"

namespace phasetree::tracer {

/// * radiance(w): what arrives from the direction w.
/// * sample(u): a direction, best in proportion to the luminance of radiance(); nothing if the light is black.
/// * pdf(w): the density of sample(). It is greater than 0 wherever radiance() is not black.
/// * fluence(): the luminance of the radiance, integrated over all directions.
/// * centre_direction(): the middle of a light that is small in the sky, and nothing for one that is all around.
/// * bright_parts(): caps of the sphere of directions from which photons are sent; none if it throws no caustics.
template <class L>
concept InfiniteLightKind = std::copyable<L> && requires(const L& light, const glm::vec3& w, const glm::vec2& u) {
    { light.radiance(w) } -> std::same_as<glm::vec3>;
    { light.sample(u) } -> std::same_as<std::optional<DirectionSample>>;
    { light.pdf(w) } -> std::same_as<float>;
    { light.fluence() } -> std::same_as<float>;
    { light.centre_direction() } -> std::same_as<std::optional<glm::vec3>>;
    { light.bright_parts() } -> std::same_as<std::vector<Cap>>;
};

/// * radiance(): what is emitted, the same from every point to every direction.
/// * visible_to_camera(): whether camera rays meet the light; otherwise they pass through.
/// * approximate_solid_angle(p): the solid angle in steradians that the light fills as seen from p, roughly, which is
///   all that a choice among lights needs. It is 0 exactly where nothing of the light is seen.
/// * bounding_sphere(): a ball around it.
/// * emission_bounds(): how much it sends at most, and where to.
/// * sample(p, u): a direction from p towards the light; asked only where approximate_solid_angle(p) is not 0.
/// * pdf_at(p, w, d): the density of sample(), for a direction w in which the light is met at the distance d.
/// * intersect(p, w): the distance at which a ray from p first meets the light's emitting side, if it does.
/// * surface_point(u): a point of its surface, uniformly by area, with the normal on its emitting side.
/// * normal_at(q): that normal at a point of the surface.
/// * area(): of the surface that emits.
template <class L>
concept AreaLightKind = std::copyable<L> &&
    requires(const L& light, const glm::vec3& p, const glm::vec3& w, const glm::vec2& u, float d) {
    { light.radiance() } -> std::convertible_to<glm::vec3>;
    { light.visible_to_camera() } -> std::same_as<bool>;
    { light.approximate_solid_angle(p) } -> std::same_as<double>;
    { light.bounding_sphere() } -> std::convertible_to<BoundingSphere>;
    { light.emission_bounds() } -> std::same_as<EmissionBounds>;
    { light.sample(p, u) } -> std::same_as<DirectionSample>;
    { light.pdf_at(p, w, d) } -> std::same_as<float>;
    { light.intersect(p, w) } -> std::same_as<std::optional<float>>;
    { light.surface_point(u) } -> std::same_as<SurfacePoint>;
    { light.normal_at(p) } -> std::same_as<glm::vec3>;
    { light.area() } -> std::same_as<float>;
};

/// * position(): where it is.
/// * intensity(w): the radiant intensity in the direction w away from the light, in the unit of radiance times m²: a
///   surface that faces the light at the distance d gets the irradiance intensity/d².
/// * emission_bounds(): how much it sends at most, and where to.
///
/// Such a light is a delta function of direction. It is only found by a ray that goes straight to it, or by the photons
/// that it sends: paths that refract never meet it.
template <class L>
concept PointLightKind = std::copyable<L> && requires(const L& light, const glm::vec3& w) {
    { light.position() } -> std::convertible_to<glm::vec3>;
    { light.intensity(w) } -> std::same_as<glm::vec3>;
    { light.emission_bounds() } -> std::same_as<EmissionBounds>;
};

}  // namespace phasetree::tracer
