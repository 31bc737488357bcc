#include "phasetree/io/mesh.hpp"
#include "phasetree/nodes/fields/mesh_traits.hpp"

namespace phasetree {

TriangleMesh FileFormat<TriangleMesh>::read(const std::filesystem::path& path) {
    return read_mesh(path);
}

}  // namespace phasetree
