#include "command/unplaced_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "command/streams.hpp"
#include "scene/unplaced.hpp"

namespace phasetree::tracer {

namespace {

constexpr std::size_t most_named = 5;

// "cup", "plate" and 3 more
std::string names_of(const PlacedObjects& placed, const std::vector<std::uint32_t>& objects) {
    std::string names;
    for (std::size_t i = 0; i < std::min(objects.size(), most_named); ++i)
        names += fmt::format("{}\"{}\"", i > 0 ? ", " : "", placed.objects[objects[i]].name);
    if (objects.size() > most_named) names += fmt::format(" and {} more", objects.size() - most_named);
    return names;
}

}  // namespace

std::vector<std::string> warnings_of_unplaced_groups(const Document& document, const PlacedObjects& placed) {
    const UnplacedGroups unplaced = find_unplaced_groups(placed);
    std::vector<std::string> warnings;
    for (const auto& [number, lost] : unplaced.found) {
        const PlacedGroup& group = placed.groups[number];
        std::string warning =
            fmt::format("warning: the group \"{}\" is not in the scene, because no instance refers to it", group.name);
        if (!lost.empty())
            warning += fmt::format("; so {} {} missing from the scene", names_of(placed, lost),
                                   lost.size() == 1 ? "is" : "are");
        warnings.emplace_back(document.error(group.offset, warning).what());
    }
    if (unplaced.more > 0)
        warnings.push_back(
            fmt::format("{}: warning: {} more groups are not in the scene", document.name(), unplaced.more));
    return warnings;
}

void warn_of_unplaced_groups(const Document& document, const PlacedObjects& placed) {
    for (const std::string& warning : warnings_of_unplaced_groups(document, placed)) say("{}\n", warning);
}

}  // namespace phasetree::tracer
