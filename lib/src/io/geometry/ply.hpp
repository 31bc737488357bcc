#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/geometry/words.hpp"
#include "phasetree_support/reading.hpp"

namespace phasetree::io {

/// A PLY file, in text or in binary of either byte order. Its header lists the elements and their properties; the rows
/// of the elements follow in order. Throws SceneError, like the readers in mesh_file.hpp.
class Ply {
  public:
    enum class Type : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
    struct Property {
        std::string name;
        Type type;
        std::optional<Type> count;  ///< for a list: the type of its length
    };
    struct Element {
        std::string name;
        std::uint64_t rows = 0;
        std::vector<Property> properties;

        /// The index of a property; nullopt if there is none with that name.
        std::optional<std::size_t> find(std::string_view property) const;
    };
    /// The values of each property in a row: one number, or those of a list. Anything in the file that is not a number
    /// becomes NaN.
    using Row = std::vector<std::vector<double>>;

    /// Reads the header, and checks that the file is long enough for what it claims.
    Ply(std::filesystem::path, std::string_view content);

    const std::vector<Element>& elements() const { return elements_; }
    /// Calls f(row) for each row of the next element. Elements must be read in order.
    template <class F>
    void for_each_row(const Element& element, F&& f) {
        Row row(element.properties.size());
        for (row_ = 1; row_ <= element.rows; ++row_) {
            read_row(element, row);
            f(static_cast<const Row&>(row));
            if (!is_second_) place_.reached(offset());
        }
    }
    /// Another reader, which starts at the current element, for elements that are needed only after others. It reports
    /// no progress.
    Ply second_reader() const {
        Ply second = *this;
        second.is_second_ = true;
        return second;
    }
    /// Call this when all required elements have been read.
    void finish() { place_.finished(content_.size()); }
    /// The number that the most recently read row has for a property. It is an error if the property is a list, or not
    /// a number.
    double number(const Element&, const Row&, std::size_t property) const;
    /// Throws an error at the most recently read row.
    [[noreturn]] void fail(const Element&, std::string_view what) const;

  private:
    enum class Format { words, little_endian, big_endian };

    [[noreturn]] void fail(std::string_view what) const;
    void read_header();
    void add_property();
    void check_claims() const;
    void read_row(const Element&, Row&);
    double read(const Element&, Type);
    std::size_t offset() const { return format_ == Format::words ? words_.offset() : content_.size() - rest_.size(); }

    std::filesystem::path path_;
    std::string_view content_;
    Words words_;
    std::string_view rest_;  // the data not yet read
    Format format_{};
    std::vector<Element> elements_;
    std::uint64_t row_ = 0;
    bool is_second_ = false;
    support::ReadingPlace place_;
};

}  // namespace phasetree::io
