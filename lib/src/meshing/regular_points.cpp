#include "meshing/regular_points.hpp"

namespace phasetree::meshing {

CubeEdge edge_of_cube(int edge) {
    CubeEdge e;
    e.axis = edge / 4;
    e.start[e.axis == 0 ? 1 : 0] = edge & 1;
    e.start[e.axis == 2 ? 1 : 2] = edge >> 1 & 1;
    return e;
}

glm::dvec3 regular_vertex(const CubePatches& patches, const CubeLabels& labels, int patch) {
    glm::dvec3 sum(0);
    int edges = 0;
    for (int edge = 0; edge < 12; ++edge) {
        const CubeEdge e = edge_of_cube(edge);
        const int start = e.start.x + 2 * e.start.y + 4 * e.start.z;
        if (labels.at(start) == labels.at(start | 1 << e.axis) || patches.patch(edge) != patch) continue;
        sum += e.middle();
        ++edges;
    }
    return sum / static_cast<double>(edges);
}

glm::dvec3 SideCut::regular_point(int side) const {
    glm::dvec3 middle(0);
    for (const int c : sides_of_cube[side]) middle += 0.25 * glm::dvec3(offset_of_corner(c));
    return corner < 0 ? middle : 0.5 * (middle + glm::dvec3(offset_of_corner(corner)));
}

SideCut cut_of_side(const CubeLabels& labels, int side, int edge) {
    const auto& corners = sides_of_cube[side];
    const WallAcross wall = wall_across(labels, side);
    // The corners beside the wall, or those whose two edges are the only ones that are cut.
    for (int i = 0; i < 4; ++i) {
        const int before = corners[(i + 3) % 4], corner = corners[i], after = corners[(i + 1) % 4];
        const int opposite = corners[(i + 2) % 4];
        if (wall.is_there) {
            if (i % 2 != wall.first) continue;
            if (edge == edge_between(before, corner) || edge == edge_between(corner, after))
                return {corner, true, opposite};
        } else if (labels.at(before) == labels.at(opposite) && labels.at(after) == labels.at(opposite) &&
                   labels.at(corner) != labels.at(opposite)) {
            return {corner, false, opposite};
        }
    }
    return {};
}

}  // namespace phasetree::meshing
