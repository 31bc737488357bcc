// Slices: the outlines of an object's phases in a plane.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <stdexcept>
#include <vector>

#include "phasetree/model/handle.hpp"

namespace phasetree {

/// A plane perpendicular to an axis. Its points have two coordinates: those along the other two axes, in ascending
/// order. Outlines perpendicular to z are therefore seen from above, those perpendicular to x from +x, and those
/// perpendicular to y from −y.
struct SlicePlane {
    int axis = 2;  ///< 0, 1 or 2 for x, y or z
    float at = 0;

    glm::vec3 point(float u, float v) const {
        return axis == 0 ? glm::vec3(at, u, v) : axis == 1 ? glm::vec3(u, at, v) : glm::vec3(u, v, at);
    }
    glm::vec2 coordinates(const glm::vec3& p) const { return {p[axis == 0 ? 1 : 0], p[axis == 2 ? 1 : 2]}; }
};

/// Thrown if SliceOptions::cancelled returned true.
class SlicingCancelled : public std::runtime_error {
  public:
    SlicingCancelled() : std::runtime_error("slicing was cancelled") {}
};

struct SliceOptions {
    /// Maximum distance of the outlines from the true interfaces, in the scene's unit of length; 0 for a thousandth of
    /// the object's longest side. Not negative.
    double tolerance = 0;
    std::size_t max_squares = std::size_t{1} << 20;  ///< maximum number of squares in doubt; see slice()
    std::function<bool()> cancelled{};               ///< polled from any thread; return true to cancel
};

/// The outlines of phases in a plane. Phases in contact share vertices and edges.
struct Slice {
    /// A closed polygon, which has its phase on the left. The vacuum has outlines, too.
    struct Loop {
        Phase phase;
        std::vector<std::uint32_t> vertices;
    };

    SlicePlane plane;
    std::vector<glm::vec2> vertices;
    std::vector<Loop> loops;  ///< sorted by phase
    double tolerance = 0;     ///< in use
    std::size_t squares = 0;  ///< number of squares in doubt
    /// The number of squares in doubt without an outline nearby, usually 0, and the centre of one of them. A detail
    /// smaller than the tolerance may be missing there.
    std::size_t unexplained = 0;
    std::optional<glm::vec2> first_unexplained{};

    /// The area that the outlines of a phase enclose; negative for the vacuum around the object.
    double area(Phase) const;
};

/// Find the outlines of an object's phases in a plane.
///
/// The plane is divided into squares, and these into smaller ones, except where enclosures of the distances prove that
/// a square is in one phase, as for measure(). What is left are *squares in doubt*, with sides of a third of the
/// tolerance. Labels are evaluated at their corners. Where two neighbouring corners differ, bisection finds a vertex on
/// the edge between them. Vertices are joined by one segment through a square with two phases, and by segments to the
/// centre of a square with more. Then vertices that are nearly on a straight line are removed.
///
/// *What is guaranteed*, up to the rounding errors that measure() allows for: a point that is farther than the
/// tolerance from every outline is in the phase drawn there, unless it is in one of the `unexplained` squares. Each
/// segment is in the outline of the phase on its left and, reversed, in that of the phase on its right. So there are no
/// gaps, and the areas of the phases add up. Outlines may cross only where a phase is thinner than a twelfth of the
/// tolerance.
///
/// Uses all threads of TBB's arena; the result does not depend on their number. Throws ModelError if the object is
/// empty or unbounded, if an argument is out of its range, or if more than max_squares squares are in doubt. The same
/// applies to a tolerance below the precision of coordinates, or one for which more than 16384 squares lie along the
/// object. Throws SlicingCancelled.
Slice slice(const Phased& object, const SlicePlane& plane, const SliceOptions& options = {});

}  // namespace phasetree
