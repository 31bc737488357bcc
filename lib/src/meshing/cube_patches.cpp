#include "meshing/cube_patches.hpp"

namespace phasetree::meshing {

WallAcross wall_across(const Corners& corners, const int (&side)[4]) {
    const auto at = [&](int i) { return corners[static_cast<std::size_t>(side[i])]; };
    for (const int first : {0, 1}) {
        const Phase wall = at(1 - first);
        if (wall == at(3 - first) && at(first) != at(first + 2) && at(first) != wall && at(first + 2) != wall)
            return {true, first};
    }
    return {};
}

CubePatches::CubePatches(const Corners& corners) {
    const LinkedEdges edges = cut_edges(corners, [](Phase a, Phase b) { return a != b; });
    std::array<int, 12> number{};
    for (int edge = 0; edge < 12; ++edge) {
        if (!edges.has(edge)) continue;
        const auto first = static_cast<std::size_t>(edges.first(edge));
        if (edges.first(edge) == edge) number[first] = count_++;
        patches_ |= static_cast<std::uint32_t>(number[first]) << (2 * edge);
    }
}

}  // namespace phasetree::meshing
