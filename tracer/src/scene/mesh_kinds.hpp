// The kinds of meshes in scene files: one list, which drives the reader, the reference and the schema. made() returns
// the mesh, or a group of meshes from one file, and placement() where it is. If that changes while the shutter is open,
// the mesh moves.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "parameters/world_limits.hpp"
#include "phasetree/io/kind.hpp"
#include "phasetree/model/concepts.hpp"
#include "scene/mesh.hpp"
#include "scene/parameter_types.hpp"
#include "scene/placement.hpp"

namespace phasetree::tracer {

inline constexpr Parameter mesh_material_parameter{"material", "", "Material of the mesh."};

// Parameters for holes in meshes of a single material.
struct OpacityParameters {
    std::optional<Number> opacity_number{};
    std::optional<float> opacity_cutoff{};

    template <class P, class V>
    static void opacity_parameters(V&& v) {
        v(&P::opacity_number, Parameter{"opacity", "",
                                        "Opacity: 0 is a hole, 1 is opaque. For values in between, the rest of the "
                                        "light passes straight through, as through a fine net.",
                                        limits::fraction, true});
        v(&P::opacity_cutoff,
          Parameter{"opacity_cutoff", "",
                    "With an opacity: values below this are holes and all others opaque, so edges are sharp.",
                    limits::fraction, true});
    }
    /// Throws ParameterError if only a cutoff is given.
    std::optional<Opacity> opacity() const;
};

// Parameters of meshes from files that contain a single mesh.
struct MeshFileParameters : OpacityParameters {
    Material material{};
    std::filesystem::path file{};
    float scale = 1.0f;
    float rotate_z_degrees = 0.0f;
    bool y_up = false;
    glm::vec3 translate{0.0f};
    bool smooth = true;

    template <class P, class V>
    static void file_parameters(V&& v) {
        v(&P::material, mesh_material_parameter);
        v(&P::file, Parameter{"file", "", "The file."});
        placement_parameters<P>(v);
        opacity_parameters<P>(v);
        v(&P::y_up, y_up_parameter);
        v(&P::smooth, Parameter{"smooth", "",
                                "Whether to shade the mesh smoothly. Normals come from the file; if it has none, they "
                                "are the mean normals of the faces around each vertex.",
                                limits::any, true});
    }
    // `ending` is the required extension, such as ".obj". Both throw ParameterError. The first checks what it can
    // without reading the file.
    void check_without_file(std::string_view ending) const;
    Mesh read(std::string_view ending) const;
    Placement placement() const { return Placement(scale, rotate_z_degrees, translate, y_up); }
};

struct ObjParameters : MeshFileParameters {
    static constexpr KindInfo info{
        "obj",
        "The faces of a Wavefront OBJ file of at most 1 GiB, with normals, texture coordinates and vertex colours; its "
        "materials are ignored. The mesh is scaled first, then rotated, then translated."};

    template <class V>
    static void parameters(V&& v) {
        file_parameters<ObjParameters>(v);
    }
    void check() const { check_without_file(".obj"); }
    Mesh made() const { return read(".obj"); }
};

struct PlyParameters : MeshFileParameters {
    static constexpr KindInfo info{"ply",
                                   "The faces of a PLY file of at most 1 GiB, such as a scan, with normals, texture "
                                   "coordinates and vertex colours. Placed as for obj."};

    template <class V>
    static void parameters(V&& v) {
        file_parameters<PlyParameters>(v);
    }
    void check() const { check_without_file(".ply"); }
    Mesh made() const { return read(".ply"); }
};

struct StlParameters : MeshFileParameters {
    static constexpr KindInfo info{"stl", "The triangles of an STL file of at most 1 GiB. Placed as for obj."};

