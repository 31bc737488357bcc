// Traits of meshes, kept out of mesh.hpp: how they are read, and how their values are enclosed in a box.
#pragma once

#include "phasetree/model/from_file.hpp"
#include "phasetree/nodes/fields/mesh.hpp"

namespace phasetree {

template <>
struct FileFormat<TriangleMesh> {
    static TriangleMesh read(const std::filesystem::path&);
};

/// Encloses the values in a small box by the normals of the few pieces that matter there.
struct MeshEnclosing {
    static std::optional<enclosure::Enclosure> enclosed(const float* pieces, const Vec3<enclosure::Enclosure>& q,
                                                        const std::array<double, 3>& half);
};
template <>
struct EnclosingOf<Mesh::Specialised> {
    using Stated = MeshEnclosing;
};

}  // namespace phasetree
