#pragma once

#include "phasetree/model/handle.hpp"

namespace phasetree {

/// The view for which levels of detail are chosen.
struct DetailView {
    glm::vec3 position{0};  ///< of the camera, in the object's space
    /// The largest acceptable error, as a fraction of its distance from the camera. To accept n pixels, use n times the
    /// size of a pixel at distance 1. Must be positive.
    float angle = 1e-3f;
};

/// Set the switching distances of level_of_detail nodes for a view.
///
/// Affects each level_of_detail node that has errors but no distances. Level i + 1 is used from the distance errors[i]
/// / angle on, where its error looks no larger than the view allows. The view is transformed through nodes that
/// translate, rotate and scale. A node that its ancestors copy or distort, or that is below a warp of only some phases,
/// appears in several places or distorted. Such a node keeps its finest level. Subtrees without level_of_detail nodes
/// to set are shared with the original.
///
/// The result is an ordinary object, the same for all rays. It is as accurate as the nodes' errors claim. Throws
/// ModelError if the angle is not positive and finite.
Phased with_levels_of_detail(const Phased&, const DetailView&);

}  // namespace phasetree
