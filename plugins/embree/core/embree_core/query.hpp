#pragma once

#include "embree_core/cell_search.hpp"
#include "embree_core/ray_phases.hpp"

namespace phasetree::embree {

/// An optional hint for a ray that starts at p_in or p_out of a crossing that was hit, in the phase there. It saves the
/// hit's cell from finding out that the ray leaves. Most reflected or refracted rays do, and never return.
struct StartHint {
    ObjectInstance object;
    unsigned cell = 0;      ///< the hit's primID
    Phase from{};           ///< the phase that ends at the crossing
    glm::vec3 gradient{0};  ///< CrossingNormal::gradient of the crossing
};

/// The state of one ray on its way through Embree to the callbacks of CellGeometry and back. Embree's context is the
/// first member, so that both have the same address. A geometry reads the rest only if it was created with
/// CellGeometry::Options::rays_carry_phases.
struct Query {
    Context context;
    /// In: the phases of individual objects that the ray is in. The caller owns the elements.
    std::span<const CarriedPhase> carried;
    /// In: the phase of all other objects that the ray is in. Without a value, each object uses the phase at the ray's
    /// start.
    std::optional<Phase> elsewhere;
    /// In: the crossing at which the ray starts, if any.
    StartHint start;
    /// In: whether to ignore cells, so that only other geometry in the scene is hit.
    bool passes_cells = false;
    /// Out: the crossing of the last hit that an object reported, in that object's own space. It belongs to the ray's
    /// final hit if that is an object's. The hit's primID is then the cell, whose InterfaceCells::normal computes the
    /// normal, and ObjectInstance::of(hit) is the object whose phase changes.
    Crossing crossing;
    /// In and out: costs of the searches in all cells are added to these counters.
    TraceCounters counters;
    /// Out: a cell could not be searched for lack of memory, so the hit may be wrong. Exceptions cannot pass through
    /// Embree.
    bool is_out_of_memory = false;
    /// The last ray seen, which is the same for all cells of one object.
    SeenRay seen;

    Query() { initialise(context); }

    /// Sets the phases that the ray is in. They must outlive the query.
    void carry(const RayPhases& phases) {
        carried = phases.carried();
        elsewhere = phases.elsewhere();
    }
    void carry(RayPhases&&) = delete;
};

}  // namespace phasetree::embree
