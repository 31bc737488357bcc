// Joins the vertices of squares to the outlines of phases.
#include "measuring/slice_outlines.hpp"

#include <algorithm>
#include <utility>

#include "measuring/slice_vertices.hpp"

namespace phasetree::measuring {

namespace {

constexpr std::uint32_t none = SliceVertices::none;

// A vertex may be left out if it is at most this far from the line, in sides of squares.
constexpr double straightness = 1.0 / 8;

// The part of an outline in one square, from a vertex with the phase on the left.
struct Step {
    std::uint32_t to = none;
    std::uint32_t through = none;  // the vertex in the square's centre
};

double distance_to_segment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
    const glm::dvec2 d = b - a;
    const double square = glm::dot(d, d), t = square > 0 ? std::clamp(glm::dot(p - a, d) / square, 0.0, 1.0) : 0;
    return glm::length(p - (a + t * d));
}

class Outlines {
  public:
    Outlines(const SliceGrid& grid, const SliceVertices& vertices)
        : grid_(grid), vertices_(vertices), positions_(vertices.positions()), steps_(2 * vertices.count()) {}

    // Adds the parts of outlines in a square. Returns whether there are any.
    bool add(const GridSquare& s) {
        const std::array<Phase, 4> labels = vertices_.corners(s);
        std::array<std::size_t, 4> edges{};  // with a vertex, counterclockwise
        std::size_t count = 0;
        for (std::size_t i = 0; i < 4; ++i)
            if (labels[i] != labels[(i + 1) % 4]) edges[count++] = i;
        if (count == 0) return false;
        if (count == 4 && add_joined_corners(s, labels)) return true;
        const std::uint32_t centre = count > 2 ? add_centre(s, edges, count) : none;
        for (std::size_t k = 0; k < count; ++k) {
            const std::size_t before = edges[k], after = edges[(k + 1) % count];
            add_step(labels[(before + 1) % 4], vertices_.vertex(s, after), vertices_.vertex(s, before), centre);
        }
        return true;
    }
    void set(Slice& result) {
        leave_out_vertices();
        std::vector<std::uint32_t> numbers(positions_.size(), none);
        for (std::size_t i = 0; i < positions_.size(); ++i) {
            if (is_left_out_[i]) continue;
            numbers[i] = static_cast<std::uint32_t>(result.vertices.size());
            result.vertices.push_back(positions_[i]);
        }
        std::vector<bool> is_done(steps_.size());
        for (std::size_t start = 0; start < steps_.size(); ++start) {
            if (is_done[start]) continue;
            const Phase phase = phase_of(start);
            Slice::Loop loop{phase, {}};
            for (std::size_t slot = start; !is_done[slot]; slot = slot_of(steps_[slot].to, phase)) {
                is_done[slot] = true;
                const auto vertex = static_cast<std::size_t>(slot / 2);
                if (!is_left_out_[vertex]) loop.vertices.push_back(numbers[vertex]);
                if (steps_[slot].through != none) loop.vertices.push_back(numbers[steps_[slot].through]);
            }
            if (loop.vertices.size() > 2) result.loops.push_back(std::move(loop));
        }
        std::ranges::stable_sort(result.loops, {}, &Slice::Loop::phase);
    }

  private:
    // A vertex has two steps, one for each of its phases.
    std::size_t slot_of(std::uint32_t vertex, Phase phase) const {
        return 2 * std::size_t{vertex} + (phase == vertices_.phases_at(vertex)[1] ? 1 : 0);
    }
    Phase phase_of(std::size_t slot) const {
        return vertices_.phases_at(static_cast<std::uint32_t>(slot / 2))[slot % 2];
    }
    void add_step(Phase phase, std::uint32_t from, std::uint32_t to, std::uint32_t through) {
        steps_[slot_of(from, phase)] = {to, through};
    }
    // If two opposite corners and the centre are in one phase, that phase separates the other two corners.
    bool add_joined_corners(const GridSquare& s, const std::array<Phase, 4>& labels) {
        const glm::vec2 low(grid_.columns[s.column], grid_.rows[s.row]);
        const glm::vec2 high(grid_.columns[s.column + 1], grid_.rows[s.row + 1]);
        const Phase at_centre = vertices_.label_at(0.5f * (low.x + high.x), 0.5f * (low.y + high.y));
        for (const std::size_t first : {0u, 1u}) {
            if (labels[first] != labels[first + 2] || labels[first] != at_centre) continue;
            for (const std::size_t cut : {first + 1, (first + 3) % 4}) {
                const std::uint32_t before = vertices_.vertex(s, (cut + 3) % 4), after = vertices_.vertex(s, cut);
                add_step(labels[cut], after, before, none);
                add_step(at_centre, before, after, none);
            }
            return true;
        }
        return false;
    }
    std::uint32_t add_centre(const GridSquare& s, const std::array<std::size_t, 4>& edges, std::size_t count) {
        glm::vec2 sum(0);
        for (std::size_t k = 0; k < count; ++k) sum += positions_[vertices_.vertex(s, edges[k])];
        positions_.push_back(sum / static_cast<float>(count));
        return static_cast<std::uint32_t>(positions_.size() - 1);
    }

