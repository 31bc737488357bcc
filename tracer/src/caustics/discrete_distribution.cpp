#include "caustics/discrete_distribution.hpp"

#include <algorithm>

namespace phasetree::tracer {

DiscreteDistribution::DiscreteDistribution(std::size_t bins) {
    set_weights(std::vector<double>(bins, 1.0));
}

void DiscreteDistribution::set_weights(std::span<const double> weights) {
    cumulative_.assign(1, 0.0);
    for (const double weight : weights) cumulative_.push_back(cumulative_.back() + weight);
    const double sum = cumulative_.back();
    for (double& c : cumulative_) c /= sum;
}

std::size_t DiscreteDistribution::sample(double u) const {
    const auto above = std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, u);
    return static_cast<std::size_t>(above - cumulative_.begin()) - 1;
}

}  // namespace phasetree::tracer
