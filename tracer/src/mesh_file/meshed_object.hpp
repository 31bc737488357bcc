// What files of meshes are written of.
#pragma once

#include <string>
#include <vector>

#include "page/look.hpp"
#include "phasetree/meshing/phase_mesh.hpp"

namespace phasetree::tracer {

struct MeshedObject {
    PhaseMesh mesh;
    std::vector<Look> looks;  ///< of all phases, the vacuum first
    PhaseSet chosen;          ///< the phases that a file is to have; the vacuum is none of them
    float scale = 1;          ///< how much larger the mesh is than the scene, in whose unit of length the looks are

    /// Those of the chosen ones that have triangles, in their order.
    std::vector<Phase> phases() const {
        std::vector<Phase> there;
        for_each_phase((chosen & mesh.phases()).bits,
                       [&](int i) { there.push_back(Phase{static_cast<std::uint8_t>(i)}); });
        return there;
    }
    const Look& look(Phase phase) const { return looks[phase.index]; }
};

}  // namespace phasetree::tracer
