// Divides a face with any number of corners into triangles by ear clipping. A corner is cut off if the triangle that it
// forms with its neighbours bulges outwards and contains no other corner (Meisters, *Polygons Have Ears*, The American
// Mathematical Monthly 82, 1975). Each side of the face is a side of one of the triangles, so closed meshes stay
// closed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace phasetree::io {

/// Readers reject faces with more corners.
inline constexpr std::size_t most_corners_of_face = 1'000'000;
/// Non-convex faces with more corners than this become fans about their first corner, which may fold over.
inline constexpr std::size_t most_corners_to_clip = 1024;

/// Divides the faces of a file. It gives up after a limited number of comparisons of a corner with an ear, in addition
/// to those that ordinary faces need. The default limit takes a few seconds.
class FaceDivider {
  public:
    static constexpr const char* takes_too_long =
        "its faces with many corners take too long to triangulate; triangulate them before exporting";

    explicit FaceDivider(std::size_t comparisons = 1'000'000'000) : comparisons_left_(comparisons) {}

    /// Returns the triangles of a face with at least three corners, with the orientation of the face. Triangle corners
    /// are indices of the face's corners, from 0. The face is assumed to be planar. A convex face becomes a fan about
    /// its first corner. Returns nothing if the faces so far have taken too many comparisons.
    std::optional<std::vector<glm::uvec3>> triangles(std::span<const glm::vec3> corners);

  private:
    std::size_t comparisons_left_;
};

}  // namespace phasetree::io
