// When a box is worth dividing: the more there are of its size, the more each of them has to save.
#pragma once

#include "phasetree/cells/cells.hpp"

namespace phasetree {

/// The share of what a box's rays need at least (price.hpp) that dividing it must promise to save. `size` is the box's
/// diagonal over the object's. Along an interface there are as many boxes as the square of how small they are, all of
/// them are built, and few rays meet any one. The fourth power is measured: with the square or the first, large boxes
/// suffer for what small ones cost (benchmarks/README.md).
inline float least_gain(BuildQuality quality, float size) {
    struct Gain {
        float large, small;  // of large boxes; the size at which it is twice that
    };
    const Gain gain = quality == BuildQuality::low      ? Gain{0.5f, 0.04f}
                      : quality == BuildQuality::medium ? Gain{0.1f, 0.025f}
                                                        : Gain{0.05f, 0.02f};
    const float ratio = gain.small / size, square = ratio * ratio;
    return gain.large * (1 + square * square);
}

}  // namespace phasetree
