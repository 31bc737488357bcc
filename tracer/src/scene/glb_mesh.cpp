// Meshes from .glb files, one for each material that the file has.
#include <fmt/format.h>

#include "gltf/read_glb.hpp"
#include "parameters/named_file.hpp"
#include "scene/mesh_kinds.hpp"
#include "scene/mesh_placement.hpp"

namespace phasetree::tracer {

MeshGroup GlbParameters::made() const {
    check_ending_of_mesh(file, ".glb");
    gltf::GlbFile read;
    try {
        read = gltf::read_glb(read_whole_file(file, most_bytes_of_mesh, "1 GiB"),
                              material ? gltf::ReadMaterials::none : gltf::ReadMaterials::all);
    } catch (const gltf::GltfError& e) {
        throw ParameterError("file", fmt::format("{}: {}", file.string(), e.what()));
    }
    MeshGroup group;
    for (gltf::Part& part : read.parts) {
        Mesh mesh{.vertices = std::move(part.mesh.vertices),
                  .triangles = std::move(part.mesh.triangles),
                  .normals = std::move(part.normals),
                  .uv = std::move(part.texture),
                  .colors = std::move(part.colors),
                  .material = material.value_or(part.material),
                  .name = std::move(part.name)};
        MeshPlacement(scale, rotate_z_degrees, translate, true).apply(mesh, file);
        group.meshes.push_back(std::move(mesh));
    }
    for (const std::string& sentence : read.not_shown)
        group.not_shown.push_back(fmt::format("{}: {}", file.string(), sentence));
    return group;
}

}  // namespace phasetree::tracer
