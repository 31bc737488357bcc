// Requirements on lights. There are three sorts. Infinite lights look the same from everywhere. Area lights have a
// position and hide what is behind them. Point lights have no extent, so no ray meets them. kinds.hpp lists all kinds.
//
// Radiance is linear Rec.709 in W/(sr m²), and intensity is in W/sr, up to one factor for the whole scene. Directions
// have unit length and point from the lit point towards the light. Pdfs are per steradian; those of an infinite or area
// light integrate to 1 over all directions.
//
// `u` is in [0, 1)²; points that are stratified in the square should result in stratified directions.
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

/// * radiance(w): the radiance that arrives from the direction w.
/// * sample(u): a direction, ideally in proportion to the luminance of radiance(); nullopt if the light is black.
/// * pdf(w): the pdf of sample(). It must be positive wherever radiance() is not black.
/// * fluence(): the luminance of the radiance, integrated over all directions.
/// * centre_direction(): the centre of a light that covers a small part of the sky, otherwise nullopt.
/// * bright_parts(): caps of the sphere of directions that emit photons; empty if the light causes no caustics.
template <class L>
concept InfiniteLightKind = std::copyable<L> && requires(const L& light, const glm::vec3& w, const glm::vec2& u) {
    { light.radiance(w) } -> std::same_as<glm::vec3>;
    { light.sample(u) } -> std::same_as<std::optional<DirectionSample>>;
    { light.pdf(w) } -> std::same_as<float>;
    { light.fluence() } -> std::same_as<float>;
    { light.centre_direction() } -> std::same_as<std::optional<glm::vec3>>;
    { light.bright_parts() } -> std::same_as<std::vector<Cap>>;
};

/// * radiance(): the emitted radiance, the same from every point in every direction.
/// * visible_to_camera(): whether camera rays meet the light; otherwise they pass through.
/// * approximate_solid_angle(p): approximately the solid angle in steradians that the light subtends at p, precise
///   enough for a choice among lights. It is 0 exactly where nothing of the light is seen.
/// * bounding_sphere(): a ball that contains it.
/// * emission_bounds(): an upper bound on its emission, and its directions.
/// * sample(p, u): a direction from p towards the light; called only where approximate_solid_angle(p) is not 0.
/// * pdf_at(p, w, d): the pdf of sample(), for a direction w in which the light is met at the distance d.
/// * intersect(p, w): the distance at which a ray from p first meets the light's emitting side, if any.
/// * surface_point(u): a point of its surface, uniform in area, with the normal on its emitting side.
/// * normal_at(q): that normal at a point of the surface.
/// * area(): the area of the emitting surface.
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

/// * position(): its position.
/// * intensity(w): the radiant intensity in the direction w away from the light, in the unit of radiance times m²: a
///   surface that faces the light at the distance d receives the irradiance intensity/d².
/// * emission_bounds(): an upper bound on its emission, and its directions.
///
/// Such a light is a delta function of direction. Only a ray that goes straight to it, or the photons that it emits,
/// can find it: refracted paths never meet it.
template <class L>
concept PointLightKind = std::copyable<L> && requires(const L& light, const glm::vec3& w) {
    { light.position() } -> std::convertible_to<glm::vec3>;
    { light.intensity(w) } -> std::same_as<glm::vec3>;
    { light.emission_bounds() } -> std::same_as<EmissionBounds>;
};

}  // namespace phasetree::tracer
