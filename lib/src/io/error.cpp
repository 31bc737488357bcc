#include "phasetree/io/error.hpp"

#include <algorithm>

#include "io/json/utf8.hpp"

namespace phasetree {

using io::CodePoint;
using io::decode;

struct SceneError::Details {
    std::string file;
    std::size_t line = 0;
    std::size_t column = 0;
    std::string message;
    std::string quoted_line;
    std::string caret_line;
    std::optional<std::string> suggestion;
};

namespace {

constexpr std::string_view indent = "  ";
constexpr std::size_t max_columns = 120;
constexpr std::size_t max_tab_columns = 8;  // maximum width of a tab
// The window contains the indent, an ellipsis at either end, and this many columns of the line on either side of the
// caret. The character under the caret belongs to the right side.
constexpr std::size_t side_columns = (max_columns - indent.size() - 2) / 2;

bool is_line_end(char c) {
    return c == '\n' || c == '\r';
}

// The number of columns reserved for a character in the window. It is at least one, so that the window is also short in
// bytes.
std::size_t window_columns(char32_t c) {
    if (c == '\t') return max_tab_columns;
    return static_cast<std::size_t>(std::max(io::columns_of(c), 1));
}

// The start of the character before `at`; first <= result < at.
std::size_t step_back(std::string_view text, std::size_t first, std::size_t at) {
    for (std::size_t bytes = 4; bytes > 1; --bytes) {
        if (at >= first + bytes && decode(text, at - bytes).bytes == bytes) return at - bytes;
    }
    return at - 1;
}

}  // namespace

SceneError::SceneError(std::shared_ptr<const Details> details)
    : std::runtime_error([&] {
          std::string out = io::printable(details->file);
          if (details->line > 0) {
              out += ':' + std::to_string(details->line) + ':' + std::to_string(details->column);
          }
          out += ": " + details->message;
          if (details->suggestion) out += " (did you mean " + io::in_quotes(*details->suggestion) + "?)";
          if (!details->caret_line.empty()) {
              out += '\n' + std::string(indent) + details->quoted_line;
              out += '\n' + std::string(indent) + details->caret_line;
          }
          return out;
      }()),
      details_(std::move(details)) {}

SceneError::SceneError(std::string file, std::string message, std::optional<std::string> suggestion)
    : SceneError(std::make_shared<const Details>(Details{.file = std::move(file),
                                                         .message = io::printable(message),
                                                         .quoted_line = {},
                                                         .caret_line = {},
                                                         .suggestion = std::move(suggestion)})) {}

SceneError::SceneError(std::string file, std::string_view text, std::size_t offset, std::string message,
                       std::optional<std::string> suggestion)
    : SceneError([&] {
          offset = std::min(offset, text.size());
          auto details = std::make_shared<Details>();
          details->file = std::move(file);
          details->message = io::printable(message);
          details->suggestion = std::move(suggestion);

          std::size_t first = text.starts_with(io::byte_order_mark) ? io::byte_order_mark.size() : 0;
          details->line = 1;
          for (std::size_t at = first; at < offset; ++at) {
              if (!is_line_end(text[at])) continue;
              if (text[at] == '\r' && at + 1 < text.size() && text[at + 1] == '\n') {
                  if (at + 1 == offset) break;  // between CR and LF, which belongs to the line that they end
                  ++at;
              }
              ++details->line;
              first = at + 1;
          }
          offset = std::max(offset, first);

          details->column = 1;
          std::size_t caret = first;
          while (caret < offset) {
              const std::size_t next = caret + decode(text, caret).bytes;
              if (next > offset) break;  // an offset inside a character refers to that character
              caret = next;
              ++details->column;
          }

          std::size_t begin = caret;
          for (std::size_t columns = 0; begin > first;) {
              const std::size_t before = step_back(text, first, begin);
              columns += window_columns(decode(text, before).value);
              if (columns > side_columns) break;
              begin = before;
          }
          std::string& quoted = details->quoted_line;
          std::string& under = details->caret_line;
          if (begin > first) {
              quoted += "…";
              under += ' ';
          }
          std::size_t columns = 0;
          for (std::size_t at = begin; at < text.size() && !is_line_end(text[at]);) {
              const CodePoint c = decode(text, at);
              if (at >= caret) {
                  columns += window_columns(c.value);
                  if (columns > side_columns) {
                      quoted += "…";
                      break;
                  }
              }
              // Keep tabs in both lines, so that the caret is under its character whatever the width of a tab.
              const bool is_tab = c.value == '\t';
              quoted += is_tab ? "\t" : io::printable_at(text, at, c);
              if (at < caret) under += is_tab ? "\t" : std::string(std::max(io::columns_of(c.value), 0), ' ');
              at += c.bytes;
          }
          under += '^';
          return std::shared_ptr<const Details>(std::move(details));
      }()) {}

SceneError::SceneError(std::string file, std::size_t line, std::size_t column, std::string message)
    : SceneError(std::make_shared<const Details>(Details{.file = std::move(file),
                                                         .line = line,
                                                         .column = column,
                                                         .message = io::printable(message),
                                                         .quoted_line = {},
                                                         .caret_line = {},
                                                         .suggestion = {}})) {}

const std::string& SceneError::file() const noexcept {
    return details_->file;
}
std::size_t SceneError::line() const noexcept {
    return details_->line;
}
std::size_t SceneError::column() const noexcept {
    return details_->column;
}
const std::string& SceneError::message() const noexcept {
    return details_->message;
}
const std::string& SceneError::quoted_line() const noexcept {
    return details_->quoted_line;
}
const std::optional<std::string>& SceneError::suggestion() const noexcept {
    return details_->suggestion;
}

}  // namespace phasetree
