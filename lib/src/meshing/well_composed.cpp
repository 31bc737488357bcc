#include "meshing/well_composed.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "meshing/cube_patches.hpp"

namespace phasetree::meshing {

namespace {

// The label to raise, and its new value; a default-constructed change does nothing.
struct Change {
    int corner = -1;
    Phase to{};

    explicit operator bool() const { return corner >= 0; }
};

// A side with a wall across it has two opposite corners of a phase that neither of the other two corners has. If one of
// those other two has a lower label than the wall, the one with the lowest takes the wall's phase. Otherwise, one of
// the wall's corners takes the lower of the other two labels.
Change change_of_side(const CubeLabels& c, int side) {
    const auto& corners = sides_of_cube[side];
    for (int turn = 0; turn < 2; ++turn) {
        const int a = corners[turn], b = corners[turn + 1], opposite = corners[turn + 2], d = corners[(turn + 3) % 4];
        if (c.at(a) != c.at(opposite) || c.at(b) == c.at(a) || c.at(d) == c.at(a)) continue;
        const int lower = c.at(b) <= c.at(d) ? b : d;
        return c.at(lower) < c.at(a) ? Change{lower, c.at(a)} : Change{a, c.at(lower)};
    }
    return {};
}

// Whether both faces of a wall across a side belong to the same patch.
bool is_wall_in_one_patch(const CubePatches& patches, int side, const WallAcross& wall) {
    const auto& corners = sides_of_cube[side];
    const auto patch_at = [&](int i) { return patches.patch(edge_between(corners[i], corners[(i + 1) % 4])); };
    return patch_at(wall.first) == patch_at(wall.first + 2);
}

// Whether a patch has two rings of a phase (well_composed.hpp).
bool has_two_rings(const CubeLabels& c, const CubePatches& patches, Phase phase) {
    const LinkedEdges rings = cut_edges(c, [&](Phase a, Phase b) { return (a == phase) != (b == phase); });
    std::array<int, 4> in_patch{};
    for (int edge = 0; edge < 12; ++edge)
        if (rings.has(edge) && rings.first(edge) == edge &&
            ++in_patch[static_cast<std::size_t>(patches.patch(edge))] > 1)
            return true;
    return false;
}

// A corner with the lowest label that is adjacent to a higher label takes the lowest of these.
Change change_of_lowest(const CubeLabels& c) {
    const Phase lowest = *std::min_element(c.corners.begin(), c.corners.end());
    for (int corner = 0; corner < 8; ++corner) {
        if (c.at(corner) != lowest) continue;
        Change change;
        for (const int axis : {1, 2, 4})
            if (const Phase beside = c.at(corner ^ axis); beside > lowest && (!change || beside < change.to))
                change = {corner, beside};
        if (change) return change;
    }
    return {};
}

// Finds the change that a cube needs, if any. The outermost points, all vacuum, are never changed. Proof: a cube at the
// border has at least four of them as corners. Each of its sides that has such corners has two adjacent ones, so no
// phase is only at opposite corners of that side. In such a cube, each patch surrounds corners of the inner side. So in
// a patch, the vacuum has one ring, and so have all other phases taken together. Therefore neither rule changes an
// outermost point.
Change change_of(const CubeLabels& c) {
    if (std::all_of(c.corners.begin(), c.corners.end(), [&](Phase p) { return p == c.corners[0]; })) return {};
    const CubePatches patches(c);
    for (int side = 0; side < 6; ++side)
        if (const WallAcross wall = wall_across(c, side); wall.is_there && is_wall_in_one_patch(patches, side, wall))
            return change_of_side(c, side);
    for (const Phase phase : c.corners)
        if (has_two_rings(c, patches, phase)) return change_of_lowest(c);
    return {};
}

class Repair {
  public:
    Repair(const Grid& grid, Labels& labels, JoinedSides& joined) : grid_(grid), labels_(labels), joined_(joined) {}

    // Changes labels of a cube until no further change is needed. The cubes around changed labels must be examined
    // again.
    void mend(const glm::ivec3& cube) {
        for (;;) {
            joined_.find(labels_, cube);
            const Change change = change_of(joined_.labels_of(labels_, cube));
            if (!change) return;
            const glm::ivec3 point = cube + offset_of_corner(change.corner);
            labels_[grid_.index(point)] = change.to;
            for (int i = 0; i < 8; ++i) again_.push_back(point - offset_of_corner(i));
        }
    }
    bool is_sound(const glm::ivec3& cube) const { return !change_of(joined_.labels_of(labels_, cube)); }
    void mend_what_is_left(const std::function<void()>& cancelled) {
        for (std::size_t seen = 0; !again_.empty(); ++seen) {
            if (seen % 4096 == 0) cancelled();
            const glm::ivec3 cube = again_.back();
            again_.pop_back();
            mend(cube);
        }
    }

  private:
    const Grid& grid_;
    Labels& labels_;
    JoinedSides& joined_;
    std::vector<glm::ivec3> again_;
};

}  // namespace

void make_well_composed(const Grid& grid, Labels& labels, JoinedSides& joined, const std::function<void()>& cancelled) {
    Repair repair(grid, labels, joined);
    // Few cubes need changes. All are examined in parallel; those are then repaired one after the other.
    std::vector<std::vector<glm::ivec3>> unsound(static_cast<std::size_t>(grid.points.z - 1));
    tbb::parallel_for(0, grid.points.z - 1, [&](int k) {
        cancelled();
        for (int j = 0; j + 1 < grid.points.y; ++j)
            for (int i = 0; i + 1 < grid.points.x; ++i)
                if (const glm::ivec3 cube(i, j, k); !is_uniform(grid, labels, cube) && !repair.is_sound(cube))
                    unsound[static_cast<std::size_t>(k)].push_back(cube);
    });
    for (const std::vector<glm::ivec3>& layer : unsound) {
        cancelled();
        for (const glm::ivec3& cube : layer) repair.mend(cube);
    }
    repair.mend_what_is_left(cancelled);
}

}  // namespace phasetree::meshing