    template <class V>
    static void parameters(V&& v) {
        file_parameters<StlParameters>(v);
    }
    void check() const { check_without_file(".stl"); }
    Mesh made() const { return read(".stl"); }
};

struct GltfParameters {
    static constexpr KindInfo info{
        "gltf",
        "The triangles of a glTF 2.0 file (.glb, or .gltf with files in its folder and its subfolders), with "
        "materials, images, normal maps, opacity and vertex colours. The y axis of glTF becomes z. Skins are deformed "
        "by their joints, and morph targets are applied with the weights of their node or mesh; animations are "
        "ignored. The alpha of images and vertices is used in the modes MASK and BLEND. Images may use two sets of "
        "texture coordinates per material, with any transforms. Materials with KHR_materials_transmission become "
        "\"thin_glass\" if they have no volume; those with a KHR_materials_volume are ignored, because meshes have no "
        "interior, and `phasetree import` makes them phases. Other supported extensions: KHR_texture_transform, "
        "KHR_mesh_quantization, KHR_node_visibility, EXT_mesh_gpu_instancing, KHR_materials_ior and "
        "KHR_materials_emissive_strength. KHR_draco_mesh_compression and EXT_meshopt_compression are supported if "
        "phasetree was built with their libraries. A file that requires another extension is rejected if the picture "
        "would be affected; otherwise a warning lists what is missing. Limits: 20 million triangles, counted once per "
        "instance; 2,000 materials; images in PNG or JPEG of at most 4096 × 4096 pixels each and 256 million in total; "
        "1 GiB per file."};

    std::optional<Material> material{};
    std::filesystem::path file{};
    float scale = 1.0f;
    float rotate_z_degrees = 0.0f;
    glm::vec3 translate{0.0f};
    bool imported = false;
    bool panes = false;

    template <class V>
    static void parameters(V&& v) {
        using P = GltfParameters;
        v(&P::material,
          Parameter{
              "material", "",
              "Material for the whole mesh, including clear parts and holes, instead of the materials in the file.",
              limits::any, true});
        v(&P::file, Parameter{"file", "", "The file."});
        placement_parameters<P>(v);
        v(&P::imported,
          Parameter{"imported", "",
                    "Set by `phasetree import`: this scene has the file's clear materials as phases and its lights in "
                    "\"lights\", so no warning reports that the mesh ignores them.",
                    limits::any, true});
        v(&P::panes, Parameter{"panes", "",
                               "With \"imported\": whether clear materials without a volume are not phases, but "
                               "\"thin_glass\" in this mesh.",
                               limits::any, true});
    }
    /// Checks the parameters without reading the file. Throws ParameterError.
    void check() const;
    MeshGroup made() const;
    Placement placement() const { return Placement(scale, rotate_z_degrees, translate, true); }
};

// A square on the plane z = height.
struct FloorParameters : OpacityParameters {
    static constexpr KindInfo info{"floor", "A horizontal square about the z axis."};

    Material material{};
    float height = 0.0f;
    float size = 1000.0f;

    template <class V>
    static void parameters(V&& v) {
        using P = FloorParameters;
        v(&P::material, mesh_material_parameter);
        v(&P::height, Parameter{"height", "m", "Height of the floor: its z coordinate.", coordinate, true});
        v(&P::size, Parameter{"size", "m", "Length of the edges.", extent, true});
        opacity_parameters<P>(v);
    }
    Mesh made() const;
    Placement placement() const { return Placement(1, 0, {0, 0, height}, false); }
};

// A photographer's sweep: a floor at z = height that curves smoothly up into a wall at y = distance.
struct BackdropParameters : OpacityParameters {
    static constexpr KindInfo info{"backdrop",
                                   "A photographer's sweep: a floor that curves smoothly up into a back wall."};

    Material material{};
    float height = 0.0f;
    float distance = 5.0f;
    float radius = 2.0f;
    float width = 100.0f;
    float front = 50.0f;
    float wall = 50.0f;

    template <class V>
    static void parameters(V&& v) {
        using P = BackdropParameters;
        v(&P::material, mesh_material_parameter);
        v(&P::height, Parameter{"height", "m", "z of the floor.", coordinate, true});
        v(&P::distance, Parameter{"distance", "m", "y of the wall.", extent, true});
        v(&P::radius, Parameter{"radius", "m", "Radius of the curve between floor and wall.", extent, true});
        v(&P::width, Parameter{"width", "m", "Length along x.", extent, true});
        v(&P::front, Parameter{"front", "m", "The floor begins at y = −front.", extent, true});
        v(&P::wall,
          Parameter{"wall", "m", "Height of the straight part of the wall, which begins `radius` above the floor.",
                    extent, true});
        opacity_parameters<P>(v);
    }
    Mesh made() const;
    Placement placement() const { return Placement(1, 0, {0, 0, height}, false); }
};

using MeshKinds =
    TypeList<ObjParameters, PlyParameters, StlParameters, GltfParameters, FloorParameters, BackdropParameters>;

}  // namespace phasetree::tracer
