// The state of a path between two of its vertices.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "integrator/path_chain.hpp"
#include "integrator/path_wavelengths.hpp"
#include "world/ray.hpp"

namespace phasetree::tracer {

struct PathState {
    Ray ray;  ///< the current segment
    /// The weight of radiance that is found from here on.
    glm::vec3 throughput{1.0f};
    PathWavelengths wavelengths{};
    /// The last vertex where lights were sampled, and the interfaces since.
    PathChain chain{};
    /// The outward normal of the last clear boundary that the path met in this medium.
    std::optional<glm::vec3> last_boundary_normal{};
};

}  // namespace phasetree::tracer
