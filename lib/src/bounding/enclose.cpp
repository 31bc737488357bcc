#include "bounding/enclose.hpp"

#include <cmath>
#include <memory>

#include "bounding/cut.hpp"
#include "bounding/enclose_primitive.hpp"
#include "bounding/nearly_linear.hpp"
#include "bounding/plane_cut.hpp"
#include "evaluation/interpret.hpp"
#include "rewriting/readable_steps.hpp"

namespace phasetree::bounding {

using evaluation::interpret, evaluation::PointInRegisters;
using kernel::Step;
using program::gives_point, program::is_fold, program::traits;
using rewriting::give_slots, rewriting::has_local_primitive;

namespace {

/// A program's steps but for those whose result is known, for interpret().
struct StepsToTake {
    std::span<const Instruction> code;
    std::span<const std::uint32_t> known;
    const float* first_constant;
    std::span<std::uint32_t> slot;

    std::size_t size() const { return code.size(); }
    bool is_left_out(std::size_t i) const { return i == 0 || known[i] != 0; }
    Step step(std::size_t i) const {
        const Instruction& in = code[i];
        return {static_cast<std::uint32_t>(in.op), slot[i], slot[in.a], slot[in.b]};
    }
    const float* constants(std::size_t i) const { return first_constant + code[i].data; }
};

}  // namespace

Encloser::Encloser(const ProgramContext& context, const Bounds& box, std::span<const LocalValue> around, Arena& scratch)
    : context_(context), box_(box), scratch_(scratch), middle_(box.centre()), around_(around) {
    const glm::vec3 extent = box.extent();
    half_ = enclosure::detail::each_number(
        [&](std::size_t i) { return 0.5 * double{extent[static_cast<int>(i)]} * (1 + 1e-6); });
    input_ = std::construct_at(scratch.take<AffinePoint>(1).data(), AffinePoint::of_box(middle_, half_));
}

/// For each instruction its number in the last program, if it is a primitive, or a map of space, that was in it; or 0.
std::span<const std::uint32_t> Encloser::known_of(const WorkingProgram& program) const {
    const std::span<std::uint32_t> known = scratch_.take<std::uint32_t>(program.code.size());
    std::ranges::fill(known, 0u);
    std::size_t at = 0;  // mostly they are in the same order
    for (std::size_t i = 1; i < known.size() && !code_.empty(); ++i) {
        const Instruction& in = program.code[i];
        if (in.op < Op::first_primitive || (in.a != 0 && known[in.a] == 0)) continue;
        for (std::size_t tries = code_.size(); tries > 0 && known[i] == 0; --tries) {
            at = at + 1 < code_.size() ? at + 1 : 0;
            const Instruction& old = code_[at];
            if (old.op == in.op && old.data == in.data && old.a == known[in.a])
                known[i] = static_cast<std::uint32_t>(at);
        }
    }
    return known;
}

void Encloser::compute(const WorkingProgram& program) {
    const std::span<const std::uint32_t> known = known_of(program);
    const StepsToTake steps{program.code, known, context_.constants.data(), scratch_.take<std::uint32_t>(known.size())};
    const std::span<Enclosure> registers = scratch_.take<Enclosure>(give_slots(program, steps.slot));
    for (int i = 0; i < 3; ++i) {
        const auto k = static_cast<std::size_t>(i);
        std::construct_at(&registers[k], Enclosure::coordinate(i, middle_[i], half_[k]));
    }
    for (std::size_t i = 1; i < known.size(); ++i)
        if (known[i] != 0)
            std::copy_n(registers_ + slot_[known[i]], gives_point(program.code[i].op) ? 3 : 1,
                        registers.data() + steps.slot[i]);
    // What local primitives become: known of the last program, or found now, in their order.
    std::span<LocalValue> local{};
    if (context_.has_local_primitives && has_local_primitive(program)) {
        local = scratch_.take<LocalValue>(known.size());
        std::ranges::fill(local, LocalValue{});
        for (const LocalValue& v : local_)
            if (const auto now = std::ranges::find(known, v.value); now != known.end())
                local[static_cast<std::size_t>(now - known.begin())] = v;
    }
    // By the box's own point, if it is that; it is so of most primitives.
    const auto enclose_rounded = [&](const auto& solid, const auto& q, Enclosure& to) {
        if constexpr (std::is_same_v<decltype(q), const PointInRegisters<Enclosure>&>)
            if (q.slot == 0) return enclose_convex(solid, *input_, to);
        const std::optional<AffinePoint> affine = AffinePoint::of(q, half_);
        return affine && enclose_convex(solid, *affine, to);
    };
    std::size_t at = 0;
    interpret(
        steps, registers.data(),
        [&]<class P, class Point>(const float* c, const Point& q, Enclosure& to) {
            if constexpr (RoundedPrimitive<P>) {
                if (!enclose_rounded(program::read<P>(c), q, to)) {
                    to = enclose_primitive<P>(c, q);
                    tighten_by_bend(to, half_);
                }
            } else if constexpr (LongPrimitive<P>) {
                LocalValue found;
                std::span<const float> of;
                if constexpr (LocalPrimitive<P>) {
                    do ++at;
                    while (known[at] != 0 || !traits(program.code[at].op).is_local);
                    const auto source = static_cast<std::uint32_t>(c - context_.constants.data());
                    for (const LocalValue& v : around_)
                        if (v.source == source) of = v.data;
                }
                to = enclose_long_primitive<P>(c, q, half_, of, found, scratch_);
                if constexpr (LocalPrimitive<P>) local[at] = found;
            } else {
                to = enclose_primitive<P>(c, q);
                tighten_by_bend(to, half_);
            }
            to.tighten(half_);
        },
        [&](Enclosure& e) { e.tighten(half_); });
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < local.size(); ++i) {
        if (local[i].data.empty()) continue;
        LocalValue& v = local[count++] = local[i];
        v.value = i;
        const Instruction& in = program.code[i];
        const auto is_like = [&](const Instruction& other) { return other.op == in.op && other.data == in.data; };
        v.source = std::ranges::count_if(program.code, is_like) == 1 ? in.data : LocalValue::no_source;
    }
    local_ = local.first(count);
    code_ = program.code;
    slot_ = steps.slot;
    registers_ = registers.data();
}

