// The values of a formula's term in a box, and a bound of the slope of each. The box of a value's gradient knows what
// cancels; a rule for each operation knows what that does not: a length is no steeper than the vector that it is of.
// The smaller of the two bounds counts.
#pragma once

#include <array>
#include <vector>

#include "nodes/formula_box.hpp"
#include "nodes/formula_terms.hpp"

namespace phasetree::nodes {

class TermInBox {
  public:
    void run(const TermSteps& term, const BoxOfDoubles& box);
    /// Of the whole term.
    double bound() const { return slopes_.back(); }
    const enclosure::Enclosure& result() const { return values_.back(); }
    /// Of one of its steps.
    double slope(std::size_t i) const { return slopes_[i]; }

  private:
    double slope_of(const FormulaStep& s) const;
    double slope_of_length(const std::array<FormulaIndex, 3>& of, std::size_t n) const;

    std::vector<enclosure::Enclosure> values_;
    std::vector<double> slopes_;
};

}  // namespace phasetree::nodes
