#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <type_traits>

namespace phasetree::io {

/// The words of a text, separated by blanks, one line after the other.
class Words {
  public:
    explicit Words(std::string_view text) : text_(text) {}

    /// Goes to the next line; false if there is none.
    bool next_line() {
        if (at_ > text_.size()) return false;
        const std::size_t end = std::min(text_.find('\n', at_), text_.size());
        line_ = text_.substr(at_, end - at_);
        at_ = end + 1;
        ++number_;
        return true;
    }
    /// The next word of the line; empty at its end.
    std::string_view word() {
        const std::size_t first = std::min(line_.find_first_not_of(blanks), line_.size());
        const std::size_t end = std::min(line_.find_first_of(blanks, first), line_.size());
        const std::string_view found = line_.substr(first, end - first);
        line_.remove_prefix(end);
        return found;
    }
    /// The next word of this line or of one of those that follow; empty at the end of the text.
    std::string_view word_of_any_line() {
        for (;;) {
            if (const std::string_view found = word(); !found.empty()) return found;
            if (!next_line()) return {};
        }
    }
    /// Of the line, from 1.
    std::size_t number() const { return number_; }
    /// Where in the text the line after this one begins, or the text's end.
    std::size_t offset() const { return std::min(at_, text_.size()); }

  private:
    static constexpr std::string_view blanks = " \t\r\v\f";

    std::string_view text_, line_;
    std::size_t at_ = 0, number_ = 0;
};

/// A whole word as a number; nothing if it is none, or one that is not finite.
template <class Number>
std::optional<Number> number_of(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (end != word.data() + word.size()) return std::nullopt;
    if constexpr (std::is_same_v<Number, float>)
        // What is too small for a float is a double all the same, and then 0; what is too large is not finite.
        if (error == std::errc::result_out_of_range)
            if (const auto wider = number_of<double>(word))
                return std::abs(*wider) < 1 ? std::optional<Number>(static_cast<Number>(*wider)) : std::nullopt;
    if (error != std::errc()) return std::nullopt;
    if constexpr (std::is_floating_point_v<Number>)
        if (!std::isfinite(value)) return std::nullopt;
    return value;
}

}  // namespace phasetree::io
