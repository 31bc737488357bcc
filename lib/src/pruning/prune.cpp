#include "pruning/prune.hpp"

#include <algorithm>
#include <cmath>

#include "pruning/required_interval.hpp"
#include "rewriting/live_set.hpp"
#include "rewriting/rewrite.hpp"

/// Two kinds of pruning, in one backward sweep over the program.
///
/// *By value* (Barbier et al. 2025): in min(a, b), if b − a at the centre exceeds what both can change by within the
/// ball, b never wins and goes; likewise for max and smooth_min. In a box, where gradients are known, if it exceeds
/// what the difference can change by.
///
/// *By what is demanded*: of an output only the sign matters. sign(max(a, b) − τ) is that of b − τ if a stays below τ
/// throughout; if one of the two stays above, that decides and the other goes. Negation, offsets and scaling only move
/// τ. And of a in min(a, b) nothing matters above the most that b can be, for b is what is taken there. So each value
/// is demanded between two numbers: what it is between them, and else only which side it is on. That reaches down a
/// chain of minima to links that are far from the box, though each of them is too near the next one to be told from it.
///
/// What stands in for a value is the same where that is between the two numbers, and beyond the same one where it is
/// not. Both operands of a minimum may be replaced at once: the smaller, a, is not above the most that b can be, so it
/// stays what it is; and what stands in for b is b, or not below the most that a can be.
///
/// A value that stands in has the same sign relative to a threshold and is itself Lipschitz, so its distance from that
/// still bounds the distance to where the sign changes.
namespace phasetree::pruning {

using program::is_far_bound, program::operands, program::ProgramOutput;
using rewriting::ArenaScope, rewriting::LiveSet, rewriting::Rewriter, rewriting::SignedValue;

namespace {

/// Where two phases meet, one component tells both. The one that costs less.
WorkingProgram one_of_two(const WorkingProgram& both, Arena& keep, Arena& scratch) {
    ProgramOutput outputs[2][2];
    for (const std::size_t k : {0, 1}) {
        const ProgramOutput& kept = both.outputs[k];
        outputs[k][k] = kept;
        outputs[k][1 - k] = {both.outputs[1 - k].phase, kept.value, !kept.negate};
    }
    const LiveSet first(both, outputs[0], scratch), second(both, outputs[1], scratch);
    return (second.size() < first.size() ? second : first).program(keep, scratch);
}

/// Of which nothing is known.
struct RangesAnywhere {
    std::span<const float> slope;

    float low(std::uint32_t) const { return -Bounds::infinity; }
    float high(std::uint32_t) const { return Bounds::infinity; }
    bool is_above(std::uint32_t, std::uint32_t, float) const { return false; }
};

template <class Ranges>
class Pruner {
  public:
    Pruner(const WorkingProgram& program, std::span<const float> constants, const Ranges& ranges, PhaseSet opaque,
           bool is_near, Arena& scratch)
        : program_(program),
          constants_(constants),
          ranges_(ranges),
          opaque_(opaque),
          is_near_(is_near),
          scratch_(scratch),
          required_(scratch.take<RequiredInterval>(program.code.size())),
          instead_(scratch.take<std::uint32_t>(program.code.size())),
          op_(scratch.take<Op>(program.code.size())),
          demanded_(scratch.take<std::uint32_t>(program.code.size())) {}

    std::optional<WorkingProgram> run(Arena& keep) {
        const std::span<ProgramOutput> room = scratch_.take<ProgramOutput>(program_.outputs.size());
        std::size_t count = 0;
        for (const ProgramOutput& o : program_.outputs) {
            const float low = o.negate ? -high(o.value) : this->low(o.value);
            const float high = o.negate ? -this->low(o.value) : this->high(o.value);
            if (high < 0) return std::nullopt;  // this phase everywhere
            if (low <= 0) room[count++] = o;
        }
        const std::span<const ProgramOutput> outputs = room.first(count);
        if (!has_interface(outputs)) return std::nullopt;

        std::ranges::fill(required_, RequiredInterval{});
        for (const ProgramOutput& o : outputs) ask(o.value, RequiredInterval::threshold(0));
        for (auto i = static_cast<std::uint32_t>(program_.code.size()); i-- > 1;)
            if (!required_[i].is_none()) {
                demanded_[demanded_count_++] = i;
                instead_[i] = i;
                op_[i] = program_.code[i].op;
                resolve(i);
            }
        if (is_all_left(outputs)) return program_;
        const WorkingProgram left = rewritten(outputs);
        if (!has_interface(left.outputs)) return std::nullopt;
        if (left.outputs.size() == 2 && left.outputs[0].value != left.outputs[1].value)
            return one_of_two(left, keep, scratch_);
        return LiveSet(left, left.outputs, scratch_).program(keep, scratch_);
    }

