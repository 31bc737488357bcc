#pragma once

#include <cstddef>
#include <string>
#include <string_view>

// The tokens of JSON text (RFC 8259), as far as positions and error messages need them. The parser itself has its own.
namespace phasetree::io {

/// The first byte at or after `at` that is neither white space nor inside a comment. Stops at a '/' that begins an
/// unterminated comment or none.
std::size_t skip_blank(std::string_view text, std::size_t at);

/// Does the same, but also skips commas and colons.
std::size_t skip_to_token(std::string_view text, std::size_t at);

/// Whether an unterminated /* comment begins here.
bool begins_comment(std::string_view text, std::size_t at);

/// The end of the longest JSON number that begins at `at`; `at` itself if there is none.
std::size_t number_end(std::string_view text, std::size_t at);

/// The end of the run of letters, digits and signs, as in names and numbers, that begins at `at`.
std::size_t word_end(std::string_view text, std::size_t at);

/// The end of the string that opens at `at`: past its closing quote, or the end of the line if the quote is missing.
std::size_t string_end(std::string_view text, std::size_t at);

/// The token at `at` in the form shown by error messages: '}', 'word', "string".
std::string shown_token(std::string_view text, std::size_t at);

}  // namespace phasetree::io
