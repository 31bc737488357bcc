// Reflection and transmission of plane layers that scatter, computed in double precision by adding and doubling, and
// Chandrasekhar's H function. The path tracer is compared with these.
//
// Radiance is kept at the cosines µᵢ of a Gauss quadrature over (0, 1), and at further cosines of weight 0, which only
// receive light. A layer's R and T are matrices that map the incoming radiance to the outgoing one. For a layer of
// thickness Δ → 0, with p averaged over the azimuth,
//     Rᵢⱼ = a/2 wⱼ p(µᵢ, −µⱼ) Δ/µᵢ,   Tᵢⱼ = δᵢⱼ (1 − Δ/µᵢ) + a/2 wⱼ p(µᵢ, µⱼ) Δ/µᵢ,
//     p(µ, µ') = Σ (2k + 1) gᵏ Pₖ(µ) Pₖ(µ')   (Henyey and Greenstein),
// and for two equal layers on top of each other, with M = (1 − RR)⁻¹,
//     R₂ = R + T M R T,   T₂ = T M T.
// In light of radiance 1 from everywhere above, the radiance along µᵢ is the row's sum. By reciprocity, it is the share
// of a beam along µᵢ that is reflected or transmitted.
//
// References: van de Hulst, Multiple Light Scattering, 1980; Prahl, van Gemert & Welch, Determining the Optical
// Properties of Turbid Media by Using the Adding-Doubling Method, Applied Optics 32 (1993), 559-568; Chandrasekhar,
// Radiative Transfer, 1960, V.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace phasetree::tests {

/// Nodes and weights of the Gauss-Legendre quadrature over (0, 1), by Newton's method on the polynomial.
inline std::pair<std::vector<double>, std::vector<double>> gauss_legendre(int n) {
    std::vector<double> nodes, weights;
    for (int i = 0; i < n; ++i) {
        double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1;
        for (int step = 0; step < 50; ++step) {
            double last = 1, value = x;
            for (int k = 2; k <= n; ++k) {
                const double next = ((2 * k - 1) * x * value - (k - 1) * last) / k;
                last = value;
                value = next;
            }
            slope = n * (x * value - last) / (x * x - 1);
            x -= value / slope;
        }
        nodes.push_back((1 + x) / 2);
        weights.push_back(1 / ((1 - x * x) * slope * slope));
    }
    return {nodes, weights};
}

class Matrix {
  public:
    explicit Matrix(std::size_t n) : n_(n), values_(n * n) {}
    double& operator()(std::size_t i, std::size_t j) { return values_[i * n_ + j]; }
    double operator()(std::size_t i, std::size_t j) const { return values_[i * n_ + j]; }
    std::size_t size() const { return n_; }

    friend Matrix operator*(const Matrix& a, const Matrix& b) {
        Matrix product(a.n_);
        for (std::size_t i = 0; i < a.n_; ++i)
            for (std::size_t k = 0; k < a.n_; ++k)
                for (std::size_t j = 0; j < a.n_; ++j) product(i, j) += a(i, k) * b(k, j);
        return product;
    }
    friend Matrix operator+(Matrix a, const Matrix& b) {
        for (std::size_t i = 0; i < a.values_.size(); ++i) a.values_[i] += b.values_[i];
        return a;
    }
    /// (1 − A)⁻¹ B by Gaussian elimination. No pivoting is needed, because A reflects less than it receives.
    static Matrix solve(const Matrix& a, Matrix b) {
        Matrix left(a.n_);
        for (std::size_t i = 0; i < a.n_; ++i)
            for (std::size_t j = 0; j < a.n_; ++j) left(i, j) = (i == j ? 1 : 0) - a(i, j);
        for (std::size_t k = 0; k < a.n_; ++k)
            for (std::size_t i = 0; i < a.n_; ++i) {
                if (i == k) continue;
                const double factor = left(i, k) / left(k, k);
                for (std::size_t j = 0; j < a.n_; ++j) {
                    left(i, j) -= factor * left(k, j);
                    b(i, j) -= factor * b(k, j);
                }
            }
        for (std::size_t i = 0; i < a.n_; ++i)
            for (std::size_t j = 0; j < a.n_; ++j) b(i, j) /= left(i, i);
        return b;
    }

