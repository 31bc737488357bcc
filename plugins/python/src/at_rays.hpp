// Crossings along many rays, in plain C++: the implementation of the Python functions, and the baseline for their cost.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "arrays.hpp"
#include "embree_core/closest.hpp"
#include "embree_core/walk.hpp"

namespace phasetree::python {

struct RaysIn {
    const float* origins;
    const float* directions;

    std::optional<embree::UnitRay> operator[](std::size_t i) const {
        return embree::UnitRay::of(point(origins, i), point(directions, i), 0, std::numeric_limits<float>::infinity());
    }
};

struct FoundCrossing {
    float t = 0;  ///< in units of the ray's direction
    Phase before, after;
    glm::vec3 normal{0};
};

inline FoundCrossing found(const InterfaceCells& cells, const embree::CellScene::Hit& hit, const embree::UnitRay& ray) {
    return {hit.crossing.t_from / ray.length, hit.crossing.from, hit.crossing.to,
            cells.normal(hit.cell, hit.crossing, ray.direction).unit};
}

/// All crossings of several rays, one ray after the other.
struct CrossingList {
    std::vector<FoundCrossing> crossings;
    std::vector<std::size_t> ends;  ///< per ray, the number of crossings up to and including its last
};

/// Finds every crossing along the rays, and the phases in which they start. A ray that is not finite or has a zero
/// direction starts in the vacuum and has no crossings.
inline void trace_rays(const embree::CellScene& scene, const RaysIn& rays, std::size_t begin, std::size_t end,
                       std::uint8_t* start, CrossingList& list) {
    Evaluator::Workspace& workspace = Evaluator::thread_workspace();
    for (std::size_t i = begin; i < end; ++i) {
        start[i] = 0;
        if (const auto ray = rays[i]) {
            const Phase phase = scene.cells().label(ray->origin, workspace);
            start[i] = phase.index;
            embree::Walk walk(scene, *ray, phase);
            while (const auto hit = walk.next()) list.crossings.push_back(found(scene.cells(), *hit, *ray));
        }
        list.ends.push_back(list.crossings.size());
    }
}

struct JoinedCrossings {
    std::int64_t* offsets;
    float* t;
    std::uint8_t* before;
    std::uint8_t* after;
    float* normal;
};

/// Concatenates the lists of all blocks, each of `block` rays except the last.
inline void join(const std::vector<CrossingList>& blocks, std::size_t block, std::size_t rays,
                 const JoinedCrossings& to) {
    std::size_t at = 0;
    to.offsets[0] = 0;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const std::size_t first = b * block, count = std::min(block, rays - first);
        for (std::size_t i = 0; i < count; ++i)
            to.offsets[first + i + 1] = static_cast<std::int64_t>(at + blocks[b].ends[i]);
        for (const FoundCrossing& c : blocks[b].crossings) {
            to.t[at] = c.t;
            to.before[at] = c.before.index;
            to.after[at] = c.after.index;
            put(to.normal, at, c.normal);
            ++at;
        }
    }
}

struct FirstCrossings {
    float* t;
    std::uint8_t* before;
    std::uint8_t* after;
    float* normal;
};

/// Finds the first crossing along each ray. If there is none, t is infinite, both phases are that at the start, and the
/// normal is zero.
inline void intersect_rays(const embree::CellScene& scene, const RaysIn& rays, std::size_t begin, std::size_t end,
                           const FirstCrossings& to) {
    Evaluator::Workspace& workspace = Evaluator::thread_workspace();
    for (std::size_t i = begin; i < end; ++i) {
        FoundCrossing first{std::numeric_limits<float>::infinity(), {}, {}, glm::vec3(0)};
        if (const auto ray = rays[i]) {
            const Phase phase = scene.cells().label(ray->origin, workspace);
            first.before = first.after = phase;
            if (const auto hit = scene.first_crossing(*ray, phase)) first = found(scene.cells(), *hit, *ray);
        }
        to.t[i] = first.t;
        to.before[i] = first.before.index;
        to.after[i] = first.after.index;
        put(to.normal, i, first.normal);
    }
}

struct ClosestInterfaces {
    float* distance;
    float* point;
    std::uint8_t* here;
    std::uint8_t* there;
};

/// Finds the closest interface to each point. If there is none within the radius, or the point is not finite, the
/// distance is infinite, the position is NaN and both phases are the vacuum.
inline void find_closest_to(const embree::CellScene& scene, const float* points, std::size_t begin, std::size_t end,
                            float radius, float tolerance, const ClosestInterfaces& to) {
    for (std::size_t i = begin; i < end; ++i) {
        embree::Closest c;
        if (const glm::vec3 p = point(points, i); is_finite(p))
            c = embree::find_closest(scene, p, glm::dmat3(1), radius, tolerance);
        if (!c.found)
            c = {false, 0, std::numeric_limits<float>::infinity(), glm::vec3(std::numeric_limits<float>::quiet_NaN()),
                 {},    {}};
        to.distance[i] = c.distance;
        put(to.point, i, c.point);
        to.here[i] = c.here.index;
        to.there[i] = c.there.index;
    }
}

}  // namespace phasetree::python
