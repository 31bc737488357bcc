// Makes file names from other names.
#pragma once

#include <cctype>
#include <cstddef>
#include <string>

namespace phasetree::tracer {

/// The name with ASCII characters that have a special meaning in file names replaced by _.
inline std::string in_file_name(std::string name) {
    // Names that consist only of dots are folders.
    for (std::size_t i = 0; i < name.size() && name[i] == '.'; ++i) name[i] = '_';
    for (char& c : name) {
        const auto code = static_cast<unsigned char>(c);
        if (code < 128 && !std::isalnum(code) && c != '-' && c != '_' && c != '.') c = '_';
    }
    return name;
}

}  // namespace phasetree::tracer
