#include "trace/component_along_ray.hpp"

#include <algorithm>
#include <cmath>

#include "bounding/enclose_primitive.hpp"
#include "evaluation/interpret.hpp"
#include "math/precise.hpp"
#include "program/op_traits.hpp"

namespace phasetree::trace {

using bounding::enclose_long_primitive, bounding::enclose_primitive;
using enclosure::Enclosure, enclosure::Interval;
using evaluation::interpret, evaluation::RoutineSteps, evaluation::StepAction;
using kernel::Routine, kernel::Step;
using program::first_map, program::is_fold;
using rewriting::ArenaScope;

namespace {

// The steps of a routine for interpret(). Execution stops at a repetition of space (FoldingMap) that jumps somewhere
// within the enclosure of its point, because an enclosure across a jump would be wrong.
class StepsUpToJump : public RoutineSteps {
  public:
    StepsUpToJump(const Routine& routine, const Enclosure* registers) : RoutineSteps(routine), registers_(registers) {}
    StepAction action(std::size_t i) const {
        return is_fold(static_cast<Op>(step(i).op)) && jumps(i) ? StepAction::stop : StepAction::run;
    }

  private:
    // Whether the repetition of space in a step jumps.
    bool jumps(std::size_t i) const {
        const Step& s = step(i);
        bool jumps = false;
        program::dispatch(PointMaps(), s.op - first_map, [&]<class M>() {
            if constexpr (FoldingMap<M>) {
                const auto fold = program::read<M>(constants(i));
                for (int axis = 0; axis < 3; ++axis) {
                    const Interval& x = registers_[s.a + static_cast<std::uint32_t>(axis)].value;
                    jumps = jumps || fold.jumps_between(axis, x.low, x.high);
                }
            }
        });
        return jumps;
    }

    const Enclosure* registers_;
};

// Tightens the enclosure of a convex primitive along a straight line, for t between −half and half. A convex function
// lies below the chord through its values at both ends, so it is at most the larger of these. It lies above the
// extension of any chord beyond its ends. Take the chord over [−half − L, −half], where L = 2·half. Extended over
// [−half, half], a stretch of the same length, this chord falls by at most as much as it does over its own interval.
// The same holds for the chord that begins at t = half. So for t between −half and half:
//     f(t) ≥ f(−half) − max(f(−half − L) − f(−half), 0),   f(t) ≥ f(half) − max(f(half + L) − f(half), 0).
// This holds even where the derivatives of the equation are unknown, such as those of a square root at zero.
template <class P>
void tighten_by_convexity(const float* constants, const Vec3<Enclosure>& q, double half, Enclosure& f) {
    if (!enclosure::detail::are_affine<3>({&q.x, &q.y, &q.z})) return;
    const auto at = [&](double t) {
        const auto coordinate = [t](const Enclosure& e) { return Precise<0>(e.centre + t * e.gradient[0].low); };
        return program::distance_of<P>(constants, Vec3<Precise<0>>{coordinate(q.x), coordinate(q.y), coordinate(q.z)})
            .value();
    };
    const double length = 2 * half, begin = at(-half), end = at(half);
    const double falls = std::min(begin - at(-half - length), 0.0), rises = std::max(at(half + length) - end, 0.0);
    const double low = std::max(begin + falls, end - rises), high = std::max(begin, end);
    f.value = {std::max(f.value.low, low), std::min(f.value.high, high)};
}

}  // namespace

ComponentAlongRay::ComponentAlongRay(const Routine& routine, const glm::dvec3& origin, const glm::dvec3& direction,
                                     float phase)
    : routine_(routine), direction_(direction), origin_(origin) {
    for (std::size_t i = 0; i < routine_.output_count; ++i)
        if (routine_.outputs[i].phase == phase) output_ = &routine_.outputs[i];
    std::uint32_t slots = 3;
    for (std::size_t i = 0; i < routine_.count; ++i) slots = std::max(slots, routine_.steps[i].to + 3);
    registers_.resize(slots);
}

// Runs the routine over a stretch of the ray. Returns false if it stops at a jump. If `centres` is given, appends every
// value that the steps compute at the midpoint of the stretch.
bool ComponentAlongRay::run(double t_low, double t_high, double precision, std::vector<double>* centres) {
    const double middle = 0.5 * (t_low + t_high), half = 0.5 * (t_high - t_low);
    for (int i = 0; i < 3; ++i) {
        const double along = direction_[i], centre = origin_[i] + middle * along, half_width = half * std::abs(along);
        registers_[static_cast<std::size_t>(i)] =
            Enclosure(centre, {centre - half_width, centre + half_width}, {Interval{along, along}}, {along}, {});
    }
    // The first axis of the enclosures' box represents t; the others are unused.
    const Enclosure::Vector extent{half, 0, 0};
    return interpret(
        StepsUpToJump(routine_, registers_.data()), registers_.data(),
        [&]<class P, class Point>(std::size_t, const float* constants, const Point& q, Enclosure& result) {
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
            if (centres) centres->push_back(result.centre);
        },
        [&](Enclosure& e) {
            e.tighten(extent);
            if (centres) centres->push_back(e.centre);
        });
}

double ComponentAlongRay::upper_bound(double t_low, double t_high, double precision) {
    if (!output_ || !run(t_low, t_high, precision, nullptr)) return Interval::most;
    const Interval& value = registers_[output_->slot].value;
    const double most = output_->sign < 0 ? -value.low : value.high;
    return std::isnan(most) ? Interval::most : most;
}

std::vector<double> centres_at(const Routine& routine, const glm::dvec3& p) {
    std::vector<double> centres;
    ComponentAlongRay(routine, p, glm::dvec3(0), -1).run(0, 0, Interval::most, &centres);
    return centres;
}

}  // namespace phasetree::trace
