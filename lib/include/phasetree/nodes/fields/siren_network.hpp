#pragma once

#include <cstddef>
#include <vector>

namespace phasetree {

/// A network of sinusoidal layers (Sitzmann et al., "Implicit Neural Representations with Periodic Activation
/// Functions", 2020): x ← sin(W x + b) for each layer but the last, which is linear. The frequencies ω are multiplied
/// into W and b. It takes x, y, z and gives a distance, learned within the ball of the radius about the origin.
struct SirenNetwork {
    struct Layer {
        int inputs = 0, outputs = 0;
        std::vector<float> weights;  ///< a row of `inputs` for each output
        std::vector<float> bias;     ///< one an output
    };
    float radius = 1;
    std::vector<Layer> layers;

    static constexpr int widest = 128;

    /// Empty if the layers fit each other, else what is wrong.
    const char* mistake() const;
    /// Π ‖Wᵢ‖₂, never below it: a bound of the slope, because sine's is 1. (The printed 9.4 has wᵢ for the norm.)
    double spectral_bound() const;
    /// The steepest gradient at so many points of the ball, a tenth added. *Not a bound*: between the points it may be
    /// steeper.
    double sampled_slope(int points) const;
    std::size_t bytes() const {
        std::size_t numbers = 0;
        for (const Layer& layer : layers) numbers += layer.weights.size() + layer.bias.size();
        return numbers * sizeof(float);
    }
    /// As the program carries it: how many layers, and for each inputs, outputs, W, b; the last one scaled.
    std::vector<float> table(float scale) const;
};

}  // namespace phasetree
