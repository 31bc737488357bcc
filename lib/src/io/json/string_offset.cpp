#include "io/json/string_offset.hpp"

#include <charconv>

namespace phasetree::io {

std::size_t offset_in_string(std::string_view text, std::size_t string, std::size_t byte) {
    std::size_t at = string + 1;
    for (std::size_t meant = 0; meant < byte && at < text.size() && text[at] != '"';) {
        if (text[at] != '\\') {
            ++at, ++meant;
        } else if (at + 1 < text.size() && text[at + 1] == 'u') {
            unsigned code = 0;
            const std::string_view digits = text.substr(at + 2, 4);
            std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
            // A surrogate pair takes four bytes: two for each surrogate.
            meant += code < 0x80 ? 1 : code < 0x800 || (code >= 0xd800 && code < 0xe000) ? 2 : 3;
            at += 6;
        } else {
            at += 2, ++meant;
        }
    }
    return at;
}

}  // namespace phasetree::io