  private:
    /// Not one phase everywhere, nor opaque ones only.
    bool has_interface(std::span<const ProgramOutput> outputs) const {
        return outputs.size() > 1 &&
               !std::ranges::all_of(outputs, [&](const ProgramOutput& o) { return opaque_.contains(o.phase); });
    }
    /// Whether every instruction is still what it was. Pruning wrote them as short as it could when it made them.
    bool is_all_left(std::span<const ProgramOutput> outputs) const {
        return !is_changed_ && outputs.size() == program_.outputs.size() &&
               (outputs.size() != 2 || outputs[0].value == outputs[1].value) &&
               ranges_.slope.data() == program_.lipschitz.data() && demanded_count_ + 1 == program_.code.size();
    }
    void ask(std::uint32_t i, RequiredInterval d) { required_[i] = required_[i].with(d); }

    /// What is demanded, written anew; without phases whose component is nowhere negative.
    WorkingProgram rewritten(std::span<const ProgramOutput> outputs) {
        Rewriter rewriter(constants_, demanded_count_, scratch_);
        const std::span<SignedValue> written = scratch_.take<SignedValue>(program_.code.size());
        written[0] = {};
        const std::span<const Instruction> code = program_.code;
        const std::span<const float> slope = ranges_.slope;
        for (std::size_t k = demanded_count_; k-- > 0;) {
            const std::uint32_t i = demanded_[k];
            if (instead_[i] != i) {
                written[i] = written[instead_[i]];
                continue;
            }
            const Instruction& in = code[i];
            written[i] =
                rewriter.write(op_[i], written[in.a], written[in.b], in.data, slope[i], required_[i].is_sign());
        }
        const std::span<ProgramOutput> ends = scratch_.take<ProgramOutput>(outputs.size());
        std::size_t count = 0;
        for (const ProgramOutput& o : outputs) {
            const SignedValue& v = written[o.value];
            const bool is_negative = v.is_negative() != o.negate;
            if (is_negative || rewriter.code()[v.id()].op != Op::absolute)
                ends[count++] = {o.phase, v.id(), is_negative};
        }
        return {rewriter.code(), rewriter.lipschitz(), ends.first(count)};
    }
    float low(std::uint32_t i) const { return ranges_.low(i); }
    float high(std::uint32_t i) const { return ranges_.high(i); }
    bool is_above(std::uint32_t a, std::uint32_t b, float least = 0) const { return ranges_.is_above(a, b, least); }

    void replace(std::uint32_t i, std::uint32_t by) {
        instead_[i] = by;
        is_changed_ = true;
        ask(by, required_[i]);
    }

