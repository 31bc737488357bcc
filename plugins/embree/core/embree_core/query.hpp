#pragma once

#include "embree_core/cell_search.hpp"
#include "embree_core/ray_phases.hpp"

namespace phasetree::embree {

/// What a ray may say that starts at p_in or p_out of a crossing that was hit, in the phase there. It saves the hit's
/// cell from finding out that the ray leaves: most that are reflected or refracted do, and never come back.
struct StartHint {
    ObjectInstance object;
    unsigned cell = 0;      ///< the hit's primID
    Phase from{};           ///< the phase that the crossing ends
    glm::vec3 gradient{0};  ///< CrossingNormal::gradient of the crossing
};

/// One ray's state on its way through Embree to the callbacks of CellGeometry and back. Embree's own context comes
/// first, so that its address is the context's. A geometry reads the rest only if it was made with
/// CellGeometry::Options::rays_carry_phases.
struct Query {
    Context context;
    /// In: the phases that the ray is in, of some objects. The caller owns what the span refers to.
    std::span<const CarriedPhase> carried;
    /// In: the phase that the ray is in of all other objects. Without a value each takes the phase at the ray's start.
    std::optional<Phase> elsewhere;
    /// In: the crossing at which the ray starts, if it starts at one.
    StartHint start;
    /// In: whether cells are passed by, so that only what else is in the scene is found.
    bool passes_cells = false;
    /// Out: the crossing behind the last hit that an object reported, in that object's own space. If the ray's final
    /// hit is an object's, this is that hit's; the hit's primID is the cell, whose InterfaceCells::normal gives the
    /// normal, and ObjectInstance::of(hit) is the object whose phase changes.
    Crossing crossing;
    /// Out: what the searches of all cells have cost, added to what was there.
    TraceCounters counters;
    /// Out: a cell could not be searched for want of memory, so the hit may be wrong. Embree lets no exception through.
    bool is_out_of_memory = false;
    /// The last ray that came, which stays the same from cell to cell of one object.
    SeenRay seen;

    Query() { initialise(context); }

    /// The ray is in these phases, which must outlive the query.
    void carry(const RayPhases& phases) {
        carried = phases.carried();
        elsewhere = phases.elsewhere();
    }
    void carry(RayPhases&&) = delete;
};

}  // namespace phasetree::embree