    // The phases on both sides of a line of vertices lose the same vertices, because each line is followed once, with
    // the phase of the lower index on the left.
    void leave_out_vertices() {
        is_left_out_.assign(positions_.size(), false);
        std::vector<bool> is_done(vertices_.count());
        std::vector<std::uint32_t> line;
        const auto follow = [&](std::uint32_t vertex) {
            while (!is_done[vertex]) {
                is_done[vertex] = true;
                line.push_back(vertex);
                const Step& step = steps_[2 * std::size_t{vertex}];
                if (step.through != none) return line.push_back(step.through);
                vertex = step.to;
            }
        };
        for (std::size_t slot = 0; slot < steps_.size(); ++slot) {
            const Step& step = steps_[slot];
            if (step.through == none || slot_of(step.to, phase_of(slot)) % 2 != 0) continue;
            line.assign(1, step.through);
            follow(step.to);
            straighten(line, 0, line.size() - 1);
        }
        for (std::uint32_t first = 0; first < vertices_.count(); ++first) {
            if (is_done[first]) continue;
            line.clear();
            follow(first);
            line.push_back(first);
            straighten_loop(line);
        }
    }
    // The first vertex and the one farthest from it stay.
    void straighten_loop(const std::vector<std::uint32_t>& line) {
        std::size_t farthest = 0;
        double largest = 0;
        for (std::size_t i = 0; i < line.size(); ++i) {
            const double d = glm::length(at(line[i]) - at(line[0]));
            if (d > largest) farthest = i, largest = d;
        }
        if (farthest == 0) return;
        straighten(line, 0, farthest);
        straighten(line, farthest, line.size() - 1);
        std::size_t left = 0;
        for (std::size_t i = 0; i + 1 < line.size(); ++i) left += is_left_out_[line[i]] ? 0 : 1;
        if (left < 3)
            for (const std::uint32_t vertex : line) is_left_out_[vertex] = false;
    }
    // Douglas and Peucker's method: leaves out the vertices between two if all of them are close to the line.
    void straighten(const std::vector<std::uint32_t>& line, std::size_t first, std::size_t last) {
        std::vector<std::pair<std::size_t, std::size_t>> open{{first, last}};
        while (!open.empty()) {
            const auto [a, b] = open.back();
            open.pop_back();
            std::size_t farthest = a;
            double largest = straightness * grid_.side;
            for (std::size_t i = a + 1; i < b; ++i) {
                const double d = distance_to_segment(at(line[i]), at(line[a]), at(line[b]));
                if (d > largest) farthest = i, largest = d;
            }
            if (farthest == a) {
                for (std::size_t i = a + 1; i < b; ++i) is_left_out_[line[i]] = true;
                continue;
            }
            open.emplace_back(a, farthest);
            open.emplace_back(farthest, b);
        }
    }
    glm::dvec2 at(std::uint32_t vertex) const { return positions_[vertex]; }

    const SliceGrid& grid_;
    const SliceVertices& vertices_;
    std::vector<glm::vec2> positions_;  // of vertices on edges, then of those in centres
    std::vector<Step> steps_;
    std::vector<bool> is_left_out_;
};

// Counts the squares that neither have an outline nor a neighbour with one.
void set_unexplained(Slice& result, const SliceGrid& grid, const std::vector<GridSquare>& squares,
                     const std::vector<bool>& has_outline) {
    const auto is_near = [&](const GridSquare& s) {
        for (std::uint32_t column = s.column == 0 ? 0 : s.column - 1; column <= s.column + 1; ++column)
            for (std::uint32_t row = s.row == 0 ? 0 : s.row - 1; row <= s.row + 1; ++row) {
                const auto found = std::ranges::lower_bound(squares, GridSquare{column, row});
                if (found != squares.end() && *found == GridSquare{column, row} &&
                    has_outline[static_cast<std::size_t>(found - squares.begin())])
                    return true;
            }
        return false;
    };
    for (std::size_t i = 0; i < squares.size(); ++i) {
        const GridSquare& s = squares[i];
        if (has_outline[i] || is_near(s)) continue;
        if (++result.unexplained == 1)
            result.first_unexplained = 0.5f * glm::vec2(grid.columns[s.column] + grid.columns[s.column + 1],
                                                        grid.rows[s.row] + grid.rows[s.row + 1]);
    }
}

}  // namespace

void set_outlines(Slice& result, const SliceGrid& grid, const Evaluator& evaluator, std::vector<GridSquare> squares,
                  const SliceOptions& options) {
    const SliceVertices vertices(grid, evaluator, squares, options);
    Outlines outlines(grid, vertices);
    std::vector<bool> has_outline;
    for (const GridSquare& s : squares) has_outline.push_back(outlines.add(s));
    outlines.set(result);
    result.squares = squares.size();
    set_unexplained(result, grid, squares, has_outline);
}

}  // namespace phasetree::measuring
