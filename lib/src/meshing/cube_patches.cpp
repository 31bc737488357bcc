#include "meshing/cube_patches.hpp"

namespace phasetree::meshing {

WallAcross wall_across(const CubeLabels& labels, int side) {
    const auto at = [&](int i) { return labels.at(sides_of_cube[side][i]); };
    for (const int first : {0, 1}) {
        const Phase wall = at(1 - first);
        if (wall != at(3 - first) || at(first) == wall || at(first + 2) == wall) continue;
        if (at(first) != at(first + 2) || labels.joined[static_cast<std::size_t>(side)] == wall) return {true, first};
    }
    return {};
}

CubePatches::CubePatches(const CubeLabels& labels) {
    const LinkedEdges edges = cut_edges(labels, [](Phase a, Phase b) { return a != b; });
    std::array<int, 12> number{};
    for (int edge = 0; edge < 12; ++edge) {
        if (!edges.has(edge)) continue;
        const auto first = static_cast<std::size_t>(edges.first(edge));
        if (edges.first(edge) == edge) number[first] = count_++;
        patches_ |= static_cast<std::uint32_t>(number[first]) << (2 * edge);
    }
}

}  // namespace phasetree::meshing
