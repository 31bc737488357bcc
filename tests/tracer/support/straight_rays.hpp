// Rays straight through all clear phases, for the tests of several objects.
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <variant>
#include <vector>

#include "world/traced_geometry.hpp"

namespace phasetree::tracer::tests {

using Random = std::mt19937;

inline float uniform(Random& random, float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
}

inline glm::vec3 direction(Random& random) {
    while (true) {
        const glm::vec3 v(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
        const float length = glm::length(v);
        if (length > 0.1f && length < 1) return v / length;
    }
}

struct Step {
    double t;
    float cosine;
    Phase from, to;
};

/// The interfaces along the straight line through all clear phases, at a share of the time in which the shutter is
/// open.
inline std::vector<Step> straight_through(const TracedGeometry& geometry, const glm::vec3& origin, const glm::vec3& d,
                                          float time = 0) {
    std::vector<Step> steps;
    const TracedGeometry::Inside start = geometry.inside(origin, time);
    Ray ray{origin, d, start.phase, {}, start.in};
    PathCounters counters;
    while (steps.size() < 10'000) {
        const Hit hit = geometry.intersect(ray, counters);
        const auto* surface = std::get_if<Surface>(&hit);
        if (!surface) return steps;
        CHECK(surface->near_side.phase == ray.phase);
        const double t = glm::dot(glm::dvec3(surface->near_side.origin) - glm::dvec3(origin), glm::dvec3(d));
        steps.push_back({t, std::abs(glm::dot(surface->normal, d)), ray.phase, surface->entered.value()});
        ray = surface->transmitted(d);
    }
    FAIL("a ray meets no end of interfaces");
    return steps;
}

/// Without the phases that are too thin along the ray to be found with certainty.
inline std::vector<Step> without_slivers(const std::vector<Step>& steps, double thickness) {
    std::vector<Step> kept;
    for (const Step& step : steps) {
        if (!kept.empty() && kept.back().from == step.to && step.t - kept.back().t < thickness)
            kept.pop_back();
        else
            kept.push_back(step);
    }
    return kept;
}

}  // namespace phasetree::tracer::tests
