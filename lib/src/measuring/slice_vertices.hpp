#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "measuring/slice_grid.hpp"
#include "phasetree/evaluation/evaluator.hpp"

namespace phasetree::measuring {

/// The labels at the corners of squares, and the vertices on those of their edges whose ends differ.
class SliceVertices {
  public:
    /// `squares` must be in ascending order. Squares are added until both squares beside every vertex are included.
    /// Throws SlicingCancelled.
    SliceVertices(const SliceGrid&, const Evaluator&, std::vector<GridSquare>& squares, const SliceOptions&);

    static constexpr std::uint32_t none = ~std::uint32_t{0};

    /// The corners of a square, counterclockwise from the one with the lowest coordinates.
    std::array<Phase, 4> corners(const GridSquare&) const;
    /// The vertex on a square's edge between corner i and the next one; the corners' labels must differ.
    std::uint32_t vertex(const GridSquare&, std::size_t i) const;
    std::size_t count() const { return edges_.size(); }
    const std::vector<glm::vec2>& positions() const { return positions_; }
    /// The two phases at a vertex, in ascending order.
    std::array<Phase, 2> phases_at(std::uint32_t vertex) const { return phases_[vertex]; }
    Phase label_at(float u, float v) const;

  private:
    /// The number of a corner or an edge. Corners are numbered row by row. The edge from corner n along its row is
    /// number 2n, the one along its column 2n + 1.
    using Number = std::uint64_t;
    Number corner(std::uint32_t column, std::uint32_t row) const { return Number{row} * (grid_.count() + 1) + column; }
    glm::vec2 position(Number corner) const;
    Number edge(const GridSquare&, std::size_t i) const;
    std::array<Number, 2> ends(Number edge) const;
    Phase label(Number corner) const;
    void set_labels(const std::vector<GridSquare>& squares);
    void set_edges(const std::vector<GridSquare>& squares);
    bool add_missing(std::vector<GridSquare>& squares) const;
    void set_positions();
    std::vector<Phase> labels_of(std::span<const glm::vec2> points) const;

    const SliceGrid& grid_;
    const Evaluator& evaluator_;
    const SliceOptions& options_;
    std::vector<Number> corners_;  // sorted
    std::vector<Phase> labels_;
    std::vector<Number> edges_;  // with a vertex; sorted
    std::vector<std::array<Phase, 2>> phases_;
    std::vector<glm::vec2> positions_;
};

}  // namespace phasetree::measuring
