#pragma once

#include <memory>

#include "embree_core/query.hpp"

namespace phasetree::embree {

/// An object's cells as the primitives of an RTCGeometry of type user. A hit is the first change of phase along the
/// ray:
///     tfar         distance to where the old phase ends (in units of the ray's direction, as Embree has it)
///     Ng           normal on the side the ray came from; unit in object space. For rays that carry phases it is minus
///                  the direction, which stands for it: their host asks InterfaceCells::normal() for the one hit that
///                  it keeps
///     u, v         index of the phase left and of the phase entered
///     primID       the cell
/// A ray's direction may have any length. Rays with numbers that are not finite hit nothing.
///
/// The boxes of neighbouring cells overlap a little, so that a crossing at a common face is lost to neither by
/// rounding: it may be found in both. Embree asks cells in any order and keeps the nearest hit, so a crossing that is
/// found twice is one hit all the same, and the nearest hit is right, and whether there is any. But a filter function
/// would see some crossings twice: where it matters use CellScene.
///
/// Owns the handle and what its callbacks read: must outlive every scene that it is attached to. The geometry is not
/// committed; do so before attaching, as with any other. Any thread may trace.
class CellGeometry {
  public:
    struct Options {
        /// Every query that reaches the geometry is a Query, one ray at a time (rtcIntersect1 and rtcOccluded1).
        /// Otherwise any context and any packet size will do, and a ray is in the phase at its start.
        bool rays_carry_phases = false;
    };

    CellGeometry(RTCDevice device, std::shared_ptr<const InterfaceCells> cells, const Options& options);
    CellGeometry(RTCDevice device, std::shared_ptr<const InterfaceCells> cells)
        : CellGeometry(device, std::move(cells), Options()) {}
    ~CellGeometry();
    CellGeometry(CellGeometry&&) noexcept;
    CellGeometry& operator=(CellGeometry&&) noexcept;

    RTCGeometry handle() const { return handle_; }
    const InterfaceCells& cells() const { return *cells_; }

  private:
    RTCGeometry handle_ = nullptr;
    std::shared_ptr<const InterfaceCells> cells_;  ///< callbacks have the address of what it points to
};

}  // namespace phasetree::embree
