#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <unordered_map>
#include <utility>
#include <vector>

namespace phasetree::meshing {

/// The quadrilateral of an edge of the grid that lies between two phases. It consists of two triangles, or, if there is
/// a vertex on the edge, of the triangles between that vertex and the sides.
struct Quad {
    glm::ivec3 point{0};  ///< where the edge begins
    std::uint8_t axis = 0;
    std::uint8_t diagonal = 0;  ///< the corner, 0 or 1, where the diagonal between two triangles starts
    bool is_turned = false;     ///< whether the phase in front is at the beginning of the edge
    bool is_split = false;      ///< whether there is a vertex on the edge
    /// Vertices in the four cubes around the edge, counterclockwise as seen against the axis: in those below the edge
    /// along the next two axes, below it along the second one, above it, and below it along the first one.
    std::array<std::uint32_t, 4> corners{};
};

class QuadMesh {
  public:
    std::vector<glm::vec3> vertices;  ///< first those of the cubes, then others
    std::vector<Quad> quads;

    /// Adds and returns a vertex on the edge of a quadrilateral, which is split from now on.
    std::uint32_t centre(std::uint32_t quad) {
        quads[quad].is_split = true;
        return made(centres_, quad);
    }
    /// The vertex that divides the side between two vertices, in all quadrilaterals with this side.
    std::uint32_t divider(std::uint32_t a, std::uint32_t b) { return made(dividers_, key(a, b)); }

    /// Calls f(vertices) for each triangle of a quadrilateral, counterclockwise as seen from the phase in front.
    template <class F>
    void for_each_triangle(std::uint32_t quad, F&& f) const {
        const Quad& q = quads[quad];
        const auto emit = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            f(q.is_turned ? std::array{a, c, b} : std::array{a, b, c});
        };
        const auto corner = [&](std::size_t i) { return q.corners[i % 4]; };
        if (!q.is_split) {
            const std::size_t d = q.diagonal;
            emit(corner(d), corner(d + 1), corner(d + 2));
            emit(corner(d), corner(d + 2), corner(d + 3));
            return;
        }
        const std::uint32_t centre = centres_.at(quad);
        for (std::size_t i = 0; i < 4; ++i) {
            const std::uint32_t a = corner(i), b = corner(i + 1);
            if (const auto d = dividers_.find(key(a, b)); d != dividers_.end()) {
                emit(centre, a, d->second);
                emit(centre, d->second, b);
            } else {
                emit(centre, a, b);
            }
        }
    }

  private:
    using Made = std::unordered_map<std::uint64_t, std::uint32_t>;
    static std::uint64_t key(std::uint32_t a, std::uint32_t b) {
        return a < b ? std::uint64_t{a} << 32 | b : std::uint64_t{b} << 32 | a;
    }
    std::uint32_t made(Made& all, std::uint64_t key) {
        const auto [place, is_new] = all.try_emplace(key, static_cast<std::uint32_t>(vertices.size()));
        if (is_new) vertices.emplace_back(0);
        return place->second;
    }

    Made centres_, dividers_;
};

}  // namespace phasetree::meshing
