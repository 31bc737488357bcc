#include "trace/march.hpp"

#include <algorithm>
#include <cmath>

#include "program/target.hpp"

namespace phasetree {

TracedRay::TracedRay(const glm::vec3& o, const glm::vec3& d) : origin(o), direction(d) {
    const glm::dvec3 unit(d);
    inverse = 1.0 / unit;
    is_traceable = std::abs(glm::dot(unit, unit) - 1) < 1e-3 && std::isfinite(glm::dot(glm::dvec3(o), glm::dvec3(1)));
}

Interval clip(const Bounds& box, const TracedRay& ray, double t_min, double t_max) {
    Interval r{t_min, t_max};
    for (int i = 0; i < 3; ++i) {
        const double o = static_cast<double>(ray.origin[i]);
        const double low = static_cast<double>(box.low[i]) - o, high = static_cast<double>(box.high[i]) - o;
        if (ray.direction[i] == 0) {
            if (low > 0 || high < 0) return {1, 0};
            continue;
        }
        const double a = low * ray.inverse[i], b = high * ray.inverse[i];
        r.low = std::max(r.low, std::min(a, b));
        r.high = std::min(r.high, std::max(a, b));
    }
    return r;
}

/// Of a ray that leaves an interface; below, rounding has more to say.
constexpr float least_rise = 0.02f;

std::optional<Crossing> march_within(const Bounds& box, const LinearBound& bound, const Curvature& curvature,
                                     const Routine& routine, std::uint32_t slots, const TracedRay& traced, float t_min,
                                     float t_max, float resolution, std::optional<Phase> carried,
                                     const std::optional<Departure>& departure, Evaluator::Workspace* workspace,
                                     TraceCounters& counters) {
    if (!traced.is_traceable) return std::nullopt;
    const glm::vec3 &origin = traced.origin, &direction = traced.direction;
    Interval span = clip(box, traced, static_cast<double>(t_min), static_cast<double>(t_max));
    if (!(span.low <= span.high) || !std::isfinite(span.high)) return std::nullopt;
    const auto at = [&](double t) {
        return t != 0 ? glm::vec3(glm::dvec3(origin) + t * glm::dvec3(direction)) : origin;
    };
    glm::vec3 start = at(span.low);
    // What starts here and carries a phase has mostly just crossed or left an interface.
    bool on_interface = carried && span.low == static_cast<double>(t_min);
    float slope = 1;
    bool is_monotone = false;
    const bool is_in_first = carried && routine.outputs[0].phase == static_cast<float>(carried->index);
    if (departure && on_interface && departure->rise > least_rise && routine.output_count == 2 &&
        routine.outputs[0].slot == routine.outputs[1].slot) {
        // From an interface s = rise·t − K/2·t² at least, where K is how much s curves downward: as much as upward in
        // the other phase. A tenth is left for what the rise is off. That is positive up to here:
        const double safe = 1.8 * static_cast<double>(departure->rise) /
                            std::max(static_cast<double>(curvature.most[is_in_first ? 1 : 0]), 1e-30);
        if (safe >= span.high - span.low) return std::nullopt;
        if (safe > 8 * static_cast<double>(resolution)) {
            span.low += safe;
            start = at(span.low);
            on_interface = false;
        }
    }
    if (bound.slack < Bounds::infinity && (routine.output_count == 2 || is_in_first)) {
        // The field along the ray is value + rise·t within the slack: where that is not zero, there is no interface.
        const float value = glm::dot(bound.normal, start) + bound.offset, rise = glm::dot(bound.normal, direction);
        const float length = static_cast<float>(span.high - span.low);
        slope = std::min(1.f, std::abs(rise) + bound.spread);
        is_monotone = std::abs(rise) > bound.spread;
        // A ray that has left the interface for the phase that the field grows into stays there.
        if (departure && on_interface && is_monotone) {
            const bool is_first = routine.outputs[0].phase == static_cast<float>(carried->index);
            if (routine.outputs[is_first ? 0 : 1].sign * rise < 0) return std::nullopt;
        }
        const float steps = 1 / std::max(std::abs(rise), 1e-20f), depth = rise < 0 ? value : -value;
        const float enter = (depth - bound.slack) * steps, leave = (depth + bound.slack) * steps;
        if (enter > 0 || leave < 0) {
            // It starts where the label is known.
            const bool is_below = value < 0;
            const OutputSlot& here = routine.outputs[(routine.outputs[0].sign > 0) == is_below ? 0 : 1];
            if (!carried || here.phase == static_cast<float>(carried->index)) {
                if (leave < 0 || enter > length) return std::nullopt;
                span.low += static_cast<double>(enter);
                start = at(span.low);
                carried = Phase{static_cast<std::uint8_t>(here.phase)};
                on_interface = false;
                span.high = std::min(span.high, span.low + static_cast<double>(leave - enter));
            }
        } else {
            span.high = std::min(span.high, span.low + static_cast<double>(leave));
        }
    }
    const RaySegment ray{{start.x, start.y, start.z},
                         {direction.x, direction.y, direction.z},
                         static_cast<float>(span.high - span.low),
                         static_cast<float>(span.low) - t_min,
                         resolution,
                         slope,
                         {curvature.most[0], curvature.most[1]},
                         carried ? static_cast<float>(carried->index) : -1.f,
                         is_monotone,
                         on_interface};
    constexpr std::uint32_t few = 48;
    alignas(64) float registers[few * batch_size];
    const auto many = [&] { return (workspace ? *workspace : Evaluator::thread_workspace()).registers(slots); };
    RayCrossing c;
    const bool is_hit = active_kernel().march(routine, ray, slots <= few ? registers : many(), c);
    counters.batches += c.batches;
    counters.phantoms += c.phantoms;
    if (!is_hit) return std::nullopt;
    return Crossing{static_cast<float>(span.low + static_cast<double>(c.t_in)),
                    static_cast<float>(span.low + static_cast<double>(c.t_out)),
                    start + c.t_in * direction,
                    start + c.t_out * direction,
                    Phase{static_cast<std::uint8_t>(c.from)},
                    Phase{static_cast<std::uint8_t>(c.to)}};
}

}  // namespace phasetree
