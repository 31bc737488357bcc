#pragma once

#include "embree_core/cell_geometry.hpp"

namespace phasetree::embree {

/// An object's cells in an Embree scene of their own. It finds the first crossing of a ray; Walk finds all of them in
/// order. Immutable; any thread may trace.
///
/// Cells as primitives of the host's scene (CellGeometry) are faster by a tenth to a third. But Embree visits cells in
/// any order, and each cell knows only its own interval of the ray. That suffices to find the first crossing. It does
/// not suffice to report each crossing once to a filter function, because cells overlap, or to know the phase of a ray
/// that a filter has let through. A separate scene makes both simple.
class CellScene {
  public:
    /// Throws EmbreeError. Clears the device's error code of the calling thread.
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
    /// Whether there is any crossing.
    bool any_crossing(const UnitRay&, std::optional<Phase> carried) const;

  private:
    CellGeometry geometry_;
    RTCScene scene_ = nullptr;
};

}  // namespace phasetree::embree
