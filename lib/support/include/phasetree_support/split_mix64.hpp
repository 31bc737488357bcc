#pragma once

#include <cstdint>

namespace phasetree::support {

/// Random numbers that are the same on every machine and with every standard library: SplitMix64 (Steele, Lea and
/// Flood, OOPSLA 2014).
class SplitMix64 {
  public:
    explicit SplitMix64(std::uint64_t seed) : state_(seed) {}

    /// Sixty-four random bits.
    std::uint64_t operator()() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }

  private:
    std::uint64_t state_;
};

}  // namespace phasetree::support
