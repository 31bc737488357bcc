// Meshing: the interfaces of an object as triangles, and the closed surfaces of its phases.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <stdexcept>
#include <vector>

#include "phasetree/math/bounds.hpp"
#include "phasetree/model/phase.hpp"
#include "phasetree/trace/tracer.hpp"

namespace phasetree {

/// Thrown if MeshOptions::cancelled returned true.
class MeshingCancelled : public std::runtime_error {
  public:
    MeshingCancelled() : std::runtime_error("meshing was cancelled") {}
};

/// A change of phase along a line.
struct CrossingOnLine {
    float t = 0;  ///< distance from the line's origin
    Phase from, to;
    glm::vec3 normal{0};  ///< of unit length, from `from` into `to`
};

/// Appends all crossings along a line, in ascending order: origin + t·direction for t from 0 to `length`. The line
/// starts in the vacuum, and the direction has unit length. Called from many threads at once.
using LineTracer = std::function<void(const glm::vec3& origin, const glm::vec3& direction, float length,
                                      std::vector<CrossingOnLine>&)>;
/// Make a line tracer from an object's tracer, which must outlive it. It runs the program of the whole object at each
/// step. For objects with many nodes, tracing through cells is faster (phasetree_embree.h).
LineTracer line_tracer(const InterfaceTracer&);

struct MeshOptions {
    /// Side of the grid's cubes in the scene's unit of length; 0 for a 256th of the longest side of the bounds.
    float spacing = 0;
    std::function<bool()> cancelled{};  ///< polled from any thread; return true to cancel
    /// Receives the fraction of the work that is done, in (0, 1], strictly increasing up to 1. Called from one thread
    /// at a time.
    std::function<void(float)> progress{};
};

/// The interfaces of an object as triangles. Phases in contact share triangles, and neighbouring triangles share
/// vertices, so there are no gaps.
struct PhaseMesh {
    struct Triangle {
        /// Counterclockwise as seen from the phase in front.
        std::array<std::uint32_t, 3> vertices{};
        Phase behind;  ///< the phase with the higher index
        Phase front;
    };

    std::vector<glm::vec3> vertices;
    std::vector<Triangle> triangles;
    float spacing = 0;  ///< in use
    /// The number of crossings along the lines of the grid, and how many of them the mesh does not show. For each edge
    /// of the grid, it shows one crossing if the labels at both ends differ after mesh_of() has changed labels (see
    /// there), and otherwise none.
    std::size_t crossings = 0, skipped = 0;

    /// The phases that have triangles.
    PhaseSet phases() const;
};

/// The maximum number of cubes along a side of the bounds.
inline constexpr int max_cubes_along = 1024;

/// Mesh the interfaces within the bounds.
///
/// bounds  must contain everything that is not vacuum.
/// lines   called from many threads at once.
///
/// Uses all threads of TBB's arena; the mesh does not depend on their number. Labels take one byte per point of the
/// grid, 1.1 GB for the finest grid.
///
/// Throws ModelError if the bounds are empty or infinite, if the spacing needs more than max_cubes_along cubes along a
/// side, or if it is finer than the precision of floats at the bounds' coordinates. Throws MeshingCancelled.
///
/// The method is dual contouring (Ju, Losasso, Schaefer & Warren, *Dual Contouring of Hermite Data*, SIGGRAPH 2002),
/// extended to several labels. Labels are evaluated at the points of a grid. Each edge of the grid between two phases
/// produces a quadrilateral, whose corners are vertices in the four cubes around the edge. A cube has one vertex per
/// connected patch of interfaces in it. Rays along the edges give positions and normals of the interfaces, so edges and
/// corners of the object are sharp: a vertex is the best intersection of the planes at these positions, in its cube or
/// near it.
///
/// Labels are first changed where a phase would touch itself only along an edge or at a point (after Latecki, *3D
/// Well-Composed Pictures*, Graphical Models and Image Processing 1997). Each phase's surface is then a closed
/// manifold: each edge has two triangles, and the triangles around a vertex form a single fan. A wall at least 1.2
/// times as thick as the spacing is meshed without holes. A thinner wall may have holes or be missing.
///
/// Triangles neither cross nor touch each other, other than in common vertices and edges. Where they would, vertices
/// are moved into their cubes, and more are added on the edges and sides of the grid (after Ju and Udeshi,
/// *Intersection-free Contouring on an Octree Grid*, Pacific Graphics 2006). They stay apart by the smaller of a 64th
/// of the spacing and two units in the last place of the farthest coordinate, so rounding does not make them cross.
PhaseMesh mesh_of(const Bounds& bounds, const LineTracer& lines, const MeshOptions& options = {});

/// A closed surface. Triangles are counterclockwise as seen from outside.
struct ClosedMesh {
    std::vector<glm::vec3> vertices;
    std::vector<std::uint32_t> in_mesh;  ///< index of each vertex in PhaseMesh::vertices
    std::vector<std::array<std::uint32_t, 3>> triangles;

    double volume() const;
};

/// Extract the boundary of a set of phases: the triangles with exactly one side in the set, and their vertices. It is a
/// manifold if the set is a single phase, or all phases but one.
ClosedMesh surface_of(const PhaseMesh& mesh, PhaseSet phases);

}  // namespace phasetree
