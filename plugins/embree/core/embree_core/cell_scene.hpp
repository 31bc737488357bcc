#pragma once

#include "embree_core/cell_geometry.hpp"

namespace phasetree::embree {

/// An object's cells in an Embree scene of their own, in which rays find their crossings once each and in order.
/// Immutable; any thread may trace.
///
/// Cells as primitives of the host's own scene (CellGeometry) are faster, by a tenth to a third. However, Embree visits
/// cells in any order, and each cell knows only its own span of the ray. That determines the first crossing. It does
/// not allow a filter function to see each crossing once, because cells overlap, nor does it give the phase of a ray
/// after a filter has let it through. A separate scene makes both simple.
class CellScene {
  public:
    /// Throws EmbreeError. Clears the device's error code for the calling thread.
    CellScene(RTCDevice device, std::shared_ptr<const InterfaceCells> cells);
    ~CellScene();
    CellScene(const CellScene&) = delete;
    CellScene& operator=(const CellScene&) = delete;

    const InterfaceCells& cells() const { return geometry_.cells(); }

    struct Hit {
        unsigned cell = 0;
        Crossing crossing;
    };
    std::optional<Hit> first_crossing(const UnitRay&, std::optional<Phase> carried) const;
    /// Whether the ray has any crossing.
    bool any_crossing(const UnitRay&, std::optional<Phase> carried) const;

  private:
    CellGeometry geometry_;
    RTCScene scene_ = nullptr;
};

}  // namespace phasetree::embree
