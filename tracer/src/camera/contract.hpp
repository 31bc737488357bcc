// Requirements on a camera, which generates the ray that reaches a point of the film. camera.hpp lists all kinds.
#pragma once

#include <concepts>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

namespace phasetree::tracer {

struct CameraRay {
    glm::vec3 origin;
    glm::vec3 direction;  ///< unit length
};

/// * Parameters: the description in a scene, as plain values; includes `position` and `look_at`.
/// * C(parameters, resolution): for a whole picture of this many pixels, which are square. Throws
///   std::invalid_argument, with a message for users, if the parameters are invalid.
/// * generate(film, lens): the ray that reaches a point of the film, in pixels from the top left corner of the whole
///   picture; points outside of the picture continue it. `lens` in [0, 1)² chooses the point of a lens. All rays have
///   the same weight: the value of the film is the mean radiance of the rays.
/// * single_origin(): the point from which all rays start, if there is one.
template <class C>
concept CameraKind = std::copyable<C> && std::copyable<typename C::Parameters> &&
    std::constructible_from<C, const typename C::Parameters&, const glm::ivec2&> &&
    requires(const C& camera, const typename C::Parameters& parameters, const glm::dvec2& film, const glm::vec2& lens) {
    { parameters.position } -> std::convertible_to<glm::vec3>;
    { parameters.look_at } -> std::convertible_to<glm::vec3>;
    { camera.generate(film, lens) } -> std::same_as<CameraRay>;
    { camera.single_origin() } -> std::same_as<std::optional<glm::vec3>>;
};

}  // namespace phasetree::tracer
