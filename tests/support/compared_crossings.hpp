#pragma once

/// The nearest crossing over all cells of an object against that of the whole object, along rays.

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "phasetree/cells/cells.hpp"
#include "phasetree/model/walk.hpp"
#include "phasetree/trace/tracer.hpp"
#include "support/random_tree.hpp"

namespace phasetree::tests {

/// Whether two crossings at one place differ only by a phase thinner along the ray than the resolution, which one of
/// them saw and the other passed: the crossing that follows the shorter one at once leads to where the other is.
inline bool is_sliver(const InterfaceTracer& tracer, const Crossing& a, const Crossing& b, const glm::vec3& d,
                      Evaluator::Workspace& w) {
    if (a.from != b.from) return false;
    const auto leads_to = [&](const Crossing& seen, const Crossing& passed) {
        if (tracer.label(seen.p_out, w) != seen.to) return false;
        const auto next = tracer.first_crossing(seen.p_out, d, 0, 2 * tracer.resolution(), seen.to, w);
        return next && next->to == passed.to;
    };
    return leads_to(a, b) || leads_to(b, a);
}

/// Whether a place is within a share of the resolution of where a phase ends.
inline bool is_near_end(const Phased& object, const glm::vec3& p, Phase phase, float distance) {
    const Phases<float> all = distances(object, p);
    return all.present >> phase.index & 1 && std::abs(all[phase.index]) <= distance;
}

/// The crossing, or the next one that is followed by more than a hair of another phase: what is thinner than the
/// resolution may be passed; and what is no longer than four, if that is twice as deep as rounding at most, as where a
/// ray leaves at half a degree.
template <class Next>
std::optional<Crossing> beyond_hairs(const Phased& object, std::optional<Crossing> c, float resolution,
                                     const Next& next) {
    while (c) {
        const std::optional<Crossing> after = next(c->p_out, c->to);
        if (!after || after->t_in > 4 * resolution || after->to != c->from) return c;
        if (after->t_in > resolution && !is_near_end(object, 0.5f * (c->p_out + after->p_in), c->from, resolution / 8))
            return c;
        const float passed = c->t_out + after->t_out;
        c = next(after->p_out, after->to);
        if (c) {
            c->t_in += passed;
            c->t_out += passed;
        }
    }
    return c;
}

/// Whether a place is on an interface but for rounding: a ray that grazes it may cross anywhere there.
inline bool is_on_interface(const Phased& object, const glm::vec3& p, Phase from, float resolution) {
    return is_near_end(object, p, from, resolution / 16);
}

/// Over all cells, in the order in which the ray enters them.
inline std::optional<Crossing> nearest_crossing(const InterfaceCells& cells, const glm::vec3& p, const glm::vec3& d,
                                                Phase phase, Evaluator::Workspace& w, TraceCounters& counters) {
    std::vector<std::pair<float, std::size_t>> met;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const Bounds box = cells.bounds(c);
        float enter = 0, leave = Bounds::infinity;
        for (int i = 0; i < 3; ++i) {
            const float a = (box.low[i] - p[i]) / d[i], b = (box.high[i] - p[i]) / d[i];
            enter = std::max(enter, std::min(a, b) - 1e-5f);
            leave = std::min(leave, std::max(a, b) + 1e-5f);
        }
        if (!(enter > leave)) met.emplace_back(enter, c);
    }
    std::sort(met.begin(), met.end());
    std::optional<Crossing> nearest;
    for (const auto& [enter, c] : met) {
        if (nearest && nearest->t_in < enter) break;
        const auto hit = cells.first_crossing(c, p, d, 0, nearest ? nearest->t_in : 1e6f, phase, w, counters);
        if (hit && (!nearest || hit->t_in < nearest->t_in)) nearest = hit;
    }
    return nearest;
}

struct Compared {
    std::size_t rays = 0, crossings = 0, different = 0, into_opaque = 0;
    TraceCounters counters{};
};

/// Along so many rays, until they enter an opaque phase.
inline void compare_crossings(const Phased& object, PhaseSet opaque, int rays, Random& rng, Compared& result) {
    Evaluator::Workspace w;
    const InterfaceCells cells(object, {.opaque = opaque});
    const InterfaceTracer tracer(object);
    const float tolerance = 4 * tracer.resolution();
    for (int i = 0; i < rays; ++i) {
        glm::vec3 p = rng.in(cells.bounds().inflated(0.5f));
        const glm::vec3 d = glm::normalize(rng.in(cells.bounds()) - p);
        Phase phase = tracer.label(p, w);
        ++result.rays;
        for (int n = 0; n < 100 && !opaque.contains(phase); ++n) {
            const auto by_whole = [&](const glm::vec3& from, Phase in) {
                return tracer.first_crossing(from, d, 0, 1e6f, in, w);
            };
            const auto by_cells = [&](const glm::vec3& from, Phase in) {
                return nearest_crossing(cells, from, d, in, w, result.counters);
            };
            std::optional<Crossing> expected = by_whole(p, phase), nearest = by_cells(p, phase);
            if (expected.has_value() != nearest.has_value() ||
                (expected && std::abs(nearest->t_in - expected->t_in) > tolerance)) {
                expected = beyond_hairs(object, expected, tracer.resolution(), by_whole);
                nearest = beyond_hairs(object, nearest, tracer.resolution(), by_cells);
            }
            if (expected.has_value() != nearest.has_value()) {
                ++result.different;
                break;
            }
            if (!expected) break;
            ++result.crossings;
            const bool same = nearest->from == expected->from && nearest->to == expected->to;
            const bool grazes = is_on_interface(object, nearest->p_out, nearest->from, tracer.resolution()) &&
                                is_on_interface(object, expected->p_out, expected->from, tracer.resolution());
            if ((std::abs(nearest->t_in - expected->t_in) > tolerance && !grazes) ||
                (!same && !is_sliver(tracer, *expected, *nearest, d, w)))
                ++result.different;
            p = nearest->p_out;
            phase = nearest->to;
            result.into_opaque += opaque.contains(phase);
        }
    }
}

}  // namespace phasetree::tests
