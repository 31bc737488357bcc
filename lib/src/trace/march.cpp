#include "trace/march.hpp"

#include <algorithm>
#include <cmath>

#include "program/target.hpp"

/// Multiphase sphere tracing with a batch of points *along the one ray*.
///
/// We hold a place `here` that is certainly in the ray's phase, and the samples already taken ahead of it. Two
/// neighbours of equal label whose radii together cover the gap between them prove the gap free. The first gap in doubt
/// is sampled again, sixteen points inside it: evenly; or, where the two labels differ, gathered around the place where
/// the distances on either side predict the interface; or, where the ray starts on an interface, spread out
/// geometrically from there. A gap no longer than the resolution is either the crossing or, with equal labels, passed.
///
/// A hit is a change of label, never a small distance: phantom zeros, where components vanish without a change, cost
/// samples but are never hits.
namespace phasetree {

namespace {

/// Samples ahead of the ray, the nearest on top.
class Ahead {
    using Stack = std::array<Waypoint, 64 * batch_size>;
    struct Lifted : Stack {
        Lifted() {}  // unset on purpose
    };

  public:
    Ahead() {}
    bool empty() const { return size_ == 0; }
    bool has_room() const { return size_ + batch_size <= stack_.size(); }
    const Waypoint& top() const { return stack_[size_ - 1]; }
    const Waypoint* second() const { return size_ > 1 ? &stack_[size_ - 2] : nullptr; }
    void pop() { --size_; }
    /// Puts a batch of samples, in rising order, among those ahead; none at or before `after`, none twice.
    void merge(const BatchOfFloats& t, const Samples& s, float after) {
        // Those ahead that are no farther than the batch's end are lifted off, and laid back with the batch's.
        const std::size_t end = size_;
        while (size_ > 0 && stack_[size_ - 1].t <= t[batch_size - 1]) --size_;
        Lifted lifted;
        const std::size_t count = end - size_;
        std::copy(stack_.begin() + static_cast<std::ptrdiff_t>(size_),
                  stack_.begin() + static_cast<std::ptrdiff_t>(end), lifted.begin());
        std::size_t old = 0;  // the farthest of the lifted comes first
        float before = Bounds::infinity;
        const auto lay = [&](const Waypoint& w) {
            if (w.t > after && w.t < before) push(w);
            before = std::min(before, w.t);
        };
        for (std::size_t i = batch_size; i-- > 0;) {
            while (old < count && lifted[old].t >= t[i]) lay(lifted[old++]);
            lay({t[i], s.distance[i], s.label[i]});
        }
        while (old < count) lay(lifted[old++]);
    }
    void push(const Waypoint& w) { stack_[size_++] = w; }

