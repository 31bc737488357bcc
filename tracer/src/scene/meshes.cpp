#include <fmt/format.h>

#include "phasetree/io/read_kind.hpp"
#include "scene/mesh_kinds.hpp"
#include "scene/read_parts.hpp"

namespace phasetree::tracer {

std::vector<Mesh> read_meshes(const Document& document, Value list) {
    if (!list.is_array())
        throw document.error(list, fmt::format("\"meshes\" must be a list, but is {}", name_of(list.kind())));
    std::vector<Mesh> meshes;
    for (const Value value : list) {
        with_kind(MeshKinds(), document, value, "a mesh", [&]<class Kind>(Value member) {
            meshes.push_back(
                read_kind<Kind>(document, member, fmt::format("the {}", Kind::info.name), [](const Kind& kind) {
                    Mesh mesh = kind.made();
                    mesh.material = kind.material;
                    return mesh;
                }));
        });
    }
    return meshes;
}

}  // namespace phasetree::tracer
