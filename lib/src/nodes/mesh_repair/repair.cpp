#include "nodes/mesh_repair/repair.hpp"

#include <fmt/format.h>

#include "nodes/mesh_repair/arrange.hpp"
#include "nodes/mesh_repair/holes.hpp"
#include "nodes/mesh_repair/shells.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree::mesh {

Surface repaired(const TriangleMesh& mesh, WindingRule rule, const std::string& name, model::Preparation& work) {
    Chain chain = welded(mesh);
    work.tell(0.4f);
    std::vector<EdgeOfChain> edges = edges_of(chain);
    orient(chain, edges);
    std::vector<std::uint32_t> shells = shells_of(chain, edges);
    const ClosedHoles closed = close_holes(chain, edges, shells);
    edges = {};
    if (closed.sheets > 0 && chain.triangles.empty())
        throw ModelError(fmt::format(
            "mesh: {} is a sheet that encloses nothing: its holes are about as large as itself. Make a wall of it by "
            "\"thickness\", close it, or use it as one of the scene's \"meshes\", which may be open",
            name));
    if (rule == WindingRule::winding_number && !chain.triangles.empty()) turn_shells(chain, shells);
    work.tell(0.45f);
    const std::vector<std::uint32_t> touching_others = arrange(chain, name, work);
    work.tell(0.7f);
    Chain boundary;
    if (!chain.triangles.empty()) {
        const std::vector<SideWinding> windings = windings_of(chain);
        if (!are_confirmed(chain, windings, touching_others))
            throw ModelError(
                fmt::format("mesh: {} has parts that lie on each other within rounding and cannot be separated: move "
                            "one of them by a ten-thousandth of the mesh's size, or remove it",
                            name));
        boundary = boundary_of(chain, windings, rule);
    }
    if (boundary.triangles.empty())
        throw ModelError(fmt::format(
            "mesh: {} encloses nothing: there are no points around which its triangles wind as its rule requires. Its "
            "triangles may face both ways or have no volume between them. \"thickness\" makes a wall along them",
            name));
    return surface_of_boundary(boundary);
}

}  // namespace phasetree::mesh
