#pragma once

#include <algorithm>

#include "pruning/required_interval.hpp"
#include "rewriting/working_program.hpp"

namespace phasetree::pruning {

using program::operands, program::ProgramOutput;
using rewriting::Arena, rewriting::WorkingProgram;

/// The rules of pruning: what an instruction becomes, given the ranges of its operands and the interval in which its
/// value is required, and what that requires of its operands. There is a function for each operation that has more than
/// one rule; `r` is the required interval of the instruction `in` with the index i.
///
/// Instructions are resolved from the last to the first, each after all that use its value. `Ranges` provides the
/// values' ranges: low(i), high(i), is_above(a, b, least) and slope[i].
template <class Ranges>
class OperationRules {
  public:
    /// All memory is in `scratch`. Call start() first.
    OperationRules(const WorkingProgram& program, const Ranges& ranges, std::span<const float> constants,
                   bool drops_far_bounds, Arena& scratch)
        : program_(program),
          constants_(constants),
          ranges_(ranges),
          drops_far_bounds_(drops_far_bounds),
          required_(scratch.allocate<RequiredInterval>(program.code.size())),
          replacement_(scratch.allocate<std::uint32_t>(program.code.size())),
          op_(scratch.allocate<Op>(program.code.size())) {}

    /// Requires the signs of these outputs, and nothing else.
    void start(std::span<const ProgramOutput> outputs) {
        std::ranges::fill(required_, RequiredInterval{});
        for (const ProgramOutput& o : outputs) require(o.value, RequiredInterval::threshold(0));
    }
    /// Applies the rules to an instruction whose value is required.
    void resolve(std::uint32_t i) {
        replacement_[i] = i;
        op_[i] = program_.code[i].op;
        apply(i);
    }

    const RequiredInterval& required(std::uint32_t i) const { return required_[i]; }
    /// What a resolved value becomes: itself or an earlier one.
    std::uint32_t replacement(std::uint32_t i) const { return replacement_[i]; }
    /// The operation of a resolved instruction, possibly changed.
    Op op(std::uint32_t i) const { return op_[i]; }
    /// Whether any value was replaced or any operation was changed.
    bool is_changed() const { return is_changed_; }

  private:
    float low(std::uint32_t i) const { return ranges_.low(i); }
    float high(std::uint32_t i) const { return ranges_.high(i); }
    bool is_above(std::uint32_t a, std::uint32_t b, float least = 0) const { return ranges_.is_above(a, b, least); }
    float constant(const Instruction& in) const { return constants_[in.data]; }

    /// Adds an interval to the requirements of a value.
    void require(std::uint32_t i, RequiredInterval r) { required_[i] = required_[i].hull(r); }
    /// Replaces a value by an earlier one.
    void replace(std::uint32_t i, std::uint32_t by) {
        replacement_[i] = by;
        is_changed_ = true;
        require(by, required_[i]);
    }
    /// Replaces an instruction's operation.
    void change(std::uint32_t i, Op op) {
        op_[i] = op;
        is_changed_ = true;
    }

    void apply(std::uint32_t i);
    void resolve_minimum(std::uint32_t i);
    void resolve_maximum(std::uint32_t i);
    void resolve_smooth_minimum(std::uint32_t i);
    void resolve_guarded(std::uint32_t i);
    void resolve_sum(std::uint32_t i);
    void resolve_difference(std::uint32_t i);
    void resolve_corner(std::uint32_t i);
    void resolve_nearer(std::uint32_t i);
    void resolve_absolute(std::uint32_t i);
    void resolve_product(std::uint32_t i);
    struct Choice {
        bool is_a, is_b;                          ///< whether an operand may replace the extremum
        RequiredInterval required_a, required_b;  ///< what is required of the operands if neither replaces it
    };
    void resolve_extremum(std::uint32_t i, const Choice&);
    bool is_leaf(std::uint32_t i) const;
    bool is_zero(std::uint32_t i) const;

