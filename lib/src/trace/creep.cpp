#include "trace/creep.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "bounding/enclose_primitive.hpp"
#include "evaluation/target.hpp"
#include "phasetree/program/batch.hpp"

namespace phasetree::trace {

using bounding::enclose_long_primitive, bounding::enclose_primitive;
using enclosure::Enclosure, enclosure::Range;
using evaluation::active_kernel, evaluation::interpret, evaluation::RoutineSteps;
using kernel::few_slots, kernel::OutputSlot, kernel::Routine, kernel::Step;
using program::fold_map;
using rewriting::Arena, rewriting::ArenaScope, rewriting::LocalValue;

namespace {

/// In resolutions: shorter stretches are sampled in the time that it takes to enclose them.
constexpr float first_stretch = 1024, shortest_stretch = 256;
/// What enclosing a stretch costs, in batches.
constexpr std::uint64_t batches_to_enclose = 32;
constexpr std::uint64_t batches_of_walk = 256, most_batches = 524'288;
/// In resolutions: so far from an interface a ray creeps no more.
constexpr float away = 16;
/// Of a resolution: a step's length, with room for the rounding of places.
constexpr float step_length = 0.95f;

/// A routine's steps with the numbers that they work on, because a fold of space is none where it jumps.
class StepsAlong {
  public:
    StepsAlong(const Routine& routine, const Enclosure* registers)
        : steps_(routine), registers_(registers), size_(routine.count) {}
    std::size_t size() const { return has_jumped_ ? 0 : size_; }
    static bool is_left_out(std::size_t) { return false; }
    const Step& step(std::size_t i) const {
        const Step& s = steps_.step(i);
        if (s.op == static_cast<std::uint32_t>(fold_map)) {
            const auto fold = program::read<FoldMap>(steps_.constants(i));
            for (int axis = 0; axis < 3; ++axis) {
                const Range& x = registers_[s.a + static_cast<std::uint32_t>(axis)].value;
                const auto cell = [&](double at) {
                    return std::floor(
                        (at - static_cast<double>(fold.centre[axis])) * static_cast<double>(fold.inverse[axis]) + 0.5);
                };
                has_jumped_ = has_jumped_ || cell(x.low) != cell(x.high);
            }
        }
        return s;
    }
    const float* constants(std::size_t i) const { return steps_.constants(i); }
    bool has_jumped() const { return has_jumped_; }

  private:
    RoutineSteps steps_;
    const Enclosure* registers_;
    std::size_t size_;
    mutable bool has_jumped_ = false;
};

/// A component along a ray.
class ComponentAlong {
  public:
    ComponentAlong(const Visit& visit, const RayCrossing& c)
        : routine_(*visit.routine), direction_(visit.ray->direction), origin_(c.origin[0], c.origin[1], c.origin[2]) {
        for (std::size_t i = 0; i < routine_.output_count; ++i)
            if (routine_.outputs[i].phase == c.from) output_ = &routine_.outputs[i];
        std::uint32_t slots = 3;
        for (std::size_t i = 0; i < routine_.count; ++i) slots = std::max(slots, routine_.steps[i].to + 3);
        registers_.resize(slots);
    }

    /// What it is at most between two places, to about so much; endless if that is not known.
    double most(float from, float to, double precision) {
        if (!output_) return Range::most;
        const double middle = 0.5 * (double{from} + double{to}), half = 0.5 * (double{to} - double{from});
        for (int i = 0; i < 3; ++i) {
            const auto along = static_cast<double>(direction_[i]);
            const double centre = static_cast<double>(origin_[i]) + middle * along, reach = half * std::abs(along);
            registers_[static_cast<std::size_t>(i)] =
                Enclosure(centre, {centre - reach, centre + reach}, {Range{along, along}}, {along}, {});
        }
        // Functions of the one variable t.
        const Enclosure::Vector extent{half, 0, 0};
        StepsAlong steps(routine_, registers_.data());
        interpret(
            steps, registers_.data(),
            [&]<class P, class Point>(const float* constants, const Point& q, Enclosure& result) {
                if constexpr (LongPrimitive<P>) {
                    ArenaScope scope(scratch_);
                    LocalValue unused;
                    result = enclose_long_primitive<P>(constants, q, extent, {}, unused, scratch_);
                } else {
                    result = enclose_primitive<P>(constants, q);
                    if constexpr (ConvexPrimitive<P>)
                        if (result.value.high - result.value.low > precision)
                            tighten_by_convexity<P>(constants, q, half, result);
                }
                result.tighten(extent);
            },
            [&](Enclosure& e) { e.tighten(extent); });
        const Range& value = registers_[output_->slot].value;
        const double most = output_->sign < 0 ? -value.low : value.high;
        return steps.has_jumped() || std::isnan(most) ? Range::most : most;
    }

