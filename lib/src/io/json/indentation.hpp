#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace phasetree::io {

/// A position where the indentation of a JSON text contradicts its brackets: the next line is indented as if one
/// bracket more, or one fewer, had been closed before it. A bracket is probably missing or superfluous there. The
/// parser only notices this much later.
struct IndentationBreak {
    std::size_t at;  ///< the last token before the line that does not match
    char bracket;    ///< the missing or superfluous bracket
};

struct IndentationBreaks {
    std::optional<IndentationBreak> missing, too_many;  ///< the first of each kind
};

/// Reads the text before `end`, which must consist of valid tokens. A line is reported only if there is another line to
/// compare it with, so a text without indentation gives few reports or none.
IndentationBreaks indentation_breaks(std::string_view text, std::size_t end);

}  // namespace phasetree::io