    const WorkingProgram& program_;
    std::span<const float> constants_;
    const Ranges& ranges_;
    bool drops_far_bounds_;
    std::span<RequiredInterval> required_;
    std::span<std::uint32_t> replacement_;
    std::span<Op> op_;
    bool is_changed_ = false;
};

template <class Ranges>
void OperationRules<Ranges>::apply(std::uint32_t i) {
    const Instruction& in = program_.code[i];
    const RequiredInterval r = required_[i];
    if (in.op >= Op::first_primitive) {
        required_[in.a] = RequiredInterval::all();  // The operand is a point.
        return;
    }
    switch (in.op) {
        case Op::minimum:
            return resolve_minimum(i);
        case Op::far_bound:
            if (r.is_sign() && drops_far_bounds_) return replace(i, in.a);
            return resolve_maximum(i);
        case Op::far_bound_inside:
            if (r.is_sign() && drops_far_bounds_) return replace(i, in.a);
            return resolve_minimum(i);
        case Op::maximum:
            return resolve_maximum(i);
        case Op::smooth_minimum:
            return resolve_smooth_minimum(i);
        case Op::guarded:
            return resolve_guarded(i);
        case Op::falloff:
            return require(in.a, {-Bounds::infinity, constant(in)});  // Beyond this distance it is zero.
        case Op::add:
            return resolve_sum(i);
        case Op::subtract:
            return resolve_difference(i);
        case Op::corner:
            return resolve_corner(i);
        case Op::nearer:
            return resolve_nearer(i);
        case Op::absolute:
            return resolve_absolute(i);
        case Op::negate:
            return require(in.a, r.negated());
        case Op::add_constant:
            return require(in.a, {r.low() - constant(in), r.high() - constant(in)});
        case Op::constant_minus:
            return require(in.a, {constant(in) - r.high(), constant(in) - r.low()});
        case Op::multiply_constant:
            return resolve_product(i);
        default:
            if (operands(in.op) > 0) require(in.a, RequiredInterval::all());
            if (operands(in.op) > 1) require(in.b, RequiredInterval::all());
    }
}

template <class Ranges>
void OperationRules<Ranges>::resolve_minimum(std::uint32_t i) {
    const Instruction& in = program_.code[i];
    const RequiredInterval r = required_[i];
    const float low_a = low(in.a), high_a = high(in.a), low_b = low(in.b), high_b = high(in.b);
    // If a is above b, or above r, then b replaces the minimum: either b is the minimum, or both are above r. Likewise,
    // a replaces it if b is above a or above r. An operand below r also replaces the minimum, which is then below r as
    // well.
    const bool is_b_surely = is_above(in.a, in.b) | bool(low_a > r.high());
    const bool is_a = is_above(in.b, in.a) | ((!is_b_surely) & (bool(low_b > r.high()) | bool(high_a < r.low())));
    const bool is_b = is_b_surely | bool(high_b < r.low());
    // Above the largest value of the other operand, an operand does not matter, because the minimum is the other one
    // there.
    resolve_extremum(i, {is_a, is_b, r.below(high_b), r.below(high_a)});
}

template <class Ranges>
void OperationRules<Ranges>::resolve_maximum(std::uint32_t i) {
    const Instruction& in = program_.code[i];
    const RequiredInterval r = required_[i];
    const float low_a = low(in.a), high_a = high(in.a), low_b = low(in.b), high_b = high(in.b);
    // If a is below b, or below r, then b replaces the maximum: either b is the maximum, or both are below r. Likewise,
    // a replaces it if b is below a or below r. An operand above r also replaces the maximum, which is then above r as
    // well.
    const bool is_b_surely = is_above(in.b, in.a) | bool(high_a < r.low());
    const bool is_a = is_above(in.a, in.b) | ((!is_b_surely) & (bool(high_b < r.low()) | bool(low_a > r.high())));
    const bool is_b = is_b_surely | bool(low_b > r.high());
    // Below the smallest value of the other operand, an operand does not matter, because the maximum is the other one
    // there.
    resolve_extremum(i, {is_a, is_b, r.above(low_b), r.above(low_a)});
}

/// Replaces a minimum or maximum by one of its operands (by a if both are possible), or keeps it. The code has no
/// branches, because about half of the comparisons here would be mispredicted. If one operand replaces the result, both
/// calls of require() get this operand and the same interval; the second has no effect.
template <class Ranges>
void OperationRules<Ranges>::resolve_extremum(std::uint32_t i, const Choice& choice) {
    const Instruction& in = program_.code[i];
    const RequiredInterval r = required_[i];
    const std::uint32_t first = (choice.is_b & (!choice.is_a)) ? in.b : in.a, second = choice.is_a ? in.a : in.b;
    const bool is_replaced = choice.is_a | choice.is_b;
    replacement_[i] = is_replaced ? first : i;
    is_changed_ |= is_replaced;
    require(first, is_replaced ? r : choice.required_a);
    require(second, is_replaced ? r : choice.required_b);
}

/// min(a, b) − ρ/6 · max(1 − |b − a|/ρ, 0)³ with the blending radius ρ (smooth_min in math/number.hpp).
template <class Ranges>
void OperationRules<Ranges>::resolve_smooth_minimum(std::uint32_t i) {
    const Instruction& in = program_.code[i];
    const RequiredInterval r = required_[i];
    const float radius = constant(in);
    // Operands that differ by more than the radius are not blended.
    if (is_above(in.b, in.a, radius)) return replace(i, in.a);
    if (is_above(in.a, in.b, radius)) return replace(i, in.b);
    // If a is above r by more than the radius, b replaces the smooth minimum:
    //  - Where b ≤ r.high, it is more than the radius below a, so it is the smooth minimum.
    //  - Where b > r.high, the smooth minimum is above r as well. If b is the smaller, blending lowers it by at most a
    //    sixth of ρ − (a − b), which is less than b − r.high because a > r.high + ρ. If a is the smaller, it is above r
    //    by more than ρ, and is lowered by at most a sixth of ρ.
    // The same holds with a and b exchanged.
    if (low(in.a) > r.high() + radius) return replace(i, in.b);
    if (low(in.b) > r.high() + radius) return replace(i, in.a);
    // The smooth minimum is at most either operand, so it is below r if one of them is.
    if (high(in.a) < r.low()) return replace(i, in.a);
    if (high(in.b) < r.low()) return replace(i, in.b);
    // For the same reasons, an operand does not matter below r, more than the radius above r, or more than the radius
    // above the largest value of the other.
    require(in.a, {r.low(), std::min(r.high(), high(in.b)) + radius});
    require(in.b, {r.low(), std::min(r.high(), high(in.a)) + radius});
}

/// max(a, min(b, c − a)), where a is the bound, which is continuous, and b is the field, which may jump (`guarded` in
/// math/number.hpp).
template <class Ranges>
void OperationRules<Ranges>::resolve_guarded(std::uint32_t i) {
    const Instruction& in = program_.code[i];
    const RequiredInterval r = required_[i];
    // Where a > c/2, c − a is below a, so the maximum is a. Where a is above r, so is the maximum.
    const float half = 0.5f * constant(in);
    if (low(in.a) > std::min(half, r.high())) return replace(i, in.a);
    // max(a, b) has the same sign. Where a is positive, both are positive; elsewhere, c − a is positive, so min(b, c −
    // a) has the sign of b. So max(a, b) can replace it if b does not jump. If b jumps, its slope is far more than
    // twice that of a (FoldMap::jump).
    if (r.is_sign() && ranges_.slope[in.b] <= 2 * ranges_.slope[in.a]) {
        change(i, Op::maximum);
        return resolve_maximum(i);
    }
    // The bound a itself is required, because c − a depends on it. The field b does not matter below the smallest value
    // of a, because the maximum is a there. It does not matter below r, because min(b, c − a) is then below r, too. Nor
    // does it matter above r, because min(b, c − a) is then above r or equals c − a.
    require(in.a, RequiredInterval::all());
    require(in.b, {std::max(r.low(), low(in.a)), r.high()});
}

template <class Ranges>
void OperationRules<Ranges>::resolve_sum(std::uint32_t i) {
    const Instruction& in = program_.code[i];
    const RequiredInterval r = required_[i];
    if (is_zero(in.a)) return replace(i, in.b);
    if (is_zero(in.b)) return replace(i, in.a);
    // One operand is required in an interval widened by the range of the other, which must then stay unchanged.
    if (is_leaf(in.a)) {
        require(in.a, RequiredInterval::all());
        return require(in.b, {r.low() - high(in.a), r.high() - low(in.a)});
    }
    require(in.b, RequiredInterval::all());
    require(in.a, {r.low() - high(in.b), r.high() - low(in.b)});
}

template <class Ranges>
void OperationRules<Ranges>::resolve_difference(std::uint32_t i) {
    const Instruction& in = program_.code[i];
    const RequiredInterval r = required_[i];
    if (is_leaf(in.a)) {
        require(in.a, RequiredInterval::all());
        return require(in.b, {low(in.a) - r.high(), high(in.a) - r.low()});
    }
    require(in.b, RequiredInterval::all());
    require(in.a, {r.low() + low(in.b), r.high() + high(in.b)});
}

/// The corner of a and b is max(a, b) where that is negative, and otherwise the length of the vector (max(a, 0), max(b,
/// 0)). So it is at least as large as either operand.
template <class Ranges>
void OperationRules<Ranges>::resolve_corner(std::uint32_t i) {
    const Instruction& in = program_.code[i];
    const RequiredInterval r = required_[i];
    // If one operand is negative and the smaller, the corner is the other.
    if (high(in.a) < 0 && is_above(in.b, in.a)) return replace(i, in.b);
    if (high(in.b) < 0 && is_above(in.a, in.b)) return replace(i, in.a);
    // An operand below `least` is negative and below r. If it is the smaller, the corner is the other operand.
    // Otherwise both operands are below r, and so is the corner, which is their maximum.
    const float least = std::min(r.low(), 0.f);
    if (high(in.a) < least) return replace(i, in.b);
    if (high(in.b) < least) return replace(i, in.a);
    // An operand above r replaces the corner, which is then above r as well.
    if (low(in.a) > r.high()) return replace(i, in.a);
    if (low(in.b) > r.high()) return replace(i, in.b);
    // For the same reasons, an operand does not matter in three ranges: below `least`; where it is negative and below
    // every value of the other operand; and above r.
    require(in.a, {std::max(least, std::min(low(in.b), 0.f)), r.high()});
    require(in.b, {std::max(least, std::min(low(in.a), 0.f)), r.high()});
}

/// max(a, (a − b)/2) is negative where a is negative and less than b.
template <class Ranges>
void OperationRules<Ranges>::resolve_nearer(std::uint32_t i) {
    const Instruction& in = program_.code[i];
    const RequiredInterval r = required_[i];
    // It is at least a, so it is above r where a is.
    if (low(in.a) > r.high()) return replace(i, in.a);
    if (!r.is_sign()) {
        require(in.a, RequiredInterval::all());
        return require(in.b, RequiredInterval::all());
    }
    // Where b is positive or above a, the sign is that of a.
    if (low(in.b) > 0 || is_above(in.b, in.a)) return replace(i, in.a);
    // Only the sign of max((a − b)/2, a) matters, so only negative values do. An operand below every possible value of
    // the other is certainly the smaller of the two, and how far below does not change the sign.
    require(in.a, {std::min(low(in.b), 0.f), 0});
    require(in.b, {std::min(low(in.a), 0.f), 0});
}

template <class Ranges>
void OperationRules<Ranges>::resolve_absolute(std::uint32_t i) {
    const Instruction& in = program_.code[i];
    const RequiredInterval r = required_[i];
    if (low(in.a) > 0) return replace(i, in.a);
    if (high(in.a) < 0) {
        change(i, Op::negate);
        return require(in.a, r.negated());
    }
    require(in.a, {-std::max(r.high(), 0.f), std::max(r.high(), 0.f)});
}

template <class Ranges>
void OperationRules<Ranges>::resolve_product(std::uint32_t i) {
    const Instruction& in = program_.code[i];
    const RequiredInterval r = required_[i];
    const float c = constant(in);
    if (c == 0) return require(in.a, RequiredInterval::all());
    const float one = r.low() / c, other = r.high() / c;
    require(in.a, {std::min(one, other), std::max(one, other)});
}

/// Whether pruning cannot delete any part of what computes a value.
template <class Ranges>
bool OperationRules<Ranges>::is_leaf(std::uint32_t i) const {
    const Instruction& in = program_.code[i];
    return in.op >= Op::first_primitive || (in.op == Op::multiply_constant && is_leaf(in.a));
}

/// Whether a value is exactly zero in the whole region, such as the falloff of a skeleton out of reach.
template <class Ranges>
bool OperationRules<Ranges>::is_zero(std::uint32_t i) const {
    const Instruction& in = program_.code[i];
    if (in.op == Op::multiply_constant) return is_zero(in.a);
    return in.op == Op::falloff && low(in.a) > constant(in);
}

}  // namespace phasetree::pruning
