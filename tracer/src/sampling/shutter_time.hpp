// The time of a path: one number for all of its rays, as a share of the time in which the shutter is open.
#pragma once

#include "sampling/sobol.hpp"

namespace phasetree::tracer {

/// The samples of a pixel are spread evenly over the time, as all that is drawn. It is drawn as if by another pixel,
/// beside any that a picture has, so that pictures in which nothing moves draw what they always drew.
inline float shutter_time(std::uint32_t x, std::uint32_t y, std::uint32_t sample, std::uint32_t seed) {
    constexpr std::uint32_t beside = 0x40000000u;
    return Sampler(x ^ beside, y, sample, seed).next();
}

}  // namespace phasetree::tracer
