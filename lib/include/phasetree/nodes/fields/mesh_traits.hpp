// What a mesh states about itself, beside its own files: how it is read, and how it is enclosed in a box.
#pragma once

#include "phasetree/model/from_file.hpp"
#include "phasetree/nodes/fields/mesh.hpp"

namespace phasetree {

template <>
struct FileFormat<TriangleMesh> {
    static TriangleMesh read(const std::filesystem::path&);
};

/// By the normals of the few pieces in a small box.
struct MeshEnclosing {
    static std::optional<enclosure::Enclosure> enclosed(const float* pieces, const Vec3<enclosure::Enclosure>& q,
                                                        const std::array<double, 3>& half);
};
template <>
struct EnclosingOf<Mesh::Specialised> {
    using Stated = MeshEnclosing;
};

}  // namespace phasetree
