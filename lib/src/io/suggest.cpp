// Did-you-mean: finds the candidate with the smallest edit distance. An edit inserts, deletes or replaces a character,
// or swaps two neighbours (Damerau, "A technique for computer detection and correction of spelling errors", CACM 7(3),
// 1964). It is computed by the recurrence of Wagner and Fischer, JACM 21(1), 1974, with one more term for the swap.

#include "phasetree/io/suggest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "io/json/utf8.hpp"

namespace phasetree {

namespace {

// British and American spellings.
constexpr std::pair<std::string_view, std::string_view> spellings[] = {{"colour", "color"}, {"centre", "center"}};

std::string american(std::string_view name) {
    std::string result(name);
    for (const auto& [from, to] : spellings)
        for (std::size_t at = 0; (at = result.find(from, at)) != std::string::npos; at += to.size())
            result.replace(at, from.size(), to);
    return result;
}

constexpr std::size_t longest_word = 64;  // longer words are not misspelt by just a letter or two

// Code points, with ASCII letters in lower case; nothing for a word that is too long to compare.
std::optional<std::u32string> folded(std::string_view word) {
    std::u32string out;
    for (std::size_t at = 0; at < word.size();) {
        const io::CodePoint c = io::decode(word, at);
        out += c.value >= 'A' && c.value <= 'Z' ? c.value + ('a' - 'A') : c.value;
        if (out.size() > longest_word) return std::nullopt;
        at += c.bytes;
    }
    return out;
}

std::size_t edit_distance(std::u32string_view a, std::u32string_view b) {
    // Rows i−2, i−1 and i of the table; row[j] is the distance between the first i characters of a and the first j of
    // b.
    std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::swap(before_last, last);
        std::swap(last, row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replace = last[j - 1] + (a[i - 1] != b[j - 1]);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, replace});
            const bool is_swap = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (is_swap) row[j] = std::min(row[j], before_last[j - 2] + 1);
        }
    }
    return row[b.size()];
}

}  // namespace

std::optional<std::string> closest(std::string_view word, std::span<const std::string_view> candidates) {
    const auto misspelt = folded(word);
    if (!misspelt || misspelt->empty()) return std::nullopt;

    std::optional<std::string> best;
    std::size_t best_distance = longest_word;
    for (const std::string_view candidate : candidates) {
        const auto meant = folded(candidate);
        if (!meant || meant->empty()) continue;
        // Allow one edit per three letters or part thereof; at least one letter must match.
        const auto [shorter, longer] = std::minmax({misspelt->size(), meant->size()});
        const std::size_t allowed = std::min((longer + 2) / 3, longer - 1);
        if (longer - shorter > allowed) continue;
        const std::size_t distance = edit_distance(*misspelt, *meant);
        if (distance <= allowed && distance < best_distance) {
            best = std::string(candidate);
            best_distance = distance;
        }
    }
    return best;
}

std::string valid_names(std::string_view kind, std::span<const std::string_view> names) {
    constexpr std::size_t max_listed = 12;
    if (names.empty() || names.size() > max_listed) return {};
    std::string text = names.size() == 1 ? fmt::format("; the only {} is", kind) : fmt::format("; the {}s are", kind);
    for (std::size_t i = 0; i < names.size(); ++i)
        text += fmt::format("{} {}", i == 0 ? "" : ",", io::in_quotes(names[i]));
    return text;
}

bool has_other_spelling(std::string_view name) {
    return std::ranges::any_of(spellings, [&](const auto& pair) {
        return name.find(pair.first) != name.npos || name.find(pair.second) != name.npos;
    });
}

bool is_other_spelling(std::string_view key, std::string_view name) {
    return key != name && has_other_spelling(name) && american(key) == american(name);
}

}  // namespace phasetree
