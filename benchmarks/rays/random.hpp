// Random numbers that are the same on every machine (std:: distributions are not).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <numbers>

#include "phasetree_support/split_mix64.hpp"

namespace phasetree::bench {

class Random {
  public:
    explicit Random(std::uint64_t seed) : generator_(seed) {}

    // In [0, 1).
    float next() { return static_cast<float>(generator_() >> 40) * 0x1p-24f; }
    // An index below `count`.
    std::size_t below(std::size_t count) {
        return std::min(static_cast<std::size_t>(next() * static_cast<float>(count)), count - 1);
    }
    glm::vec3 in_cube() {
        const float x = next(), y = next(), z = next();
        return {x, y, z};
    }
    glm::vec3 direction() {
        const float z = 1 - 2 * next(), angle = 2 * std::numbers::pi_v<float> * next();
        const float r = std::sqrt(1 - z * z);
        return {r * std::cos(angle), r * std::sin(angle), z};
    }

  private:
    support::SplitMix64 generator_;
};

}  // namespace phasetree::bench
