#include "meshing/label_grid.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "phasetree/math/float_mode.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree::meshing {

namespace {

constexpr std::size_t lines_a_task = 64;
constexpr int default_cubes_along = 256;

// The minimum spacing, in units of the last place of the farthest coordinate.
constexpr double finest_in_digits = 16;

// The distance of the first points from the bounds, in cubes. Faces of objects, and therefore bounds, often have round
// coordinates. Fractions that are not in a simple ratio keep lines of the grid from running within faces.
constexpr double margin[] = {1.618, 1.571, 1.529};

}  // namespace

Grid Grid::around(const Bounds& bounds, float spacing) {
    if (!(spacing >= 0 && std::isfinite(spacing)))
        throw ModelError(fmt::format("the spacing must be a positive length, or 0, but is {}", spacing));
    if (bounds.empty()) throw ModelError("the object is empty, so it has no mesh");
    if (!bounds.finite())
        throw ModelError(
            "the bounds are infinite: the object is unbounded, so it has no finite mesh; intersect it with a box");
    const glm::dvec3 size = glm::dvec3(bounds.high) - glm::dvec3(bounds.low);
    const double longest = std::max({size.x, size.y, size.z});
    Grid grid;
    double farthest = 0;  // largest absolute coordinate
    for (int i = 0; i < 3; ++i)
        farthest = std::max(
            {farthest, std::abs(static_cast<double>(bounds.low[i])), std::abs(static_cast<double>(bounds.high[i]))});
    grid.digit = 0x1p-23 * farthest;
    const double finest = finest_in_digits * grid.digit;
    grid.spacing = spacing > 0 ? static_cast<double>(spacing) : std::max(longest / default_cubes_along, finest);
    if (!(longest / grid.spacing <= max_cubes_along))
        throw ModelError(fmt::format(
            "a spacing of {} needs more than {} cubes along the object, which is {:.6g} long; use at least {:.4g}",
            spacing, max_cubes_along, longest, 1.0001 * longest / max_cubes_along));
    if (grid.spacing < finest)
        throw ModelError(
            fmt::format("a spacing of {} is finer than 32-bit coordinates allow at this distance from the origin; use "
                        "at least {:.4g}",
                        spacing, 1.0001 * finest));
    for (int i = 0; i < 3; ++i) {
        grid.low[i] = static_cast<double>(bounds.low[i]) - margin[i] * grid.spacing;
        grid.points[i] = static_cast<int>(std::ceil(size[i] / grid.spacing + margin[i])) + 2;
    }
    return grid;
}

std::size_t CrossingsAlong::lines() const {
    return grid_.size() / static_cast<std::size_t>(grid_.points[axis_]);
}

std::size_t CrossingsAlong::number_of_line(const glm::ivec3& point) const {
    const int u = axis_ == 0 ? 1 : 0, v = axis_ == 2 ? 1 : 2;
    return static_cast<std::size_t>(point[v]) * static_cast<std::size_t>(grid_.points[u]) +
           static_cast<std::size_t>(point[u]);
}

void CrossingsAlong::trace(const LineTracer& tracer, const std::function<void(std::size_t)>& advance) {
    const int u = axis_ == 0 ? 1 : 0, v = axis_ == 2 ? 1 : 2;
    const std::size_t count = lines(), tasks = (count + lines_a_task - 1) / lines_a_task;
    struct Part {
        std::vector<std::size_t> ends;
        std::vector<GridCrossing> crossings;
    };
    std::vector<Part> parts(tasks);
    glm::vec3 direction(0);
    direction[axis_] = 1;
    const auto length = static_cast<float>(grid_.spacing * (grid_.points[axis_] - 1));
    tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
        const FlushSubnormals flush;
        const std::size_t end = std::min(count, (task + 1) * lines_a_task);
        std::vector<CrossingOnLine> found;
        for (std::size_t line = task * lines_a_task; line < end; ++line) {
            glm::ivec3 first(0);
            first[u] = static_cast<int>(line % static_cast<std::size_t>(grid_.points[u]));
            first[v] = static_cast<int>(line / static_cast<std::size_t>(grid_.points[u]));
            const glm::vec3 origin(grid_.place(first));
            found.clear();
            tracer(origin, direction, length, found);
            for (const CrossingOnLine& c : found)
                parts[task].crossings.push_back(
                    {static_cast<float>(static_cast<double>(c.t) / grid_.spacing), c.from, c.to, c.normal});
            parts[task].ends.push_back(parts[task].crossings.size());
        }
        advance(end - task * lines_a_task);
    });
    std::size_t total = 0;
    for (const Part& part : parts) total += part.crossings.size();
    crossings_.reserve(total);
    starts_.reserve(count + 1);
    starts_.push_back(0);
    for (Part& part : parts) {
        const std::size_t before = crossings_.size();
        for (const std::size_t end : part.ends) starts_.push_back(before + end);
        crossings_.insert(crossings_.end(), part.crossings.begin(), part.crossings.end());
        part = {};
    }
}

std::span<const GridCrossing> CrossingsAlong::of_line(const glm::ivec3& point) const {
    const std::size_t line = number_of_line(point);
    return std::span(crossings_).subspan(starts_[line], starts_[line + 1] - starts_[line]);
}

std::span<const GridCrossing> CrossingsAlong::of_edge(const glm::ivec3& point) const {
    const std::span<const GridCrossing> line = of_line(point);
    const auto from = static_cast<float>(point[axis_]);
    const auto is_before = [](const GridCrossing& c, float at) { return c.at < at; };
    const auto first = std::lower_bound(line.begin(), line.end(), from, is_before);
    const auto last = std::lower_bound(first, line.end(), from + 1, is_before);
    return {first, last};
}

std::optional<GridCrossing> CrossingsAlong::shown_on_edge(const glm::ivec3& point) const {
    const std::span<const GridCrossing> all = of_edge(point);
    if (all.empty()) return std::nullopt;
    return all[all.size() / 2];
}

bool is_uniform(const Grid& grid, const Labels& labels, const glm::ivec3& cube) {
    const std::size_t first = grid.index(cube);
    const auto dx = static_cast<std::size_t>(grid.points.x), dz = dx * static_cast<std::size_t>(grid.points.y);
    for (const std::size_t corner : {std::size_t{1}, dx, dx + 1, dz, dz + 1, dz + dx, dz + dx + 1})
        if (labels[first + corner] != labels[first]) return false;
    return true;
}

Corners corners_of(const Grid& grid, const Labels& labels, const glm::ivec3& cube) {
    Corners c;
    for (int i = 0; i < 8; ++i) c[static_cast<std::size_t>(i)] = labels[grid.index(cube + offset_of_corner(i))];
    return c;
}

Labels labels_of(const Grid& grid, const CrossingsAlong& x) {
    Labels labels(grid.size(), vacuum);
    // The outermost points are outside the bounds, and stay vacuum whatever the tracer reports.
    tbb::parallel_for(1, grid.points.z - 1, [&](int k) {
        for (int j = 1; j + 1 < grid.points.y; ++j) {
            const std::span<const GridCrossing> line = x.of_line({0, j, k});
            Phase phase = vacuum;
            std::size_t next = 0;
            Phase* const row = labels.data() + grid.index({0, j, k});
            for (int i = 1; i + 1 < grid.points.x; ++i) {
                for (; next < line.size() && line[next].at < static_cast<float>(i); ++next) phase = line[next].to;
                row[i] = phase;
            }
        }
    });
    return labels;
}

}  // namespace phasetree::meshing
