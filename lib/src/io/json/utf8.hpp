#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace phasetree::io {

/// One step through a UTF-8 text: a code point, or a single byte that does not begin one.
struct CodePoint {
    char32_t value = 0xFFFD;  ///< U+FFFD for a byte that is not UTF-8
    std::size_t bytes = 1;
    bool is_valid = false;
};

/// The code point that begins at text[at]; at < text.size(). Overlong forms, surrogates and truncated sequences are
/// invalid (Unicode 15, table 3-7).
CodePoint decode(std::string_view text, std::size_t at);

/// The number of terminal columns of a printable code point: 0 for combining marks, 2 for East Asian wide characters
/// and emoji, otherwise 1 (after Unicode's EastAsianWidth, by blocks).
int columns_of(char32_t c);

/// The code point at text[at] in a form that is safe on a terminal and always visible. Control characters become their
/// pictures (U+2400 …). Characters that would hide or reorder text, and invalid UTF-8, become U+FFFD.
std::string printable_at(std::string_view text, std::size_t at, const CodePoint& c);

/// The whole text made printable and truncated to this many code points, the last of which is then an ellipsis.
std::string printable(std::string_view text, std::size_t max_code_points = 1000);

/// "text", printable and short, in double quotes.
std::string in_quotes(std::string_view text);

inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

}  // namespace phasetree::io
