// The clear objects of a glTF file as solids: closed meshes in the space of the scene. What is inside may be solid,
// liquid or gas (Matter in precedence.hpp).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "gltf/read_gltf.hpp"
#include "phasetree/math/bounds.hpp"
#include "phasetree/nodes/fields/mesh.hpp"

namespace phasetree::tracer::gltf_import {

struct Solid {
    std::string name{};        ///< of its node, or else of its mesh; made unique
    std::size_t material = 0;  ///< in GltfFile::clear_materials
    std::optional<float> priority{};
    std::string matter{};     ///< solid, liquid or gas as stated in the file; empty if not stated
    TriangleMesh mesh{};      ///< z is up
    phasetree::Mesh field{};  ///< the solid within the mesh, repaired where needed
    Bounds bounds{};
    double volume = 0, area = 0;

    /// The signed distance of a point.
    float distance(const glm::vec3& p) const {
        return phasetree::Mesh::distance<float>(field.data().data(), Vec3<float>{p.x, p.y, p.z});
    }
};

struct Solids {
    std::vector<Solid> solids;          ///< in the order of the file
    std::vector<std::string> warnings;  ///< sentences
};

/// Makes the solids. Triangles of several clear materials on one surface become one solid. Objects that enclose nothing
/// are left out, with a warning.
Solids solids_of(const gltf::GltfFile& file);

/// Converts a position or a direction from glTF's space (y up) to the scene's (z up).
template <class T>
glm::vec<3, T> z_up(const glm::vec<3, T>& p) {
    return {p.x, -p.z, p.y};
}

}  // namespace phasetree::tracer::gltf_import
