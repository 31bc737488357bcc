#include "phasetree/nodes/fields/siren_network.hpp"

#include <cmath>
#include <limits>

#include "math/dual.hpp"
#include "model/preparation.hpp"
#include "phasetree/math/spectral.hpp"
#include "phasetree/nodes/fields/siren.hpp"

namespace phasetree {

using model::Preparation;

namespace {

// An upper bound on ‖W‖₂. The eigenvalues of WᵀW are the squares of the singular values of W.
double spectral_norm(const SirenNetwork::Layer& layer) {
    const auto n = static_cast<std::size_t>(std::min(layer.inputs, layer.outputs));
    const auto inputs = static_cast<std::size_t>(layer.inputs), outputs = static_cast<std::size_t>(layer.outputs);
    // W Wᵀ has the same norm as WᵀW, so use the smaller of the two.
    const bool wide = layer.inputs > layer.outputs;
    const auto at = [&](std::size_t row, std::size_t column) {
        return static_cast<double>(layer.weights[row * inputs + column]);
    };
    std::vector<double> g(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t k = 0; k < (wide ? inputs : outputs); ++k)
                g[i * n + j] += wide ? at(i, k) * at(j, k) : at(k, i) * at(k, j);
    return std::sqrt(largest_eigenvalue(std::move(g), n));
}

constexpr std::uint64_t multiplications_a_step = 8;

// The n-th number of the van der Corput sequence in a base; three bases give a Halton sequence in space.
double radical_inverse(unsigned n, unsigned base) {
    double result = 0, digit = 1.0 / base;
    for (; n > 0; n /= base, digit /= base) result += digit * (n % base);
    return result;
}

}  // namespace

const char* SirenNetwork::mistake() const {
    if (!(radius >= 1e-6f && radius <= 1e6f)) return "the radius must be between 1e-6 and 1e6 m";
    if (layers.empty()) return "the network has no layers";
    int width = 3;
    double largest_input = static_cast<double>(radius);  // bounds each input of the layer
    for (std::size_t n = 0; n < layers.size(); ++n) {
        const Layer& layer = layers[n];
        if (layer.inputs != width)
            return n == 0 ? "the first layer must have three inputs, x, y and z"
                          : "the number of inputs of a layer differs from the number of outputs of the one before";
        if (layer.outputs < 1 || layer.outputs > widest) return "a layer must have between 1 and 128 outputs";
        const auto weights = static_cast<std::size_t>(layer.inputs) * static_cast<std::size_t>(layer.outputs);
        if (layer.weights.size() != weights || layer.bias.size() != static_cast<std::size_t>(layer.outputs))
            return "the weights and biases of a layer do not match its inputs and outputs";
        for (std::size_t o = 0; o < layer.bias.size(); ++o) {
            double sum = std::abs(static_cast<double>(layer.bias[o]));
            for (std::size_t i = 0; i < static_cast<std::size_t>(layer.inputs); ++i)
                sum += std::abs(static_cast<double>(layer.weights[o * static_cast<std::size_t>(layer.inputs) + i])) *
                       largest_input;
            // sine() is accurate for arguments up to 10⁴.
            if (!(sum < 9000)) return "a layer's weights are too large";
        }
        width = layer.outputs;
        largest_input = 1;
    }
    return width == 1 ? nullptr : "the last layer must have one output, the distance";
}

double SirenNetwork::spectral_bound() const {
    Preparation preparation(Siren::info.name);
    for (const Layer& layer : layers) {
        const auto n = static_cast<std::uint64_t>(std::min(layer.inputs, layer.outputs));
        preparation.pay(13 * n * n * n / multiplications_a_step);
    }
    double product = 1;
    for (const Layer& layer : layers) product *= spectral_norm(layer);
    return product;
}

double SirenNetwork::sampled_slope(int points) const {
    const Siren::Network network{table(1)};
    const auto multiplications = static_cast<std::uint64_t>(Siren::Network::multiplications(network.values.data()));
    Preparation(Siren::info.name).pay(static_cast<std::uint64_t>(points) * multiplications / multiplications_a_step);
    double steepest = 0;
    for (int n = 0; n < points; ++n) {
        const auto coordinate = [&](unsigned base) {
            return radius * static_cast<float>(2 * radical_inverse(static_cast<unsigned>(n) + 1, base) - 1);
        };
        const float x = coordinate(2), y = coordinate(3), z = coordinate(5);
        if (x * x + y * y + z * z > radius * radius) continue;
        const Dual f = Siren::Network::distance(network.values.data(),
                                                Vec3<Dual>{Dual(x, 1, 0, 0), Dual(y, 0, 1, 0), Dual(z, 0, 0, 1)});
        steepest = std::max(steepest, glm::length(glm::dvec3(f.gradient())));
    }
    return 1.1 * steepest;
}

std::vector<float> SirenNetwork::table(float scale) const {
    std::vector<float> all{static_cast<float>(layers.size()), radius};
    for (const Layer& layer : layers) {
        const float k = &layer == &layers.back() ? scale : 1.f;
        all.push_back(static_cast<float>(layer.inputs));
        all.push_back(static_cast<float>(layer.outputs));
        for (const float w : layer.weights) all.push_back(w * k);
        for (const float b : layer.bias) all.push_back(b * k);
    }
    return all;
}

}  // namespace phasetree
