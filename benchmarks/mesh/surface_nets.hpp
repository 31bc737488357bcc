// Surface nets (Gibson, "Constrained Elastic Surface Nets", MICCAI 1998) over a grid of cubes: a vertex in each cube
// that the surface passes through, where the surface crosses the cube's edges on average; a quad about each crossed
// edge.
//
// Where the surface crosses the grid's edges is found by tracing the grid's lines, not by looking at all of its points:
// that is exact to the tracer's resolution, and 512³ points are nine hundred thousand lines.
#pragma once

#include "mesh/triangles.hpp"
#include "trace/field_scene.hpp"

namespace phasetree::bench {

// The outer surface, with this many cubes along the longest side of the object's bounds. Runs on the threads that TBB
// may use; the result does not depend on how many.
Triangles surface_nets(const FieldScene&, int cubes);

}  // namespace phasetree::bench
