// The time of a path, shared by all of its rays, as a share of the shutter interval.
#pragma once

#include "sampling/sobol.hpp"

namespace phasetree::tracer {

/// The samples of a pixel are spread evenly over the interval. The time is drawn from a pixel outside of any picture,
/// so that drawing it does not change the other random numbers of a path.
inline float shutter_time(std::uint32_t x, std::uint32_t y, std::uint32_t sample, std::uint32_t seed) {
    constexpr std::uint32_t beside = 0x40000000u;
    return Sampler(x ^ beside, y, sample, seed).next();
}

}  // namespace phasetree::tracer
