#include "bounding/enclose.hpp"

#include <cmath>
#include <limits>
#include <memory>

#include "bounding/enclose_primitive.hpp"
#include "bounding/nearly_linear.hpp"
#include "evaluation/interpret.hpp"
#include "rewriting/readable_steps.hpp"

namespace phasetree::bounding {

using evaluation::interpret, evaluation::PointInRegisters, evaluation::StepAction;
using kernel::Step;
using program::gives_point, program::is_fold;
using rewriting::assign_slots, rewriting::has_local_primitive;

namespace {

// The steps of a program for interpret(), except those whose results are known from the previous program.
struct UnknownSteps {
    std::span<const Instruction> code;
    std::span<const std::uint32_t> previous;
    const float* first_constant;
    std::span<const std::uint32_t> slot;

    std::size_t size() const { return code.size(); }
    StepAction action(std::size_t i) const { return i == 0 || previous[i] != 0 ? StepAction::skip : StepAction::run; }
    Step step(std::size_t i) const {
        const Instruction& in = code[i];
        return {static_cast<std::uint32_t>(in.op), slot[i], slot[in.a], slot[in.b]};
    }
    const float* constants(std::size_t i) const { return first_constant + code[i].data; }
};

}  // namespace

Encloser::Encloser(const ProgramContext& context, const Bounds& box, std::span<const Specialisation> around,
                   std::span<const RequiredOfLocal> required, Arena& scratch)
    : context_(context), box_(box), scratch_(scratch), centre_(box.centre()), around_(around), required_(required) {
    const glm::vec3 extent = box.extent();
    half_ = enclosure::detail::each_number(
        [&](std::size_t i) { return 0.5 * double{extent[static_cast<int>(i)]} * (1 + 1e-6); });
    point_of_box_ = std::construct_at(scratch.allocate<AffinePoint>(1).data(), AffinePoint::of_box(centre_, half_));
}

// For each instruction: its index in the previous program, if it is a primitive or a map of space that occurred there;
// otherwise 0.
std::span<const std::uint32_t> Encloser::previous_numbers(const WorkingProgram& program) const {
    const std::span<const Instruction> before = last_.program.code;
    const std::span<std::uint32_t> previous = scratch_.allocate<std::uint32_t>(program.code.size());
    std::ranges::fill(previous, 0u);
    std::size_t at = 0;  // The order is usually the same, so the search continues from the last instruction found.
    for (std::size_t i = 1; i < previous.size() && !before.empty(); ++i) {
        const Instruction& in = program.code[i];
        if (in.op < Op::first_primitive || (in.a != 0 && previous[in.a] == 0)) continue;
        for (std::size_t tries = before.size(); tries > 0 && previous[i] == 0; --tries) {
            at = at + 1 < before.size() ? at + 1 : 0;
            const Instruction& old = before[at];
            if (old.op == in.op && old.data == in.data && old.a == previous[in.a])
                previous[i] = static_cast<std::uint32_t>(at);
        }
    }
    return previous;
}

// For each instruction: the specialisation that the previous program had for it. Empty if there are no local
// primitives.
std::span<Specialisation> Encloser::previous_specialisations(const WorkingProgram& program,
                                                             std::span<const std::uint32_t> previous) const {
    if (!context_.has_local_primitives || !has_local_primitive(program)) return {};
    const std::span<Specialisation> found = scratch_.allocate<Specialisation>(previous.size());
    std::ranges::fill(found, Specialisation{});
    for (const Specialisation& s : specialisations_)
        if (const auto now = std::ranges::find(previous, s.value); now != previous.end())
            found[static_cast<std::size_t>(now - previous.begin())] = s;
    return found;
}

// The data of the specialisation that the local primitive with these constants had in the surrounding box.
std::span<const float> Encloser::data_around(std::uint32_t source) const {
    std::span<const float> data;
    for (const Specialisation& s : around_)
        if (s.source == source) data = s.data;
    return data;
}

// The upper limit up to which the values of the local primitive with these constants are required.
double Encloser::farthest_required(std::uint32_t source) const {
    for (const RequiredOfLocal& r : required_)
        if (r.source == source) return static_cast<double>(r.high) + 2 * static_cast<double>(context_.value_error);
    return std::numeric_limits<double>::infinity();
}

// Computes the enclosures of all values of a program, which becomes the last one.
void Encloser::enclose_values(const WorkingProgram& program) {
    const std::span<const std::uint32_t> previous = previous_numbers(program);
    const std::span<std::uint32_t> slot = scratch_.allocate<std::uint32_t>(previous.size());
    const std::span<Enclosure> registers = scratch_.allocate<Enclosure>(assign_slots(program, slot));
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        std::construct_at(&registers[k], Enclosure::coordinate(i, centre_[i], half_[k]));
    }
    for (std::size_t i = 1; i < previous.size(); ++i)
        if (previous[i] != 0)
            std::copy_n(registers_ + last_.slot[previous[i]], gives_point(program.code[i].op) ? 3 : 1,
                        registers.data() + slot[i]);
    const std::span<Specialisation> found = previous_specialisations(program, previous);
    registers_ = registers.data();
    last_ = {program, box_, &context_, registers_, slot, half_};
    enclose_instructions(program, previous, found);
    keep_specialisations(found);
}

