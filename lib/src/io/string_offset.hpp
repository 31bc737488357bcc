#pragma once

#include <cstddef>
#include <string_view>

namespace phasetree::io {

/// Where in a text the byte of a string's content stands. `string` is the offset of the string's opening quote, and
/// `byte` counts in what the string means, where "\n" is one byte and "\u00e4" are two.
std::size_t offset_in_string(std::string_view text, std::size_t string, std::size_t byte);

}  // namespace phasetree::io
