#include "measuring/slice_grid.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "measuring/divide.hpp"
#include "phasetree/math/float_mode.hpp"
#include "phasetree/program/program.hpp"
#include "rewriting/rewrite.hpp"

namespace phasetree::measuring {

using building::CellBudget, building::WorkerPool;
using rewriting::ArenaScope, rewriting::rewrite;

namespace {

constexpr int most_divisions = 14;
// The side of a square is at least this many resolutions.
constexpr double least_side = 4;
// Sides of squares per tolerance. A point is at most two diagonals from an outline in the same square or a neighbouring
// one, and leaving out vertices moves an outline by at most an eighth of a side.
constexpr double sides_per_tolerance = 3;
// The distance of the first lines from the bounds, in squares. Faces of objects, and therefore bounds, often have round
// coordinates. Fractions that are not in a simple ratio keep lines of the grid from running within faces.
constexpr double margin_of_columns = 0.618, margin_of_rows = 0.571;
// The grid is first divided into at least this many parts in doubt, unless there are fewer after some levels.
constexpr std::size_t enough_slice_parts = 128;

// Sets lines[first] … lines[last] between known ones at both ends, as SubBoxes divides.
void set_lines(std::vector<float>& lines, std::size_t first, std::size_t last) {
    if (last - first < 2) return;
    const std::size_t middle = (first + last) / 2;
    lines[middle] = (lines[first] + lines[last]) * 0.5f;
    set_lines(lines, first, middle);
    set_lines(lines, middle, last);
}

std::vector<float> lines_between(double low, double high, std::size_t count) {
    std::vector<float> lines(count + 1);
    lines.front() = static_cast<float>(low);
    lines.back() = static_cast<float>(high);
    set_lines(lines, 0, count);
    return lines;
}

// A square of some level: at level 0 it is the whole grid.
struct LevelSquare {
    Node node;
    GridSquare place;  // in the grid of its level
};

// Divides squares until they are proven, or as small as those of the grid.
class SquareDivision {
  public:
    SquareDivision(const Phased& object, const SliceGrid& grid, const SliceOptions& options)
        : grid_(grid),
          options_(options),
          recorded_(record(object)),
          root_{grid.whole(), rewrite(recorded_, arena_)},
          context_{ProgramContext(root_.program, recorded_.constants, PhaseSet(), 0.5f * grid.resolution),
                   {},
                   grid.resolution},
          budget_(std::numeric_limits<std::size_t>::max()),
          pool_(budget_, recorded_.constants),
          worker_{pool_} {}

    std::vector<GridSquare> run() {
        const FlushSubnormals flush;
        std::vector<LevelSquare> parts{{root_, {}}};
        int level = 0;
        for (; level < grid_.levels && parts.size() < enough_slice_parts && !parts.empty(); ++level) {
            std::vector<LevelSquare> next;
            for (const LevelSquare& part : parts)
                each_child(part, worker_, [&](const LevelSquare& child) { next.push_back(child); });
            parts = std::move(next);
        }
        std::vector<std::vector<GridSquare>> found(parts.size());
        tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
            const FlushSubnormals flush_here;
            const WorkerPool::Borrowed worker = pool_.borrow();
            divide(parts[i], level, *worker, found[i]);
        });
        std::vector<GridSquare> all;
        for (const std::vector<GridSquare>& part : found) all.insert(all.end(), part.begin(), part.end());
        std::ranges::sort(all);
        return all;
    }

  private:
    // Calls use(child) for each quarter of a square that is in doubt. Its node is in the worker's arena of programs.
    template <class Use>
    void each_child(const LevelSquare& square, Worker& worker, const Use& use) const {
        const ArenaScope scratch(worker.scratch);
        const Division division(square.node, context_, worker);
        for (std::size_t i = 0; i < division.count(); ++i) {
            const GridSquare place{2 * square.place.column + static_cast<std::uint32_t>(i & 1),
                                   2 * square.place.row + static_cast<std::uint32_t>(i >> 1)};
            const ExaminedBox box = division.examine(i);
            const Bounds& flat = box.node.box;
            const bool is_proven =
                box.only || !grid_.meets_bounds(grid_.plane.coordinates(flat.low), grid_.plane.coordinates(flat.high));
            if (!is_proven) use(LevelSquare{box.node, place});
        }
    }
    void divide(const LevelSquare& square, int level, Worker& worker, std::vector<GridSquare>& found) {
        if (level == grid_.levels) {
            found.push_back(square.place);
            constexpr std::size_t squares_between_checks = 64;
            if (found.size() % squares_between_checks == 0) check(squares_between_checks);
            return;
        }
        const ArenaScope programs(worker.programs), scratch(worker.scratch);
        each_child(square, worker, [&](const LevelSquare& child) { divide(child, level + 1, worker, found); });
    }
    void check(std::size_t more) {
        if (options_.cancelled && options_.cancelled()) throw SlicingCancelled();
        if ((count_ += more) > options_.max_squares)
            throw ModelError(
                fmt::format("more than {} squares with sides of {:.3g} may meet an outline; use a larger tolerance, or "
                            "move the plane "
                            "if it lies in a face of the object",
                            options_.max_squares, grid_.side));
    }

    const SliceGrid& grid_;
    const SliceOptions& options_;
    Program recorded_;
    rewriting::Arena arena_;
    Node root_;
    MeasureContext context_;
    CellBudget budget_;
    WorkerPool pool_;
    Worker worker_;  // of the squares of the parts
    std::atomic<std::size_t> count_{0};
};

}  // namespace

SliceGrid::SliceGrid(const TraceableObject& object, const SlicePlane& slice_plane, double tolerance)
    : plane(slice_plane), bounds(object.bounds), resolution(object.resolution), side(tolerance / sides_per_tolerance) {
    const glm::dvec2 low(plane.coordinates(bounds.low)), high(plane.coordinates(bounds.high));
    const double longest = std::max(high.x - low.x, high.y - low.y);
    while (levels < most_divisions && side * squares_across() < longest) ++levels;
    if (!(side * squares_across() >= longest))
        throw ModelError(
            fmt::format("a tolerance of {:.4g} is too fine for a slice that is {:.6g} long; use at least {:.4g}",
                        tolerance, longest, 1.001 * sides_per_tolerance * longest / squares_across()));
    if (!(tolerance >= finest_slice_tolerance(object)))
        throw ModelError(
            fmt::format("a tolerance of {:.4g} is finer than 32-bit coordinates allow at this distance from the "
                        "origin; use at least "
                        "{:.4g}",
                        tolerance, 1.001 * finest_slice_tolerance(object)));
    const double u = low.x - margin_of_columns * side, v = low.y - margin_of_rows * side, extent = side * count();
    columns = lines_between(u, u + extent, count());
    rows = lines_between(v, v + extent, count());
}

double finest_slice_tolerance(const TraceableObject& object) {
    return sides_per_tolerance * least_side * static_cast<double>(object.resolution);
}

Bounds SliceGrid::whole() const {
    return {plane.point(columns.front(), rows.front()), plane.point(columns.back(), rows.back())};
}

bool SliceGrid::meets_bounds(const glm::vec2& low, const glm::vec2& high) const {
    const glm::vec2 from = plane.coordinates(bounds.low), to = plane.coordinates(bounds.high);
    return low.x <= to.x && low.y <= to.y && high.x >= from.x && high.y >= from.y;
}

std::vector<GridSquare> squares_in_doubt(const Phased& object, const SliceGrid& grid, const SliceOptions& options) {
    return SquareDivision(object, grid, options).run();
}

}  // namespace phasetree::measuring
