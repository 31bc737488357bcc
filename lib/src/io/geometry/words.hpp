#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>

namespace phasetree::io {

/// Splits a text into lines, and lines into words separated by blanks. Lines end with a line feed, a carriage return,
/// or both. A byte order mark at the beginning is skipped.
class Words {
  public:
    enum class Rules {
        plain,
        obj  ///< a backslash at the end of a line continues it on the next one; # begins a comment
    };

    explicit Words(std::string_view text, Rules rules = Rules::plain)
        : text_(text), rules_(rules), at_(text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0) {}

    /// Goes to the next line; false if there is none.
    bool next_line() {
        if (at_ > text_.size()) return false;
        const std::size_t end = std::min(find('\n', feed_), find('\r', return_));
        line_ = text_.substr(at_, end - at_);
        at_ = end + (text_.substr(end).starts_with("\r\n") ? 2 : 1);
        ++number_;
        goes_on_ = rules_ == Rules::obj && take_backslash();
        return true;
    }
    /// The next word of the line; empty at its end.
    std::string_view word() {
        for (;;) {
            const std::size_t first = std::min(line_.find_first_not_of(blanks), line_.size());
            const std::size_t end = std::min(line_.find_first_of(blanks, first), line_.size());
            const std::string_view found = line_.substr(first, end - first);
            line_.remove_prefix(end);
            if (rules_ == Rules::obj && found.starts_with('#')) {
                pass_line();
                return {};
            }
            if (!found.empty() || !goes_on_ || !next_line()) return found;
        }
    }
    /// The next word on this or a later line; empty at the end of the text.
    std::string_view word_of_any_line() {
        for (;;) {
            if (const std::string_view found = word(); !found.empty()) return found;
            if (!next_line()) return {};
        }
    }
    /// Skips the rest of the line.
    void pass_line() {
        line_ = {};
        goes_on_ = false;
    }
    /// The line number, from 1.
    std::size_t number() const { return number_; }
    /// The offset of the next line in the text, or the text's end.
    std::size_t offset() const { return std::min(at_, text_.size()); }

  private:
    static constexpr std::string_view blanks = " \t\r\v\f", byte_order_mark = "\xef\xbb\xbf";

    // The position of the next such character, or the text's end. It is cached, so that a text without any is searched
    // only once.
    std::size_t find(char c, std::size_t& kept) const {
        if (kept == unknown || kept < at_) kept = std::min(text_.find(c, at_), text_.size());
        return kept;
    }
    bool take_backslash() {
        const std::size_t last = line_.find_last_not_of(blanks);
        if (last == line_.npos || line_[last] != '\\') return false;
        line_ = line_.substr(0, last);
        return true;
    }

    static constexpr std::size_t unknown = std::string_view::npos;

    std::string_view text_, line_;
    Rules rules_;
    std::size_t at_ = 0, number_ = 0;
    std::size_t feed_ = unknown, return_ = unknown;  // the next line feed and the next carriage return
    bool goes_on_ = false;
};

/// A whole word as a number; nullopt unless it is a finite number.
template <class Number>
std::optional<Number> number_of(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size()) return std::nullopt;
    if constexpr (std::is_same_v<Number, float>)
        // A number too small for a float is still a double, and becomes 0; one that is too large is not finite.
        if (error == std::errc::result_out_of_range)
            if (const auto wider = number_of<double>(word))
                return std::abs(*wider) < 1 ? std::optional<Number>(static_cast<Number>(*wider)) : std::nullopt;
    if (error != std::errc()) return std::nullopt;
    if constexpr (std::is_floating_point_v<Number>)
        if (!std::isfinite(value)) return std::nullopt;
    return value;
}

/// Like number_of, but returns NaN for what programs write if a number is undefined or too large: nan, -inf, 1e999,
/// -1.#IND.
template <class Number>
std::optional<Number> number_or_nan(std::string_view word) {
    if (const auto number = number_of<Number>(word)) return number;
    word.remove_prefix(std::min(word.find_first_not_of("+-"), word.size()));
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool is_too_large =
        end == word.data() + word.size() &&
        (error == std::errc::result_out_of_range || value > static_cast<double>(std::numeric_limits<Number>::max()));
    const bool is_none = !word.empty() && std::string_view("nNiI").find(word[0]) != word.npos;
    if (!is_too_large && !is_none && !word.starts_with("1.#")) return std::nullopt;
    return std::numeric_limits<Number>::quiet_NaN();
}

}  // namespace phasetree::io
