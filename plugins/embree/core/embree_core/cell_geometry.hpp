#pragma once

#include <memory>

#include "embree_core/query.hpp"

namespace phasetree::embree {

/// An object's cells as the primitives of an RTCGeometry of type user. A hit is the first change of phase along the
/// ray:
///     tfar         distance to the end of the old phase, in units of the ray's direction, as usual in Embree
///     Ng           normal on the side that the ray comes from, of unit length in object space. For rays that carry
///     phases
///                  it is minus the direction, as a placeholder: the host calls InterfaceCells::normal() only for the
///                  hit
///                  that it keeps
///     u, v         index of the phase left and of the phase entered
///     primID       the cell
/// A ray's direction may have any length. Rays with non-finite numbers hit nothing.
///
/// The boxes of neighbouring cells overlap slightly, so that rounding cannot lose a crossing at a common face; such a
/// crossing may be found in both cells. Embree visits cells in any order and keeps the nearest hit, so a crossing found
/// twice is still one hit, and both the nearest hit and occlusion are correct. A filter function, however, would see
/// some crossings twice; use CellScene where that matters.
///
/// Owns the handle and the data that its callbacks read, so it must outlive every scene that it is attached to. The
/// geometry is not committed; commit it before attaching it, like any other. Any thread may trace.
class CellGeometry {
  public:
    struct Options {
        /// Every query that reaches the geometry is a Query with a single ray (rtcIntersect1 and rtcOccluded1). If
        /// false, any context and packet size is allowed, and a ray is in the phase at its start.
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
    std::shared_ptr<const InterfaceCells> cells_;  ///< callbacks hold the address of the cells
};

}  // namespace phasetree::embree
