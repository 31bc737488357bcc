#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace phasetree::mesh {

/// Divides a triangle into smaller ones, with vertices on its sides and within. Each side consists of the sides of
/// small triangles between consecutive vertices. The triangulation is constrained Delaunay in a projection, with ties
/// decided by the numbers of vertices, so triangles in the same plane are divided alike where they overlap.
///
/// Rounding may put vertices slightly outside the triangle. Regardless, the boundary of the small triangles is that of
/// the triangle, divided at the vertices on its sides.
class Subdivision {
  public:
    using Corners = std::array<std::uint32_t, 3>;
    /// Thrown where rounding has made the triangles inconsistent: the triangle cannot be divided.
    struct Tangled {};

    Subdivision(std::span<const glm::dvec3> points, const Corners&);

    /// Adds the vertices on the side from a corner to the next, in this order. Call this first.
    void add_on_side(std::size_t side, std::span<const std::uint32_t> vertices);
    void add_within(std::uint32_t vertex);
    /// Make the segment between two of the vertices an edge, or several edges if it passes other vertices closely.
    /// Parts that cross an earlier segment are left out. Call this last.
    void add_segment(std::uint32_t from, std::uint32_t to);
    std::vector<Corners> triangles() const;

  private:
    struct Small {
        std::array<int, 3> corners, neighbours;  // neighbour i shares the side from corner i to the next, or is `none`
    };
    static constexpr int none = -1;

    glm::dvec2 projected(std::uint32_t vertex) const;
    static constexpr unsigned side_bit(std::size_t side) { return 1u << side; }
    int add(std::uint32_t vertex, unsigned sides);
    // Whether two vertices are on the same side of the whole triangle. Vertices on a side are up to `touching` away
    // from its line. So an edge between two of them that are no neighbours would pass the vertices between them again,
    // and would not meet the divided side of the next triangle.
    bool are_on_one_side(int a, int b) const {
        return (sides_[static_cast<std::size_t>(a)] & sides_[static_cast<std::size_t>(b)]) != 0;
    }
    double turn(int a, int b, int c) const;
    bool should_flip(int a, int b, int c, int d) const;
    std::size_t side_from(int triangle, int a, int b) const;
    Small& at(int triangle) { return small_[static_cast<std::size_t>(triangle)]; }
    const Small& at(int triangle) const { return small_[static_cast<std::size_t>(triangle)]; }
    void set_neighbour(int triangle, int a, int b, int neighbour);
    int containing(int vertex) const;
    void split_face(int triangle, int vertex);
    void split_side(int triangle, std::size_t side, int vertex);
    void flip_while_needed();
    void flip(int triangle, std::size_t side);
    void write(int triangle, const Small&);
    struct Side {
        int triangle;
        std::size_t side;
    };
    template <class F>
    void for_each_around(int vertex, const F&) const;
    std::optional<Side> find_side(int a, int b) const;
    bool is_passed(int from, int to, int vertex) const;
    bool is_fixed(int a, int b) const { return fixed_.contains({std::min(a, b), std::max(a, b)}); }
    void connect(int from, int to, int most_parts);
    struct Way {
        int passed = none;  // a vertex that the segment passes closely, to be connected first
        bool is_free = true;
        std::vector<std::pair<int, int>> crossed;
    };
    Way way_between(int from, int to) const;
    void flip_crossed(int from, int to, std::vector<std::pair<int, int>> crossed);
    int index_of(std::uint32_t vertex) const;

    std::span<const glm::dvec3> points_;
    int x_axis_ = 0, y_axis_ = 1;
    std::vector<std::uint32_t> vertices_;
    std::vector<unsigned> sides_;  // of the whole triangle on which each vertex is, as bits
    std::vector<glm::dvec2> xy_;
    std::vector<Small> small_;
    std::vector<std::array<int, 2>> doubtful_;  // triangles and sides that may have to be flipped
    std::vector<int> at_vertex_;                // a triangle at each vertex
    std::set<std::pair<int, int>> fixed_;
    int last_ = 0;
};

}  // namespace phasetree::mesh
