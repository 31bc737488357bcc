// New values for a scene file, written as a person would.
#pragma once

#include <string>
#include <string_view>

#include "phasetree/io/document.hpp"
#include "studio/layout.hpp"

namespace phasetree::tracer::studio {

/// Where a value begins in a text, and the text's style.
struct Place {
    std::string indentation;  ///< of the line
    std::size_t column = 0;   ///< at which the value begins, in bytes
    std::string unit = "  ";  ///< one more level of indentation
    std::string line_ending = "\n";

    static constexpr std::size_t width = 120;  ///< of a line, unless something unbreakable is longer
};

/// The place of something at an offset of a text.
Place place_at(std::string_view text, std::size_t offset);

/// A value at a place: on one line if it fits, otherwise with its parts on lines of their own. Numbers and strings stay
/// as they are written. A text with comments keeps its lines, and only their indentation changes.
std::string value_text(const Document& value, const Place& place);

/// A piece of a text, moved from one place to another: the indentation of its lines changes.
std::string moved_text(std::string_view piece, const Place& from, const Place& to);

/// The text of `around` at the place `to`, with its only null replaced by `piece`, which stood at the place `from`.
/// Throws SceneError unless there is exactly one null.
std::string wrapped_text(const Document& around, std::string_view piece, const Place& from, const Place& to);

}  // namespace phasetree::tracer::studio
