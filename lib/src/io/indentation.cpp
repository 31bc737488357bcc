#include "io/indentation.hpp"

#include <algorithm>
#include <vector>

#include "io/lexis.hpp"

namespace phasetree::io {

namespace {

struct Container {
    char closing;
    std::size_t line_indent;                    // of the line in which it was opened
    std::optional<std::size_t> members_indent;  // of the lines that begin with one of its members or items
};

class Reader {
  public:
    Reader(std::string_view text, std::size_t end) : text_(text.substr(0, std::min(end, text.size()))) {}

    IndentationBreaks operator()() {
        for (std::size_t at = next(0); at < text_.size();) {
            const char c = text_[at];
            if (begins_line_ && (c == '"' || c == '{' || c == '[')) member_at_line_start();
            std::size_t behind = at + 1;
            if (c == '{' || c == '[') {
                open_.push_back({c == '{' ? '}' : ']', line_indent_, std::nullopt});
            } else if (c == '}' || c == ']') {
                if (open_.empty() || open_.back().closing != c) break;
                open_.pop_back();
            } else if (c == '"') {
                behind = string_end(text_, at);
            } else {
                behind = std::max(behind, word_end(text_, at));
            }
            last_ = at;
            at = next(behind);
        }
        return found_;
    }

  private:
    // The token at `from` or after it; tells whether it is the first of its line.
    std::size_t next(std::size_t from) {
        const std::size_t at = skip_blank(text_, from);
        const std::size_t line_end = text_.substr(from, at - from).find_last_of("\r\n");
        begins_line_ = from == 0 || line_end != std::string_view::npos;
        if (begins_line_) line_indent_ = line_end == std::string_view::npos ? at : at - (from + line_end + 1);
        return at;
    }

    void member_at_line_start() {
        if (open_.empty()) return;
        Container& in = open_.back();
        const char before = text_[last_];
        if (in.members_indent) {
            if (line_indent_ < *in.members_indent && line_indent_ <= in.line_indent) tell(found_.missing, in.closing);
            if (line_indent_ > *in.members_indent && (before == '}' || before == ']' || before == ','))
                tell(found_.too_many, last_closing());
        } else if (before == ',' && line_indent_ <= in.line_indent) {
            tell(found_.missing, in.closing);
        }
        if (!in.members_indent) in.members_indent = line_indent_;
    }

    void tell(std::optional<IndentationBreak>& found, char bracket) const {
        if (!found && bracket != '\0') found = IndentationBreak{last_, bracket};
    }

    // The closing bracket before the comma that the last token is; none, if there is something else.
    char last_closing() const {
        const std::size_t before = last_ > 0 ? text_.find_last_not_of(" \t\r\n", last_ - 1) : std::string_view::npos;
        const char c = before == std::string_view::npos ? '\0' : text_[before];
        return c == '}' || c == ']' ? c : '\0';
    }

    std::string_view text_;
    std::vector<Container> open_;
    IndentationBreaks found_;
    std::size_t last_ = 0;         // the token before
    std::size_t line_indent_ = 0;  // of the current line
    bool begins_line_ = false;
};

}  // namespace

IndentationBreaks indentation_breaks(std::string_view text, std::size_t end) {
    return Reader(text, end)();
}

}  // namespace phasetree::io
