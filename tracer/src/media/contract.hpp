// What a medium must provide: the interior of a clear phase, through which rays travel.
#pragma once

#include <concepts>
#include <glm/vec3.hpp>

namespace phasetree::tracer {

/// * transmittance(d): the part of the radiance, in each colour channel, that is left after a straight way of length d
///   in the scene's unit. It is 1 for d = 0, in [0, 1] for every d, and defined for an infinite d.
template <class M>
concept MediumKind = std::copyable<M> && requires(const M& medium, float distance) {
    { medium.transmittance(distance) } -> std::same_as<glm::vec3>;
};

}  // namespace phasetree::tracer