  private:
    std::size_t n_;
    std::vector<double> values_;
};

struct ScatteringLayer {
    double albedo, thickness, g;  ///< single scattering; optical; mean cosine
};

struct PlaneResponse {
    double reflected, transmitted;  ///< what goes straight through included
};

/// For a beam along each of the cosines.
inline std::vector<PlaneResponse> adding_doubling(const ScatteringLayer& layer, std::span<const double> cosines,
                                                  int quadrature = 24) {
    auto [mu, weight] = gauss_legendre(quadrature);
    for (const double cosine : cosines) {
        mu.push_back(cosine);
        weight.push_back(0);
    }
    const std::size_t n = mu.size();
    // As many terms as the quadrature integrates exactly.
    const auto phase = [&](double a, double b) {
        double last_a = 1, last_b = 1, at_a = a, at_b = b, power = layer.g, sum = 1;
        for (int k = 1; k < 2 * quadrature; ++k) {
            sum += (2 * k + 1) * power * at_a * at_b;
            power *= layer.g;
            const double next_a = ((2 * k + 1) * a * at_a - k * last_a) / (k + 1);
            const double next_b = ((2 * k + 1) * b * at_b - k * last_b) / (k + 1);
            last_a = at_a, last_b = at_b, at_a = next_a, at_b = next_b;
        }
        return sum;
    };
    constexpr int doublings = 22;
    const double thin = std::ldexp(layer.thickness, -doublings);
    Matrix r(n), t(n);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            const double scattered = layer.albedo / 2 * weight[j] * thin / mu[i];
            r(i, j) = scattered * phase(mu[i], -mu[j]);
            t(i, j) = scattered * phase(mu[i], mu[j]) + (i == j ? 1 - thin / mu[i] : 0);
        }
    for (int k = 0; k < doublings; ++k) {
        const Matrix between = r * r;
        const Matrix through = Matrix::solve(between, t), back = Matrix::solve(between, r * t);
        r = r + t * back;
        t = t * through;
    }
    std::vector<PlaneResponse> responses;
    for (std::size_t i = static_cast<std::size_t>(quadrature); i < n; ++i) {
        PlaneResponse response{};
        for (std::size_t j = 0; j < static_cast<std::size_t>(quadrature); ++j) {
            response.reflected += r(i, j);
            response.transmitted += t(i, j);
        }
        response.transmitted += t(i, i);  // the direct beam, which no other direction contributes
        responses.push_back(response);
    }
    return responses;
}

/// H(µ) of isotropic scattering, from 1/H = √(1 − a) + a/2 ∫₀¹ µ' H(µ')/(µ + µ') dµ' by iteration.
inline double chandrasekhar_h(double albedo, double mu) {
    const auto [nodes, weights] = gauss_legendre(48);
    std::vector<double> h(nodes.size(), 1);
    const auto next = [&](double at) {
        double integral = 0;
        for (std::size_t j = 0; j < nodes.size(); ++j) integral += weights[j] * nodes[j] * h[j] / (at + nodes[j]);
        return 1 / (std::sqrt(1 - albedo) + albedo / 2 * integral);
    };
    // Without absorption, a factor of H alternates with its reciprocal forever. The geometric mean of two steps removes
    // it.
    for (double change = 1; change > 1e-10;) {
        std::vector<double> improved;
        for (std::size_t j = 0; j < nodes.size(); ++j) improved.push_back(std::sqrt(h[j] * next(nodes[j])));
        change = std::abs(improved.front() - h.front()) + std::abs(improved.back() - h.back());
        h = improved;
    }
    return next(mu);
}

}  // namespace phasetree::tests
