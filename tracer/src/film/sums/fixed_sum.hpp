// Exact sums of real numbers, which therefore do not depend on the order: integers of 64, 128 or 192 bits that count a
// fixed unit, 2^−Fraction. Integer addition is associative; floating-point addition is not (Goldberg: What Every
// Computer Scientist Should Know About Floating-Point Arithmetic, ACM Computing Surveys 23(1), 1991). The sum of a
// pixel's samples is the same to the last bit, no matter how they are divided among threads, machines and runs.
//
// Error. A value is rounded to the nearest multiple of the unit, ties to even, before it is added; after that, nothing
// is lost. So the error of the mean of any number of samples is at most half a unit. Rounding depends only on the
// value.
//
// Range. Values with |v| < 2^limit_exponent are accepted. A sum of 2^31 such values cannot overflow, because 32 bits
// are reserved for it (31, and the sign). Larger values are clamped to the limit and counted. Clamping does not depend
// on the order of values, either.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "film/bytes.hpp"
#include "film/faults.hpp"

namespace phasetree::tracer {

template <std::size_t Words, int Fraction>
class FixedSum {
  public:
    /// The maximum number of samples for which a sum cannot overflow.
    static constexpr std::uint32_t max_samples = std::uint32_t{1} << 31;
    static constexpr int limit_exponent = static_cast<int>(64 * Words) - 32 - Fraction;

    /// Adds a value, rounded to a multiple of 2^−Fraction.
    void add(double value, FilmFaults& faults) {
        const auto bits = std::bit_cast<std::uint64_t>(value);
        const int exponent = static_cast<int>((bits >> 52) & 0x7ff);
        if (exponent == 0x7ff) {
            ++faults.not_finite;
            return;
        }
        if (exponent == 0) return;  // 0, or below 2^−1022
        // |value| = mantissa · 2^(exponent − 1075), which is mantissa · 2^shift units.
        const std::uint64_t mantissa = (bits & ((std::uint64_t{1} << 52) - 1)) | (std::uint64_t{1} << 52);
        const int shift = exponent - 1075 + Fraction;
        FixedSum term;
        if (exponent - 1023 >= limit_exponent) {
            ++faults.too_large;
            term.words_ = largest();
        } else if (shift >= 0) {
            const auto word = static_cast<std::size_t>(shift) / 64;
            const int bit = shift % 64;
            term.words_[word] = mantissa << bit;
            if (bit > 0 && word + 1 < Words) term.words_[word + 1] = mantissa >> (64 - bit);
        } else if (shift > -54) {
            term.words_[0] = rounded(mantissa, -shift);
        }
        if (bits >> 63) term.negate();
        *this += term;
    }
    FixedSum& operator+=(const FixedSum& other) {
        std::uint64_t carry = 0;
        for (std::size_t i = 0; i < Words; ++i) {
            const std::uint64_t partial = words_[i] + carry;
            carry = partial < carry ? 1 : 0;
            words_[i] = partial + other.words_[i];
            carry += words_[i] < partial ? 1 : 0;
        }
        return *this;
    }

    /// The nearest double.
    double value() const {
        FixedSum magnitude = *this;
        const bool negative = is_negative();
        if (negative) magnitude.negate();
        std::size_t top = Words;
        while (top > 0 && magnitude.words_[top - 1] == 0) --top;
        if (top == 0) return 0;
        // The 64 leading bits. The last one also records whether any lower bit is set, which decides a tie.
        const int zeros = std::countl_zero(magnitude.words_[top - 1]);
        std::uint64_t leading = magnitude.words_[top - 1] << zeros;
        bool below = false;
        if (top > 1) {
            if (zeros > 0) leading |= magnitude.words_[top - 2] >> (64 - zeros);
            below = (magnitude.words_[top - 2] << zeros) != 0;
            for (std::size_t i = 0; i + 2 < top; ++i) below = below || magnitude.words_[i] != 0;
        }
        if (below) leading |= 1;
        const int exponent = static_cast<int>(64 * (top - 1)) - zeros - Fraction;
        const double nearest = std::ldexp(static_cast<double>(leading), exponent);
        return negative ? -nearest : nearest;
    }

