#include "building/sub_boxes.hpp"

#include <algorithm>

namespace phasetree::building {

SubBoxes::SubBoxes(const Bounds& whole) {
    box[0] = whole;
    const glm::vec3 extent = whole.extent(), centre = whole.centre();
    const float longest = std::max({extent.x, extent.y, extent.z});
    for (int axis = 0; axis < 3; ++axis) {
        if (extent[axis] < 0.6f * longest) continue;
        for (std::size_t i = 0; i < count; ++i) {
            box[count + i] = box[i];
            box[count + i].low[axis] = centre[axis];
            box[i].high[axis] = centre[axis];
        }
        count *= 2;
    }
}

}  // namespace phasetree::building
