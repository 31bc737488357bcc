#include "measuring/slice_vertices.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "phasetree/math/float_mode.hpp"

namespace phasetree::measuring {

namespace {

// The number of bisections. They locate a vertex to within 2⁻¹⁶ of its edge's length.
constexpr int bisections = 16;

template <class T>
void sort_unique(std::vector<T>& list) {
    std::ranges::sort(list);
    list.erase(std::unique(list.begin(), list.end()), list.end());
}

}  // namespace

SliceVertices::SliceVertices(const SliceGrid& grid, const Evaluator& evaluator, std::vector<GridSquare>& squares,
                             const SliceOptions& options)
    : grid_(grid), evaluator_(evaluator), options_(options) {
    // Both squares beside an edge with different labels should already be in doubt. Add any that rounding has left out.
    do {
        set_labels(squares);
        set_edges(squares);
    } while (add_missing(squares));
    set_positions();
}

glm::vec2 SliceVertices::position(Number corner) const {
    const std::size_t width = grid_.columns.size();
    return {grid_.columns[static_cast<std::size_t>(corner) % width],
            grid_.rows[static_cast<std::size_t>(corner) / width]};
}

SliceVertices::Number SliceVertices::edge(const GridSquare& s, std::size_t i) const {
    switch (i) {
        case 0:
            return 2 * corner(s.column, s.row);
        case 1:
            return 2 * corner(s.column + 1, s.row) + 1;
        case 2:
            return 2 * corner(s.column, s.row + 1);
        default:
            return 2 * corner(s.column, s.row) + 1;
    }
}

std::array<SliceVertices::Number, 2> SliceVertices::ends(Number edge) const {
    const Number first = edge / 2;
    return {first, edge % 2 == 0 ? first + 1 : first + grid_.columns.size()};
}

Phase SliceVertices::label(Number corner) const {
    return labels_[static_cast<std::size_t>(std::ranges::lower_bound(corners_, corner) - corners_.begin())];
}

std::array<Phase, 4> SliceVertices::corners(const GridSquare& s) const {
    return {label(corner(s.column, s.row)), label(corner(s.column + 1, s.row)), label(corner(s.column + 1, s.row + 1)),
            label(corner(s.column, s.row + 1))};
}

std::uint32_t SliceVertices::vertex(const GridSquare& s, std::size_t i) const {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(edges_, edge(s, i)) - edges_.begin());
}

Phase SliceVertices::label_at(float u, float v) const {
    const glm::vec2 point(u, v);
    return labels_of(std::span(&point, 1)).front();
}

// Everything outside the bounds is vacuum.
std::vector<Phase> SliceVertices::labels_of(std::span<const glm::vec2> points) const {
    std::vector<Phase> labels(points.size());
    constexpr std::size_t points_of_task = 64 * batch_size;
    tbb::parallel_for(std::size_t{0}, (points.size() + points_of_task - 1) / points_of_task, [&](std::size_t task) {
        if (options_.cancelled && options_.cancelled()) throw SlicingCancelled();
        const FlushSubnormals flush;
        const std::size_t end = std::min(points.size(), (task + 1) * points_of_task);
        for (std::size_t first = task * points_of_task; first < end; first += batch_size) {
            std::array<BatchOfFloats, 3> p{};
            const std::size_t count = std::min(batch_size, end - first);
            for (std::size_t i = 0; i < batch_size; ++i) {
                const glm::vec2& at = points[first + std::min(i, count - 1)];
                const glm::vec3 point = grid_.plane.point(at.x, at.y);
                for (std::size_t k = 0; k < 3; ++k) p[k][i] = point[static_cast<int>(k)];
            }
            Samples samples;
            evaluator_.sample(p[0], p[1], p[2], samples, Evaluator::thread_workspace());
            for (std::size_t i = 0; i < count; ++i) {
                const bool is_inside = grid_.bounds.contains({p[0][i], p[1][i], p[2][i]});
                labels[first + i] = is_inside ? Phase{static_cast<std::uint8_t>(samples.label[i])} : vacuum;
            }
        }
    });
    return labels;
}

void SliceVertices::set_labels(const std::vector<GridSquare>& squares) {
    corners_.clear();
    for (const GridSquare& s : squares)
        for (const std::uint32_t row : {s.row, s.row + 1})
            for (const std::uint32_t column : {s.column, s.column + 1}) corners_.push_back(corner(column, row));
    sort_unique(corners_);
    std::vector<glm::vec2> points;
    points.reserve(corners_.size());
    for (const Number c : corners_) points.push_back(position(c));
    labels_ = labels_of(points);
}

void SliceVertices::set_edges(const std::vector<GridSquare>& squares) {
    edges_.clear();
    for (const GridSquare& s : squares) {
        const std::array<Phase, 4> labels = corners(s);
        for (std::size_t i = 0; i < 4; ++i)
            if (labels[i] != labels[(i + 1) % 4]) edges_.push_back(edge(s, i));
    }
    sort_unique(edges_);
}

bool SliceVertices::add_missing(std::vector<GridSquare>& squares) const {
    std::vector<GridSquare> missing;
    for (const Number e : edges_) {
        const Number first = e / 2;
        const GridSquare beside{static_cast<std::uint32_t>(first % grid_.columns.size()),
                                static_cast<std::uint32_t>(first / grid_.columns.size())};
        GridSquare other = beside;
        --(e % 2 == 0 ? other.row : other.column);
        for (const GridSquare& s : {beside, other})
            if (s.column < grid_.count() && s.row < grid_.count() && !std::ranges::binary_search(squares, s))
                missing.push_back(s);
    }
    if (missing.empty()) return false;
    squares.insert(squares.end(), missing.begin(), missing.end());
    sort_unique(squares);
    return true;
}

// All vertices at once, because labels are evaluated in batches.
void SliceVertices::set_positions() {
    struct Bracket {
        glm::vec2 from, to;  // `from` has the label of the edge's first end
        Phase first;
    };
    std::vector<Bracket> brackets;
    brackets.reserve(edges_.size());
    for (const Number e : edges_) {
        const auto [first, last] = ends(e);
        const Phase a = label(first), b = label(last);
        brackets.push_back({position(first), position(last), a});
        phases_.push_back({std::min(a, b), std::max(a, b)});
    }
    std::vector<glm::vec2> middles(brackets.size());
    for (int step = 0; step < bisections; ++step) {
        for (std::size_t i = 0; i < brackets.size(); ++i) middles[i] = 0.5f * (brackets[i].from + brackets[i].to);
        const std::vector<Phase> found = labels_of(middles);
        for (std::size_t i = 0; i < brackets.size(); ++i)
            (found[i] == brackets[i].first ? brackets[i].from : brackets[i].to) = middles[i];
    }
    for (const Bracket& b : brackets) positions_.push_back(0.5f * (b.from + b.to));
}

}  // namespace phasetree::measuring
