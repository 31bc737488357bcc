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
        std::vector<float> weights;  ///< row-major, a row of `inputs` numbers for each output
        std::vector<float> bias;     ///< one number for each output
    };
    float radius = 1;
    std::vector<Layer> layers;

    static constexpr int widest = 128;

    /// Null if the layers fit each other, else a message that says what is wrong.
    const char* mistake() const;
    /// Π ‖Wᵢ‖₂, rounded upward: a bound of the slope, because the sine's slope is at most 1. (The printed 9.4 has wᵢ
    /// for the norm.)
    double spectral_bound() const;
    /// The length of the steepest gradient at this many points of the ball, plus a tenth. *Not a bound*: between the
    /// points it may be steeper.
    double sampled_slope(int points) const;
    std::size_t bytes() const {
        std::size_t numbers = 0;
        for (const Layer& layer : layers) numbers += layer.weights.size() + layer.bias.size();
        return numbers * sizeof(float);
    }
    /// The network as the program carries it: the number of layers, the radius, and for each layer its inputs, outputs,
    /// W and b; W and b of the last layer are multiplied by `scale`.
    std::vector<float> table(float scale) const;
};

}  // namespace phasetree
