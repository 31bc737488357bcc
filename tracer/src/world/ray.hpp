// A ray on its way through a scene. It carries the phase that it travels in, so that where it meets an interface both
// sides are known, without a question about points that rounding may have put on the wrong side.
#pragma once

#include <glm/vec3.hpp>

#include "embree_core/query.hpp"
#include "world/ray_objects.hpp"

namespace phasetree::tracer {

/// The cell in which a ray that leaves a surface starts, and what that cell knows of the place. It saves time and
/// changes no result; the default is that nothing is known.
using StartHint = embree::StartHint;

struct Ray {
    glm::vec3 origin{0};
    glm::vec3 direction{0};  ///< of unit length
    Phase phase{};           ///< in which the ray starts
    StartHint hint{};
    RayObjects in{};                     ///< of a scene of several objects, with `phase` that of the first
    std::optional<StartInCopy> start{};  ///< of a ray that leaves an interface of one of several objects
};

}  // namespace phasetree::tracer