/// Components are 1-Lipschitz, whatever their instructions are.
Enclosure Encloser::component(const ProgramOutput& o) const {
    Enclosure e = registers_[slot_[o.value]];
    for (Range& g : e.gradient) g = {std::max(g.low, -1.0), std::min(g.high, 1.0)};
    e.tighten(half_);
    return e;
}

std::optional<ValueRanges> Encloser::ranges(const WorkingProgram& program) {
    const std::size_t size = program.code.size();
    // A fold of space may jump, and then it has no gradient.
    if (context_.has_folds && std::ranges::any_of(program.code, [](const Instruction& in) { return is_fold(in.op); }))
        return std::nullopt;
    if (size > longest_enclosed && (size > 4 * longest_enclosed || !has_local_primitive(program))) return std::nullopt;
    compute(program);

    // Of a value, and of what is known at the centre.
    const double margin = 2 * static_cast<double>(context_.rounding);
    const std::span<float> low = scratch_.take<float>(size), high = scratch_.take<float>(size);
    const auto set = [&](std::size_t i, const Range& v) {
        low[i] = static_cast<float>(std::max(v.low - margin, -1e30));
        high[i] = static_cast<float>(std::min(v.high + margin, 1e30));
    };
    for (std::size_t i = 0; i < size; ++i) {
        const Range& v = registers_[slot_[i]].value;
        if (!(v.low <= v.high)) return std::nullopt;  // not a number somewhere
        set(i, v);
    }
    for (const ProgramOutput& o : program.outputs) set(o.value, component(o).value);
    return ValueRanges{low, high, program.lipschitz, program.code, registers_, slot_, half_, margin};
}

