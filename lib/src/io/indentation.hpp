#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace phasetree::io {

/// A place where the indentation of a JSON text contradicts its brackets: the next line is indented as if one more
/// bracket had been closed before it, or one fewer. A bracket was probably forgotten there, or is too many. The parser
/// notices that only much later.
struct IndentationBreak {
    std::size_t at;  ///< the last token before the line that does not fit
    char bracket;    ///< the one that is missing there, or is too many
};

struct IndentationBreaks {
    std::optional<IndentationBreak> missing, too_many;  ///< the first of each
};

/// Reads the text before `end`, which must consist of good tokens. A line is reported only if there is a line to
/// compare it with, so a text without indentation gives few reports or none.
IndentationBreaks indentation_breaks(std::string_view text, std::size_t end);

}  // namespace phasetree::io
