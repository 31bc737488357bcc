#include "scene/placed.hpp"

namespace phasetree::tracer {

std::vector<bool> PlacedObjects::moving_objects() const {
    std::vector<bool> objects_move(objects.size()), groups_move(groups.size());
    for (std::size_t i = 0; i < objects.size(); ++i) objects_move[i] = objects[i].moving != stands_still;
    const auto go_through = [&](const std::vector<Instance>& list, bool list_moves) {
        for (const Instance& instance : list)
            if (list_moves || instance.moving != stands_still)
                (instance.is_group ? groups_move : objects_move)[instance.of] = true;
    };
    go_through(instances, false);
    // Groups that contain a group have larger numbers.
    for (std::size_t i = groups.size(); i-- > 0;) go_through(groups[i].instances, groups_move[i]);
    return objects_move;
}

}  // namespace phasetree::tracer
