// The language of manual pages.
#pragma once

#include <string>
#include <string_view>

namespace phasetree::manual {

// Prose: a backslash stays one, and no line is taken for a request because of how it begins.
inline std::string roff(std::string_view text, bool starts_line = true) {
    std::string escaped;
    for (const char c : text) {
        if (starts_line && (c == '.' || c == '\'')) escaped += "\\&";
        starts_line = c == '\n';
        if (c == '\\')
            escaped += "\\e";
        else
            escaped += c;
    }
    return escaped;
}

// What may be copied into a terminal or a program: a minus is not printed as a hyphen, nor quotes as others.
inline std::string roff_code(std::string_view text) {
    std::string escaped;
    for (const char c : roff(text)) {
        switch (c) {
            case '-':
                escaped += "\\-";
                break;
            case '~':
                escaped += "\\(ti";
                break;
            case '^':
                escaped += "\\(ha";
                break;
            case '\'':
                escaped += "\\(aq";
                break;
            case '`':
                escaped += "\\(ga";
                break;
            default:
                escaped += c;
        }
    }
    return escaped;
}

}  // namespace phasetree::manual
