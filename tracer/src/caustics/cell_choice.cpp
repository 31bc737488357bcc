#include "caustics/cell_choice.hpp"

#include <algorithm>

namespace phasetree::tracer {

CellChoice::CellChoice(std::size_t cells) {
    set_weights(std::vector<double>(cells, 1.0));
}

void CellChoice::set_weights(std::span<const double> weights) {
    cumulative_.assign(1, 0.0);
    for (const double weight : weights) cumulative_.push_back(cumulative_.back() + weight);
    const double sum = cumulative_.back();
    for (double& c : cumulative_) c /= sum;
}

std::size_t CellChoice::sample(double u) const {
    const auto above = std::upper_bound(cumulative_.begin() + 1, cumulative_.end() - 1, u);
    return static_cast<std::size_t>(above - cumulative_.begin()) - 1;
}

}  // namespace phasetree::tracer