// Computes the enclosures that are not known from the previous program.
void Encloser::enclose_instructions(const WorkingProgram& program, std::span<const std::uint32_t> previous,
                                    std::span<Specialisation> found) {
    const UnknownSteps steps{program.code, previous, context_.constants.data(), last_.slot};
    const auto enclose_rounded = [&](const auto& solid, const auto& q, Enclosure& result) {
        // Most primitives take the point of the box itself, for which the AffinePoint already exists.
        if constexpr (std::is_same_v<decltype(q), const PointInRegisters<Enclosure>&>)
            if (q.slot == 0) return enclose_convex(solid, *point_of_box_, result);
        const std::optional<AffinePoint> affine = AffinePoint::of(q, half_);
        return affine && enclose_convex(solid, *affine, result);
    };
    interpret(
        steps, registers_,
        [&]<class P, class Point>([[maybe_unused]] std::size_t i, const float* c, const Point& q, Enclosure& result) {
            if constexpr (RoundedPrimitive<P>) {
                if (!enclose_rounded(program::read<P>(c), q, result)) {
                    result = enclose_primitive<P>(c, q);
                    tighten_by_linear_bound(result, half_);
                }
            } else if constexpr (LongPrimitive<P>) {
                SpecialisationInBox specialisation{{}, scratch_};
                if constexpr (AnyLocalPrimitive<P>) {
                    const auto source = static_cast<std::uint32_t>(c - context_.constants.data());
                    specialisation.around = data_around(source);
                    specialisation.farthest = farthest_required(source);
                }
                result = enclose_long_primitive<P>(c, q, half_, specialisation);
                if constexpr (AnyLocalPrimitive<P>) found[i] = specialisation.found;
            } else {
                result = enclose_primitive<P>(c, q);
                tighten_by_linear_bound(result, half_);
            }
            result.tighten(half_);
        },
        [&](Enclosure& e) { e.tighten(half_); });
}

// Keeps the specialisations of those instructions that have one.
void Encloser::keep_specialisations(std::span<Specialisation> found) {
    const std::span<const Instruction> code = last_.program.code;
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < found.size(); ++i) {
        if (found[i].data.empty()) continue;
        Specialisation& s = found[count++] = found[i];
        s.value = i;
        const Instruction& in = code[i];
        const auto is_like = [&](const Instruction& other) { return other.op == in.op && other.data == in.data; };
        s.source = std::ranges::count_if(code, is_like) == 1 ? in.data : Specialisation::no_source;
    }
    specialisations_ = found.first(count);
}

std::optional<ValueRanges> Encloser::value_ranges(const WorkingProgram& program) {
    const std::size_t size = program.code.size();
    // A fold of space may jump, in which case it has no gradient.
    if (context_.has_folds && std::ranges::any_of(program.code, [](const Instruction& in) { return is_fold(in.op); }))
        return std::nullopt;
    if (size > longest_enclosed && (size > 4 * longest_enclosed || !has_local_primitive(program))) return std::nullopt;
    enclose_values(program);

    // The margin covers the rounding error of a value evaluated for a ray and that of the value at the centre.
    const double margin = 2 * static_cast<double>(context_.value_error);
    const std::span<float> low = scratch_.allocate<float>(size), high = scratch_.allocate<float>(size);
    const auto set = [&](std::size_t i, const Interval& v) {
        low[i] = static_cast<float>(std::max(v.low - margin, -1e30));
        high[i] = static_cast<float>(std::min(v.high + margin, 1e30));
    };
    for (std::uint32_t i = 0; i < size; ++i) {
        const Interval& v = last_[i].value;
        if (!(v.low <= v.high)) return std::nullopt;  // The value is NaN somewhere.
        set(i, v);
    }
    for (const ProgramOutput& o : program.outputs) set(o.value, last_.of_output(o).value);
    return ValueRanges{low, high, program.lipschitz, last_, margin};
}

}  // namespace phasetree::bounding
