#pragma once

#include "nodes/mesh_repair/chain.hpp"
#include "nodes/mesh_surface.hpp"

namespace phasetree::mesh {

/// Which points are inside, by the winding number (parameter `rule` of the node).
enum class WindingRule : std::uint8_t { winding_number, even_odd, non_zero };

/// For each triangle, how often the chain winds around the points just in front of it and behind it. The chain must be
/// closed and arranged.
///
/// The triangles around an edge, sorted by angle, bound sectors; the two sides of triangles that face the same sector
/// belong to the same cell. The winding number changes by a triangle's multiplicity from one side to the other, so one
/// ray for each connected part of the chain is enough. Therefore, regardless of rounding, winding numbers differ only
/// across triangles, and the triangles between inside and outside cells always form a closed surface.
struct SideWinding {
    std::int64_t front, back;
};
std::vector<SideWinding> windings_of(const Chain&);

/// Whether rays confirm the winding numbers in front of these triangles. Triangles as thin as rounding errors are
/// skipped.
bool are_confirmed(const Chain&, std::span<const SideWinding>, std::span<const std::uint32_t> triangles);

/// The triangles with one side inside, facing outward.
Chain boundary_of(const Chain&, std::span<const SideWinding>, WindingRule);

/// The surface of such a boundary. If more than two triangles share an edge, the edge joins the two that bound the
/// widest sector. Only points in a sector of more than 180° can be nearest to an edge, so the edge's normal matters for
/// no other sector.
Surface surface_of_boundary(const Chain&);

}  // namespace phasetree::mesh
