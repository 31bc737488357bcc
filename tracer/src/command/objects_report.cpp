#include "command/objects_report.hpp"

#include "command/streams.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree::tracer {

namespace {

// The number of copies of each object. Groups are counted first, because lists of instances refer to earlier groups.
std::vector<std::uint64_t> copies_of_objects(const PlacedObjects& placed) {
    std::vector<std::vector<std::uint64_t>> of_groups;
    const auto count = [&](const std::vector<Instance>& list) {
        std::vector<std::uint64_t> copies(placed.objects.size(), 0);
        for (const Instance& instance : list) {
            if (!instance.is_group) ++copies[instance.of];
            if (instance.is_group)
                for (std::size_t i = 0; i < copies.size(); ++i) copies[i] += of_groups[instance.of][i];
        }
        return copies;
    };
    for (const PlacedGroup& group : placed.groups) of_groups.push_back(count(group.instances));
    return count(placed.instances);
}

std::vector<std::string> names_of_phases(const SceneModel& model, const Phased& tree) {
    std::vector<std::string> names;
    for_each_phase(phases(tree).bits & ~std::uint64_t{1},
                   [&](int i) { names.push_back(model.phases.names[static_cast<std::size_t>(i)]); });
    return names;
}

}  // namespace

nlohmann::ordered_json objects_as_json(const SceneModel& model) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    const auto copies = copies_of_objects(model.placed);
    for (std::size_t i = 0; i < copies.size(); ++i) {
        const PlacedObject& object = model.placed.objects[i];
        const TreeStatistics s = statistics(object.tree);
        list.push_back({{"name", object.name},
                        {"copies", copies[i]},
                        {"nodes", s.nodes},
                        {"depth", s.depth},
                        {"tree_bytes", s.bytes},
                        {"phases", names_of_phases(model, object.tree)}});
    }
    return list;
}

void print_objects(const SceneModel& model) {
    const auto copies = copies_of_objects(model.placed);
    put("{:<14}{} of {} objects, in {} groups and {} instances\n", "copies", model.placed.copies(),
        model.placed.objects.size(), model.placed.groups.size(), model.placed.instances.size());
    for (std::size_t i = 0; i < copies.size(); ++i) {
        const PlacedObject& object = model.placed.objects[i];
        const TreeStatistics s = statistics(object.tree);
        std::string names;
        for (const std::string& name : names_of_phases(model, object.tree)) names += (names.empty() ? "" : ", ") + name;
        put("{:<14}{}: {} copies, {} nodes ({} deep), phases {}\n", i == 0 ? "objects" : "", object.name, copies[i],
            s.nodes, s.depth, names);
    }
}

}  // namespace phasetree::tracer
