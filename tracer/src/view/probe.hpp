// What a click on the picture reports: the ray through the point, as `phasetree trace` follows it, and the phase and
// distances at its first hit, as `phasetree eval` computes them.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "view/shown.hpp"

namespace phasetree::tracer::view {

struct ProbedCrossing {
    float distance = 0;  ///< along the ray
    std::string from, to;
};

struct ProbedDistance {
    std::string phase;
    float phi = 0;
};

/// A node that contributed to a surface. Nodes that the view adds to the scene, such as the cut, have no line.
struct ProbedNode {
    std::string name;
    std::string file;
    std::size_t line = 0, column = 0;  ///< from 1
    std::string pointer;               ///< as in TextNumbers; empty if the node has no numbers there
};

struct Probed {
    glm::vec3 origin{0.0f}, direction{0.0f};  ///< of the ray through the middle of the lens
    std::string start;                        ///< the phase in which the ray starts
    std::vector<ProbedCrossing> crossings;    ///< of the object, through opaque phases too; at most `most`
    bool has_more = false;                    ///< whether there are more
    std::string met;                          ///< the phase or mesh that is hit first; empty if none
    glm::vec3 point{0.0f};                    ///< the position of the hit, if any
    std::vector<ProbedDistance> distances;    ///< at the hit, of the phases that the object has
    /// From the tree's root to the primitive that determines the distance of the phase that is hit.
    std::vector<ProbedNode> path;

    static constexpr std::size_t most = 200;
};

/// `place` is in pixels of the whole picture from its top left corner. Throws ModelError for an object that cannot be
/// traced.
Probed probe(const Picture& picture, const glm::vec2& place);

}  // namespace phasetree::tracer::view
