#include "scene/unplaced.hpp"

#include <algorithm>
#include <span>

namespace phasetree::tracer {

namespace {

constexpr std::size_t most_found = 8;

// Objects and groups that some instances refer to.
struct Named {
    explicit Named(const PlacedObjects& placed) : objects(placed.objects.size()), groups(placed.groups.size()) {}

    void add(std::span<const Instance> instances) {
        for (const Instance& instance : instances) (instance.is_group ? groups : objects)[instance.of] = true;
    }

    std::vector<bool> objects, groups;
};

// Everything that instances lead to. The groups that a group names have smaller numbers, so one pass in descending
// order is enough.
Named reached_from(const PlacedObjects& placed, std::span<const Instance> instances) {
    Named reached(placed);
    reached.add(instances);
    for (std::size_t i = placed.groups.size(); i-- > 0;)
        if (reached.groups[i]) reached.add(placed.groups[i].instances);
    return reached;
}

}  // namespace

UnplacedGroups find_unplaced_groups(const PlacedObjects& placed) {
    Named named(placed);
    named.add(placed.instances);
    for (const PlacedGroup& group : placed.groups) named.add(group.instances);
    std::vector<std::uint32_t> unplaced;
    for (std::uint32_t i = 0; i < placed.groups.size(); ++i)
        if (!named.groups[i]) unplaced.push_back(i);
    std::ranges::sort(unplaced, {}, [&](std::uint32_t i) { return placed.groups[i].offset; });

    UnplacedGroups result;
    const Named standing = reached_from(placed, placed.instances);
    for (const std::uint32_t i : unplaced) {
        if (result.found.size() == most_found) {
            ++result.more;
            continue;
        }
        const Named within = reached_from(placed, placed.groups[i].instances);
        UnplacedGroup& group = result.found.emplace_back();
        group.group = i;
        for (std::uint32_t object = 0; object < placed.objects.size(); ++object)
            if (within.objects[object] && !standing.objects[object]) group.lost.push_back(object);
    }
    return result;
}

}  // namespace phasetree::tracer
