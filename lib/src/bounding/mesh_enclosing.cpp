#include "bounding/mesh_in_box.hpp"
#include "enclosure/enclosure.hpp"
#include "phasetree/nodes/fields/mesh_traits.hpp"

namespace phasetree {

std::optional<enclosure::Enclosure> MeshEnclosing::enclosed(const float* pieces, const Vec3<enclosure::Enclosure>& q,
                                                            const std::array<double, 3>& half) {
    const enclosure::Region at(q);
    const auto known = bounding::mesh_in_box(pieces, at);
    if (!known) return std::nullopt;
    return enclose(*known, at).tightened(half);
}

}  // namespace phasetree
