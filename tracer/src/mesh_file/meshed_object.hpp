// The input of the mesh file writers.
#pragma once

#include <string>
#include <vector>

#include "page/look.hpp"
#include "phasetree/meshing/phase_mesh.hpp"

namespace phasetree::tracer {

struct MeshedObject {
    PhaseMesh mesh;
    std::vector<Look> looks;  ///< one per phase, the vacuum first
    PhaseSet chosen;          ///< the phases to write, without the vacuum
    float scale = 1;          ///< file lengths per scene length; the looks are in scene units

    /// The chosen phases that have triangles, in order.
    std::vector<Phase> phases() const {
        std::vector<Phase> there;
        for_each_phase((chosen & mesh.phases()).bits,
                       [&](int i) { there.push_back(Phase{static_cast<std::uint8_t>(i)}); });
        return there;
    }
    const Look& look(Phase phase) const { return looks[phase.index]; }
};

}  // namespace phasetree::tracer
