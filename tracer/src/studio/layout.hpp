// Where the values of a JSON text with comments begin and end, and how its lines are indented.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "phasetree/io/document.hpp"

namespace phasetree::tracer::studio {

/// A range of bytes of a text.
struct Span {
    std::size_t begin = 0, end = 0;

    std::size_t size() const { return end - begin; }
    std::string_view of(std::string_view text) const { return text.substr(begin, size()); }
};

/// The first byte at or after `at` that is neither white space nor in a comment. The text must be valid.
std::size_t skip_blank(std::string_view text, std::size_t at);

/// The bytes of the value that begins at an offset. The text must be valid. Takes time proportional to the value.
Span span_of_value(std::string_view text, std::size_t begin);
inline Span span_of(const Document& document, Value value) {
    return span_of_value(document.text(), value.offset());
}

/// Whether a piece of a valid text contains comments. Strings with slashes do not count.
bool has_comments(std::string_view text);

/// Whether a piece of text contains a line break.
inline bool has_line_break(std::string_view text) {
    return text.find_first_of("\r\n") != std::string_view::npos;
}

/// The extents of an array's items or an object's members. A member extends from its key to the end of its value.
struct Container {
    bool is_object = false;
    std::size_t open = 0, close = 0;  ///< offsets of the brackets
    std::vector<Span> items{};

    /// The bytes between item i − 1, or the opening bracket, and item i, or the closing bracket.
    Span gap(std::size_t i) const {
        return {i == 0 ? open + 1 : items[i - 1].end, i == items.size() ? close : items[i].begin};
    }
    /// Whether there is a line break between any two items, or between an item and a bracket.
    bool is_multiline(std::string_view text) const;
};

/// `value` must be an array or an object.
Container container_of(const Document& document, Value value);

/// White space at the beginning of the line that contains an offset.
std::string indentation_at(std::string_view text, std::size_t offset);
/// The number of bytes between the beginning of the line and an offset.
std::size_t column_at(std::string_view text, std::size_t offset);
/// Whether only white space precedes an offset on its line.
bool begins_line(std::string_view text, std::size_t offset);

/// The line ending of a text: that of its first line, or "\n".
std::string line_ending_of(std::string_view text);
/// What one level of indentation adds in this text; two spaces unless a line shows something else.
std::string indentation_unit_of(std::string_view text);

}  // namespace phasetree::tracer::studio
