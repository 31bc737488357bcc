// Conversion of bytes to the text that write_file takes.
#pragma once

#include <string>
#include <string_view>

#include "film/bytes.hpp"

namespace phasetree::tracer {

inline std::string bytes_as_text(const ByteWriter& writer) {
    return {reinterpret_cast<const char*>(writer.bytes().data()), writer.bytes().size()};
}
// Append byte by byte: GCC 12 warns about an append that it inlines into an empty writer.
inline void append_text(ByteWriter& writer, std::string_view text) {
    for (const char c : text) writer.number(static_cast<std::uint8_t>(c));
}

}  // namespace phasetree::tracer
