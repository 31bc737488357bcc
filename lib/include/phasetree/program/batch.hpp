#pragma once

#include <array>
#include <cstddef>

namespace phasetree {

/// How many points an evaluation takes at once, whatever the machine's SIMD width: 8 lanes of AVX, two times 4 of SSE.
/// Fixed, so that results do not depend on the machine.
inline constexpr std::size_t batch_size = 8;

struct alignas(batch_size * sizeof(float)) BatchOfFloats {
    std::array<float, batch_size> lane;
    float& operator[](std::size_t i) { return lane[i]; }
    float operator[](std::size_t i) const { return lane[i]; }
};

/// A batch of points' phases and interface distances.
struct Samples {
    BatchOfFloats label;     ///< index of the phase, as a float
    BatchOfFloats distance;  ///< s(p), the second smallest component: within that radius the label cannot change
};

}  // namespace phasetree
