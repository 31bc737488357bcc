#include "nodes/mesh_repair/repair.hpp"

#include <fmt/format.h>

#include "nodes/mesh_repair/arrange.hpp"
#include "nodes/mesh_repair/holes.hpp"
#include "nodes/mesh_repair/shells.hpp"
#include "phasetree/model/handle.hpp"

namespace phasetree::mesh {

Surface repaired(const TriangleMesh& mesh, WindingRule rule, const std::string& name) {
    Chain chain = welded(mesh);
    orient(chain);
    std::vector<std::uint32_t> shells = shells_of(chain);
    const ClosedHoles closed = close_holes(chain, shells);
    if (closed.sheets > 0 && chain.triangles.empty())
        throw ModelError(fmt::format(
            "mesh: {} is a sheet that encloses nothing: its holes are about as large as itself. Give it a thickness "
            "where it was made (in Blender, by the modifier Solidify), close it, or use it as one of the scene's "
            "\"meshes\", which may be open",
            name));
    if (rule == WindingRule::winding_number && !chain.triangles.empty()) turn_shells(chain, shells);
    const std::vector<std::uint32_t> touching_others = arrange(chain, name);
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
            "triangles may face both ways or have no volume between them",
            name));
    return surface_of_boundary(boundary);
}

}  // namespace phasetree::mesh
