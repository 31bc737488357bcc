// Random choice among bins with given or learned probabilities. A bin is a part of a square, of a cube or of the sphere
// of directions; the sources of photons are chosen in the same way.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace phasetree::tracer {

class DiscreteDistribution {
  public:
    /// Makes this many bins, all equally likely.
    explicit DiscreteDistribution(std::size_t bins);

    std::size_t size() const { return cumulative_.size() - 1; }
    /// Makes the probabilities proportional to these weights, one per bin. They must not be negative, nor all 0.
    void set_weights(std::span<const double> weights);
    /// The bin chosen by a random number in [0, 1).
    std::size_t sample(double u) const;
    double probability(std::size_t bin) const { return cumulative_[bin + 1] - cumulative_[bin]; }

  private:
    std::vector<double> cumulative_;  ///< probability of all bins before each bin, and 1 at the end
};

}  // namespace phasetree::tracer
