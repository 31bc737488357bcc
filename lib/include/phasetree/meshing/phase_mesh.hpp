// The interfaces of an object as triangles, and the closed surfaces of its phases among them.
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

/// Thrown by a meshing that MeshOptions::cancelled has stopped.
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

/// Appends all crossings along a line, which starts in the vacuum: origin + t·direction for t from 0 to `length`, in
/// rising order. The direction is of unit length. It is called by many threads at once.
using LineTracer = std::function<void(const glm::vec3& origin, const glm::vec3& direction, float length,
                                      std::vector<CrossingOnLine>&)>;
/// Lines through an object by its tracer, which must outlive what is returned. It runs the whole object's program at
/// each step: of objects of many nodes, rays through cells (phasetree_embree.h) are faster.
LineTracer line_tracer(const InterfaceTracer&);

struct MeshOptions {
    /// The side of the cubes of the grid, in the scene's unit of length; 0 takes a 256th of the bounds' longest side.
    float spacing = 0;
    std::function<bool()> cancelled{};  ///< polled from any thread; return true to cancel
    /// Receives the fraction of the work that is done, in (0, 1], strictly increasing up to 1. Called by one thread at
    /// a time.
    std::function<void(float)> progress{};
};

/// The interfaces of an object as triangles. Where phases touch they share the triangles, and all triangles share their
/// vertices, so there are no gaps between them.
struct PhaseMesh {
    struct Triangle {
        /// Counterclockwise as seen from the phase in front.
        std::array<std::uint32_t, 3> vertices{};
        Phase behind;  ///< the one of the higher index
        Phase front;
    };

    std::vector<glm::vec3> vertices;
    std::vector<Triangle> triangles;
    float spacing = 0;  ///< that was used
    /// How many crossings there are along the lines of the grid, and how many of these are not shown: those on an edge
    /// of the grid whose ends have one label in the end, and all but one where there are several on an edge.
    std::size_t crossings = 0, passed_over = 0;

    /// The phases that have triangles.
    PhaseSet phases() const;
};

/// The most cubes along a side of the bounds.
inline constexpr int most_cubes_along = 1024;

/// Makes a mesh of the interfaces within the bounds, which must contain all that is not vacuum. Uses all threads that
/// TBB gives it, and gives the same mesh for any number of them. The labels take a byte for each point of the grid, 1.1
/// GB for the finest. Throws ModelError if the bounds are empty or infinite, or for a spacing that would take more than
/// most_cubes_along cubes along a side or is finer than floats are at the bounds' coordinates, and MeshingCancelled.
///
/// It is dual contouring (Ju, Losasso, Schaefer & Warren, *Dual Contouring of Hermite Data*, SIGGRAPH 2002) for several
/// labels at once. A grid of points has the labels. Each edge of the grid between two phases has a quadrilateral, whose
/// corners are vertices in the four cubes around it; a cube has one for each patch of interfaces that hangs together in
/// it. Places and normals of the interfaces along the edges come from rays, so edges and corners of the object are
/// sharp. A vertex is where the planes through these places meet best, in its cube or near it.
///
/// Labels are first changed where a phase would touch itself along an edge or at a point alone (after Latecki, *3D
/// Well-Composed Pictures*, Graphical Models and Image Processing 1997). Then each phase's surface is closed, and a
/// manifold: each of its edges has two triangles, and the triangles around a vertex are one fan. A wall that is at
/// least 1.2 times as thick as the spacing is whole; what is thinner may have holes or be missing, and triangles may
/// intersect there.
PhaseMesh mesh_of(const Bounds& bounds, const LineTracer& lines, const MeshOptions& options = {});

/// A closed surface; its triangles are counterclockwise as seen from outside.
struct ClosedMesh {
    std::vector<glm::vec3> vertices;
    std::vector<std::uint32_t> in_mesh;  ///< for each vertex, its number in PhaseMesh::vertices
    std::vector<std::array<std::uint32_t, 3>> triangles;

    double volume() const;
};

/// What bounds some phases together: the triangles of a mesh with one of these on one side alone, and their vertices.
/// It is a manifold if they are a single phase, or all but one.
ClosedMesh surface_of(const PhaseMesh& mesh, PhaseSet phases);

}  // namespace phasetree
