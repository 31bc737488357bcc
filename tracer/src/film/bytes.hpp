// Little-endian serialisation of numbers, for film files and for triangle files (mesh_file).
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace phasetree::tracer {

/// Thrown for bytes that are not valid. The message is a clause about the file, such as "it ends too early".
class BytesError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

class ByteWriter {
  public:
    template <std::unsigned_integral T>
    void number(T value) {
        for (std::size_t i = 0; i < sizeof(T); ++i) bytes_.push_back(static_cast<std::byte>((value >> (8 * i)) & 0xff));
    }
    void number(float value) { number(std::bit_cast<std::uint32_t>(value)); }
    void append(std::span<const std::byte> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }

    const std::vector<std::byte>& bytes() const { return bytes_; }
    void clear() { bytes_.clear(); }

  private:
    std::vector<std::byte> bytes_;
};

/// Reads the output of a ByteWriter. Throws BytesError if the bytes end early.
class ByteReader {
  public:
    explicit ByteReader(std::span<const std::byte> bytes) : rest_(bytes) {}

    template <std::unsigned_integral T>
    T number() {
        std::uint64_t value = 0;
        const std::span<const std::byte> taken = take(sizeof(T));
        for (std::size_t i = 0; i < sizeof(T); ++i) value |= std::to_integer<std::uint64_t>(taken[i]) << (8 * i);
        return static_cast<T>(value);
    }
    float real() { return std::bit_cast<float>(number<std::uint32_t>()); }
    std::span<const std::byte> take(std::size_t count) {
        if (count > rest_.size()) throw BytesError("it ends too early");
        const std::span<const std::byte> taken = rest_.first(count);
        rest_ = rest_.subspan(count);
        return taken;
    }
    std::size_t bytes_left() const { return rest_.size(); }

  private:
    std::span<const std::byte> rest_;
};

}  // namespace phasetree::tracer
