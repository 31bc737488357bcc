// An accessor of glTF: rows of one to four numbers, or of the 16 numbers of a matrix, at equal distances in the bytes
// of the file. Some rows of a sparse accessor are replaced by those of a second list. If it has no bytes of its own,
// all other rows are zero.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "gltf/document.hpp"

namespace phasetree::tracer::gltf {

class Accessors;

class Accessor {
  public:
    /// Throws GltfError if not all rows are in the file. Refers to bytes of the document or of `all`.
    Accessor(Accessors& all, std::size_t index, const Item& from);
    /// The same for decoded rows, without gaps between them. With `is_uint32`, their numbers have 32 bits, regardless
    /// of the accessor's type.
    Accessor(const Document&, std::size_t index, const Item& from, std::string_view decoded, bool is_uint32 = false);

    /// The number of numbers per row of an element of "accessors".
    static std::size_t columns_of(const Item&);

    std::size_t rows() const { return rows_; }
    std::size_t columns() const { return columns_; }
    bool is_normalised() const { return is_normalised_; }
    /// Integers of an accessor that is `normalized` are divided by the largest number of their type.
    double number(std::size_t row, std::size_t column) const;
    /// Throws GltfError if it is not finite, or is larger than 10¹⁵.
    double finite_number(std::size_t row, std::size_t column) const;
    /// The index in a row that has one whole number.
    std::uint32_t index(std::size_t row) const;

    [[noreturn]] void fail(std::string_view what) const { item_.fail(what); }

  private:
    enum class Type { int8 = 5120, uint8 = 5121, int16 = 5122, uint16 = 5123, uint32 = 5125, float32 = 5126 };
    struct Rows {
        std::string_view bytes;
        std::size_t stride = 0;
        Type type{};

        double number(std::size_t row, std::size_t column) const;
        std::uint32_t whole_number(std::size_t row) const;  // of an unsigned integer type
    };
    struct Replacements {
        std::size_t count = 0;
        Rows indices, values;

        std::optional<std::size_t> of(std::size_t row) const;
    };
    // The bytes of a row: a replaced one or an ordinary one; `rows` is null for zeros.
    struct Place {
        const Rows* rows;
        std::size_t row;
    };

    Accessor(const Document&, std::size_t index, const Item& from);
    static std::optional<Type> type_of(std::size_t number);
    static std::size_t size_of(Type);
    // `count` rows of a view, starting at an offset.
    static Rows rows_in(std::string_view bytes, std::size_t stride, std::size_t offset, std::size_t count, Type,
                        std::size_t columns, const Item& item);
    void read_replacements(Accessors& all, std::size_t index, const Item& sparse);
    Place place_of(std::size_t row) const;

    Item item_;
    std::size_t rows_ = 0, columns_ = 0;
    Rows values_{};
    bool is_normalised_ = false, has_values_ = false;  // without values, all rows that are not replaced are zero
    std::optional<Replacements> replacements_{};
};

}  // namespace phasetree::tracer::gltf
