#pragma once

/// An object's cells as Embree user primitives, for Embree 3.13 and Embree 4: what the path tracer traces, and what the
/// interface for other programs (phasetree_embree.h) is built on.

#include "phasetree/cells/cells.hpp"
#include "phasetree/embree_version.hpp"

namespace phasetree::embree {

/// What a ray carries through Embree to our callbacks and back: Embree's own context first, so that its address is the
/// context's. A geometry reads it only if it was made with `Options::rays_carry_phases`.
struct Query {
    Context context;
    /// The phase the ray is in. Without it the geometry takes the label at the ray's start.
    std::optional<Phase> carried;
    /// If the ray starts at p_in or p_out of a crossing, whose hit had these IDs (the instance's that of level 0), and
    /// carries the phase there: they save the cell from finding that out again, and all the more with the phase that
    /// was left and CrossingNormal::gradient.
    struct Start {
        unsigned geometry = RTC_INVALID_GEOMETRY_ID, cell = 0, instance = RTC_INVALID_GEOMETRY_ID;
        Phase from{};
        glm::vec3 gradient{0};
    } start;
    /// The crossing behind the last hit that a PhaseTree reported. If the ray's final geomID is the tree's, this is
    /// that hit's, in the object's own space, and the hit's primID is its cell: InterfaceCells::normal gives the
    /// normal.
    Crossing crossing;
    TraceCounters counters;
    /// A cell could not be searched for want of memory, so the hit may be wrong. Embree lets no exception through.
    bool is_out_of_memory = false;
    /// The last ray that came, as it was given and as cells see it: it stays the same from cell to cell.
    struct Seen {
        glm::vec3 origin{0}, direction{0};
        float length = 0;  ///< of the direction
        TracedRay ray;
    } seen;

    Query() { initialise(context); }
};

struct Options {
    /// Every query that reaches the geometry is a phasetree::embree::Query, one ray at a time (rtcIntersect1 and
    /// rtcOccluded1). Otherwise any context and any packet size will do.
    bool rays_carry_phases = false;
};

/// An object as an RTCGeometry of type user. A hit is the first change of phase along the ray:
///     tfar         distance to where the old phase ends (in units of the ray's direction, as Embree has it)
///     Ng           normal on the side the ray came from; unit in object space (for rays that carry phases against the
///                  direction: they ask for the normal of the hit they keep)
///     u, v         index of the phase left and of the phase entered
///     primID       the cell
/// A ray's direction may have any length. Rays with numbers that are not finite hit nothing.
///
/// Owns the handle and what its callbacks read: must outlive every scene that it is attached to. The geometry is not
/// committed; do so before attaching, as with any other. Any thread may trace.
class TreeGeometry {
  public:
    TreeGeometry(RTCDevice device, std::shared_ptr<const InterfaceCells> object, const Options& options = {});
    ~TreeGeometry();
    TreeGeometry(TreeGeometry&&) noexcept;
    TreeGeometry& operator=(TreeGeometry&&) noexcept;

    RTCGeometry handle() const { return handle_; }
    const InterfaceCells& object() const;

    struct Data;

  private:
    RTCGeometry handle_ = nullptr;
    std::unique_ptr<Data> data_;
};

}  // namespace phasetree::embree
