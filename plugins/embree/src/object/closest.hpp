#pragma once

#include "embree_core/cell_scene.hpp"
#include "object/motion.hpp"

namespace phasetree::embree {

struct Closest {
    bool found = false;
    float empty_radius = 0;  ///< nothing is nearer
    float distance = 0;
    glm::vec3 point{0};  ///< in the object's space
    Phase here, there;
};

/// The closest interface to a point of the object's space, where distances are measured behind a linear map (that of an
/// instance or a placement). Ends when the empty radius is within the share `tolerance` of the distance, or within four
/// resolutions, or after some thousand evaluations.
Closest find_closest(const CellScene&, const glm::vec3& point, const glm::dmat3& to_world, float radius,
                     float tolerance);

}  // namespace phasetree::embree
