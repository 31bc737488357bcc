#include "meshing/well_composed.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace phasetree::meshing {

namespace {

// The corners of a cube: corner i is at (i & 1, i >> 1 & 1, i >> 2 & 1).
using Corners = std::array<Phase, 8>;

// Four corners around each side of a cube, in their order around it.
constexpr int squares[6][4] = {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}};

// A label that is to rise, or none.
struct Change {
    int corner = -1;
    Phase to{};

    explicit operator bool() const { return corner >= 0; }
};

// Two opposite corners of a square have a phase that neither of the others has. One of the others takes it if its label
// is lower, else one of the two takes the lower label of the others.
Change change_of_square(const Corners& c, const int (&square)[4]) {
    for (int turn = 0; turn < 2; ++turn) {
        const int a = square[turn], b = square[turn + 1], opposite = square[turn + 2], d = square[(turn + 3) % 4];
        const auto at = [&](int i) { return c[static_cast<std::size_t>(i)]; };
        if (at(a) != at(opposite) || at(b) == at(a) || at(d) == at(a)) continue;
        const int lower = at(b) <= at(d) ? b : d;
        return at(lower) < at(a) ? Change{lower, at(a)} : Change{a, at(lower)};
    }
    return {};
}

// Two opposite corners of a cube alone have a phase, or alone have it not: then one of them, or a corner beside one,
// takes the label that is higher. If that leaves two opposite corners of a square, these are seen next.
Change change_of_cube(const Corners& c) {
    for (int a = 0; a < 4; ++a) {
        const auto at = [&](int i) { return c[static_cast<std::size_t>(i)]; };
        const int opposite = 7 - a, beside = a ^ 1;
        const auto count = std::count(c.begin(), c.end(), at(a));
        if (count == 2 && at(a) == at(opposite))
            return at(beside) < at(a) ? Change{beside, at(a)} : Change{a, at(beside)};
        const Phase most = at(beside);
        if (std::count(c.begin(), c.end(), most) == 6 && at(a) != most && at(opposite) != most) {
            const int lower = at(a) <= at(opposite) ? a : opposite;
            return at(lower) < most ? Change{lower, most} : Change{lower ^ 1, at(lower)};
        }
    }
    return {};
}

Change change_of(const Corners& c) {
    if (std::all_of(c.begin(), c.end(), [&](Phase p) { return p == c[0]; })) return {};
    for (const auto& square : squares)
        if (const Change change = change_of_square(c, square)) return change;
    return change_of_cube(c);
}

class Repair {
  public:
    Repair(const Grid& grid, Labels& labels) : grid_(grid), labels_(labels) {}

    // Changes labels around a cube until the cube is well-composed; cubes around those labels are to be seen again.
    void mend(const glm::ivec3& cube) {
        while (const Change change = change_of(corners(cube))) {
            const glm::ivec3 point = cube + offset(change.corner);
            labels_[grid_.index(point)] = change.to;
            for (int i = 0; i < 8; ++i) again_.push_back(point - offset(i));
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
    static glm::ivec3 offset(int corner) { return {corner & 1, corner >> 1 & 1, corner >> 2 & 1}; }
    Corners corners(const glm::ivec3& cube) const {
        Corners c;
        for (int i = 0; i < 8; ++i) c[static_cast<std::size_t>(i)] = labels_[grid_.index(cube + offset(i))];
        return c;
    }

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
