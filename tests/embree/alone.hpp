// The object alone in an Embree scene, its cells as Embree's primitives.
#pragma once

#include "embree/embree.hpp"
#include "embree_core/cell_geometry.hpp"

namespace phasetree::tests {

struct Alone {
    explicit Alone(const embree::CellGeometry::Options& options = {})
        : tree(device, std::make_shared<const InterfaceCells>(object()), options), scene(device) {
        id = scene.add(tree.handle());
        scene.commit();
    }
    Device device;
    embree::CellGeometry tree;
    EmbreeScene scene;
    unsigned id = 0;
};

}  // namespace phasetree::tests
