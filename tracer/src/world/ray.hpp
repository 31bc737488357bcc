// A ray, which carries the phase in which it travels. At an interface, both sides are therefore known without
// classifying points, which rounding may have put on the wrong side.
#pragma once

#include <glm/vec3.hpp>

#include "embree_core/query.hpp"
#include "world/ray_objects.hpp"

namespace phasetree::tracer {

/// The cell in which a ray that leaves a surface starts, and what that cell knows of the point. It saves time without
/// changing results; the default is that nothing is known.
using StartHint = embree::StartHint;

struct Ray {
    glm::vec3 origin{0};
    glm::vec3 direction{0};  ///< unit length
    Phase phase{};           ///< in which the ray starts
    StartHint hint{};
    RayObjects in{};                     ///< in a scene with several objects, with `phase` that of the first
    std::optional<StartInCopy> start{};  ///< for a ray that leaves an interface of one of several objects
};

}  // namespace phasetree::tracer
