// Rays straight through all clear phases, for the tests of several objects.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
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

/// Checks that a ray meets the same phases by two ways of tracing, at the same distances. Returns the number of
/// crossings. Anything thinner than 2.75 resolutions may be missed. Brackets are up to one resolution long, so
/// something about that thin may be in one list and not in the other.
inline std::size_t check_same_steps(const std::vector<Step>& all_a, const std::vector<Step>& all_b, double resolution) {
    std::vector<Step> a = without_slivers(all_a, 4 * resolution), b = without_slivers(all_b, 4 * resolution);
    if (a.size() != b.size()) {
        a = without_slivers(all_a, 5 * resolution);
        b = without_slivers(all_b, 5 * resolution);
    }
    REQUIRE(a.size() == b.size());
    for (std::size_t k = 0; k < a.size(); ++k) {
        CHECK(a[k].from == b[k].from);
        CHECK(a[k].to == b[k].to);
        const double cosine = std::max(0.02, static_cast<double>(std::min(a[k].cosine, b[k].cosine)));
        CHECK(std::abs(a[k].t - b[k].t) < 2 * resolution / cosine);
    }
    return a.size();
}

}  // namespace phasetree::tracer::tests
