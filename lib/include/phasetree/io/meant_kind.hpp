#pragma once

#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace phasetree {

/// Pairs of names of nodes, materials, lights, meshes and cameras: the one that other programs use, and the one used
/// here, such as {"cube", "box"}.
std::span<const std::pair<std::string_view, std::string_view>> names_elsewhere();

/// The kind that an unknown name probably means: the one that another program calls by this name, otherwise the closest
/// one by spelling. nullopt if none of the kinds is similar.
std::optional<std::string> meant_kind(std::string_view name, std::span<const std::string_view> kinds);

/// The same for any range of strings that outlives the call.
template <std::ranges::forward_range Strings>
std::optional<std::string> meant_kind(std::string_view name, const Strings& kinds) {
    const std::vector<std::string_view> views(std::ranges::begin(kinds), std::ranges::end(kinds));
    return meant_kind(name, std::span<const std::string_view>(views));
}

}  // namespace phasetree
