#pragma once

#include <cstddef>
#include <vector>

#include "phasetree/model/from_file.hpp"

namespace phasetree {

/// A network of sinusoidal layers (Sitzmann et al., "Implicit Neural Representations with Periodic Activation
/// Functions", 2020): x ← sin(W x + b) for each layer but the last, which is linear. The frequencies ω are multiplied
/// into W and b. It maps x, y, z to a distance, trained within the ball of the given radius around the origin.
struct SirenNetwork {
    struct Layer {
        int inputs = 0, outputs = 0;
        std::vector<float> weights;  ///< row-major, one row of `inputs` numbers per output
        std::vector<float> bias;     ///< one number per output
    };
    float radius = 1;
    std::vector<Layer> layers;

    static constexpr int widest = 128;

    /// Null if the sizes of the layers match; otherwise a message that says what is wrong.
    const char* mistake() const;
    /// Π ‖Wᵢ‖₂, rounded up: a bound on the slope, because the sine's slope is at most 1. (Galin et al., Section 9.4,
    /// print wᵢ for the norm.)
    double spectral_bound() const;
    /// The maximum length of the gradient at this many points of the ball, plus ten percent. *Not a bound*: between the
    /// points it may be steeper.
    double sampled_slope(int points) const;
    std::size_t bytes() const {
        std::size_t numbers = 0;
        for (const Layer& layer : layers) numbers += layer.weights.size() + layer.bias.size();
        return numbers * sizeof(float);
    }
    /// The data of the program's primitive: the number of layers, the radius, and for each layer its inputs, outputs, W
    /// and b. W and b of the last layer are multiplied by `scale`.
    std::vector<float> table(float scale) const;
};

template <>
struct FileFormat<SirenNetwork> {
    static SirenNetwork read(const std::filesystem::path&);
};

}  // namespace phasetree