  private:
    /// A convex function of t lies below its chord, and above the lines through two values on either side: what is
    /// known where an equation's derivatives are not, as of a square root at zero. Of points that go along straight
    /// lines.
    template <class P>
    static void tighten_by_convexity(const float* constants, const Vec3<Enclosure>& q, double half, Enclosure& f) {
        if (!enclosure::detail::are_affine<3>({&q.x, &q.y, &q.z})) return;
        const auto at = [&](double t) {
            const auto coordinate = [t](const Enclosure& e) {
                const double x = e.centre + t * e.gradient[0].low;
                return Enclosure(x, {x, x}, {}, {}, {});
            };
            return program::distance_of<P>(constants,
                                           Vec3<Enclosure>{coordinate(q.x), coordinate(q.y), coordinate(q.z)})
                .centre;
        };
        const double far = 2 * half, begin = at(-half), end = at(half);
        const double falls = std::min(begin - at(-half - far), 0.0), rises = std::max(at(half + far) - end, 0.0);
        const double low = std::max(begin + falls, end - rises), high = std::max(begin, end);
        f.value = {std::max(f.value.low, low), std::min(f.value.high, high)};
    }

    const Routine& routine_;
    glm::vec3 direction_, origin_;
    const OutputSlot* output_ = nullptr;
    std::vector<Enclosure> registers_;
    Arena scratch_;
};

/// The rest of a search.
class Creep {
  public:
    Creep(const Visit& visit, RayCrossing& c, TraceCounters& counters)
        : visit_(visit), crossing_(c), counters_(counters), component_(visit, c), place_(c.t_in) {}

    bool finish() {
        Visit rest = visit_;
        for (float step = visit_.resolution;;) {
            const float came_from = place_;
            do {
                pass_enclosed();
            } while (walk(step));
            if (spent_ > most_batches && !(place_ - came_from > step) && !leap(step)) return false;
            rest.from = place_;
            const bool is_hit = active_kernel().visit(rest, crossing_);
            spend(crossing_.batches);
            counters_.phantoms += crossing_.phantoms;
            if (is_hit || !crossing_.is_unfinished) return is_hit;
            place_ = crossing_.t_in;
        }
    }

  private:
    void spend(std::uint64_t batches) {
        spent_ += batches;
        counters_.batches += batches;
    }
    struct Sampled {
        BatchOfFloats t, label, distance;
    };
    /// At eight places behind one, so far apart, up to the end.
    Sampled sample(float from, float step, float end) {
        Sampled s;
        for (std::size_t i = 0; i < batch_size; ++i) s.t[i] = std::min(from + step * static_cast<float>(i + 1), end);
        alignas(64) float registers[few_slots * batch_size];
        active_kernel().sample_ray(*visit_.routine, crossing_.origin, &visit_.ray->direction.x, s.t.lane.data(),
                                   visit_.registers ? visit_.registers : registers, s.label.lane.data(),
                                   s.distance.lane.data());
        spend(1);
        return s;
    }
    /// To the last of eight places up to an end that has the ray's label, if there is one.
    bool go_to(float from, float end) {
        const Sampled s = sample(from, (end - from) / batch_size, end);
        for (std::size_t i = batch_size; i-- > 0;)
            if (s.label[i] == crossing_.from && s.t[i] > place_) {
                place_ = s.t[i];
                return true;
            }
        return false;
    }

    /// Goes on behind stretches in which no other phase is deeper than rounding.
    void pass_enclosed() {
        const float resolution = visit_.resolution;
        float end = place_;
        for (float step = first_stretch * resolution;
             end < crossing_.length && step >= shortest_stretch * resolution;) {
            const float next = std::min(end + step, crossing_.length);
            if (!(next > end)) break;
            spend(batches_to_enclose);
            const double rounding = static_cast<double>(resolution) / 16;
            const bool is_free = component_.most(end, next, 0.1 * rounding) < rounding;
            if (is_free) end = next;
            step *= is_free ? 2 : 0.5f;
        }
        if (end > place_ && !go_to(std::max(place_, end - 8 * resolution), end)) go_to(place_, end);
    }
    /// Goes on by steps while the label stays and the interface is near; true if it may go on after some.
    bool walk(float& step) {
        if (spent_ > most_batches) step *= 2;
        const float resolution = visit_.resolution, length = step_length * step;
        float from = place_;
        for (std::uint64_t n = 0; n < batches_of_walk; ++n) {
            const Sampled s = sample(from, length, crossing_.length);
            bool is_other = false;
            for (std::size_t i = 0; i < batch_size; ++i) {
                const bool was_other = is_other;
                is_other = s.label[i] != crossing_.from;
                // One that is no deeper than rounding is undecided, if no other follows.
                if (is_other && (was_other || !(s.distance[i] < resolution / 16))) return false;
                if (!is_other) place_ = s.t[i];
            }
            const float distance = is_other ? 0 : s.distance[batch_size - 1];
            if (!(distance < away * resolution)) {
                step = resolution;
                return false;
            }
            if (!(place_ > from) || !(place_ < crossing_.length)) return false;
            from = place_ + std::max(distance, 0.f);
        }
        return true;
    }
    /// Passes a place that nothing else passes.
    bool leap(float& step) {
        do {
            if (go_to(place_, std::min(place_ + batch_size * step, crossing_.length))) return true;
            step *= 2;
        } while (place_ + step < crossing_.length);
        return false;
    }

    const Visit& visit_;
    RayCrossing& crossing_;
    TraceCounters& counters_;
    ComponentAlong component_;
    float place_;  ///< in the ray's phase; no change of that up to there
    std::uint64_t spent_ = 0;
};

}  // namespace

bool finish_search(const Visit& visit, RayCrossing& c, TraceCounters& counters) {
    return Creep(visit, c, counters).finish();
}

}  // namespace phasetree::trace
