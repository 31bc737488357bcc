// An accessor of glTF: rows of one to four numbers each, or of 16 of a matrix, which lie at equal distances in the
// bytes of the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "gltf/document.hpp"

namespace phasetree::tracer::gltf {

class Accessor {
  public:
    /// Throws GltfError if not all rows are in the file.
    Accessor(const Document&, std::size_t index, const Item& from);

    std::size_t rows() const { return rows_; }
    std::size_t columns() const { return columns_; }
    bool is_normalised() const { return is_normalised_; }
    /// Integers of an accessor that is `normalized` are divided by the largest number of their type.
    double number(std::size_t row, std::size_t column) const;
    /// Throws GltfError for what is no number, or is beyond 10¹⁵.
    double finite_number(std::size_t row, std::size_t column) const;
    /// Of rows of one whole number.
    std::uint32_t index(std::size_t row) const;

    [[noreturn]] void fail(std::string_view what) const { item_.fail(what); }

  private:
    enum class Type { int8 = 5120, uint8 = 5121, int16 = 5122, uint16 = 5123, uint32 = 5125, float32 = 5126 };

    Item item_;
    std::string_view bytes_;
    std::size_t rows_ = 0, columns_ = 0, stride_ = 0;
    Type type_{};
    bool is_normalised_ = false;
};

}  // namespace phasetree::tracer::gltf
