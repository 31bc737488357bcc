// The triangles of a face with any number of corners, by clipping ears: a corner is cut off where the triangle that it
// makes with its neighbours bulges outwards and has no other corner in it (Meisters, *Polygons Have Ears*, The American
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

/// Readers refuse faces of more corners.
inline constexpr std::size_t most_corners_of_face = 1'000'000;
/// Faces of more corners than this that are not convex become fans about their first corner, which may fold over.
inline constexpr std::size_t most_corners_to_clip = 1024;

/// Divides the faces of a file. It gives up after so many comparisons of a corner with an ear beyond those that
/// ordinary faces need. The default takes a few seconds.
class FaceDivider {
  public:
    static constexpr const char* takes_too_long =
        "its faces of many corners take too long to divide into triangles; divide them in the program that made the "
        "file";

    explicit FaceDivider(std::size_t comparisons = 1'000'000'000) : comparisons_left_(comparisons) {}

    /// Returns the triangles of a face with at least three corners, all oriented as it is. Their corners are numbers of
    /// corners of the face, from 0. The face is taken for flat. A convex one becomes a fan about its first corner.
    /// Nothing if the faces so far have taken too many comparisons.
    std::optional<std::vector<glm::uvec3>> triangles(std::span<const glm::vec3> corners);

  private:
    std::size_t comparisons_left_;
};

}  // namespace phasetree::io
