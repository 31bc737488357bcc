#include "studio/value_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace phasetree::tracer::studio {

namespace {

bool is_scalar(Value value) {
    return !value.is_array() && !value.is_object();
}

// The key of a member as it is written, with ": ".
std::string key_text(const Document& document, Value member) {
    return std::string(span_of_value(document.text(), member.key_offset()).of(document.text())) + ": ";
}

// Prints the values of a document.
class Printer {
  public:
    // `instead_of_null` is printed instead of null, if given.
    Printer(const Document& document, const Place& place, std::optional<std::string> instead_of_null)
        : document_(document), place_(place), instead_of_null_(std::move(instead_of_null)) {}

    std::string flat(Value value) const {
        if (value.is_null() && instead_of_null_) return *instead_of_null_;
        if (is_scalar(value)) return std::string(span_of(document_, value).of(document_.text()));
        std::string text(1, value.is_object() ? '{' : '[');
        for (const Value child : value) {
            if (text.size() > 1) text += ", ";
            if (value.is_object()) text += key_text(document_, child);
            text += flat(child);
        }
        return text + (value.is_object() ? '}' : ']');
    }

    // The value on as many lines as it needs. `column` is where it begins, and `after` the number of brackets that
    // follow it on its last line.
    std::string broken(Value value, const std::string& indentation, std::size_t column, std::size_t after) const {
        std::string text = flat(value);
        if (is_scalar(value) || value.size() == 0) return text;
        if (column + text.size() + after <= Place::width && !has_line_break(text)) return text;
        const char* const brackets = value.is_object() ? "{}" : "[]";
        // {"translate": {"by": …}} keeps the node's name on the line of its bracket.
        if (value.is_object() && value.size() == 1 && !is_scalar(value[0])) {
            const std::string key = key_text(document_, value[0]);
            return "{" + key + broken(value[0], indentation, column + 1 + key.size(), after + 1) + "}";
        }
        const std::string inner = indentation + place_.unit, line = place_.line_ending + inner;
        const bool is_of_scalars = !value.is_object() && std::all_of(value.begin(), value.end(), is_scalar);
        text = brackets[0];
        std::size_t at = 0;  // the column, on a line of scalars
        for (const Value child : value) {
            const std::string key = value.is_object() ? key_text(document_, child) : "";
            const std::string part = key + broken(child, inner, inner.size() + key.size(), 1);
            const bool is_first = text.size() == 1;
            if (!is_first && is_of_scalars && at + part.size() + 3 <= Place::width) {
                text += ", " + part;
                at += part.size() + 2;
            } else {
                text += (is_first ? "" : ",") + line + part;
                at = inner.size() + part.size();
            }
        }
        return text + place_.line_ending + indentation + brackets[1];
    }

  private:
    const Document& document_;
    const Place& place_;
    std::optional<std::string> instead_of_null_;
};

// The lines of a text without their line endings.
std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    for (std::size_t begin = 0;;) {
        const std::size_t end = std::min(text.find_first_of("\r\n", begin), text.size());
        lines.push_back(text.substr(begin, end - begin));
        if (end == text.size()) return lines;
        begin = end + (text.substr(end, 2) == "\r\n" ? 2 : 1);
    }
}

std::size_t indent_of(std::string_view line) {
    return std::min(line.find_first_not_of(" \t"), line.size());
}

// Finds the only null in a value. Throws SceneError if there is more than one.
void find_only_null(const Document& document, Value value, std::optional<Value>& found) {
    if (value.is_null()) {
        if (found) throw document.error(value, "only one null may stand for the wrapped value, but there are more");
        found = value;
    }
    for (const Value child : value) find_only_null(document, child, found);
}

}  // namespace

Place place_at(std::string_view text, std::size_t offset) {
    return {indentation_at(text, offset), column_at(text, offset), indentation_unit_of(text), line_ending_of(text)};
}

std::string value_text(const Document& value, const Place& place) {
    const Span span = span_of(value, value.root());
    const std::string_view text = span.of(value.text());
    if (has_comments(text)) return moved_text(text, place_at(value.text(), span.begin), place);
    return Printer(value, place, {}).broken(value.root(), place.indentation, place.column, 1);
}

std::string moved_text(std::string_view piece, const Place& from, const Place& to) {
    const std::vector<std::string_view> lines = lines_of(piece);
    std::string result(lines[0]);
    if (lines.size() == 1) return result;
    std::size_t least = std::string_view::npos;
    bool has_prefix = true;  // whether each line begins with the indentation of the first
    for (std::size_t i = 1; i < lines.size(); ++i) {
        if (indent_of(lines[i]) == lines[i].size()) continue;
        least = std::min(least, indent_of(lines[i]));
        has_prefix = has_prefix && lines[i].starts_with(from.indentation);
    }
    // Lines that are aligned with the column where the value begins follow that column.
    const bool is_aligned = least != std::string_view::npos && least > from.column && from.column > 0;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        std::string_view line = lines[i];
        result += to.line_ending;
        if (indent_of(line) == line.size()) continue;
        if (is_aligned) {
            line.remove_prefix(from.column);
            result += std::string(to.column, ' ');
        } else if (has_prefix) {
            line.remove_prefix(from.indentation.size());
            result += to.indentation;
        }
        result += line;
    }
    return result;
}

std::string wrapped_text(const Document& around, std::string_view piece, const Place& from, const Place& to) {
    std::optional<Value> null;
    find_only_null(around, around.root(), null);
    if (!null) throw around.error(around.root(), "one null must stand for the wrapped value, but there is none");
    const Span span = span_of(around, around.root());
    const std::string_view text = span.of(around.text());
    const bool is_raw = has_comments(text);
    // Print a mark instead of the piece to see where it goes.
    const std::string mark = "\x01";
    std::string result;
    if (is_raw) {
        const Place from_here = place_at(around.text(), span.begin);
        std::string marked(text);
        marked.replace(null->offset() - span.begin, 4, mark);
        result = moved_text(marked, from_here, to);
    } else if (!has_line_break(piece)) {
        result = Printer(around, to, std::string(piece)).broken(around.root(), to.indentation, to.column, 1);
        return result;
    } else {
        result = Printer(around, to, mark).flat(around.root());
    }
    const std::size_t at = result.find(mark);
    Place place = to;
    const bool is_on_first_line = !has_line_break(std::string_view(result).substr(0, at));
    if (is_on_first_line) {
        place.column = to.column + at;
    } else {
        place.indentation = indentation_at(result, at);
        place.column = column_at(result, at);
    }
    return result.replace(at, 1, moved_text(piece, from, place));
}

}  // namespace phasetree::tracer::studio
