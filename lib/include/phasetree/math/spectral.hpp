#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace phasetree {

/// An upper bound on the largest eigenvalue of a symmetric, positive semidefinite n × n matrix G, stored row-major. The
/// eigenvalue is at most trace(Gᵏ)^(1/k). With k = 2¹², this is too large by a factor of at most n^(1/k).
inline double largest_eigenvalue(std::vector<double> g, std::size_t n) {
    std::vector<double> square(n * n);
    const auto trace = [&] {
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i) sum += g[i * n + i];
        return sum;
    };
    double logarithm = 0;
    for (int step = 0; step < 12; ++step) {
        const double t = trace();
        if (!(t > 0)) return 0;
        for (double& v : g) v /= t;
        logarithm += std::log(t) / std::ldexp(1.0, step);
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = 0; j < n; ++j) {
                double sum = 0;
                for (std::size_t k = 0; k < n; ++k) sum += g[i * n + k] * g[k * n + j];
                square[i * n + j] = sum;
            }
        g.swap(square);
    }
    return std::exp(logarithm + std::log(trace()) / 4096) * (1 + 1e-9);
}

}  // namespace phasetree
