#pragma once

#include <memory>

#include "embree_core/query.hpp"

namespace phasetree::embree {

/// An object's cells as the primitives of an RTCGeometry of type user. A hit is the first change of phase along the
/// ray:
///
///     tfar         the end of the old phase, in units of the ray's direction as usual in Embree
///     Ng           the unit normal in object space, on the side the ray came from. With Options::rays_carry_phases,
///                  the reversed direction of the ray: the host calls InterfaceCells::normal() for the one hit that it
///                  keeps
///     u, v         the index of the phase left and of the phase entered
///     primID       the cell
///
/// Directions may have any length. Rays whose origin or direction is not finite hit nothing.
///
/// The boxes of neighbouring cells overlap slightly, so that rounding cannot hide a crossing at a common face from
/// both. Both may find it. Embree visits cells in any order and keeps the nearest hit, so closest-hit and occlusion
/// queries are correct. A filter function, however, would see some crossings twice. Use CellScene where that matters.
///
/// Owns the RTCGeometry and the data that its callbacks read, so it must outlive every scene to which the geometry is
/// attached. The geometry is not committed; commit it before attaching it, as any other. Any thread may trace.
class CellGeometry {
  public:
    struct Options {
        /// Requires that every query that reaches the geometry is a Query with a single ray (rtcIntersect1 and
        /// rtcOccluded1). Without it, any context and packet size is allowed, and a ray is in the phase at its start.
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
    std::shared_ptr<const InterfaceCells> cells_;  ///< callbacks hold the address of the object it points to
};

}  // namespace phasetree::embree
