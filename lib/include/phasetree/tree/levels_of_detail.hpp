#pragma once

#include "phasetree/model/handle.hpp"

namespace phasetree {

/// From where levels of detail are chosen.
struct DetailView {
    glm::vec3 position{0};  ///< the camera's, in the object's space
    /// How large an error may look, as a share of its distance: the number of pixels times the size of a pixel at
    /// distance 1.
    float angle = 1e-3f;
};

/// The object in which each level_of_detail node that says its levels' errors and no distances has those from which on
/// the errors look no larger than the view allows: level i + 1 stands from errors[i] / angle on. The view is followed
/// into nodes that are moved, turned and scaled. Below copies, below warps that bend and below those of some phases
/// alone one node stands in several places or is distorted, and its finest level stays. All of an object without such
/// nodes is kept as it is.
///
/// What results is an object like any other, the same for all rays. What is promised of it is no more than what the
/// nodes' errors promise.
Phased with_levels_of_detail(const Phased&, const DetailView&);

}  // namespace phasetree
