#pragma once

#include <cstddef>
#include <cstdint>

#include "phasetree_support/mixed_hash.hpp"

namespace phasetree::support {

/// A checksum of bytes, eight at a time. Each step is a bijection of the sum so far, and also of the bytes put in. So a
/// change within eight bytes is always detected, and any other change is missed with a probability of 2⁻⁶⁴. It does not
/// protect against forgery.
class Checksum {
  public:
    void put(const void* bytes, std::size_t count) {
        const auto* at = static_cast<const unsigned char*>(bytes);
        put(count);
        for (; count >= sizeof(std::uint64_t); count -= sizeof(std::uint64_t), at += sizeof(std::uint64_t))
            put(word(at, sizeof(std::uint64_t)));
        if (count > 0) put(word(at, count));
    }
    std::uint64_t get() const { return sum_; }

  private:
    static std::uint64_t word(const unsigned char* from, std::size_t count) {
        std::uint64_t w = 0;
        for (std::size_t i = 0; i < count; ++i) w |= std::uint64_t{from[i]} << (8 * i);
        return w;
    }
    void put(std::uint64_t w) { sum_ = mixed(sum_, w); }
    std::uint64_t sum_ = 0x70686173657472u;
};

}  // namespace phasetree::support
