// Random choice among cells with given or learned probabilities.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace phasetree::tracer {

class CellChoice {
  public:
    /// Makes this many cells, all equally likely.
    explicit CellChoice(std::size_t cells);

    std::size_t size() const { return cumulative_.size() - 1; }
    /// Makes the probabilities proportional to these weights, one per cell. They must not be negative, nor all 0.
    void set_weights(std::span<const double> weights);
    /// The cell chosen by a random number in [0, 1).
    std::size_t sample(double u) const;
    double probability(std::size_t cell) const { return cumulative_[cell + 1] - cumulative_[cell]; }

  private:
    std::vector<double> cumulative_;  ///< probability of all cells before each cell, and 1 at the end
};

}  // namespace phasetree::tracer
