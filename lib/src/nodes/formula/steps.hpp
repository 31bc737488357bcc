// The operations of a formula. Duplicates are recorded once, and operations are simplified where possible.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "phasetree/nodes/fields/formula.hpp"

namespace phasetree::nodes {

/// One operation of a formula, with earlier values as operands.
struct FormulaStep {
    formula::Op op{};
    std::uint32_t a = 0, b = 0, c = 0;
    double value = 0;        ///< of a constant, or the radius of a smooth minimum
    std::size_t offset = 0;  ///< position in the text, in bytes
};

/// The number of operands of an operation.
int operands(formula::Op);

/// The index of a step. Operands have lower indices than the steps that use them.
using FormulaIndex = std::uint32_t;

/// The maximum nesting depth of a formula and of its expressions.
inline constexpr int deepest_formula = 100;

/// Throws TextError at this position of the formula's text.
[[noreturn]] void fail_in_formula(std::size_t offset, const std::string& message);

/// The steps of a formula while it is read. Each member that returns an Index appends an operation, unless the same one
/// already exists, which is then reused. Operations on constants are evaluated immediately. A root of a sum of squares
/// becomes a length, because the slope of a length is bounded and that of a root is not.
///
/// Members throw TextError for undefined values (division by zero, numbers of 10³⁰ or more), for an exponent or a
/// radius that is not allowed, and for more than 2,000 steps.
class FormulaSteps {
  public:
    using Index = FormulaIndex;

    /// Sets the position in the text of the following steps.
    void stand_at(std::size_t offset) { offset_ = offset; }

    Index constant(double v);
    Index coordinate(formula::Op axis) { return emit({.op = axis}); }
    Index add(Index a, Index b);
    Index subtract(Index a, Index b);
    Index negate(Index a);
    Index multiply(Index a, Index b);
    Index divide(Index a, Index b);
    Index power(Index a, double n);
    /// The same with an exponent given as a step, which must be a constant.
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
    /// A function of one argument. `of` evaluates it for constants.
    Index function(formula::Op op, Index a, double (*of)(double)) {
        return is_constant(a) ? constant(of(value(a))) : emit({.op = op, .a = a});
    }

    /// The steps that a step needs, in order; the last is the step itself.
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

/// The steps that a step of a list needs, in order and renumbered; the last is the step itself.
std::vector<FormulaStep> needed_steps(const std::vector<FormulaStep>& all, FormulaIndex root);

}  // namespace phasetree::nodes
