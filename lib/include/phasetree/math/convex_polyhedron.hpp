#pragma once

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "phasetree/math/bounds.hpp"

namespace phasetree {

/// The points with normal·p ≤ offset. The normal, which leads outward, is of unit length.
struct HalfSpace {
    glm::dvec3 normal{0, 0, 1};
    double offset = 0;

    double distance(const glm::dvec3& p) const { return glm::dot(normal, p) - offset; }
};

/// A bounded intersection of half-spaces, as the polygons that are its faces. What is asked of it is computed in double
/// precision and is right up to rounding; what must be certain is asked of the half-spaces.
class ConvexPolyhedron {
  public:
    struct Face {
        std::vector<glm::dvec3> corners;  ///< counterclockwise, seen from outside
        std::size_t plane = 0;            ///< an index: which half-space it is the side of
    };

    /// The intersection of a box, whose sides are planes 0 … 5 (low x, y, z, high x, y, z), with half-spaces, which are
    /// the planes from 6 on.
    explicit ConvexPolyhedron(const Bounds& box, std::span<const HalfSpace> = {});

    /// Cuts off what is outside of a half-space.
    void clip(const HalfSpace&, std::size_t plane);

    bool empty() const { return faces_.empty(); }
    const std::vector<Face>& faces() const { return faces_; }
    double volume() const;
    double area() const;
    /// Each corner once, and the faces as indices of them.
    struct Mesh {
        std::vector<glm::dvec3> corners;
        std::vector<std::vector<std::uint32_t>> faces;
        /// Each edge once, as two indices of corners, the smaller first.
        std::vector<std::array<std::uint32_t, 2>> edges() const;
    };
    Mesh mesh() const;

  private:
    std::vector<Face> faces_;
    double size_ = 1;  ///< of the box; what is a few roundings of it apart is one point
};

}  // namespace phasetree
