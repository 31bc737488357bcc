// Numbers in [0, 1), the same in every run.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <random>

namespace phasetree::tests {

class Uniform {
  public:
    explicit Uniform(std::uint32_t seed) : generator_(seed) {}
    float operator()() { return static_cast<float>(generator_() >> 8U) * 0x1p-24f; }
    glm::vec2 two() {
        const float x = (*this)();
        return {x, (*this)()};
    }

  private:
    std::mt19937 generator_;
};

}  // namespace phasetree::tests
