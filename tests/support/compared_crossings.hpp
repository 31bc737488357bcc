#pragma once

/// Compares the nearest crossing over all cells of an object with that of the whole object, along rays.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "phasetree/cells/cells.hpp"
#include "phasetree/evaluation/evaluator.hpp"
#include "phasetree/model/crossing.hpp"
#include "phasetree/model/handle.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/cells_along_ray.hpp"
#include "support/random_tree.hpp"
#include "support/set_algebra.hpp"

namespace phasetree::tests {

/// Whether two crossings at one place differ only by a sliver of a phase that one of them saw and the other passed. The
/// sliver must be thinner along the ray than a bracket may be, two and a half resolutions. The crossing that directly
/// follows the shorter one then leads to where the other is.
inline bool is_sliver(const InterfaceTracer& tracer, const Crossing& a, const Crossing& b, const glm::vec3& d,
                      Evaluator::Workspace& w) {
    if (a.from != b.from) return false;
    const auto leads_to = [&](const Crossing& seen, const Crossing& passed) {
        if (tracer.label(seen.p_to, w) != seen.to) return false;
        const auto next = tracer.first_crossing(seen.p_to, d, 0, 8 * tracer.resolution(), seen.to, w);
        return next && next->t_from < 2.5f * tracer.resolution() && next->to == passed.to;
    };
    return leads_to(a, b) || leads_to(b, a);
}

/// Whether a phase's distance is no more than a rounding error all along a ray from `a` to `b`. That is a sixteenth of
/// a resolution, which tracing treats as rounding, plus the rounding errors of the distance and of the points where it
/// is evaluated, up to half a resolution. Labels mean little there.
inline bool is_rounding(const Phased& object, const glm::vec3& a, const glm::vec3& b, const glm::vec3& d, Phase phase,
                        float resolution) {
    const auto places = [&](int count, float beyond, auto&& f) {
        const glm::vec3 from = a - beyond * d, to = b + beyond * d;
        for (int i = 0; i < count; ++i) f(glm::mix(from, to, static_cast<float>(i) / static_cast<float>(count - 1)));
    };
    const auto distance = [&](const glm::vec3& p) {
        const Phases<float> all = distances(object, p);
        return all.present >> phase.index & 1 ? static_cast<double>(all[phase.index]) : absent;
    };
    const double known = static_cast<double>(resolution) / 16, most = 8 * known;
    double deepest = 0, rounding = 0;
    places(8, 0, [&](const glm::vec3& p) { deepest = std::max(deepest, std::abs(distance(p))); });
    if (deepest <= known) return true;
    places(32, 16 * resolution, [&](const glm::vec3& p) {
        rounding = std::max(rounding, std::abs(distance(p) - values(object, p)[phase.index]));
    });
    const auto place = 0x1p-24 * static_cast<double>(std::abs(a.x) + std::abs(a.y) + std::abs(a.z));
    return deepest <= std::min(known + rounding + place, most);
}

/// Whether tracing may pass what a ray crosses between `a` and `b`, although it is longer than a resolution
/// (lib/README.md). `a` and `b` are within a bracket of where it begins and ends. It may be passed if it is at most
/// 2.75 resolutions long, and deeper than rounding errors for at most one.
inline bool is_undecided(const Phased& object, const glm::vec3& a, const glm::vec3& b, const glm::vec3& d, Phase phase,
                         float resolution) {
    const double size = static_cast<double>(resolution), step = size / 32, length = glm::distance(a, b);
    if (length > 2.75 * size) return false;
    double outside = 0, deep = 0;
    for (double t = -1.5 * size; t <= length + 1.5 * size; t += step) {
        const double distance = values(object, glm::dvec3(a) + t * glm::dvec3(d))[phase.index];
        if (distance > 0) outside += step;
        if (distance > size / 16) deep += step;
    }
    return outside <= 2.75 * size && deep <= size;
}

/// The crossing `c` of a ray from `origin`, or the next one that leads to more than a hair of another phase. A hair is
/// what tracing may pass: something thinner than the resolution, or something that is nowhere deeper than rounding
/// errors, or deeper only for a length too short to be decided.
template <class Next>
std::optional<Crossing> beyond_hairs(const Phased& object, const glm::vec3& origin, const glm::vec3& d,
                                     std::optional<Crossing> c, float resolution, const Next& next) {
    // Measure each hair from the ray's origin, not from the previous hair. A thousand hairs along a face would
    // otherwise each add a rounding error, and never leave the face.
    double passed = 0;
    // Limited, because a ray makes no progress between cells that contradict each other.
    for (int hairs = 0; c && hairs < 1000; ++hairs) {
        const std::optional<Crossing> after = next(c->p_to, c->to);
        if (!after || after->to != c->from) break;
        if (after->t_from > resolution && !is_rounding(object, c->p_to, after->p_from, d, c->from, resolution) &&
            !is_undecided(object, c->p_to, after->p_from, d, c->from, resolution))
            break;
        passed += static_cast<double>(c->t_to) + static_cast<double>(after->t_to);
        c = next(glm::vec3(glm::dvec3(origin) + passed * glm::dvec3(d)), after->to);
    }
    if (c) {
        c->t_from = static_cast<float>(passed + static_cast<double>(c->t_from));
        c->t_to = static_cast<float>(passed + static_cast<double>(c->t_to));
    }
    return c;
}

/// Over all cells, in the order in which the ray enters them.
inline std::optional<Crossing> nearest_crossing(const CellsAlongRay& cells, const glm::vec3& p, const glm::vec3& d,
                                                Phase phase, Evaluator::Workspace& w, TraceCounters& counters) {
    std::optional<Crossing> nearest;
    for (const auto& [enter, leave, c] : cells.along(p, d)) {
        if (nearest && nearest->t_from < enter) break;
        const float end = std::min(leave + 1e-3f, nearest ? nearest->t_from : 1e6f);
        const auto hit = cells.cells().first_crossing(c, p, d, 0, end, phase, w, counters);
        if (hit && (!nearest || hit->t_from < nearest->t_from)) nearest = hit;
    }
    return nearest;
}

struct Compared {
    std::size_t rays = 0, crossings = 0, different = 0, into_opaque = 0;
    TraceCounters counters{};
};

struct ComparedRay {
    glm::vec3 origin, direction;
};

/// A ray through the object's box, or along the surface at the point where a first ray meets it, less than a sixteenth
/// of the box above or below. Such a ray barely meets or misses a curved surface, which reveals a bound that is too
/// small for the curvature.
inline ComparedRay compared_ray(const InterfaceTracer& tracer, bool grazes, Random& rng, Evaluator::Workspace& w) {
    const Bounds box = tracer.bounds();
    const glm::vec3 from = rng.in(box.inflated(0.5f)), to = rng.in(box);
    const ComparedRay through{from, glm::normalize(to - from)};
    if (!grazes) return through;
    const auto met = tracer.first_crossing(through.origin, through.direction, 0, 1e6f, {}, w);
    if (!met) return through;
    const glm::vec3 n = tracer.normal(*met, through.direction);
    const glm::vec3 along = through.direction - n * glm::dot(n, through.direction);
    if (!(glm::length(along) > 1e-3f)) return through;
    const float size = box.diagonal(), side = rng.uniform(0, 1) < 0.5f ? -1.f : 1.f;
    const glm::vec3 d = glm::normalize(along);
    return {met->p_to + n * (side * size * std::exp2(-rng.uniform(4, 18))) - d * (0.5f * size), d};
}

/// Cells must find the same crossings at every build quality; most are built at medium quality.
inline BuildQuality any_quality(Random& rng) {
    return rng.below(4) == 0 ? BuildQuality::low : BuildQuality::medium;
}

/// Along a ray, until it enters an opaque phase.
inline void compare_ray(const Phased& object, const CellsAlongRay& cells, const InterfaceTracer& tracer,
                        PhaseSet opaque, const ComparedRay& ray, Evaluator::Workspace& w, Compared& result) {
    const float tolerance = 4 * tracer.resolution();
    glm::vec3 p = ray.origin;
    const glm::vec3 d = ray.direction;
    Phase phase = tracer.label(p, w);
    ++result.rays;
    for (int n = 0; n < 100 && !opaque.contains(phase); ++n) {
        const auto by_whole = [&](const glm::vec3& from, Phase in) {
            const float end = glm::distance(from, tracer.bounds().centre()) + tracer.bounds().diagonal();
            return tracer.first_crossing(from, d, 0, end, in, w);
        };
        const auto by_cells = [&](const glm::vec3& from, Phase in) {
            return nearest_crossing(cells, from, d, in, w, result.counters);
        };
        // A ray that grazes an interface may cross it anywhere there.
        const auto is_there = [&](const std::optional<Crossing>& a, const std::optional<Crossing>& b) {
            if (!a || !b) return a.has_value() == b.has_value();
            return std::abs(a->t_from - b->t_from) <= tolerance ||
                   is_rounding(object, a->p_to, b->p_to, d, a->from, tracer.resolution());
        };
        std::optional<Crossing> expected = by_whole(p, phase), nearest = by_cells(p, phase);
        if (!is_there(expected, nearest)) {
            const auto e = beyond_hairs(object, p, d, expected, tracer.resolution(), by_whole);
            const auto c = beyond_hairs(object, p, d, nearest, tracer.resolution(), by_cells);
            // What one of them treats as a hair, the other may just not.
            if (!is_there(expected, c)) expected = e;
            if (!is_there(expected, nearest)) nearest = c;
        }
        if (!is_there(expected, nearest)) {
            ++result.different;
            break;
        }
        if (!expected) break;
        ++result.crossings;
        const bool same = nearest->from == expected->from && nearest->to == expected->to;
        if (!same && !is_sliver(tracer, *expected, *nearest, d, w)) ++result.different;
        p = nearest->p_to;
        phase = nearest->to;
        result.into_opaque += opaque.contains(phase);
    }
}

/// Compares along this many rays.
inline void compare_crossings(const Phased& object, PhaseSet opaque, int rays, Random& rng, Compared& result,
                              BuildQuality quality = BuildQuality::medium) {
    Evaluator::Workspace w;
    const InterfaceCells cells(object, {.quality = quality, .opaque = opaque});
    const CellsAlongRay boxes(cells);
    const InterfaceTracer tracer(object);
    for (int i = 0; i < rays; ++i)
        compare_ray(object, boxes, tracer, opaque, compared_ray(tracer, i % 3 == 2, rng, w), w, result);
}

}  // namespace phasetree::tests
