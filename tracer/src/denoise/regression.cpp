#include "denoise/regression.hpp"

#include <cmath>

namespace phasetree::tracer {

namespace {

// The regularisation of slopes, relative to the sum of all weights: features are of the order of 1.
constexpr double cost_of_slopes = 1e-3;

}  // namespace

void LocalModel::add(float weight, const Features& features, const std::array<float, 3>& radiance) {
    std::array<float, columns> row;
    row[0] = 1;
    for (std::size_t i = 0; i < feature_count; ++i) row[1 + i] = features[i] - centre_[i];
    for (std::size_t c = 0; c < 3; ++c) row[unknowns + c] = radiance[c];
    for (std::size_t i = 0; i < unknowns; ++i) {
        const float factor = weight * row[i];
        for (std::size_t j = 0; j < columns; ++j) sums_[i][j] += factor * row[j];
    }
}

// Cholesky decomposition of the normal equations, which the regularisation makes positive definite.
void LocalModel::solve() {
    std::array<std::array<double, unknowns>, unknowns> lower{};
    for (std::size_t i = 0; i < unknowns; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            auto sum = static_cast<double>(sums_[i][j]);
            if (i == j && i > 0) sum += cost_of_slopes * static_cast<double>(sums_[0][0]);
            for (std::size_t k = 0; k < j; ++k) sum -= lower[i][k] * lower[j][k];
            lower[i][j] = i == j ? std::sqrt(sum) : sum / lower[j][j];
        }
    for (std::size_t c = 0; c < 3; ++c) {
        std::array<double, unknowns> x{};
        for (std::size_t i = 0; i < unknowns; ++i) {
            auto sum = static_cast<double>(sums_[i][unknowns + c]);
            for (std::size_t k = 0; k < i; ++k) sum -= lower[i][k] * x[k];
            x[i] = sum / lower[i][i];
        }
        for (std::size_t i = unknowns; i-- > 0;) {
            double sum = x[i];
            for (std::size_t k = i + 1; k < unknowns; ++k) sum -= lower[k][i] * x[k];
            x[i] = sum / lower[i][i];
        }
        for (std::size_t i = 0; i < unknowns; ++i) coefficients_[i][c] = static_cast<float>(x[i]);
    }
}

std::array<float, 3> LocalModel::at(const Features& features) const {
    std::array<float, 3> radiance = coefficients_[0];
    for (std::size_t i = 0; i < feature_count; ++i)
        for (std::size_t c = 0; c < 3; ++c) radiance[c] += coefficients_[1 + i][c] * (features[i] - centre_[i]);
    return radiance;
}

}  // namespace phasetree::tracer
