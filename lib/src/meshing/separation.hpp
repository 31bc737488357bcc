// Keeps triangles from crossing and touching each other, other than in common vertices and edges.
//
// Vertices that lie outside their cubes may make triangles cross. So may those inside them: four vertices around an
// edge of the grid need not be in a plane, and two triangles between them may reach into other cubes. We look for
// triangles that touch others, and change only the vertices of these, in steps (`Placement`). Triangles then become
// finer, as in Ju and Udeshi, *Intersection-free Contouring on an Octree Grid* (Pacific Graphics 2006), until each of
// them lies in one cube. We repeat this until none touch.
//
// The last step, in which positions are regular, cannot fail. In a cube, the triangles of a patch are then those
// between its vertex, which is inside the cube, and segments on the sides, which do not cross each other. So the
// triangles of a patch meet only in common edges and at the vertex. There are finitely many ways to label a cube; the
// test lib/separation checks all of them: triangles of different patches keep a distance. Triangles of different cubes
// meet only on the common side, in the same segments. Therefore the process terminates, at the latest when all vertices
// are regular. Then no triangles touch each other, because all those that are not regular have been compared with their
// neighbours.
#pragma once

#include <array>
#include <cstdint>
#include <functional>

#include "meshing/active_cubes.hpp"
#include "meshing/joined_sides.hpp"
#include "meshing/label_grid.hpp"
#include "meshing/quad_mesh.hpp"

namespace phasetree::meshing {

/// How far the separation has gone at a vertex of a cube. Each step includes those before it.
enum class Placement : std::uint8_t {
    free,         ///< where planes meet (vertex_in_cube.hpp)
    inside,       ///< moved into the cube, onto the interface if it is found there
    split_edges,  ///< the cut edges of the cube have vertices, on the interface
    split_sides,  ///< so have the sides: each triangle with this vertex is in its cube
    regular       ///< positions that depend on labels alone (regular_points.hpp)
};

/// What is known about the grid.
struct CutGrid {
    const Grid& grid;
    const LineTracer& lines;
    const std::array<CrossingsAlong, 3>& crossings;
    const Labels& labels;
    const JoinedSides& joined;
    const ActiveCubes& cubes;
};

/// Chooses the diagonals of all quadrilaterals, and moves and adds vertices until no triangles touch each other. The
/// result does not depend on the number of threads. `cancelled` is called periodically, and may throw. `advance` is
/// called from any thread, once for each layer of points of the grid, while all triangles are compared; the subsequent
/// work takes little time.
void separate(const CutGrid&, QuadMesh&, const std::function<void()>& cancelled, const std::function<void()>& advance);

}  // namespace phasetree::meshing
