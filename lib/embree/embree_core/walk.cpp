#include "embree_core/walk.hpp"

namespace phasetree::embree {

std::optional<CellScene::Hit> Walk::next() {
    auto found = scene_.first_crossing(rest_, carried_);
    if (!found) {
        rest_.far = -1;
        return std::nullopt;
    }
    Crossing& c = found->crossing;
    const double t_from = base_ + static_cast<double>(c.t_from), t_to = base_ + static_cast<double>(c.t_to);
    rest_.origin = c.p_to;
    rest_.near = 0;
    base_ = t_to;
    carried_ = c.to;
    // Where phases flicker within rounding, crossings may follow each other without end. After 32 within a resolution
    // of `anchor_`, the walk advances by a resolution. If the phase is different there, the next search reports a
    // crossing of zero length at its start.
    const double resolution = static_cast<double>(scene_.cells().resolution());
    if (base_ - anchor_ > resolution) {
        anchor_ = base_;
        stuck_ = 0;
    } else if (++stuck_ > 32) {
        rest_.origin += scene_.cells().resolution() * rest_.direction;
        base_ += resolution;
    }
    rest_.far = static_cast<float>(far_ - base_);
    c.t_from = static_cast<float>(t_from);
    c.t_to = static_cast<float>(t_to);
    return found;
}

}  // namespace phasetree::embree
