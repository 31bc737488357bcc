#pragma once

#include "phasetree/trace/tracer.hpp"

namespace phasetree {

/// Where the samples of the next batch go: strictly between two places of which the first is known to be in the ray's
/// phase. See march.cpp.
struct Waypoint {
    float t = 0;
    float distance = 0;  ///< s(p): the label is the same within this radius
    float label = 0;
};

/// Sixteen distances in rising order between low and high. `on_interface`: low is on an interface, so the samples
/// spread geometrically from there. `root`: a place where the label probably changes; samples gather around it.
BatchOfFloats spread_evenly(float low, float high);
BatchOfFloats spread_from(float low, float high, float smallest);
BatchOfFloats gather_around(float root, float low, float high, float smallest);

/// First change of label along origin + t·direction, 0 ≤ t ≤ length. The t of the result count from origin.
std::optional<Crossing> march(const Evaluator&, const glm::vec3& origin, const glm::vec3& direction, float length,
                              float resolution, std::optional<Phase> carried, Evaluator::Workspace&, TraceCounters&);

}  // namespace phasetree
