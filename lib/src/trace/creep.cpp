#include "trace/creep.hpp"

#include <algorithm>
#include <cmath>

#include "evaluation/target.hpp"
#include "phasetree/program/batch.hpp"
#include "trace/component_along_ray.hpp"

namespace phasetree::trace {

using evaluation::active_kernel;
using kernel::few_slots, kernel::RayCrossing, kernel::Visit;

namespace {

// The lengths, in resolutions, of the first stretch to enclose and of the shortest. Sampling a shorter one takes no
// longer than enclosing it.
constexpr float first_stretch = 1024, shortest_stretch = 256;
// The cost of enclosing a stretch, in batches of samples.
constexpr std::uint64_t batches_to_enclose = 32;
// The number of batches per walk, and the number of batches of a search after which steps become longer than the
// resolution.
constexpr std::uint64_t batches_of_walk = 256, max_batches = 524'288;
// A ray farther than this from an interface, in resolutions, does not creep.
constexpr float away = 16;
// The length of a step of a walk, in resolutions. It is below 1 because positions are rounded.
constexpr float step_length = 0.95f;

// The rest of an unfinished search.
class Creep {
  public:
    Creep(const Visit& visit, RayCrossing& c, TraceCounters& counters)
        : visit_(visit),
          crossing_(c),
          counters_(counters),
          component_(*visit.routine, glm::dvec3(c.origin[0], c.origin[1], c.origin[2]),
                     glm::dvec3(visit.ray->direction), c.from),
          t_(c.t_from) {}

    // Alternates enclosed stretches, walks and searches by the kernel, until a kernel search completes or a leap
    // reaches the end of the ray. Returns whether there is a crossing.
    bool finish() {
        Visit rest = visit_;
        for (float step = visit_.resolution;;) {
            const float previous = t_;
            do {
                pass_enclosed();
            } while (walk(step));
            // The search has taken too long, and neither stretches nor walks have advanced by a step.
            if (spent_ > max_batches && !(t_ - previous > step) && !leap(step)) return false;
            rest.t_begin = t_;
            const bool is_hit = active_kernel().visit(rest, crossing_);
            spend(crossing_.batches);
            counters_.phantoms += crossing_.phantoms;
            if (is_hit || !crossing_.is_unfinished) return is_hit;
            t_ = crossing_.t_from;
        }
    }

  private:
    void spend(std::uint64_t batches) {
        spent_ += batches;
        counters_.batches += batches;
    }
    struct Batch {
        BatchOfFloats t, label, distance;
    };
    // Samples eight points after `begin`, `step` apart, up to `end`.
    Batch sample(float begin, float step, float end) {
        Batch s;
        for (std::size_t i = 0; i < batch_size; ++i) s.t[i] = std::min(begin + step * static_cast<float>(i + 1), end);
        alignas(64) float registers[few_slots * batch_size];
        active_kernel().sample_ray(*visit_.routine, crossing_.origin, &visit_.ray->direction.x, s.t.lane.data(),
                                   visit_.registers ? visit_.registers : registers, s.label.lane.data(),
                                   s.distance.lane.data());
        spend(1);
        return s;
    }
    // Samples eight points between `begin` and `end`, and moves to the last one with the label of the ray's phase.
    // Returns whether there is one.
    bool go_to(float begin, float end) {
        const Batch s = sample(begin, (end - begin) / batch_size, end);
        for (std::size_t i = batch_size; i-- > 0;)
            if (s.label[i] == crossing_.from && s.t[i] > t_) {
                t_ = s.t[i];
                return true;
            }
        return false;
    }

    // Passes stretches in which no other phase is deeper than the rounding error. Their length doubles while that is
    // proven, and is halved where it is not.
    void pass_enclosed() {
        const float resolution = visit_.resolution;
        float end = t_;
        for (float step = first_stretch * resolution;
             end < crossing_.length && step >= shortest_stretch * resolution;) {
            const float next = std::min(end + step, crossing_.length);
            if (!(next > end)) break;
            spend(batches_to_enclose);
            const double rounding_error = static_cast<double>(resolution) / 16;
            // If the bound is below the rounding error, a change of label before `next` is ignored.
            const bool is_free =
                component_.upper_bound(double{end}, double{next}, 0.1 * rounding_error) < rounding_error;
            if (is_free) end = next;
            step *= is_free ? 2 : 0.5f;
        }
        // Resume from a point in the ray's phase: preferably near the end of the proven stretch, otherwise anywhere in
        // it.
        if (end > t_ && !go_to(std::max(t_, end - 8 * resolution), end)) go_to(t_, end);
    }
    // Walks in steps while the label stays the same and the interface is near. If the search has taken too long, the
    // step is doubled first. Once the ray is away from the interface, the step becomes one resolution again. Returns
    // whether the ray still creeps, so that enclosing another stretch may help.
    bool walk(float& step) {
        if (spent_ > max_batches) step *= 2;
        const float resolution = visit_.resolution, length = step_length * step;
        float begin = t_;
        for (std::uint64_t n = 0; n < batches_of_walk; ++n) {
            const Batch s = sample(begin, length, crossing_.length);
            bool is_other = false;
            for (std::size_t i = 0; i < batch_size; ++i) {
                const bool was_other = is_other;
                is_other = s.label[i] != crossing_.from;
                // A single sample of another label, no deeper than the rounding error, does not decide a change.
                if (is_other && (was_other || !(s.distance[i] < resolution / 16))) return false;
                if (!is_other) t_ = s.t[i];
            }
            const float distance = is_other ? 0 : s.distance[batch_size - 1];
            if (!(distance < away * resolution)) {
                step = resolution;
                return false;
            }
            if (!(t_ > begin) || !(t_ < crossing_.length)) return false;
            begin = t_ + std::max(distance, 0.f);
        }
        return true;
    }
    // Advances, by longer and longer steps, from a point where neither a walk nor a search made progress. Returns false
    // at the ray's end.
    bool leap(float& step) {
        do {
            if (go_to(t_, std::min(t_ + batch_size * step, crossing_.length))) return true;
            step *= 2;
        } while (t_ + step < crossing_.length);
        return false;
    }

    const Visit& visit_;
    RayCrossing& crossing_;
    TraceCounters& counters_;
    ComponentAlongRay component_;
    float t_;                  // a point in the ray's phase; there is no crossing up to it
    std::uint64_t spent_ = 0;  // in batches
};

}  // namespace

bool finish_search(const Visit& visit, RayCrossing& c, TraceCounters& counters) {
    return Creep(visit, c, counters).finish();
}

}  // namespace phasetree::trace
