#include "building/quality.hpp"

#include <algorithm>

namespace phasetree::building {

float required_saving(BuildQuality quality, const BoxKind& box) {
    const float size = box.relative_size;
    // A share that grows with the inverse fourth power of the size; it has doubled at the size `small`.
    const auto share_by_fourth_power = [&](float of_large_boxes, float small) {
        const float square = (small / size) * (small / size);
        return of_large_boxes * (1 + square * square);
    };
    // The usual share grows with the inverse of the size.
    const float usual = (box.has_more_than_two_phases ? 0.35f : 0.3f) * (1 + 0.1f / size);
    const bool is_saving_for_others = box.has_more_than_two_phases && box.is_first_curvature_known;
    const float medium = is_saving_for_others ? std::max(usual, share_by_fourth_power(0.1f, 0.028f)) : usual;
    return quality == BuildQuality::medium ? medium : std::max(medium, share_by_fourth_power(0.5f, 0.04f));
}

}  // namespace phasetree::building
