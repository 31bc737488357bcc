#include "trace/creep.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cells/enclose_primitive.hpp"
#include "program/target.hpp"

namespace phasetree {

namespace {

constexpr std::uint32_t most_pauses = 512;
/// In resolutions: shorter stretches are sampled in the time that it takes to enclose them.
constexpr float first_stretch = 1024, shortest_stretch = 256;
/// What enclosing a stretch costs, in batches.
constexpr std::uint64_t batches_to_enclose = 32;
constexpr float coarse_steps = 64;

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
            const auto fold = detail::read<FoldMap>(steps_.constants(i));
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

    /// What it is at most between two places; endless if that is not known.
    double most(float from, float to) {
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
                }
                result.tighten(extent);
            },
            [&](Enclosure& e) { e.tighten(extent); });
        const Range& value = registers_[output_->slot].value;
        const double most = output_->sign < 0 ? -value.low : value.high;
        return steps.has_jumped() || std::isnan(most) ? Range::most : most;
    }

  private:
    const Routine& routine_;
    glm::vec3 direction_, origin_;
    const OutputSlot* output_ = nullptr;
    std::vector<Enclosure> registers_;
    Arena scratch_;
};

/// The last of eight places from one to another that has the label.
std::optional<float> last_in_phase(const Visit& visit, const RayCrossing& c, float from, float to) {
    BatchOfFloats t, label, distance;
    for (std::size_t i = 0; i < batch_size; ++i)
        t[i] = std::min(from + (to - from) * (static_cast<float>(i + 1) / batch_size), to);
    alignas(64) float registers[few_slots * batch_size];
    active_kernel().sample_ray(*visit.routine, c.origin, &visit.ray->direction.x, t.lane.data(),
                               visit.registers ? visit.registers : registers, label.lane.data(), distance.lane.data());
    for (std::size_t i = batch_size; i-- > 0;)
        if (label[i] == c.from) return t[i];
    return std::nullopt;
}

/// A place in the ray's phase up to which no other is deeper than rounding.
float end_of_creep(const Visit& visit, const RayCrossing& c, ComponentAlong& component, TraceCounters& counters) {
    const float resolution = visit.resolution, begin = c.t_in;
    float end = begin;
    for (float step = first_stretch * resolution; end < c.length && step >= shortest_stretch * resolution;) {
        const float next = std::min(end + step, c.length);
        if (!(next > end)) break;
        counters.batches += batches_to_enclose;
        const bool is_free = component.most(end, next) < double{resolution} / 16;
        if (is_free) end = next;
        step *= is_free ? 2 : 0.5f;
    }
    if (!(end > begin)) return begin;
    counters.batches += 2;
    if (const auto near = last_in_phase(visit, c, std::max(begin, end - 8 * resolution), end)) return *near;
    return last_in_phase(visit, c, begin, end).value_or(begin);
}

}  // namespace

bool finish_search(const Visit& visit, RayCrossing& c, TraceCounters& counters) {
    ComponentAlong component(visit, c);
    Visit rest = visit;
    int doublings = 0;
    float came_from = visit.from;
    for (std::uint32_t pauses = 1;; ++pauses) {
        const bool is_stuck = !(c.t_in - came_from > 4 * visit.resolution);
        rest.from = end_of_creep(visit, c, component, counters);
        rest.coarse_until = 0;
        if (is_stuck || pauses > most_pauses) {
            rest.coarse = std::ldexp(visit.resolution, ++doublings);
            rest.coarse_until = rest.from + coarse_steps * rest.coarse;
        }
        came_from = rest.from;
        const bool is_hit = active_kernel().visit(rest, c);
        counters.batches += c.batches;
        counters.phantoms += c.phantoms;
        if (is_hit || !c.is_unfinished) return is_hit;
    }
}

}  // namespace phasetree
