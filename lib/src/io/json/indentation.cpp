#include "io/json/indentation.hpp"

#include <algorithm>
#include <vector>

#include "io/json/lexis.hpp"

namespace phasetree::io {

namespace {

struct Container {
    char closing;
    std::size_t line_indent;  // of the line on which it was opened
    // The indentation of the first line that begins with one of its members, or with an item that is a string, an
    // object or an array.
    std::optional<std::size_t> members_indent;
};

class Reader {
  public:
    Reader(std::string_view text, std::size_t end) : text_(text.substr(0, std::min(end, text.size()))) {}

    IndentationBreaks operator()() {
        for (std::size_t at = next(0); at < text_.size();) {
            const char c = text_[at];
            if (begins_line_ && (c == '"' || c == '{' || c == '[')) check_indentation();
            std::size_t after = at + 1;
            if (c == '{' || c == '[') {
                open_.push_back({c == '{' ? '}' : ']', line_indent_, std::nullopt});
            } else if (c == '}' || c == ']') {
                if (open_.empty() || open_.back().closing != c) break;
                open_.pop_back();
            } else if (c == '"') {
                after = string_end(text_, at);
            } else {
                after = std::max(after, word_end(text_, at));
            }
            last_ = at;
            at = next(after);
        }
        return found_;
    }

  private:
    // Returns the start of the next token at or after `from`. Sets begins_line_, and line_indent_ if the token begins a
    // line.
    std::size_t next(std::size_t from) {
        const std::size_t at = skip_blank(text_, from);
        const std::size_t line_end = text_.substr(from, at - from).find_last_of("\r\n");
        begins_line_ = from == 0 || line_end != std::string_view::npos;
        const std::size_t line = line_end == std::string_view::npos ? 0 : from + line_end + 1;
        // Comments before the token do not count as indentation.
        if (begins_line_) line_indent_ = std::min(text_.find_first_not_of(" \t", line), at) - line;
        return at;
    }

    void check_indentation() {
        if (open_.empty()) return;
        const bool is_root = open_.size() == 1;  // nothing can follow its bracket
        Container& in = open_.back();
        const char before = text_[last_];
        if (before == ':') return;  // a value on the line below its key
        if (in.members_indent) {
            if (!is_root && line_indent_ < *in.members_indent && line_indent_ <= in.line_indent)
                report_first(found_.missing, in.closing);
            if (line_indent_ > *in.members_indent && before == ',')
                report_first(found_.too_many, bracket_before_last_comma());
        } else if (!is_root && before == ',' && line_indent_ <= in.line_indent) {
            report_first(found_.missing, in.closing);
        }
        if (!in.members_indent) in.members_indent = line_indent_;
    }

    void report_first(std::optional<IndentationBreak>& found, char bracket) const {
        if (!found && bracket != '\0') found = IndentationBreak{last_, bracket};
    }

    // If the last token is a comma: the closing bracket immediately before it, or '\0' if there is another character.
    char bracket_before_last_comma() const {
        const std::size_t before = last_ > 0 ? text_.find_last_not_of(" \t\r\n", last_ - 1) : std::string_view::npos;
        const char c = before == std::string_view::npos ? '\0' : text_[before];
        return c == '}' || c == ']' ? c : '\0';
    }

    std::string_view text_;
    std::vector<Container> open_;
    IndentationBreaks found_;
    std::size_t last_ = 0;         // the start of the token before this one
    std::size_t line_indent_ = 0;  // of the current line
    bool begins_line_ = false;
};

}  // namespace

IndentationBreaks indentation_breaks(std::string_view text, std::size_t end) {
    return Reader(text, end)();
}

}  // namespace phasetree::io