    void resolve(std::uint32_t i) {
        const Instruction& in = program_.code[i];
        const RequiredInterval d = required_[i];
        const auto constant = [&] { return constants_[in.data]; };
        if (in.op >= Op::first_primitive) {
            required_[in.a] = RequiredInterval::value();
            return;
        }
        switch (in.op) {
            case Op::minimum:
                return resolve_minimum(i, d);
            case Op::far_bound:
                if (d.is_sign() && is_near_) return replace(i, in.a);
                return resolve_maximum(i, d);
            case Op::far_bound_inside:
                if (d.is_sign() && is_near_) return replace(i, in.a);
                return resolve_minimum(i, d);
            case Op::maximum:
                return resolve_maximum(i, d);
            case Op::smooth_minimum: {
                const float r = constant();
                if (is_above(in.b, in.a, r)) return replace(i, in.a);
                if (is_above(in.a, in.b, r)) return replace(i, in.b);
                // More than r above all that is demanded, what a takes off b is less than what b is above it.
                if (low(in.a) > d.most() + r) return replace(i, in.b);
                if (low(in.b) > d.most() + r) return replace(i, in.a);
                if (high(in.a) < d.least()) return replace(i, in.a);
                if (high(in.b) < d.least()) return replace(i, in.b);
                ask(in.a, {d.least(), std::min(d.most(), high(in.b)) + r});
                ask(in.b, {d.least(), std::min(d.most(), high(in.a)) + r});
                return;
            }
            case Op::guarded: {
                const float half = 0.5f * constant();
                if (low(in.a) > std::min(half, d.most())) return replace(i, in.a);
                // Without a jump the plain intersection has the same sign.
                if (d.is_sign() && ranges_.slope[in.b] <= 2 * ranges_.slope[in.a]) {
                    op_[i] = Op::maximum;
                    is_changed_ = true;
                    return resolve_maximum(i, d);
                }
                ask(in.a, RequiredInterval::value());
                return ask(in.b, {std::max(d.least(), low(in.a)), d.most()});
            }
            case Op::falloff:
                return ask(in.a, {-Bounds::infinity, constant()});
            case Op::add:
                // A skeleton out of reach adds nothing.
                if (is_zero(in.a)) return replace(i, in.b);
                if (is_zero(in.b)) return replace(i, in.a);
                // Of one of the two, by how much the other can add. The other must then be itself.
                if (is_single(in.a)) {
                    ask(in.a, RequiredInterval::value());
                    return ask(in.b, {d.least() - high(in.a), d.most() - low(in.a)});
                }
                ask(in.b, RequiredInterval::value());
                return ask(in.a, {d.least() - high(in.b), d.most() - low(in.b)});
            case Op::subtract:
                if (is_single(in.a)) {
                    ask(in.a, RequiredInterval::value());
                    return ask(in.b, {low(in.a) - d.most(), high(in.a) - d.least()});
                }
                ask(in.b, RequiredInterval::value());
                return ask(in.a, {d.least() + low(in.b), d.most() + high(in.b)});
            case Op::corner: {
                // Where one is negative and the smaller, the corner is the other.
                if (high(in.a) < 0 && is_above(in.b, in.a)) return replace(i, in.b);
                if (high(in.b) < 0 && is_above(in.a, in.b)) return replace(i, in.a);
                const float below = std::min(d.least(), 0.f);
                if (high(in.a) < below) return replace(i, in.b);
                if (high(in.b) < below) return replace(i, in.a);
                if (low(in.a) > d.most()) return replace(i, in.a);
                if (low(in.b) > d.most()) return replace(i, in.b);
                // Above 0 both matter, unless one of them is negative and the smaller.
                ask(in.a, {std::max(below, std::min(low(in.b), 0.f)), d.most()});
                ask(in.b, {std::max(below, std::min(low(in.a), 0.f)), d.most()});
                return;
            }
            case Op::absolute:
                if (low(in.a) > 0) return replace(i, in.a);
                if (high(in.a) < 0) {
                    op_[i] = Op::negate;
                    is_changed_ = true;
                    return ask(in.a, d.negated());
                }
                return ask(in.a, {-std::max(d.most(), 0.f), std::max(d.most(), 0.f)});
            case Op::negate:
                return ask(in.a, d.negated());
            case Op::add_constant:
                return ask(in.a, {d.least() - constant(), d.most() - constant()});
            case Op::constant_minus:
                return ask(in.a, {constant() - d.most(), constant() - d.least()});
            case Op::multiply_constant: {
                const float c = constant();
                if (c == 0) return ask(in.a, RequiredInterval::value());
                const float one = d.least() / c, other = d.most() / c;
                return ask(in.a, {std::min(one, other), std::max(one, other)});
            }
            default:
                if (operands(in.op) > 0) ask(in.a, RequiredInterval::value());
                if (operands(in.op) > 1) ask(in.b, RequiredInterval::value());
        }
    }

