#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

namespace phasetree::bench {

// A number that says whether two runs found the same to the last bit: FNV-1a over the bytes of what is added. It finds
// accidents, not forgeries.
class Fingerprint {
  public:
    // A plain value without padding: a number, a vector of numbers.
    template <class T>
    void add(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        unsigned char bytes[sizeof(T)];
        std::memcpy(bytes, &value, sizeof(T));
        for (const unsigned char byte : bytes) {
            state_ ^= byte;
            state_ *= 0x100000001b3u;
        }
    }
    template <class T>
    void add_all(std::span<const T> values) {
        for (const T& value : values) add(value);
    }
    std::uint64_t value() const { return state_; }

  private:
    std::uint64_t state_ = 0xcbf29ce484222325u;
};

}  // namespace phasetree::bench
