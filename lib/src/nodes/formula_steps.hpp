// The operations of a formula, and how they are written down: each once, and simpler ones where that is possible.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "phasetree/nodes/fields/formula.hpp"

namespace phasetree::nodes {

/// One operation of a formula, on values before it.
struct FormulaStep {
    formula::Op op{};
    std::uint32_t a = 0, b = 0, c = 0;
    double value = 0;        ///< of a constant; the radius of a smooth minimum
    std::size_t offset = 0;  ///< where in the text it stands, in bytes
};

/// How many values an operation takes.
int operands(formula::Op);

/// The index of a step. Operands have lower indices than what is made of them.
using FormulaIndex = std::uint32_t;

/// No formula, and no expression in one, is nested deeper than this.
inline constexpr int deepest_formula = 100;

/// Throws TextError about the place in the formula's text.
[[noreturn]] void fail_in_formula(std::size_t offset, const std::string& message);

/// The steps of a formula while it is read. Each member that returns an Index appends an operation, unless the same one
/// is there already, which is then meant again. Operations on constants are computed at once. A root of a sum of
/// squares becomes a length, because the slope of a length has a bound and that of a root has none. Members throw
/// TextError for what has no value (a division by zero, a number of 10³⁰ or more), for an exponent or a radius that is
/// not allowed, and for more than 2,000 steps.
class FormulaSteps {
  public:
    using Index = FormulaIndex;

    /// Where in the text the steps stand that follow.
    void stand_at(std::size_t offset) { offset_ = offset; }

    Index constant(double v);
    Index coordinate(formula::Op axis) { return emit({.op = axis}); }
    Index add(Index a, Index b);
    Index subtract(Index a, Index b);
    Index negate(Index a);
    Index multiply(Index a, Index b);
    Index divide(Index a, Index b);
    Index power(Index a, double n);
    /// The same with an exponent that has been read as a step; it must be a constant.
    Index power_of(Index a, Index exponent);
    Index square_root(Index a);
    Index length_of(Index a, Index b) { return emit({.op = formula::Op::length_of_two, .a = a, .b = b}); }
    Index length_of(Index a, Index b, Index c) {
        return emit({.op = formula::Op::length_of_three, .a = a, .b = b, .c = c});
    }
    Index absolute(Index a);
    Index minimum(Index a, Index b);
    Index maximum(Index a, Index b);
    Index smooth_minimum(Index a, Index b, Index radius);
    /// A function of one argument, which `of` computes where that is constant.
    Index function(formula::Op op, Index a, double (*of)(double)) {
        return is_constant(a) ? constant(of(value(a))) : emit({.op = op, .a = a});
    }

    /// The steps that one of them needs, in their order; it is the last.
    std::vector<FormulaStep> needed_for(Index result) const;

  private:
    using Key = std::tuple<formula::Op, Index, Index, Index, double>;

    Index emit(FormulaStep s);
    bool is_constant(Index i) const { return steps_[i].op == formula::Op::constant; }
    bool are_constant(Index a, Index b) const { return is_constant(a) && is_constant(b); }
    bool is(Index i, double v) const { return is_constant(i) && steps_[i].value == v; }
    double value(Index i) const { return steps_[i].value; }
    bool collect_squares(Index i, std::vector<Index>& sides, int depth = 0);

    std::vector<FormulaStep> steps_;
    std::map<Key, Index> known_;
    std::size_t offset_ = 0;
};

/// The steps that one step of a list needs, in their order and renumbered; it is the last.
std::vector<FormulaStep> needed_steps(const std::vector<FormulaStep>& all, FormulaIndex root);

}  // namespace phasetree::nodes
