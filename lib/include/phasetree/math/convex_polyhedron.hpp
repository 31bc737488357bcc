#pragma once

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "phasetree/math/bounds.hpp"

namespace phasetree {

/// The points with normal·p ≤ offset. The normal points outward and has unit length.
struct HalfSpace {
    glm::dvec3 normal{0, 0, 1};
    double offset = 0;

    double distance(const glm::dvec3& p) const { return glm::dot(normal, p) - offset; }
};

/// A bounded intersection of half-spaces, represented by its polygonal faces. Results are computed in double precision
/// and correct up to rounding. For guarantees, use the half-spaces.
class ConvexPolyhedron {
  public:
    struct Face {
        std::vector<glm::dvec3> corners;  ///< counterclockwise, seen from outside
        std::size_t plane = 0;            ///< index of the half-space whose boundary this face lies on
    };

    /// The intersection of a box with half-spaces. The sides of the box are planes 0 … 5 (low x, y, z, high x, y, z);
    /// the half-spaces are the planes from 6 on.
    explicit ConvexPolyhedron(const Bounds& box, std::span<const HalfSpace> = {});

    /// Cut off everything outside a half-space.
    void clip(const HalfSpace&, std::size_t plane);

    bool empty() const { return faces_.empty(); }
    const std::vector<Face>& faces() const { return faces_; }
    double volume() const;
    double area() const;
    /// The distinct corners, and the faces as indices of corners.
    struct Mesh {
        std::vector<glm::dvec3> corners;
        std::vector<std::vector<std::uint32_t>> faces;
        /// The distinct edges, as two indices of corners, the smaller first.
        std::vector<std::array<std::uint32_t, 2>> edges() const;
    };
    Mesh mesh() const;

  private:
    std::vector<Face> faces_;
    double size_ = 1;  ///< of the box; points closer than a few units in its last place are merged
};

}  // namespace phasetree
