// Runs a routine with any number type, one number at a time, for gradients and enclosures. Kernels have their own
// interpreter (kernel/kernel.inl).
#pragma once

#include "kernel/kernel.hpp"
#include "program/dispatch.hpp"
#include "program/fused.hpp"

namespace phasetree::evaluation {

using kernel::Routine, kernel::Step;
using program::affine_map, program::first_map, program::first_placed, program::placed_floats, program::PlacedPrimitive;

/// A point in three registers.
template <class T>
struct PointInRegisters {
    const T* registers;
    std::uint32_t slot;

    operator Vec3<T>() const { return {registers[slot], registers[slot + 1], registers[slot + 2]}; }
};

/// What interpret() does with a step.
enum class StepAction : unsigned char { run, skip, stop };

/// The steps of a routine in the form that interpret() expects.
class RoutineSteps {
  public:
    explicit RoutineSteps(const Routine& routine) : routine_(routine) {}
    std::size_t size() const { return routine_.count; }
    static StepAction action(std::size_t) { return StepAction::run; }
    const Step& step(std::size_t i) const { return routine_.steps[i]; }
    const float* constants(std::size_t i) const { return routine_.constants + routine_.data[i]; }

  private:
    const Routine& routine_;
};

/// Runs the steps in order, as steps.action(i) says of each when all earlier ones have been run or skipped. Returns
/// false if a step stopped the run. Registers 0 … 2 hold the point.
///
/// For a primitive P in step i, calls `distance.template operator()<P>(i, constants, point, to)`, which must set `to`
/// to its distance; the point is a Vec3<T> or PointInRegisters<T>. Calls `done(number)` with each number that any other
/// step has computed, including each coordinate of a point, and the distance of a fused primitive after its scale and
/// offset. It is not called for plain primitives, because `distance` sees their results.
template <class Steps, class T, class Distance, class Done>
bool interpret(const Steps& steps, T* registers, Distance&& distance, Done&& done) {
    constexpr auto first_primitive = static_cast<std::uint32_t>(Op::first_primitive);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const StepAction action = steps.action(i);
        if (action == StepAction::skip) continue;
        if (action == StepAction::stop) return false;
        const Step& s = steps.step(i);
        const T& a = registers[s.a];
        const T& b = registers[s.b];
        T& to = registers[s.to];
        const float* c = steps.constants(i);
        if (s.op >= first_primitive) {
            const PointInRegisters<T> input{registers, s.a};
            const std::uint32_t index = s.op - first_primitive;
            // The end of the loop calls done() with the first coordinate, `to`.
            const auto set_point = [&](const Vec3<T>& q) {
                registers[s.to] = q.x;
                done(registers[s.to + 1] = q.y);
                done(registers[s.to + 2] = q.z);
            };
            const auto primitive = [&]<class P>(const float* floats, const auto& point) {
                distance.template operator()<P>(i, floats, point, to);
            };
            if (s.op < first_map) {
                if (index < Primitives::size)
                    program::dispatch(Primitives(), index,
                                      [&]<class P>() { primitive.template operator()<P>(c, input); });
                else
                    program::dispatch(DataPrimitives(), index - static_cast<std::uint32_t>(Primitives::size),
                                      [&]<class P>() { primitive.template operator()<P>(c, input); });
                continue;
            }
            if (s.op >= first_placed) {
                const auto placed = program::read<PlacedPrimitive>(c);
                program::dispatch(Primitives(), s.op - first_placed, [&]<class P>() {
                    primitive.template operator()<P>(c + placed_floats, placed.map(Vec3<T>(input)));
                });
                to = to * placed.scale + placed.offset;
            } else if (s.op == affine_map) {
                set_point(program::read<AffineMap>(c)(Vec3<T>(input)));
            } else {
                program::dispatch(PointMaps(), s.op - first_map,
                                  [&]<class M>() { set_point(program::read<M>(c)(Vec3<T>(input))); });
            }
        } else {
            switch (static_cast<Op>(s.op)) {
                case Op::input:
                    break;
                case Op::negate:
                    to = -a;
                    break;
                case Op::add:
                    to = a + b;
                    break;
                case Op::subtract:
                    to = a - b;
                    break;
                case Op::minimum:
                case Op::far_bound_inside:
                    to = min(a, b);
                    break;
                case Op::maximum:
                case Op::far_bound:
                    to = max(a, b);
                    break;
                case Op::absolute:
                    to = abs(a);
                    break;
                case Op::add_constant:
                    to = a + *c;
                    break;
                case Op::constant_minus:
                    to = *c - a;
                    break;
                case Op::multiply_constant:
                    to = a * *c;
                    break;
                case Op::smooth_minimum:
                    to = smooth_min(a, b, *c);
                    break;
                case Op::guarded:
                    to = guarded(a, b, *c);
                    break;
                case Op::falloff:
                    to = falloff(a, *c);
                    break;
                case Op::corner:
                    to = corner(a, b);
                    break;
                case Op::nearer:
                    to = nearer(a, b);
                    break;
                case Op::first_primitive:  // not an operation
                    break;
            }
        }
        done(to);
    }
    return true;
}

}  // namespace phasetree::evaluation
