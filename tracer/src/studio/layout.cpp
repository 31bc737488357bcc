#include "studio/layout.hpp"

#include <algorithm>

namespace phasetree::tracer::studio {

namespace {

bool is_line_break(char c) {
    return c == '\n' || c == '\r';
}

// The end of the string whose opening quote is at `at`.
std::size_t end_of_string(std::string_view text, std::size_t at) {
    for (std::size_t i = at + 1; i < text.size(); ++i) {
        if (text[i] == '"') return i + 1;
        if (text[i] == '\\') ++i;
    }
    return text.size();
}

// The end of the comment at `at`, or `at` if there is none.
std::size_t end_of_comment(std::string_view text, std::size_t at) {
    const std::string_view start = text.substr(at, 2);
    if (start == "//") return std::min(text.find_first_of("\r\n", at), text.size());
    if (start != "/*") return at;
    const std::size_t end = text.find("*/", at + 2);
    return end == std::string_view::npos ? text.size() : end + 2;
}

std::size_t line_begin(std::string_view text, std::size_t offset) {
    while (offset > 0 && !is_line_break(text[offset - 1])) --offset;
    return offset;
}

}  // namespace

std::size_t skip_blank(std::string_view text, std::size_t at) {
    if (at == 0 && text.starts_with("\xEF\xBB\xBF")) at = 3;
    while (at < text.size()) {
        if (text[at] == ' ' || text[at] == '\t' || is_line_break(text[at])) {
            ++at;
            continue;
        }
        const std::size_t end = end_of_comment(text, at);
        if (end == at) break;
        at = end;
    }
    return at;
}

Span span_of_value(std::string_view text, std::size_t begin) {
    const char first = text[begin];
    if (first == '"') return {begin, end_of_string(text, begin)};
    if (first != '{' && first != '[') return {begin, std::min(text.find_first_of(" \t\r\n,]}/", begin), text.size())};
    std::size_t depth = 0;
    for (std::size_t i = begin; i < text.size();) {
        const char c = text[i];
        if (c == '"') {
            i = end_of_string(text, i);
            continue;
        }
        if (const std::size_t end = end_of_comment(text, i); end != i) {
            i = end;
            continue;
        }
        ++i;
        if (c == '{' || c == '[') ++depth;
        if ((c == '}' || c == ']') && --depth == 0) return {begin, i};
    }
    return {begin, text.size()};
}

bool has_comments(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        if (text[i] == '"')
            i = end_of_string(text, i);
        else if (end_of_comment(text, i) != i)
            return true;
        else
            ++i;
    }
    return false;
}

Container container_of(const Document& document, Value value) {
    const std::string& text = document.text();
    Container result;
    result.is_object = value.is_object();
    result.open = value.offset();
    std::size_t at = result.open + 1;
    for (const Value item : value) {
        const Span span = span_of(document, item);
        result.items.push_back({result.is_object ? item.key_offset() : span.begin, span.end});
        at = span.end;
    }
    result.close = skip_blank(text, at);
    return result;
}

bool Container::is_multiline(std::string_view text) const {
    for (std::size_t i = 0; i <= items.size(); ++i)
        if (has_line_break(gap(i).of(text))) return true;
    return false;
}

std::string indentation_at(std::string_view text, std::size_t offset) {
    const std::size_t begin = line_begin(text, offset);
    std::size_t end = begin;
    while (end < offset && (text[end] == ' ' || text[end] == '\t')) ++end;
    return std::string(text.substr(begin, end - begin));
}

std::size_t column_at(std::string_view text, std::size_t offset) {
    return offset - line_begin(text, offset);
}

bool begins_line(std::string_view text, std::size_t offset) {
    return indentation_at(text, offset).size() == column_at(text, offset);
}

std::string line_ending_of(std::string_view text) {
    const std::size_t first = text.find_first_of("\r\n");
    if (first == std::string_view::npos || text[first] == '\n') return "\n";
    return first + 1 < text.size() && text[first + 1] == '\n' ? "\r\n" : "\r";
}

std::string indentation_unit_of(std::string_view text) {
    for (std::size_t i = 0; (i = text.find_first_of("\r\n", i)) != std::string_view::npos; ++i) {
        std::size_t end = i + 1;
        while (end < text.size() && (text[end] == ' ' || text[end] == '\t')) ++end;
        // The first indented line that begins a member or an item shows what a level is.
        if (end == i + 1 || end >= text.size() || is_line_break(text[end]) || text[end] == '/') continue;
        const std::string_view found = text.substr(i + 1, end - i - 1);
        if (found[0] == '\t') return "\t";
        return found.size() <= 8 ? std::string(found) : "  ";
    }
    return "  ";
}

}  // namespace phasetree::tracer::studio
