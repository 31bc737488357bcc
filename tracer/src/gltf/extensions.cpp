#include "gltf/extensions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "gltf/draco.hpp"
#include "gltf/meshopt.hpp"

namespace phasetree::tracer::gltf {

namespace {

enum class Use {
    read,      // at least nearly; what is lost is reported where the extension is used
    harmless,  // does not affect the picture
    accepted,  // part of the picture is missing, but a file that requires it is read
    refused    // part of the picture is missing, and a file that requires it is rejected
};

struct Extension {
    std::string_view name;
    Use use;
    std::string_view missing = "";                  // what is missing from the picture if it is not read
    std::string_view remedy = "export without it";  // what to do about a file that requires it
};

constexpr std::string_view as_png = "export the images as PNG or JPEG";

constexpr std::array known_extensions{
    Extension{"EXT_mesh_gpu_instancing", Use::read},
    Extension{"EXT_meshopt_compression", Use::read},
    Extension{"KHR_draco_mesh_compression", Use::read},
    Extension{"KHR_materials_anisotropy", Use::read, "anisotropic reflections"},
    Extension{"KHR_materials_clearcoat", Use::read, "clear coats"},
    Extension{"KHR_materials_diffuse_transmission", Use::read, "transmission through thin surfaces"},
    Extension{"KHR_materials_emissive_strength", Use::read},
    Extension{"KHR_materials_ior", Use::read},
    Extension{"KHR_materials_iridescence", Use::read, "thin films"},
    Extension{"KHR_materials_sheen", Use::read, "sheen of cloth"},
    Extension{"KHR_materials_specular", Use::read, "the strength and colour of specular reflection"},
    Extension{"KHR_materials_transmission", Use::read},
    Extension{"KHR_mesh_quantization", Use::read},
    Extension{"KHR_node_visibility", Use::read},
    Extension{"KHR_texture_transform", Use::read},

    Extension{"AGI_articulations", Use::harmless},
    Extension{"AGI_stk_metadata", Use::harmless},
    Extension{"CESIUM_primitive_outline", Use::harmless},
    Extension{"EXT_instance_features", Use::harmless},
    Extension{"EXT_mesh_features", Use::harmless},
    Extension{"EXT_mesh_manifold", Use::harmless},
    Extension{"EXT_structural_metadata", Use::harmless},
    Extension{"GODOT_single_root", Use::harmless},
    Extension{"KHR_animation_pointer", Use::harmless},  // animations are reported separately
    Extension{"KHR_audio_emitter", Use::harmless},
    Extension{"KHR_implicit_shapes", Use::harmless},
    Extension{"KHR_interactivity", Use::harmless},
    Extension{"KHR_node_hoverability", Use::harmless},
    Extension{"KHR_node_selectability", Use::harmless},
    Extension{"KHR_physics_rigid_bodies", Use::harmless},
    Extension{"KHR_xmp", Use::harmless},
    Extension{"KHR_xmp_json_ld", Use::harmless},
    Extension{"MSFT_lod", Use::harmless},  // the nodes of the scene have the finest level
    Extension{"VRM", Use::harmless},
    Extension{"VRMC_node_constraint", Use::harmless},
    Extension{"VRMC_springBone", Use::harmless},
    Extension{"VRMC_vrm", Use::harmless},

    Extension{"CESIUM_RTC", Use::accepted, "the offset from the centre of the Earth"},
    Extension{"EXT_lights_ies", Use::accepted, "lamps; add them to \"lights\" as \"ies\""},
    Extension{"EXT_lights_image_based", Use::accepted, "the environment; add it to \"lights\" as \"image\""},
    Extension{"KHR_lights_punctual", Use::accepted, "lights; add them to \"lights\""},
    Extension{"KHR_materials_variants", Use::accepted, "variants; the default materials are shown"},

    Extension{"ADOBE_materials_clearcoat_specular", Use::refused, "the index of clear coats"},
    Extension{"ADOBE_materials_clearcoat_tint", Use::refused, "the colour of clear coats"},
    Extension{"ADOBE_materials_thin_transparency", Use::refused, "transparency"},
    Extension{"EXT_texture_avif", Use::refused, "images in AVIF", as_png},
    Extension{"EXT_texture_webp", Use::refused, "images in WebP", as_png},
    Extension{"KHR_gaussian_splatting", Use::refused, "Gaussian splats", "export triangles"},
    Extension{"KHR_materials_diffuse_roughness", Use::refused, "the roughness of diffuse reflection"},
    Extension{"KHR_materials_dispersion", Use::refused, "dispersion"},
    Extension{"KHR_materials_pbrSpecularGlossiness", Use::refused, "colours of the specular-glossiness workflow",
              "export metallic-roughness materials"},
    Extension{"KHR_materials_subsurface", Use::refused, "subsurface scattering"},
    Extension{"KHR_materials_unlit", Use::refused, "unlit colours; surfaces are lit like others"},
    Extension{"KHR_materials_volume", Use::refused, "absorption inside clear materials"},
    Extension{"KHR_materials_volume_scatter", Use::refused, "scattering inside materials"},
    Extension{"KHR_meshopt_compression", Use::refused, "compressed meshes",
              "compress with EXT_meshopt_compression (gltfpack -c), or not at all"},
    Extension{"KHR_techniques_webgl", Use::refused, "shaders"},
    Extension{"KHR_texture_basisu", Use::refused, "images in KTX2", as_png},
    Extension{"KHR_texture_procedurals", Use::refused, "procedural textures", "bake the textures to images"},
    Extension{"MOZ_lightmap", Use::refused, "light maps"},
    Extension{"MOZ_texture_rgbe", Use::refused, "images in RGBE", as_png},
    Extension{"MSFT_texture_dds", Use::refused, "images in DDS", as_png},
    Extension{"VRMC_materials_mtoon", Use::refused, "toon shading"},
};

// Read if clear materials become phases.
constexpr std::array<std::string_view, 2> extensions_of_phases{"KHR_materials_dispersion", "KHR_materials_volume"};

const Extension* find(std::string_view name) {
    const auto* const found = std::ranges::find(known_extensions, name, &Extension::name);
    return found == known_extensions.end() ? nullptr : found;
}

// Messages quote only texts that look like the name of an extension.
bool is_name(std::string_view text) {
    constexpr std::size_t longest = 60;
    return !text.empty() && text.size() <= longest &&
           std::ranges::all_of(text, [](unsigned char c) { return (c < 0x80 && std::isalnum(c) != 0) || c == '_'; });
}

bool is_of_materials(std::string_view name) {
    const auto has = [&](std::string_view part) { return name.find(part) != std::string_view::npos; };
    return has("_materials_") || has("_texture_") || has("lightmap");
}

[[noreturn]] void refuse_without(std::string_view name, std::string_view library, std::string_view package,
                                 std::string_view compression) {
    throw GltfError(
        fmt::format("it requires {}, which this build cannot read without {}; export it without {} compression, or "
                    "install {} and rebuild",
                    name, library, compression, package));
}

}  // namespace

std::string loss_without(std::string_view name) {
    const Extension* const extension = find(name);
    if (!extension) return is_name(name) ? "has an unknown extension" : "";
    return extension->missing.empty() ? "" : fmt::format("loses {}", extension->missing);
}

void check_required_extensions(const Document& document, bool has_materials, bool has_phases) {
    for (const std::string& name : document.root().texts("extensionsRequired")) {
        if (name == "KHR_draco_mesh_compression" && !has_draco())
            refuse_without(name, "Draco's library", "libdraco-dev", "Draco");
        if (name == "EXT_meshopt_compression" && !has_meshopt())
            refuse_without(name, "meshoptimizer's library", "libmeshoptimizer-dev", "meshopt");
        const Extension* const extension = find(name);
        if (extension && extension->use != Use::refused) continue;
        if (has_phases && std::ranges::find(extensions_of_phases, name) != extensions_of_phases.end()) continue;
        const bool is_material = is_of_materials(name);
        if (is_material && !has_materials) continue;
        throw GltfError(fmt::format("it requires {}, which phasetree cannot read; {}{}",
                                    is_name(name) ? name : "a glTF extension",
                                    extension ? extension->remedy : "export without it",
                                    is_material ? ", or give the mesh a \"material\" here" : ""));
    }
}

std::string sentence_about_unread(const std::set<std::string>& used, bool has_materials) {
    constexpr std::size_t most = 20;
    std::string list;
    std::size_t listed = 0, others = 0;
    for (const std::string& name : used) {
        const Extension* const extension = find(name);
        if (extension && (extension->use == Use::read || extension->use == Use::harmless)) continue;
        if (!has_materials && is_of_materials(name)) continue;
        if (!is_name(name) || listed == most) {
            ++others;
            continue;
        }
        const std::string effect = extension ? fmt::format("missing: {}", extension->missing) : "unknown";
        list += fmt::format("{}{} ({})", listed++ == 0 ? "" : ", ", name, effect);
    }
    if (others > 0)
        list += fmt::format("{}{} {}", listed == 0 ? "" : " and ", others, listed == 0 ? "unknown" : "more");
    return list.empty() ? list : "uses unsupported extensions: " + list;
}

}  // namespace phasetree::tracer::gltf
