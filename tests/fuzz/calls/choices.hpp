// The choices that an input of the target `calls` encodes: numbers, members of lists, pointers that may be NULL.
#pragma once

#include <iterator>
#include <limits>

#include "fuzz/target.hpp"

namespace phasetree::fuzz {

inline constexpr float some_numbers[] = {0, 0.5f, -0.5f, 1, -1, 0.01f, 2, -3, 1e-3f, 100, 1e6f, -0.0f, 1e20f, 1e-30f};
inline constexpr float not_finite[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                                       -std::numeric_limits<float>::infinity()};

// The rest of an input; zeros after its end.
class Choices {
  public:
    explicit Choices(Bytes bytes) : bytes_(bytes) {}
    bool is_over() const { return bytes_.empty(); }
    unsigned byte() {
        if (bytes_.empty()) return 0;
        const unsigned b = bytes_.front();
        bytes_ = bytes_.subspan(1);
        return b;
    }
    unsigned below(unsigned n) { return n == 0 ? 0 : byte() % n; }
    bool rarely() { return byte() >= 240; }
    template <class List>
    auto of(const List& list) {
        return list[below(static_cast<unsigned>(std::size(list)))];
    }
    float number() {
        const unsigned b = byte();
        if (b < 120) return static_cast<float>(b) / 30 - 2;
        return b >= 248 ? of(not_finite) : of(some_numbers);
    }
    // The pointer, or periodically NULL.
    template <class T>
    T* or_null(T* p) {
        return rarely() ? nullptr : p;
    }

  private:
    Bytes bytes_;
};

}  // namespace phasetree::fuzz
