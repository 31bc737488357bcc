#pragma once

#include "embree_core/cell_geometry.hpp"

namespace phasetree::embree {

/// An object's cells in an Embree scene of their own: rays find their first crossing, whole and in order. Immutable;
/// any thread may trace.
///
/// Cells as primitives of the host's own scene (CellGeometry) are faster, by a tenth to a third. But Embree asks
/// cells in any order and each knows only its own span of the ray. That tells which crossing is the first; it cannot
/// tell a filter function each crossing once, because cells reach into each other, nor which phase a ray is in that a
/// filter has let through. A scene within makes both simple.
class CellScene {
  public:
    /// Throws EmbreeError. Clears the thread's error code of the device.
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
    /// Whether there is any.
    bool any_crossing(const UnitRay&, std::optional<Phase> carried) const;

  private:
    CellGeometry geometry_;
    RTCScene scene_ = nullptr;
};

}  // namespace phasetree::embree
