#include "meshing/well_composed.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "meshing/cube_patches.hpp"

namespace phasetree::meshing {

namespace {

// A label that is to rise, or none.
struct Change {
    int corner = -1;
    Phase to{};

    explicit operator bool() const { return corner >= 0; }
};

// Around a side, two opposite corners have a phase that neither of the others has. One of the others takes it if its
// label is lower, else one of the two takes the lower label of the others.
Change change_of_side(const Corners& c, const int (&side)[4]) {
    for (int turn = 0; turn < 2; ++turn) {
        const int a = side[turn], b = side[turn + 1], opposite = side[turn + 2], d = side[(turn + 3) % 4];
        const auto at = [&](int i) { return c[static_cast<std::size_t>(i)]; };
        if (at(a) != at(opposite) || at(b) == at(a) || at(d) == at(a)) continue;
        const int lower = at(b) <= at(d) ? b : d;
        return at(lower) < at(a) ? Change{lower, at(a)} : Change{a, at(lower)};
    }
    return {};
}

// Whether both faces of a wall across a side are of one patch.
bool is_wall_in_one_patch(const CubePatches& patches, const int (&side)[4], const WallAcross& wall) {
    const auto patch_at = [&](int i) { return patches.patch(edge_between(side[i], side[(i + 1) % 4])); };
    return patch_at(wall.first) == patch_at(wall.first + 2);
}

// Whether a patch has two rings of a phase.
bool has_two_rings(const Corners& c, const CubePatches& patches, Phase phase) {
    const LinkedEdges rings = cut_edges(c, [&](Phase a, Phase b) { return (a == phase) != (b == phase); });
    std::array<int, 4> in_patch{};
    for (int edge = 0; edge < 12; ++edge)
        if (rings.has(edge) && rings.first(edge) == edge &&
            ++in_patch[static_cast<std::size_t>(patches.patch(edge))] > 1)
            return true;
    return false;
}

// A corner of the lowest label that is beside a higher one takes the lowest of these.
Change change_of_lowest(const Corners& c) {
    const auto at = [&](int i) { return c[static_cast<std::size_t>(i)]; };
    const Phase lowest = *std::min_element(c.begin(), c.end());
    for (int corner = 0; corner < 8; ++corner) {
        if (at(corner) != lowest) continue;
        Change change;
        for (const int axis : {1, 2, 4})
            if (const Phase beside = at(corner ^ axis); beside > lowest && (!change || beside < change.to))
                change = {corner, beside};
        if (change) return change;
    }
    return {};
}

Change change_of(const Corners& c) {
    if (std::all_of(c.begin(), c.end(), [&](Phase p) { return p == c[0]; })) return {};
    const CubePatches patches(c);
    for (const auto& side : sides_of_cube) {
        const WallAcross wall = wall_across(c, side);
        if (!wall.is_there || is_wall_in_one_patch(patches, side, wall))
            if (const Change change = change_of_side(c, side)) return change;
    }
    for (const Phase phase : c)
        if (has_two_rings(c, patches, phase)) return change_of_lowest(c);
    return {};
}

class Repair {
  public:
    Repair(const Grid& grid, Labels& labels) : grid_(grid), labels_(labels) {}

    // Changes labels around a cube until the cube is well-composed; cubes around those labels are to be seen again.
    void mend(const glm::ivec3& cube) {
        while (const Change change = change_of(corners(cube))) {
            const glm::ivec3 point = cube + offset_of_corner(change.corner);
            labels_[grid_.index(point)] = change.to;
            for (int i = 0; i < 8; ++i) again_.push_back(point - offset_of_corner(i));
        }
    }
    bool is_sound(const glm::ivec3& cube) const { return !change_of(corners(cube)); }
    void mend_what_is_left(const std::function<void()>& cancelled) {
        for (std::size_t seen = 0; !again_.empty(); ++seen) {
            if (seen % 4096 == 0) cancelled();
            const glm::ivec3 cube = again_.back();
            again_.pop_back();
            mend(cube);
        }
    }

  private:
    Corners corners(const glm::ivec3& cube) const { return corners_of(grid_, labels_, cube); }

    const Grid& grid_;
    Labels& labels_;
    std::vector<glm::ivec3> again_;
};

}  // namespace

void make_well_composed(const Grid& grid, Labels& labels, const std::function<void()>& cancelled) {
    Repair repair(grid, labels);
    // Few cubes are unsound: all are looked at in parallel, these are mended in turn.
    std::vector<std::vector<glm::ivec3>> unsound(static_cast<std::size_t>(grid.points.z - 1));
    tbb::parallel_for(0, grid.points.z - 1, [&](int k) {
        cancelled();
        for (int j = 0; j + 1 < grid.points.y; ++j)
            for (int i = 0; i + 1 < grid.points.x; ++i)
                if (const glm::ivec3 cube(i, j, k); !repair.is_sound(cube))
                    unsound[static_cast<std::size_t>(k)].push_back(cube);
    });
    for (const std::vector<glm::ivec3>& layer : unsound)
        for (const glm::ivec3& cube : layer) repair.mend(cube);
    repair.mend_what_is_left(cancelled);
}

}  // namespace phasetree::meshing
