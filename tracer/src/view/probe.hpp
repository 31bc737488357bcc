// What a click on a point of the picture tells: the ray through it, as `phasetree trace` would follow it, and the phase
// and the distances where it first meets something, as `phasetree eval` would give them.
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

/// A node of those that made a surface. What the view itself puts around the scene, such as the cut, has no line.
struct ProbedNode {
    std::string name;
    std::string file;
    std::size_t line = 0, column = 0;  ///< from 1
    std::string pointer;               ///< as in TextNumbers; empty if the node has no numbers there
};

struct Probed {
    glm::vec3 origin{0.0f}, direction{0.0f};  ///< of the ray through the middle of the lens
    std::string start;                        ///< the phase in which the ray starts
    std::vector<ProbedCrossing> crossings;    ///< of the object, opaque phases passed through; `most` at most
    bool has_more = false;                    ///< than these
    std::string met;                          ///< the phase or the mesh that is met first; empty if nothing is
    glm::vec3 point{0.0f};                    ///< where, if anything
    std::vector<ProbedDistance> distances;    ///< there, of the phases that the object has
    /// From the tree's root to the primitive that gives the distance of the phase that is met.
    std::vector<ProbedNode> path;

    static constexpr std::size_t most = 200;
};

/// `place` is in pixels of the whole picture from its top left corner. Throws ModelError for an object that rays cannot
/// be traced through.
Probed probe(const Picture& picture, const glm::vec2& place);

}  // namespace phasetree::tracer::view
