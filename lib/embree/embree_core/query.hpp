#pragma once

#include "embree_core/cell_search.hpp"
#include "embree_core/ray_phases.hpp"

namespace phasetree::embree {

/// Information about a ray that starts at p_from or p_to of a crossing that was hit, and carries the phase there. With
/// it, the cell of that hit usually need not be searched again: most reflected and refracted rays leave the cell and
/// never come back.
struct StartHint {
    ObjectInstance object;
    unsigned cell = 0;      ///< the hit's primID
    Phase from{};           ///< the phase before the crossing
    glm::vec3 gradient{0};  ///< CrossingNormal::gradient of the crossing
};

/// The state of one ray on its way through Embree to the callbacks of CellGeometry and back. Embree's own context is
/// the first member, so that both have the same address. A geometry reads the other members only with
/// CellGeometry::Options::rays_carry_phases.
struct Query {
    Context context;
    /// In: the phases of some objects that the ray is in. The caller owns the memory.
    std::span<const CarriedPhase> carried;
    /// In: the phase of all other objects. Without a value, each object uses the phase at the ray's start.
    std::optional<Phase> default_phase;
    /// In: the crossing at which the ray starts, if any.
    StartHint start;
    /// In: whether to skip cells, so that only other geometries of the scene are found.
    bool skips_cells = false;
    /// Out: the crossing of the hit that a CellGeometry reported last during the query, in object space. If the closest
    /// hit, which the query returns, is on a CellGeometry, this is its crossing. The hit's primID is then the cell,
    /// whose InterfaceCells::normal() returns the normal, and ObjectInstance::of(hit) is the object whose phase
    /// changes.
    Crossing crossing;
    /// Out: the cost of searching all cells, added to the previous values.
    TraceCounters counters;
    /// Out: a cell could not be searched because memory ran out, so the hit may be wrong. Exceptions cannot pass
    /// through Embree.
    bool is_out_of_memory = false;
    /// The last ray, prepared for its next cell. It stays the same from cell to cell of one object.
    PreparedRay prepared;

    Query() { initialise(context); }

    /// Set the phases that the ray is in. They must outlive the query.
    void carry(const RayPhases& phases) {
        carried = phases.carried();
        default_phase = phases.default_phase();
    }
    void carry(RayPhases&&) = delete;
};

}  // namespace phasetree::embree