    /// Of either operand no more matters than is below the other.
    void resolve_minimum(std::uint32_t i, const RequiredInterval& d) {
        const Instruction& in = program_.code[i];
        const float low_a = low(in.a), high_a = high(in.a), low_b = low(in.b), high_b = high(in.b);
        const bool is_b_first = is_above(in.a, in.b) | bool(low_a > d.most());
        const bool is_a = is_above(in.b, in.a) | ((!is_b_first) & (bool(low_b > d.most()) | bool(high_a < d.least())));
        take(i, is_a, is_b_first | bool(high_b < d.least()), d, d.below(high_b), d.below(high_a));
    }

    void resolve_maximum(std::uint32_t i, const RequiredInterval& d) {
        const Instruction& in = program_.code[i];
        const float low_a = low(in.a), high_a = high(in.a), low_b = low(in.b), high_b = high(in.b);
        const bool is_b_first = is_above(in.b, in.a) | bool(high_a < d.least());
        const bool is_a = is_above(in.a, in.b) | ((!is_b_first) & (bool(high_b < d.least()) | bool(low_a > d.most())));
        take(i, is_a, is_b_first | bool(low_b > d.most()), d, d.above(low_b), d.above(low_a));
    }

    /// One of its operands in its place, a if both may be, or nothing. Here, where every other comparison surprises the
    /// processor, without a branch: what is demanded twice in the same way is demanded once.
    void take(std::uint32_t i, bool is_a, bool is_b, const RequiredInterval& d, const RequiredInterval& of_a,
              const RequiredInterval& of_b) {
        const Instruction& in = program_.code[i];
        const std::uint32_t first = (is_b & (!is_a)) ? in.b : in.a, second = is_a ? in.a : in.b;
        const bool is_one = is_a | is_b;
        instead_[i] = is_one ? first : i;
        is_changed_ |= is_one;
        ask(first, is_one ? d : of_a);
        ask(second, is_one ? d : of_b);
    }

    /// Whether pruning could take nothing from a value.
    bool is_single(std::uint32_t i) const {
        const Instruction& in = program_.code[i];
        return in.op >= Op::first_primitive || (in.op == Op::multiply_constant && is_single(in.a));
    }

    /// Whether a value is exactly zero throughout the ball.
    bool is_zero(std::uint32_t i) const {
        const Instruction& in = program_.code[i];
        if (in.op == Op::multiply_constant) return is_zero(in.a);
        return in.op == Op::falloff && low(in.a) > constants_[in.data];
    }

    const WorkingProgram& program_;
    std::span<const float> constants_;
    const Ranges& ranges_;
    PhaseSet opaque_;
    bool is_near_;  ///< bounds for far away go
    Arena& scratch_;
    std::span<RequiredInterval> required_;
    std::span<std::uint32_t> instead_;  ///< what a value is replaced by: itself, or an earlier one
    std::span<Op> op_;
    std::span<std::uint32_t> demanded_;  ///< what is, from the last one on
    std::size_t demanded_count_ = 0;
    bool is_changed_ = false;
};

template <class Ranges>
std::optional<WorkingProgram> pruned(const WorkingProgram& program, std::span<const float> constants,
                                     const Ranges& ranges, PhaseSet opaque, bool is_near, Arena& keep, Arena& scratch) {
    const ArenaScope scope(scratch);
    return Pruner<Ranges>(program, constants, ranges, opaque, is_near, scratch).run(keep);
}

}  // namespace

std::optional<WorkingProgram> prune(const WorkingProgram& program, std::span<const float> constants,
                                    const ValueRanges& ranges, PhaseSet opaque, Arena& keep, Arena& scratch) {
    return pruned(program, constants, ranges, opaque, false, keep, scratch);
}
std::optional<WorkingProgram> prune(const WorkingProgram& program, std::span<const float> constants,
                                    const RangesInBall& ranges, PhaseSet opaque, Arena& keep, Arena& scratch) {
    return pruned(program, constants, ranges, opaque, false, keep, scratch);
}

std::optional<WorkingProgram> without_far_bounds(const WorkingProgram& program, std::span<const float> constants,
                                                 PhaseSet opaque, Arena& keep, Arena& scratch) {
    const ArenaScope scope(scratch);
    if (std::ranges::none_of(program.code, [](const Instruction& in) { return is_far_bound(in.op); }))
        return std::nullopt;
    return pruned(program, constants, RangesAnywhere{program.lipschitz}, opaque, true, keep, scratch);
}

}  // namespace phasetree::pruning
