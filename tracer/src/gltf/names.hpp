// Cleans names from a glTF file for use in messages and scene files.
#pragma once

#include <cstddef>
#include <string>

namespace phasetree::tracer::gltf {

/// The name without control characters, on one line, and at most 60 bytes long. It stays valid UTF-8.
inline std::string clean_name(std::string name) {
    constexpr std::size_t longest = 60;
    if (name.size() > longest) {
        std::size_t end = longest;
        while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0) == 0x80) --end;  // within a character of UTF-8
        name.resize(end);
    }
    std::string clean;
    for (std::size_t i = 0; i < name.size(); ++i) {
        const auto c = static_cast<unsigned char>(name[i]);
        // Control characters have one byte or two.
        const bool is_two = c == 0xC2 && i + 1 < name.size() && static_cast<unsigned char>(name[i + 1]) < 0xA0;
        if (is_two) ++i;
        clean += c < 0x20 || c == 0x7F || is_two ? '_' : name[i];
    }
    return clean;
}

}  // namespace phasetree::tracer::gltf
