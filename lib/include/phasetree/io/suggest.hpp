#pragma once

#include <concepts>
#include <initializer_list>
#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace phasetree {

/// The candidate closest to a misspelt word, or nullopt if none is close. ASCII letters are compared without case.
/// Among equally close candidates the first one wins.
std::optional<std::string> closest(std::string_view word, std::span<const std::string_view> candidates);

inline std::optional<std::string> closest(std::string_view word, std::initializer_list<std::string_view> candidates) {
    return closest(word, std::span(candidates.begin(), candidates.size()));
}

/// The same for any range of strings that outlives the call.
template <std::ranges::input_range Strings>
requires std::convertible_to<std::ranges::range_reference_t<const Strings>, std::string_view> &&
    (std::is_reference_v<std::ranges::range_reference_t<const Strings>> ||
     std::same_as<std::ranges::range_reference_t<const Strings>, std::string_view>)
        std::optional<std::string> closest(std::string_view word, const Strings& candidates) {
    std::vector<std::string_view> views;
    for (const auto& candidate : candidates) views.emplace_back(candidate);
    return closest(word, std::span<const std::string_view>(views));
}

/// The ending of a message about an unknown name, for use if no valid name is similar. For the kind "key" and the names
/// a and b it is "; the keys are "a", "b"". Empty if there are no valid names, or more than twelve.
std::string valid_names(std::string_view kind, std::span<const std::string_view> names);

/// The same for any range of strings that outlives the call.
template <std::ranges::forward_range Strings>
std::string valid_names(std::string_view kind, const Strings& names) {
    const std::vector<std::string_view> views(std::ranges::begin(names), std::ranges::end(names));
    return valid_names(kind, std::span<const std::string_view>(views));
}

/// Whether a key is another spelling of a name: British (colour, centre) instead of American (color, center), or vice
/// versa. Readers accept both; the documentation uses only the spelling of `name`.
bool is_other_spelling(std::string_view key, std::string_view name);

/// Whether a name has another spelling.
bool has_other_spelling(std::string_view name);

}  // namespace phasetree
