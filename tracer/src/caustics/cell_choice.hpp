// Cells of which one is chosen with a probability each, which may be learnt.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace phasetree::tracer {

class CellChoice {
  public:
    /// This many cells, all of which are equally likely.
    explicit CellChoice(std::size_t cells);

    std::size_t size() const { return cumulative_.size() - 1; }
    /// From now on cells are chosen in proportion to these numbers, one for each, not negative, not all 0.
    void set_weights(std::span<const double> weights);
    /// The cell that a number in [0, 1) chooses.
    std::size_t sample(double u) const;
    double probability(std::size_t cell) const { return cumulative_[cell + 1] - cumulative_[cell]; }

  private:
    std::vector<double> cumulative_;  ///< the probability of all cells before a cell, and 1 at the end
};

}  // namespace phasetree::tracer
