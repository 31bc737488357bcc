#include "io/json/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "io/json/indentation.hpp"
#include "io/json/lexis.hpp"
#include "io/json/utf8.hpp"
#include "phasetree/io/suggest.hpp"

namespace phasetree::io {

namespace {

class Diagnosis {
  public:
    Diagnosis(std::string_view name, std::string_view text, const Failure& failure)
        : name_(name), text_(text), failure_(failure) {}

    SceneError operator()() const {
        const std::size_t at = skip_blank(text_, failure_.last_token_end);
        switch (failure_.expecting) {
            case Expecting::document:
            case Expecting::first_item:
                return value(at, "a value");
            case Expecting::first_key:
                return key(at);
            case Expecting::colon: {
                if (is_end(at) || text_[at] == ':') return value(skip_blank(text_, at + 1), "a value");
                return expected(at, fmt::format("':' after the key {}", shown_token(text_, failure_.last_token)));
            }
            case Expecting::next_item:
                return next(at, ']');
            case Expecting::next_member:
                return next(at, '}');
            case Expecting::end_of_file: {
                if (const auto error = broken_word(at)) return *error;
                return expected(at, "the end of the file");
            }
        }
        return expected(at, "a value");
    }

  private:
    SceneError error(std::size_t at, std::string message, std::optional<std::string> suggestion = {}) const {
        return {std::string(name_), text_, at, std::move(message), std::move(suggestion)};
    }

    bool is_end(std::size_t at) const { return at >= text_.size(); }

    // Point just after the last visible character, because an empty last line would be uninformative.
    SceneError ends_early() const {
        const std::size_t last = text_.find_last_not_of(" \t\r\n");
        const std::size_t end = last == std::string_view::npos ? 0 : last + 1;
        if (!failure_.opened) {
            const bool is_blank = end == 0 || text_.substr(0, end) == byte_order_mark;
            return error(end, is_blank ? "the file is empty" : "the file contains only comments");
        }
        const std::size_t opened = *failure_.opened;
        const std::size_t line = line_of(opened);
        return error(end,
                     fmt::format("the file ends inside {} that was opened at line {}{}",
                                 text_[opened] == '{' ? "an object" : "an array", line, hint_of_missing_bracket(end)));
    }

    std::size_t line_of(std::size_t at) const { return SceneError({}, text_, at, {}).line(); }

    // Both functions return a clause for the end of a message. It names the line where, judging by the indentation, a
    // bracket is missing or superfluous. It is empty if nothing is found, or if that is the line of the error itself.
    std::string hint_of_missing_bracket(std::size_t at) const {
        const auto missing = indentation_breaks(text_, at).missing;
        if (!missing || line_of(missing->at) == line_of(at)) return "";
        return fmt::format("; by the indentation, line {} lacks a '{}'", line_of(missing->at), missing->bracket);
    }
    std::string hint_of_extra_bracket(std::size_t at) const {
        const auto too_many = indentation_breaks(text_, at).too_many;
        if (!too_many || line_of(too_many->at) == line_of(at)) return "";
        return fmt::format("; by the indentation, line {} has a '{}' too many", line_of(too_many->at),
                           too_many->bracket);
    }

    SceneError expected(std::size_t at, std::string_view what, std::optional<std::string> suggestion = {}) const {
        if (is_end(at)) return ends_early();
        if (begins_comment(text_, at)) return error(at, "unterminated comment: no */ follows");
        if (text_[at] == '#') return error(at, "a comment begins with // or /*, not with #");
        if (text_[at] == '\'') return error(at, "strings must be in \"double quotes\", not in 'single quotes'");
        const bool is_bracket = std::string_view("{}[]:").find(text_[at]) != std::string_view::npos;
        const std::string hint = failure_.expecting == Expecting::end_of_file ? hint_of_extra_bracket(at)
                                 : is_bracket                                 ? hint_of_missing_bracket(at)
                                                                              : "";
        return error(at, fmt::format("expected {}, found {}{}", what, shown_token(text_, at), hint),
                     std::move(suggestion));
    }

    // After an item or a member: a comma and whatever must follow it, or the closing bracket.
    SceneError next(std::size_t at, char bracket) const {
        if (const auto broken = broken_word(at)) return *broken;
        if (is_end(at) || text_[at] != ',') return expected(at, fmt::format("',' or '{}'", bracket));
        const std::size_t after = skip_blank(text_, at + 1);
        if (!is_end(after) && text_[after] == bracket) {
            return error(at, fmt::format("remove the comma before '{}'", bracket));
        }
        return bracket == ']' ? value(after, "a value") : key(after);
    }

    SceneError key(std::size_t at) const {
        if (is_end(at) || text_[at] != '"') return expected(at, "a key in double quotes");
        return broken_string(at);
    }

    SceneError value(std::size_t at, std::string_view what) const {
        if (is_end(at)) return ends_early();
        if (text_[at] == '"') return broken_string(at);
        const std::string word(text_.substr(at, word_end(text_, at) - at));
        if (word.empty()) return expected(at, what);
        // The parser accepts every well-formed finite number, so a well-formed number here is not finite.
        if (is_not_finite(word) || number_end(text_, at) == at + word.size()) {
            return error(at, fmt::format("{} is not a finite number", shown_token(text_, at)));
        }
        const std::size_t unsigned_part = word.find_first_not_of("+-.");
        const bool is_number = unsigned_part == std::string::npos || is_digit(word[unsigned_part]);
        return is_number ? broken_number(at) : expected(at, what, closest(word, {"true", "false", "null"}));
    }

