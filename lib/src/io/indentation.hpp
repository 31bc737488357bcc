#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace phasetree::io {

/// Where the indentation of a JSON text says something else than its brackets: a line that follows is indented as if
/// one bracket more, or one fewer, were closed. That is where people forgot a bracket, or wrote one too many, which the
/// parser sees much later.
struct IndentationBreak {
    std::size_t at;  ///< the last token before the line that does not fit
    char bracket;    ///< the one that is missing there, or is too many
};

struct IndentationBreaks {
    std::optional<IndentationBreak> missing, too_many;  ///< the first of each
};

/// Looks at what is before `end`, in which all tokens are good. Lines of which nothing is known, as of a text without
/// indentation, fit.
IndentationBreaks indentation_breaks(std::string_view text, std::size_t end);

}  // namespace phasetree::io