  private:
    Stack stack_;  // unset on purpose: most rays use a few
    std::size_t size_ = 0;
};

/// Makes the resolution coarser for a ray that creeps along an interface, so that the work stays bounded: it doubles
/// for every 32 batches past the first 128.
float effective_resolution(float resolution, std::uint64_t batches) {
    if (batches < 128) return resolution;
    return std::ldexp(resolution, static_cast<int>(std::min<std::uint64_t>((batches - 128) / 32 + 1, 60)));
}

}  // namespace

std::optional<Crossing> march(const Routine& routine, float* registers, const glm::vec3& origin,
                              const glm::vec3& direction, float length, float resolution, std::optional<Phase> carried,
                              bool on_interface, TraceCounters& counters) {
    const auto sample_ray = active_kernel().sample_ray;
    std::uint64_t batches = 0;
    Samples s;
    const auto sample = [&](const BatchOfFloats& t) {
        sample_ray(routine, &origin.x, &direction.x, t.lane.data(), registers, s.label.lane.data(),
                   s.distance.lane.data());
        ++batches;
        ++counters.batches;
    };
    const auto crossing = [&](float t_in, float t_out, float from, float to) {
        return Crossing{t_in,
                        t_out,
                        origin + t_in * direction,
                        origin + t_out * direction,
                        Phase{static_cast<std::uint8_t>(from)},
                        Phase{static_cast<std::uint8_t>(to)}};
    };

    // The start, and the first batch behind it.
    BatchOfFloats t = on_interface ? spread_from(0, length, resolution) : spread_evenly(0, length);
    for (std::size_t i = batch_size - 1; i > 0; --i) t[i] = t[i - 1];
    t[0] = 0;
    t[batch_size - 1] = length;
    sample(t);

    Waypoint here{0, s.distance[0], s.label[0]};
    const float phase = carried ? static_cast<float>(carried->index) : here.label;
    Ahead ahead;
    const auto push_samples = [&](const BatchOfFloats& at, float low, float high) {
        bool any = false;
        float before = high;
        for (std::size_t i = batch_size; i-- > 0;) {
            if (!(at[i] > low && at[i] < before)) continue;
            ahead.push({at[i], s.distance[i], s.label[i]});
            before = at[i];
            any = true;
        }
        return any;
    };
    push_samples(t, 0, std::nextafter(length, Bounds::infinity));

    if (here.label != phase) {
        // Rounding may have put the start just across the interface it was found on: look a little ahead.
        BatchOfFloats near;
        for (std::size_t i = 0; i < batch_size; ++i) near[i] = resolution * 0.25f * static_cast<float>(i + 1);
        sample(near);
        std::size_t found = 0;
        while (found < batch_size && s.label[found] != phase) ++found;
        if (found == batch_size || near[found] > length) return crossing(0, 0, phase, here.label);
        here = {near[found], s.distance[found], phase};
        while (!ahead.empty() && ahead.top().t <= here.t) ahead.pop();
    }

    Waypoint certain = here;  // the last place whose own label is the ray's phase; mostly `here`
    constexpr float none = -1;
    Waypoint other{0, 0, none};  // after it, the first place of the label there
    while (!ahead.empty()) {
        const Waypoint next = ahead.top();
        const bool same = next.label == phase;
        const float gap = next.t - here.t;
        if (same && here.distance + next.distance >= gap) {
            here = certain = next;
            other.label = none;
            ahead.pop();
            continue;
        }
        const float fine = effective_resolution(resolution, batches);
        const float low = here.t + std::max(here.distance, 0.f);
        const float high = same ? next.t - std::max(next.distance, 0.f) : next.t;
        bool resolved = gap <= (same ? fine : resolution) || (same && high - low <= fine) || !ahead.has_room();
        if (!resolved) {
            BatchOfFloats between;
            if (!same) {
                const float sum = here.distance + next.distance;
                const float root = sum > 0 ? here.t + gap * (here.distance / sum) : here.t + 0.5f * gap;
                between = gather_around(std::clamp(root, here.t, next.t), here.t, next.t, 0.4f * resolution);
            } else if (const float slope = (next.distance - here.distance) / gap; slope > 0.02f) {
                // The ray leaves an interface it started on, at a low angle: one batch for many of the gaps ahead.
                between = spread_growing(here.t, length, std::max(here.distance, 0.25f * fine), std::min(slope, 1.f));
                sample(between);
                ahead.merge(between, s, here.t);
                continue;
            } else {
                between = spread_evenly(std::min(low, high), high);
            }
            sample(between);
            resolved = !push_samples(between, here.t, next.t);  // no float lies between
        }
        if (!resolved) continue;

        ahead.pop();
        if (same) {
            ++counters.phantoms;
            here = certain = next;
            other.label = none;
            continue;
        }
        // A change of label. Within rounding of an interface labels mean little: solids that abut leave slivers, and a
        // ray along a face flickers. So a change counts once the new phase is decided: s(p) above rounding, or the same
        // label for two resolutions. Until then the ray stays in its phase. The bracket is where the label changed.
        const float rounding = resolution * (1.f / 16);
        if (other.label != next.label) other = next;
        if (next.distance >= rounding || next.t - other.t >= 1.5f * resolution)
            return crossing(certain.t, other.t, phase, next.label);
        BatchOfFloats beyond;
        for (std::size_t i = 0; i < batch_size; ++i)
            beyond[i] = std::min(next.t + resolution * (1.f / 8) * static_cast<float>(i + 1), length);
        sample(beyond);
        for (std::size_t i = 0; i < batch_size; ++i) {
            here = {beyond[i], s.distance[i], phase};
            bool decided = s.distance[i] >= rounding;
            if (s.label[i] == phase) {
                certain = here;
                other.label = none;
            } else {
                if (other.label != s.label[i]) other = {beyond[i], s.distance[i], s.label[i]};
                decided = decided || here.t - other.t >= 1.5f * resolution;
                if (decided) return crossing(certain.t, other.t, phase, other.label);
            }
            if (decided) break;
        }
        ++counters.phantoms;
        while (!ahead.empty() && ahead.top().t <= here.t) ahead.pop();
    }
    return std::nullopt;
}

Interval clip(const Bounds& box, const glm::vec3& origin, const glm::vec3& direction, double t_min, double t_max) {
    Interval r{t_min, t_max};
    for (int i = 0; i < 3; ++i) {
        const double o = static_cast<double>(origin[i]), d = static_cast<double>(direction[i]);
        const double low = static_cast<double>(box.low[i]) - o, high = static_cast<double>(box.high[i]) - o;
        if (d == 0) {
            if (low > 0 || high < 0) return {1, 0};
            continue;
        }
        const double a = low / d, b = high / d;
        r.low = std::max(r.low, std::min(a, b));
        r.high = std::min(r.high, std::max(a, b));
    }
    return r;
}

std::optional<Crossing> march_within(const Bounds& box, const Routine& routine, float* registers,
                                     const glm::vec3& origin, const glm::vec3& direction, float t_min, float t_max,
                                     float resolution, std::optional<Phase> carried, TraceCounters& counters) {
    const glm::dvec3 unit(direction);
    if (!(std::abs(glm::dot(unit, unit) - 1) < 1e-3) || !std::isfinite(glm::dot(glm::dvec3(origin), glm::dvec3(1))))
        return std::nullopt;
    const Interval span = clip(box, origin, direction, static_cast<double>(t_min), static_cast<double>(t_max));
    if (!(span.low <= span.high) || !std::isfinite(span.high)) return std::nullopt;
    const glm::vec3 start = span.low != 0 ? glm::vec3(glm::dvec3(origin) + span.low * glm::dvec3(direction)) : origin;
    // What starts here and carries a phase has mostly just crossed or left an interface.
    const bool on_interface = carried && span.low == static_cast<double>(t_min);
    auto hit = march(routine, registers, start, direction, static_cast<float>(span.high - span.low), resolution,
                     carried, on_interface, counters);
    if (hit) {
        hit->t_in = static_cast<float>(span.low + static_cast<double>(hit->t_in));
        hit->t_out = static_cast<float>(span.low + static_cast<double>(hit->t_out));
    }
    return hit;
}

}  // namespace phasetree
