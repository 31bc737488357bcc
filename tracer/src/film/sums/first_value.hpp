// The value of the sample with the lowest number, among those that have one. Independent of the order of samples, and
// suited to values that have no mean, such as IDs.
#pragma once

#include <array>
#include <bit>
#include <limits>

#include "film/bytes.hpp"

namespace phasetree::tracer {

template <std::size_t N>
class FirstValue {
  public:
    /// `number` is that of the sample in its pixel, below 2^32 − 1.
    void add(const std::array<float, N>& values, std::uint32_t number) {
        if (number >= number_) return;
        values_ = values;
        number_ = number;
    }
    FirstValue& operator+=(const FirstValue& other) {
        add(other.values_, other.number_);
        return *this;
    }

    std::array<float, N> values(float otherwise) const {
        if (number_ != none) return values_;
        std::array<float, N> values;
        values.fill(otherwise);
        return values;
    }

    // Compares bits, so that a NaN is equal to itself.
    bool operator==(const FirstValue& other) const {
        for (std::size_t i = 0; i < N; ++i)
            if (std::bit_cast<std::uint32_t>(values_[i]) != std::bit_cast<std::uint32_t>(other.values_[i]))
                return false;
        return number_ == other.number_;
    }
    void write(ByteWriter& out) const {
        for (const float value : values_) out.number(value);
        out.number(number_);
    }
    static FirstValue read(ByteReader& in) {
        FirstValue first;
        for (float& value : first.values_) value = in.real();
        first.number_ = in.number<std::uint32_t>();
        return first;
    }

  private:
    static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

    std::array<float, N> values_{};
    std::uint32_t number_ = none;
};

}  // namespace phasetree::tracer
