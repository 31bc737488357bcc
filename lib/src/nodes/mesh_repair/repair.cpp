#include "nodes/mesh_repair/repair.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

#include "nodes/mesh_repair/holes.hpp"
#include "nodes/mesh_repair/shells.hpp"
#include "nodes/mesh_repair/unite_shells.hpp"
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
    Chain boundary;
    if (!chain.triangles.empty()) {
        std::optional<Chain> united;
        if (rule == WindingRule::winding_number && overlap_often(chain, shells))
            united = union_of_shells(chain, shells, name, work);
        boundary = united ? std::move(*united) : arranged_boundary(chain, rule, name, work);
    }
    work.tell(0.7f);
    if (boundary.triangles.empty())
        throw ModelError(fmt::format(
            "mesh: {} encloses nothing: there are no points around which its triangles wind as its rule requires. Its "
            "triangles may face both ways or have no volume between them. \"thickness\" makes a wall along them",
            name));
    return surface_of_boundary(boundary);
}

}  // namespace phasetree::mesh