BoxKnowledge Encloser::rest(const WorkingProgram& program) const {
    BoxKnowledge result;
    result.box = box_;
    const bool is_shared = program.outputs.size() == 2 && program.outputs[0].value == program.outputs[1].value;
    const Enclosure f = component(program.outputs[0]);  // the first, but for its sign
    // Of s as Routine::is_by_own says, both ways.
    double by_others[] = {0, 0}, by_own[] = {0, 0}, of_first = 0;
    for (std::size_t i = 0; i < program.outputs.size(); ++i) {
        const Range& c = registers_[slot_[program.outputs[i].value]].curvature;
        const Range curvature = program.outputs[i].negate ? -c : c;
        if (i == 0) of_first = std::max(of_first, curvature.high);
        if (i > 0) by_others[0] = std::max(by_others[0], curvature.high);
        by_others[1] = std::max(by_others[1], curvature.high);
        by_own[i == 0 ? 0 : 1] = std::max(by_own[i == 0 ? 0 : 1], -curvature.low);
    }
    result.local = local_;
    const auto known = [](double most) {
        return most < 1e30 ? static_cast<float>(most) * (1 + 1e-3f) : Curvature::unknown;
    };
    result.curvature.is_by_own = by_own[0] + by_own[1] < by_others[0] + by_others[1];
    for (std::size_t i = 0; i < 2; ++i)
        result.curvature.bound[i] = known(result.curvature.is_by_own ? by_own[i] : by_others[i]);
    const auto is_clear = [&](const ProgramOutput& o) { return !context_.opaque.contains(o.phase); };
    result.curvature.is_by_first = is_shared || std::ranges::none_of(program.outputs.subspan(1), is_clear);
    if (!is_shared) result.curvature.bound[0] = known(by_own[0]);  // the first component is known by itself
    if (result.curvature.is_by_first) result.curvature.bound[1] = known(of_first);

    const NearlyLinear linear(f, half_);
    if (linear.slack < 1e30) {
        const glm::vec3 farthest = glm::max(glm::abs(box_.low), glm::abs(box_.high));
        const float size_of_numbers = std::max({farthest.x, farthest.y, farthest.z});
        for (int i = 0; i < 3; ++i)
            result.bound.normal[i] = static_cast<float>(linear.normal[static_cast<std::size_t>(i)]);
        result.bound.offset =
            static_cast<float>(linear.at_centre - glm::dot(glm::dvec3(result.bound.normal), glm::dvec3(box_.centre())));
        // What the linear part's own floats lose.
        result.bound.slack =
            static_cast<float>(linear.slack) * (1 + 1e-6f) + 3 * context_.rounding + 1e-6f * size_of_numbers;
        result.bound.spread =
            static_cast<float>(linear.spread(f, half_)) * (1 + 1e-3f) + 1e-5f;  // directions are that near unit length
    }
    // Where the other phases are opaque, rays meet no interface but the first component's.
    if (result.curvature.is_by_first) {
        const LinearBound& bound = result.bound;
        result.box = PlaneCut(linear, box_.centre(), cut_margin(box_, context_.rounding)).at(0, LaneBox(box_)).bounds();
        if (!(bound.slack < 0.15f * glm::dot(glm::abs(bound.normal), box_.extent())))
            result.box = cut_to_zero(program.outputs[0].value, result.box, box_, program, context_.constants,
                                     registers_, slot_, context_.rounding, scratch_);
        if (result.box.empty()) return result;
    }

    const auto is_blind = [&](std::size_t side) { return !(result.curvature.bound[side] < Curvature::unknown); };
    if ((is_blind(0) && is_clear(program.outputs[0])) || (is_shared && is_blind(1) && is_clear(program.outputs[1])))
        result.certificate = certify_sign(program, context_.constants, registers_, slot_, scratch_);

    return result;
}

}  // namespace phasetree::bounding
