#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace phasetree::cells {

/// Of bytes, eight at a time. Each step is a bijection of what it has so far and of the bytes that come, so that a
/// change within eight bytes is always found, and any other all but once in 2⁶⁴. The result depends on the byte order.
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
        std::memcpy(&w, from, count);
        return w;
    }
    void put(std::uint64_t w) {
        sum_ = (sum_ ^ w) * 0x9e3779b97f4a7c15u;
        sum_ ^= sum_ >> 32;
    }
    std::uint64_t sum_ = 0x70686173657472u;
};

}  // namespace phasetree::cells
