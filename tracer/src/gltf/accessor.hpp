// An accessor of glTF: rows of one to four numbers each, or of 16 of a matrix, at equal distances in the bytes of the
// file. Rows of a sparse accessor are replaced by those of a second list; without bytes of its own the rest is zero.
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
    /// The same, but its rows are those that were decoded, without gaps between them. With `is_uint32` they are numbers
    /// of 32 bits, whatever the type of the accessor is.
    Accessor(const Document&, std::size_t index, const Item& from, std::string_view decoded, bool is_uint32 = false);

    /// How many numbers a row of an element of "accessors" has.
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
        std::uint32_t whole_number(std::size_t row) const;  // of a type that has no fractions and no signs
    };
    struct Replacements {
        std::size_t count = 0;
        Rows indices, values;

        std::optional<std::size_t> of(std::size_t row) const;
    };
    // A row's bytes: those of a replacement, or of the rest; `rows` is null for zeros.
    struct Place {
        const Rows* rows;
        std::size_t row;
    };

    Accessor(const Document&, std::size_t index, const Item& from);
    static std::optional<Type> type_of(std::size_t number);
    static std::size_t size_of(Type);
    // `count` rows of a view from an offset on.
    static Rows rows_in(std::string_view bytes, std::size_t stride, std::size_t offset, std::size_t count, Type,
                        std::size_t columns, const Item& item);
    void read_replacements(Accessors& all, std::size_t index, const Item& sparse);
    Place place_of(std::size_t row) const;

    Item item_;
    std::size_t rows_ = 0, columns_ = 0;
    Rows values_{};
    bool is_normalised_ = false, has_values_ = false;  // without values all that is not replaced is zero
    std::optional<Replacements> replacements_{};
};

}  // namespace phasetree::tracer::gltf