    bool operator==(const FixedSum&) const = default;

    /// Only the significant bytes of a sum are written, without the sign bytes above and the zero bytes below them. The
    /// first byte written is (bytes + 1) · z + n, where z is the number of zero bytes below that are omitted, and n the
    /// number of bytes that follow. A leading byte is omitted if the sign of the next one implies it. A negative number
    /// always keeps at least one byte, because an empty sequence encodes 0. So equal sums have equal bytes.
    void write(ByteWriter& out) const {
        const std::uint64_t sign = is_negative() ? 0xff : 0;
        std::size_t low = 0, high = bytes;
        while (low < max_low && byte(low) == 0) ++low;
        while (high > low && byte(high - 1) == sign && (high == low + 1 ? sign == 0 : sign_of(high - 2) == sign))
            --high;
        out.number(static_cast<std::uint8_t>(high - low + low * (bytes + 1)));
        for (std::size_t i = low; i < high; ++i) out.number(static_cast<std::uint8_t>(byte(i)));
    }
    /// Throws BytesError.
    static FixedSum read(ByteReader& in) {
        const auto head = in.template number<std::uint8_t>();
        const std::size_t low = head / (bytes + 1), count = head % (bytes + 1);
        if (low > max_low || low + count > bytes) throw BytesError("it contains a number of invalid length");
        FixedSum sum;
        for (std::size_t i = low; i < low + count; ++i) sum.set_byte(i, in.template number<std::uint8_t>());
        if (count > 0 && sum.sign_of(low + count - 1) != 0)
            for (std::size_t i = low + count; i < bytes; ++i) sum.set_byte(i, 0xff);
        return sum;
    }

  private:
    static constexpr std::size_t bytes = 8 * Words;
    // The maximum number of zero bytes to omit, such that one byte can encode both numbers.
    static constexpr std::size_t max_low = std::min<std::size_t>(bytes, (255 - bytes) / (bytes + 1));

    static constexpr std::array<std::uint64_t, Words> largest() {
        std::array<std::uint64_t, Words> words{};
        words.fill(~std::uint64_t{0});
        words[Words - 1] >>= 32;
        return words;
    }
    // mantissa / 2^places, ties to even; 0 < places < 54.
    static std::uint64_t rounded(std::uint64_t mantissa, int places) {
        const std::uint64_t half = std::uint64_t{1} << (places - 1);
        const std::uint64_t whole = mantissa >> places, rest = mantissa & (2 * half - 1);
        return whole + (rest > half || (rest == half && (whole & 1)) ? 1 : 0);
    }
    bool is_negative() const { return words_[Words - 1] >> 63; }
    void negate() {
        std::uint64_t carry = 1;
        for (std::uint64_t& word : words_) {
            word = ~word + carry;
            carry = carry && word == 0 ? 1 : 0;
        }
    }
    std::uint64_t byte(std::size_t i) const { return (words_[i / 8] >> (8 * (i % 8))) & 0xff; }
    void set_byte(std::size_t i, std::uint64_t value) { words_[i / 8] |= value << (8 * (i % 8)); }
    // The value of all bytes above, as implied by a byte's leading bit.
    std::uint64_t sign_of(std::size_t i) const { return byte(i) >> 7 ? 0xff : 0; }

    std::array<std::uint64_t, Words> words_{};  // two's complement, the lowest word first
};

/// For radiances, positions, lengths. The unit is 2^−56 = 1.4·10⁻¹⁷, the limit 2^40 = 1.1·10¹². A float above 2^−33 =
/// 1.2·10⁻¹⁰ in magnitude is a multiple of the unit, so it is not rounded at all. The radiance of a dim corner, 10⁻⁶,
/// is exact, and so is that of a sun's disc, 10¹⁰.
using ValueSum = FixedSum<2, 56>;
/// For products of two such values. The limit, 2^80, is the square of theirs. The square of a float above 2^−17 is
/// exact, and that of 10⁻⁶ has 12 correct digits.
using SquareSum = FixedSum<3, 80>;
/// For weights from 0 to 1, in units of 2^−31.
using WeightSum = FixedSum<1, 31>;

}  // namespace phasetree::tracer
