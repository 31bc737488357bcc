// The triangles of a glTF file, with their materials; on request also its clear solids, camera and lights.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gltf/clear_material.hpp"
#include "gltf/document.hpp"
#include "gltf/thin_material.hpp"
#include "phasetree/io/mesh.hpp"
#include "shading/material.hpp"
#include "shading/opacity.hpp"

namespace phasetree::tracer::gltf {

/// The triangles of one material, in glTF's space: y is up, the unit is the metre.
struct Part {
    std::string name{};  ///< of the material; unique among the parts
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

/// What happens to clear materials. Meshes have no interior, so triangles of clear materials are left out of the
/// parts. See ReadPanes about those without a volume.
enum class ReadClear {
    warn,      ///< report each clear material
    skip,      ///< leave them out without a report, as well as lights, because the scene has them elsewhere
    as_solids  ///< read them as ClearSolids
};

/// The triangles of one clear material of one placed mesh, in the same space as a Part.
struct ClearSolid {
    std::string name{};           ///< of its node, else of its mesh
    std::size_t placed_mesh = 0;  ///< the number of the placed mesh, in the order of the file; others may have the same
    std::size_t material = 0;     ///< in GltfFile::clear_materials
    std::optional<float> priority{};  ///< extras.phasetree_priority of the node, else of the material
    std::string matter{};  ///< extras.phasetree_matter of the node, else of the material; empty if there is none
    TriangleMesh mesh{};
};

struct NamedClearMaterial {
    std::string name{};  ///< unlike that of any other clear material
    ClearMaterial material{};
};

/// A perspective camera of the file, in its space.
struct Camera {
    glm::dvec3 position{0}, forward{0, 0, -1}, up{0, 1, 0};  ///< directions are normalised
    float vertical_fov = 0;                                  ///< in radians
    std::optional<float> aspect_ratio{};                     ///< width over height
};

/// A light of KHR_lights_punctual, in the space of the file.
struct PunctualLight {
    enum class Kind { directional, point, spot };
    Kind kind = Kind::point;
    glm::dvec3 position{0}, forward{0, 0, -1};  ///< the direction is normalised
    glm::vec3 color{1};
    float intensity = 1;                   ///< in candela; of a directional light, in lux
    float inner_cone = 0, outer_cone = 0;  ///< of a spot: half angles in radians
};

/// Limits, because a small file may place one mesh many times, or declare large images.
struct Limits {
    std::size_t triangles = 20'000'000;  ///< a mesh counts once per placement
    std::size_t primitives = 5'000'000;  ///< glTF's parts of meshes; counted in the same way
    std::size_t materials = 2'000;       ///< that triangles have
    std::size_t solids = 1'000;          ///< of clear materials
    std::size_t pixels = 256'000'000;    ///< of all images
    std::size_t moves = 200'000'000;     ///< of vertices by morph targets
};

/// With `none`, all triangles form one part, including clear ones, and neither materials nor images are examined. If
/// only some triangles of the part have vertex colours, the others are white.
enum class ReadMaterials { all, none };

struct GltfFile {
    std::vector<Part> parts;             ///< in the order of the materials, after those without a material
    std::vector<std::string> not_shown;  ///< sentences about content of the file that the parts lack
    bool has_panes = false;              ///< whether a part is, or is mixed with, thin_glass
    // With ReadClear::as_solids:
    std::vector<ClearSolid> solids{};  ///< in the order of the file
    std::vector<NamedClearMaterial> clear_materials{};
    std::optional<Camera> camera{};  ///< the first perspective camera
    std::vector<PunctualLight> lights{};
};

/// How to read a file.
struct ReadOptions {
    ReadMaterials materials = ReadMaterials::all;
    ReadClear clear = ReadClear::warn;
    ReadPanes panes = ReadPanes::as_thin_glass;
    Limits limits{};
};

/// `content` is the whole file, .glb or .gltf; `read_file` reads files that it names. Throws GltfError if it is not
/// such a file, has no triangles to show, or exceeds the limits. Exceptions of `read_file` are passed on.
GltfFile read_gltf(std::string_view content, const ReadOptions& options, const ReadFile& read_file = {});
inline GltfFile read_gltf(std::string_view content, ReadMaterials materials = ReadMaterials::all,
                          const Limits& limits = {}, const ReadFile& read_file = {}) {
    return read_gltf(content, {.materials = materials, .limits = limits}, read_file);
}

}  // namespace phasetree::tracer::gltf
