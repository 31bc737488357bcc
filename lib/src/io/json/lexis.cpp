#include "io/json/lexis.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/json/utf8.hpp"

namespace phasetree::io {

namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_white(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

bool is_word(char c) {
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '+' || c == '-' ||
           c == '.' || c == '$' || static_cast<unsigned char>(c) >= 0x80;
}

std::size_t skip(std::string_view text, std::size_t at, bool over_separators) {
    if (at == 0 && text.starts_with(byte_order_mark)) at = byte_order_mark.size();
    while (at < text.size()) {
        if (is_white(text[at]) || (over_separators && (text[at] == ',' || text[at] == ':'))) {
            ++at;
        } else if (text.substr(at, 2) == "//") {
            at = std::min(text.find_first_of("\r\n", at), text.size());
        } else if (text.substr(at, 2) == "/*") {
            const std::size_t end = text.find("*/", at + 2);
            if (end == std::string_view::npos) return at;
            at = end + 2;
        } else {
            return at;
        }
    }
    return at;
}

}  // namespace

std::size_t skip_blank(std::string_view text, std::size_t at) {
    return skip(text, at, false);
}
std::size_t skip_to_token(std::string_view text, std::size_t at) {
    return skip(text, at, true);
}
bool begins_comment(std::string_view text, std::size_t at) {
    return text.substr(std::min(at, text.size()), 2) == "/*";
}

std::size_t number_end(std::string_view text, std::size_t at) {
    const auto digits = [&](std::size_t i) {
        while (i < text.size() && is_digit(text[i])) ++i;
        return i;
    };
    const auto is_at = [&](std::size_t i, std::string_view any_of) {
        return i < text.size() && any_of.find(text[i]) != std::string_view::npos;
    };
    const std::size_t first = at + (is_at(at, "-") ? 1 : 0);
    std::size_t end = is_at(first, "0") ? first + 1 : digits(first);
    if (end == first) return at;
    if (is_at(end, ".")) {
        const std::size_t fraction = digits(end + 1);
        if (fraction == end + 1) return end;
        end = fraction;
    }
    if (is_at(end, "eE")) {
        const std::size_t exponent = end + (is_at(end + 1, "+-") ? 2 : 1);
        if (digits(exponent) > exponent) end = digits(exponent);
    }
    return end;
}

std::size_t word_end(std::string_view text, std::size_t at) {
    while (at < text.size() && is_word(text[at])) ++at;
    return at;
}

std::size_t string_end(std::string_view text, std::size_t at) {
    for (std::size_t i = at + 1; i < text.size(); ++i) {
        if (text[i] == '"') return i + 1;
        if (text[i] == '\n' || text[i] == '\r') return i;
        if (text[i] == '\\') ++i;
    }
    return text.size();
}

std::string shown_token(std::string_view text, std::size_t at) {
    constexpr std::size_t longest = 40;
    if (text[at] == '"') return printable(text.substr(at, string_end(text, at) - at), longest);
    const std::size_t end = word_end(text, at);
    return fmt::format("'{}'", printable(text.substr(at, end > at ? end - at : 1), longest));
}

}  // namespace phasetree::io