    static bool is_digit(char c) { return c >= '0' && c <= '9'; }

    static bool is_not_finite(std::string word) {
        for (char& c : word) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c;
        const std::string_view bare = std::string_view(word).substr(word[0] == '-' || word[0] == '+' ? 1 : 0);
        return bare == "nan" || bare == "inf" || bare == "infinity";
    }

    // For example 01, 0x10, 1.5f, truely: the parser reads a number or a literal, and then fails on the characters
    // attached to it.
    std::optional<SceneError> broken_word(std::size_t at) const {
        const bool sticks = failure_.last_is_word && at == failure_.last_token_end && word_end(text_, at) > at;
        if (!sticks) return std::nullopt;
        const std::size_t first = failure_.last_token;
        if (number_end(text_, first) > first) return broken_number(first);
        return expected(first, "a value",
                        closest(text_.substr(first, word_end(text_, first) - first), {"true", "false", "null"}));
    }

    SceneError broken_number(std::size_t at) const {
        const std::string_view word = text_.substr(at, word_end(text_, at) - at);
        // Syntax that other languages allow: a leading plus or leading zeros, and no digit before or after the point.
        std::string better(word.substr(std::min(word.find_first_not_of("+-"), word.size())));
        better.erase(0, std::min(better.find_first_not_of('0'), better.size()));
        if (better.empty() || !is_digit(better[0])) better.insert(0, 1, '0');
        const std::size_t point = better.find('.');
        if (point != std::string::npos && (point + 1 == better.size() || !is_digit(better[point + 1]))) {
            better.erase(point, 1);
        }
        if (word[0] == '-') better.insert(0, 1, '-');
        const bool has_digit = std::any_of(word.begin(), word.end(), is_digit);
        const bool is_good = has_digit && word.size() < 40 && number_end(better, 0) == better.size();
        return error(at, fmt::format("{} is not a valid JSON number", shown_token(text_, at)),
                     is_good ? std::optional(better) : std::nullopt);
    }

    // Scans the string as the parser did (RFC 8259, section 7), up to the first thing that is not allowed.
    SceneError broken_string(std::size_t at) const {
        const auto unterminated = [&] { return error(at, "unterminated string: no closing quote on this line"); };
        bool is_closed = false;
        for (std::size_t i = at + 1; i < text_.size() && !is_closed;) {
            const CodePoint c = decode(text_, i);
            is_closed = c.value == '"';
            if (is_closed) continue;
            if (c.value == '\n' || c.value == '\r') return unterminated();
            if (c.value == '\t') return error(i, "write a tab inside a string as \\t");
            if (c.value < 0x20) {
                return error(i, fmt::format("write a control character inside a string as \\u{:04x}",
                                            static_cast<unsigned>(c.value)));
            }
            if (!c.is_valid) return error(i, "this byte is not valid UTF-8; save the file as UTF-8");
            if (c.value != '\\') {
                i += c.bytes;
                continue;
            }
            const std::size_t escaped = i + 1;
            if (is_end(escaped) || text_[escaped] == '\n' || text_[escaped] == '\r') return unterminated();
            if (text_[escaped] != 'u') {
                if (std::string_view("\"\\/bfnrt").find(text_[escaped]) == std::string_view::npos) {
                    return error(i, fmt::format("'\\{}' is not an escape sequence; write a backslash as \\\\",
                                                printable_at(text_, escaped, decode(text_, escaped))));
                }
                i += 2;
                continue;
            }
            const auto unit = utf16_unit(i);
            if (!unit) {
                return is_end(i + 6) && text_.find('"', i) == std::string_view::npos
                           ? unterminated()
                           : error(i, "\\u must be followed by four hexadecimal digits");
            }
            if (*unit == 0) return error(i, "a string must not contain the null character");
            const bool is_high = *unit >= 0xD800 && *unit <= 0xDBFF;
            const bool is_low = *unit >= 0xDC00 && *unit <= 0xDFFF;
            const auto second = is_high ? utf16_unit(i + 6) : std::nullopt;
            if (is_low || (is_high && !(second && *second >= 0xDC00 && *second <= 0xDFFF))) {
                return error(i, "unpaired surrogate: \\ud800 to \\udbff must be followed by \\udc00 to \\udfff");
            }
            i += is_high ? 12 : 6;
        }
        return is_closed ? error(at, "this string cannot be read") : unterminated();
    }

    // The value of \uXXXX at `at`.
    std::optional<unsigned> utf16_unit(std::size_t at) const {
        if (at + 6 > text_.size() || text_.substr(at, 2) != "\\u") return std::nullopt;
        unsigned unit = 0;
        for (const char c : text_.substr(at + 2, 4)) {
            const std::size_t digit = std::string_view("0123456789abcdef0123456789ABCDEF").find(c);
            if (digit == std::string_view::npos) return std::nullopt;
            unit = unit * 16 + static_cast<unsigned>(digit % 16);
        }
        return unit;
    }

    std::string_view name_;
    std::string_view text_;
    const Failure& failure_;
};

}  // namespace

SceneError diagnose(std::string_view name, std::string_view text, const Failure& failure) {
    return Diagnosis(name, text, failure)();
}

}  // namespace phasetree::io
