#pragma once

#include <array>
#include <cstddef>

namespace phasetree {

/// The number of points that are evaluated together, whatever the machine's SIMD width: one AVX register, or two SSE
/// registers. It is fixed so that results do not depend on the machine.
inline constexpr std::size_t batch_size = 8;

/// One float per point of a batch.
struct alignas(batch_size * sizeof(float)) BatchOfFloats {
    std::array<float, batch_size> lane;
    float& operator[](std::size_t i) { return lane[i]; }
    float operator[](std::size_t i) const { return lane[i]; }
};

/// The phases and interface distances of a batch of points.
struct Samples {
    BatchOfFloats label;  ///< the index of the phase, as a float
    /// s(p), the second smallest component, in the scene's unit of length. Within this radius the label does not
    /// change.
    BatchOfFloats distance;
};

}  // namespace phasetree
