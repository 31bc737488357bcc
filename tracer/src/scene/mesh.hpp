// Triangles with one opaque material, in addition to the objects. They may have holes.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "phasetree/io/mesh.hpp"
#include "scene/mesh_motion.hpp"
#include "shading/material.hpp"
#include "shading/opacity.hpp"

namespace phasetree::tracer {

struct Mesh {
    std::vector<glm::vec3> vertices{};
    std::vector<glm::uvec3> triangles{};
    AtCorners<glm::vec3> normals{};    // of length 1, or 0 where undefined; if present, shading is smooth
    AtCorners<glm::vec2> uv{};         // texture coordinates, for image textures
    AtCorners<glm::vec3> colors{};     // linear Rec.709, each channel in [0, 1]
    AtCorners<glm::vec2> second_uv{};  // for images that do not use `uv`
    AtCorners<float> alphas{};         // of `colors`, each in [0, 1]; only if the opacity depends on them
    AtCorners<glm::vec4> tangents{};   // mesh_tangents.hpp; only where the material has a map of normals
    std::optional<Opacity> opacity{};  // opaque everywhere if absent
    Material material{};
    std::optional<MeshMotion> motion{};  // while the shutter is open; absent if it stands still
    // The kind of the mesh, numbered from the second of a kind on: "floor", "obj 2". A part of a glTF file also has the
    // name of its material: "gltf wood".
    std::string name{};
};

// The meshes from one file, one per material.
struct MeshGroup {
    std::vector<Mesh> meshes;
    std::vector<std::string> not_shown{};  // sentences about contents of the file that the meshes lack
};

// Interpolates values at a triangle's corners by barycentric coordinates. As in Embree, u belongs to the second corner
// and v to the third.
template <class T>
T at_barycentric(const Mesh& mesh, const AtCorners<T>& values, std::size_t triangle, float u, float v) {
    const auto corner = [&](int i) { return values.at(mesh.triangles, triangle, i); };
    return (1 - u - v) * corner(0) + u * corner(1) + v * corner(2);
}

}  // namespace phasetree::tracer
