#include "trace/component_along_ray.hpp"

#include <algorithm>
#include <cmath>

#include "bounding/enclose_primitive.hpp"
#include "evaluation/interpret.hpp"

namespace phasetree::trace {

using bounding::enclose_long_primitive, bounding::enclose_primitive;
using enclosure::Enclosure, enclosure::Range;
using evaluation::interpret, evaluation::RoutineSteps;
using kernel::RayCrossing, kernel::Routine, kernel::Step, kernel::Visit;
using program::fold_map;
using rewriting::ArenaScope;

namespace {

// The steps of a routine for interpret(), which calls size() before each step. The list ends at a fold of space that
// jumps somewhere within the range of its point, because an enclosure across a jump would be wrong. has_jumped()
// reports this.
class StepsUpToJump {
  public:
    StepsUpToJump(const Routine& routine, const Enclosure* registers)
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

// Tightens the enclosure of a convex primitive along a straight line, for t between −half and half. A convex function
// lies below the chord through its values at both ends, so it is at most the larger of these. It also lies above the
// extension of any chord. So with L = 2 half, for t between −half and half:
//     f(t) ≥ f(−half) − max(f(−half − L) − f(−half), 0),   f(t) ≥ f(half) − max(f(half + L) − f(half), 0).
// This holds even where the derivatives of the equation are unknown, such as those of a square root at zero.
template <class P>
void tighten_by_convexity(const float* constants, const Vec3<Enclosure>& q, double half, Enclosure& f) {
    if (!enclosure::detail::are_affine<3>({&q.x, &q.y, &q.z})) return;
    const auto at = [&](double t) {
        const auto coordinate = [t](const Enclosure& e) {
            const double x = e.centre + t * e.gradient[0].low;
            return Enclosure(x, {x, x}, {}, {}, {});
        };
        return program::distance_of<P>(constants, Vec3<Enclosure>{coordinate(q.x), coordinate(q.y), coordinate(q.z)})
            .centre;
    };
    const double length = 2 * half, begin = at(-half), end = at(half);
    const double falls = std::min(begin - at(-half - length), 0.0), rises = std::max(at(half + length) - end, 0.0);
    const double low = std::max(begin + falls, end - rises), high = std::max(begin, end);
    f.value = {std::max(f.value.low, low), std::min(f.value.high, high)};
}

}  // namespace

ComponentAlongRay::ComponentAlongRay(const Visit& visit, const RayCrossing& c)
    : routine_(*visit.routine), direction_(visit.ray->direction), origin_(c.origin[0], c.origin[1], c.origin[2]) {
    for (std::size_t i = 0; i < routine_.output_count; ++i)
        if (routine_.outputs[i].phase == c.from) output_ = &routine_.outputs[i];
    std::uint32_t slots = 3;
    for (std::size_t i = 0; i < routine_.count; ++i) slots = std::max(slots, routine_.steps[i].to + 3);
    registers_.resize(slots);
}

double ComponentAlongRay::upper_bound(float t_low, float t_high, double precision) {
    if (!output_) return Range::most;
    const double middle = 0.5 * (double{t_low} + double{t_high}), half = 0.5 * (double{t_high} - double{t_low});
    for (int i = 0; i < 3; ++i) {
        const auto along = static_cast<double>(direction_[i]);
        const double centre = static_cast<double>(origin_[i]) + middle * along, half_width = half * std::abs(along);
        registers_[static_cast<std::size_t>(i)] =
            Enclosure(centre, {centre - half_width, centre + half_width}, {Range{along, along}}, {along}, {});
    }
    // The first axis of the enclosures' box represents t; the others are unused.
    const Enclosure::Vector extent{half, 0, 0};
    StepsUpToJump steps(routine_, registers_.data());
    interpret(
        steps, registers_.data(),
        [&]<class P, class Point>(const float* constants, const Point& q, Enclosure& result) {
            if constexpr (LongPrimitive<P>) {
                ArenaScope scope(scratch_);
                bounding::SpecialisationInBox unused{{}, scratch_};
                result = enclose_long_primitive<P>(constants, q, extent, unused);
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

}  // namespace phasetree::trace
