// The values of a formula's term in a box, and two bounds of the slope of each value, of which the smaller is used. One
// is the longest vector in the range of the gradient, in which terms that cancel do cancel. The other follows from the
// slopes of the operands by a rule for each operation; it is better for lengths.
#pragma once

#include <array>
#include <vector>

#include "nodes/formula/box.hpp"
#include "nodes/formula/terms.hpp"

namespace phasetree::nodes {

class TermInBox {
  public:
    void run(const TermSteps& term, const BoxOfDoubles& box);
    /// The bound of the slope of the whole term, and its enclosure.
    double bound() const { return slopes_.back(); }
    const enclosure::Enclosure& result() const { return values_.back(); }
    /// The bound of the slope of one of its steps.
    double slope(std::size_t i) const { return slopes_[i]; }

  private:
    double slope_of(const FormulaStep& s) const;
    double slope_of_length(const std::array<FormulaIndex, 3>& of, std::size_t n) const;

    std::vector<enclosure::Enclosure> values_;
    std::vector<double> slopes_;
};

}  // namespace phasetree::nodes
