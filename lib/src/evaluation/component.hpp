#pragma once

#include <glm/vec3.hpp>

#include "kernel/kernel.hpp"

namespace phasetree::evaluation {

using kernel::Routine;

/// A component's value at a point, and its gradient.
struct Component {
    float value = 0;
    glm::vec3 gradient{0};
};
/// The component of a phase, computed with dual numbers; zero if the phase is absent. `slots` is the number of the
/// routine's slots.
Component component(const Routine&, std::uint32_t slots, const glm::vec3& p, Phase);

}  // namespace phasetree::evaluation
