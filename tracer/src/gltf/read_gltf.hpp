// The triangles of a glTF file, with their materials.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gltf/document.hpp"
#include "phasetree/io/mesh.hpp"
#include "shading/material.hpp"
#include "shading/opacity.hpp"

namespace phasetree::tracer::gltf {

/// The triangles of one material, in glTF's space, of which y is up, in metres.
struct Part {
    std::string name{};  ///< of the material, unlike that of any other part
    Material material{};
    std::optional<Opacity> opacity{};  ///< none is opaque everywhere
    TriangleMesh mesh{};
    AtCorners<glm::vec3> normals{};         ///< of length 1, or 0 where the file has none; empty if it has none at all
    AtCorners<glm::vec2> texture{};         ///< (0, 0) is the lower left corner of an image
    AtCorners<glm::vec3> colors{};          ///< linear Rec.709
    AtCorners<glm::vec2> second_texture{};  ///< a second set of texture coordinates, if images use one
    AtCorners<float> alphas{};              ///< of the colours, only if the opacity follows them
    /// The file's tangents (scene/mesh_tangents.hpp), if the material has a map of normals and every vertex has one.
    AtCorners<glm::vec4> tangents{};
};

/// How much a file may have: a small one may place one mesh many times, or say that its images are large.
struct Limits {
    std::size_t triangles = 20'000'000;  ///< a mesh counts at each place where it is
    std::size_t primitives = 5'000'000;  ///< which are glTF's parts of meshes; they count in the same way
    std::size_t materials = 2'000;       ///< that triangles have
    std::size_t pixels = 256'000'000;    ///< of all images
    std::size_t moves = 200'000'000;     ///< of vertices by morph targets
};

/// With `none` all triangles are of one part, clear ones too, and neither materials nor images are examined. If only
/// some triangles of the part have colours of vertices, the others are white.
enum class ReadMaterials { all, none };

struct GltfFile {
    std::vector<Part> parts;             ///< in the order of the materials; what has none comes first
    std::vector<std::string> not_shown;  ///< sentences about what the file has and the parts have not
};

/// `content` is all of the file, .glb or .gltf; files that it names are read by `read_file`. Throws GltfError for what
/// is no such file, what has no triangles to be shown, and what is beyond the limits, and whatever `read_file` throws.
GltfFile read_gltf(std::string_view content, ReadMaterials materials = ReadMaterials::all, const Limits& limits = {},
                   const ReadFile& read_file = {});

}  // namespace phasetree::tracer::gltf
