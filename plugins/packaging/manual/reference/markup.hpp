// The little markup that comments have.
#pragma once

#include <string>
#include <vector>

namespace phasetree::manual {

enum class Style {
    plain,
    code,      // between backticks
    emphasis,  // between stars
    name       // of this interface or of Embree's, without any mark
};

struct Span {
    Style style;
    std::string text;
};

std::vector<Span> spans_of(const std::string& text);

// Without the marks.
std::string plain(const std::string& text);

}  // namespace phasetree::manual
