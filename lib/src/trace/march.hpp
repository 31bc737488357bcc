#pragma once

#include "kernel/kernel.hpp"
#include "phasetree/trace/crossing.hpp"

namespace phasetree {

/// Where the samples of the next batch go: strictly between two places of which the first is known to be in the ray's
/// phase. See march.cpp.
struct Waypoint {
    float t;
    float distance;  ///< s(p): the label is the same within this radius
    float label;
};

/// Sixteen distances in rising order between low and high. `on_interface`: low is on an interface, so the samples
/// spread geometrically from there. `root`: a place where the label probably changes; samples gather around it.
BatchOfFloats spread_evenly(float low, float high);
BatchOfFloats spread_from(float low, float high, float smallest);
/// From low on, as far as the steps reach that the distance s, growing by `slope` for each unit, is expected to cover.
BatchOfFloats spread_growing(float low, float high, float s, float slope);
BatchOfFloats gather_around(float root, float low, float high, float smallest);

/// First change of label along origin + t·direction, 0 ≤ t ≤ length. The t of the result count from origin.
/// `registers` has room for the routine's slots. `on_interface` tells that the ray most likely starts on one: a hint
/// where to look first.
std::optional<Crossing> march(const Routine&, float* registers, const glm::vec3& origin, const glm::vec3& direction,
                              float length, float resolution, std::optional<Phase> carried, bool on_interface,
                              TraceCounters&);

struct Interval {
    double low, high;
};

/// Where a ray is within a box, clipped to [t_min, t_max]; empty if low > high. In double, so that an origin far from
/// the object costs no accuracy.
Interval clip(const Bounds& box, const glm::vec3& origin, const glm::vec3& direction, double t_min, double t_max);

/// march() within a box, from the ray's entry on, so that t is small and exact there. A ray that starts inside keeps
/// its very origin.
std::optional<Crossing> march_within(const Bounds& box, const Routine&, float* registers, const glm::vec3& origin,
                                     const glm::vec3& direction, float t_min, float t_max, float resolution,
                                     std::optional<Phase> carried, TraceCounters&);

}  // namespace phasetree
