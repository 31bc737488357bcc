// The first mesh of a scene that comes from a glTF file, and its interpolated data at a point.
#pragma once

#include <string>

#include "phasetree_support/temporary_directory.hpp"
#include "scene/mesh_kinds.hpp"
#include "tracer/gltf/gltf_corner.hpp"
#include "world/mesh_place.hpp"

namespace phasetree::tracer::tests {

inline Mesh scene_mesh(const std::string& content) {
    const phasetree::support::TemporaryDirectory folder;
    phasetree::support::write_text(folder / "a.glb", content);
    GltfParameters parameters;
    parameters.file = folder / "a.glb";
    MeshGroup group = parameters.made();
    REQUIRE(group.meshes.size() == 1);
    CHECK(group.not_shown.empty());
    return std::move(group.meshes[0]);
}

// A point of a triangle, as rays find it: u belongs to the second corner, v to the third.
inline TexturePoint place_on(const Mesh& mesh, std::size_t triangle, float u, float v) {
    const MeshPlace place{mesh, triangle, u, v};
    return TexturePoint(place.point(), {0, 0, 1}, place.coordinates());
}

}  // namespace phasetree::tracer::tests
