#pragma once

#include <cstddef>
#include <string_view>

namespace phasetree::io {

/// The offset in a text of a byte of a string's content. `string` is the offset of the string's opening quote. `byte`
/// counts bytes of the unescaped string, in which "\n" is one byte and "\u00e4" two.
std::size_t offset_in_string(std::string_view text, std::size_t string, std::size_t byte);

}  // namespace phasetree::io
