// Each kind of thing in a scene file: the members that it requires, and how it is read. The result of reading is
// converted to numbers, so tests can check whether a key changes it without knowing its type.
#pragma once

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "film/film.hpp"
#include "lights/light_kinds.hpp"
#include "phasetree_support/temporary_directory.hpp"
#include "scene/camera_kinds.hpp"
#include "scene/image_parameters.hpp"
#include "scene/material_kinds.hpp"
#include "scene/mesh_kinds.hpp"
#include "scene/read_parts.hpp"
#include "scene/read_transform.hpp"
#include "tracer/support/written_glb.hpp"

namespace phasetree::tests {

/// A folder with an image and a mesh, for kinds that need a file.
inline const support::TemporaryDirectory& folder() {
    static const support::TemporaryDirectory made;
    static const bool is_filled = [] {
        std::string image = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n";
        for (int i = 0; i < 32; ++i) image += std::string(1, static_cast<char>(0x20 + 2 * i)) + "\x40\x60\x80";
        support::write_text(made / "sky.hdr", image);
        support::write_text(made / "mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        support::write_text(made / "mesh.ply",
                            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
                            "float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 "
                            "0\n0 1 0\n3 0 1 2\n");
        support::write_text(made / "mesh.stl",
                            "solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\nendsolid\n");
        support::write_text(made / "layer.pgm", std::string("P5 3 2 255\n") + "\x50\xa0\x30\x90\x60\xff");
        GlbBytes bytes;
        const std::string view = bytes.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0});
        support::write_text(made / "mesh.glb",
                            glb(R"("extensionsUsed": ["KHR_lights_punctual"], "scenes": [{"nodes": [0]}],
                                "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "accessors": [{"bufferView": 0, "componentType": 5126,
                                "count": 3, "type": "VEC3"}], "bufferViews": [)" +
                                    view + "]",
                                bytes.bytes()));
        support::write_text(
            made / "pane.glb",
            glb(R"("extensionsUsed": ["KHR_materials_transmission"], "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}, {"attributes": {"POSITION": 0}, "material": 0}]}],
                "materials": [{"extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}}}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}], "bufferViews": [)" +
                    view + "]",
                bytes.bytes()));
        support::write_text(made / "lamp.ies", "TILT=NONE\n1 1 1 3 2 1 2 0 0 0\n1 1 0\n0 90 180\n0 90\n5 2 1\n3 2 1\n");
        return true;
    }();
    REQUIRE(is_filled);
    return made;
}

/// A kind of thing: where the schema describes it, the members that it requires, and how it is read. `text` is an
/// object of its parameters; the result of reading is converted to numbers that depend on them.
struct Case {
    std::string chapter, name, needed;
    std::string before, after;  ///< around the object, to make of it what the reader reads
    void (*read)(const Document&, std::vector<float>& told);
    /// Members that replace `needed` where a key is incompatible with those.
    std::map<std::string, std::string> instead = {};

    Document document(const std::string& members) const {
        return Document::from_text(before + "{" + members + "}" + after, (folder() / "scene.json").string());
    }
    std::string needed_with(const std::string& key) const {
        const auto found = instead.find(key);
        return found == instead.end() ? needed : found->second;
    }
    /// `members` and the other required ones; the member with this key comes last.
    Document with(const std::string& key, const std::string& value) const {
        std::string members;
        const Document all = Document::from_text("{" + needed_with(key) + "}");
        for (const Value member : all.root()) {
            if (member.key() == key) continue;
            const std::size_t end = member.offset();
            members += all.text().substr(member.key_offset(), end - member.key_offset());
            members += text_of(all, member) + ", ";
        }
        return document(members + "\"" + key + "\": " + value);
    }
    std::vector<float> told(const Document& document) const {
        std::vector<float> numbers;
        read(document, numbers);
        return numbers;
    }

    static std::string text_of(const Document& document, Value value) {
        if (value.is_string()) return "\"" + std::string(value.string()) + "\"";
        if (!value.is_array() && !value.is_object()) return std::string(value.written());
        std::string text;
        for (const Value item : value) {
            text += text.empty() ? "" : ", ";
            if (value.is_object()) text += "\"" + std::string(item.key()) + "\": ";
            text += text_of(document, item);
        }
        return value.is_array() ? "[" + text + "]" : "{" + text + "}";
    }
};

inline void tell(std::vector<float>& told, const glm::vec3& v) {
    told.insert(told.end(), {v.x, v.y, v.z});
}

inline void tell(std::vector<float>& told, const tracer::Texture& texture) {
    for (int i = 0; i < 20; ++i) {
        const float t = 0.173f * static_cast<float>(i);
        const glm::vec3 p(t, 0.31f - 2.1f * t, 0.7f * t * t);
        const tracer::MeshCoordinates coordinates{.uv = {t, 0.3f * t}, .color = {0.05f * t, 0.5f, 0.1f}};
        tracer::TexturePoint place{p, {0.36f, 0.48f, 0.8f}, coordinates};
        place.copy = static_cast<std::uint32_t>(i);
        tell(told, color_at(texture, place));
    }
}

inline void tell(std::vector<float>& told, const tracer::Number& number) {
    for (const float t : {0.0f, 0.4f, 1.7f}) {
        const glm::vec3 p(t, 0.5f * t, -t);
        told.push_back(number_at(number, {p, {0, 0, 1}, tracer::MeshCoordinates{.uv = {t, 0.3f * t}}}));
    }
}

inline void tell(std::vector<float>& told, const tracer::Material& material) {
    told.push_back(static_cast<float>(material.index()));
    std::visit(
        [&](const auto& m) {
            if constexpr (requires { m.ior; }) told.push_back(m.ior);
            if constexpr (requires { m.dispersion; }) told.push_back(m.dispersion ? m.dispersion->index(450.0f) : 0.0f);
            if constexpr (requires { m.interior; }) {
                // Several estimates, because a single one could be zero for every density.
                for (std::uint32_t i = 0; i < 8; ++i) {
                    tracer::Sampler sampler(i, 0, 0, 0);
                    const tracer::Way way{glm::vec3(0, 0, -0.9f), glm::vec3(0, 0, 1), 1};
                    tell(told, transmittance(m.interior, way, sampler));
                    const tracer::Flight flight = fly(m.interior, way, glm::vec3(1), sampler);
                    tell(told, flight.weight);
                    tell(told, flight.emitted);
                }
                if (const auto* phase = phase_function(m.interior)) {
                    told.push_back(phase->mean_cosine());
                    told.push_back(phase->evaluate(0.3f));
                }
            }
            if constexpr (requires { m.roughness; }) tell(told, m.roughness);
            if constexpr (requires { m.film; }) {
                tell(told, m.film ? m.film->thickness : tracer::Number(-1.0f));
                told.push_back(m.film ? m.film->ior : 0);
            }
            if constexpr (requires { m.bump; }) {
                told.push_back(m.bump ? m.bump->height : 0);
                if (m.bump) tell(told, m.bump->texture);
            }
            if constexpr (requires { m.perturbation; }) {
                const auto* bump = m.perturbation ? std::get_if<tracer::Bump>(&*m.perturbation) : nullptr;
                told.push_back(bump ? bump->height : 0);
                if (bump) tell(told, bump->texture);
                if (const auto* map = normal_map_of(material)) {
                    told.push_back(map->repeat.x), told.push_back(map->repeat.y), told.push_back(map->strength);
                    told.push_back(map->green_down), tell(told, map->image->mean());
                }
            }
            if constexpr (requires { m.grain; }) {
                tell(told, m.grain ? m.grain->axis : glm::vec3(0));
                tell(told, m.grain && m.grain->through ? *m.grain->through : glm::vec3(-1));
                told.push_back(m.grain ? m.grain->aspect : 1);
            }
            if constexpr (requires { m.amount; }) tell(told, m.amount);
            if constexpr (requires { m.crossings; }) told.push_back(m.crossings);
            if constexpr (requires { m.transmission; }) tell(told, m.transmission);
            if constexpr (requires { m.of; }) {
                tell(told, m.of->first);
                tell(told, m.of->second);
            }
            if constexpr (requires { m.color; }) tell(told, m.color);
            if constexpr (requires { m.metalness; }) {
                m.for_each_parameter([&](const auto& parameter) { tell(told, parameter); });
                told.push_back(m.coat_ior);
                if (m.emission) tell(told, tracer::Material(*m.emission));
            }
            if constexpr (requires { m.light; }) {
                tell(told, m.light);
                told.push_back(m.radiance);
                tell(told, m.spectrum ? m.spectrum->colour() : glm::vec3(0));
                for (const char letter : m.group) told.push_back(static_cast<float>(letter));
            }
            if constexpr (requires { m.eta; }) {
                tell(told, m.eta);
                tell(told, m.k);
                if (m.reflectance) tell(told, *m.reflectance);
            }
        },
        material);
}

inline void tell_material(const Document& document, std::vector<float>& told) {
    tell(told, tracer::read_material(document, document.root()));
}

// A scene in which a field can be read.
inline void tell_material_of_scene(const Document& document, std::vector<float>& told) {
    tell(told, tracer::read_material(document, *document.root().find("material")));
}

inline void tell_lights(const Document& document, std::vector<float>& told) {
    const tracer::Lights lights = tracer::read_lights(document, document.root());
    CHECK(!lights.empty());
    for (const bool is_camera : {false, true}) {
        for (int i = 0; i < 200; ++i) {
            const float z = 1 - 2 * (static_cast<float>(i) + 0.5f) / 200, turn = 2.399963f * static_cast<float>(i);
            const float r = std::sqrt(1 - z * z);
            const glm::vec3 direction(r * std::cos(turn), r * std::sin(turn), z);
            const auto seen = lights.seen({0, 0, 0}, direction, INFINITY, is_camera);
            if (seen) tell(told, seen->radiance);
            told.push_back(lights.pdf(glm::vec3{0, 0, 0}, direction));
        }
    }
    for (int i = 0; i < 16; ++i) {
        const auto sample = lights.sample(glm::vec3{0, 0, 0}, {(static_cast<float>(i) + 0.5f) / 16, 0.37f});
        if (!sample) continue;
        tell(told, sample->wi);
        tell(told, sample->radiance);
        told.push_back(sample->pdf);
    }
    told.push_back(static_cast<float>(lights.groups().size()));
}

inline void tell_meshes(const Document& document, std::vector<float>& told) {
    const auto group = tracer::read_meshes(document, document.root());
    told.push_back(static_cast<float>(group.not_shown.size()));
    for (const tracer::Mesh& mesh : group.meshes) {
        for (const glm::vec3& v : mesh.vertices) tell(told, v);
        for (const glm::vec3& v : mesh.normals.values) tell(told, v);
        for (const glm::uvec3& t : mesh.triangles) tell(told, glm::vec3(t));
        tell(told, mesh.material);
        tell(told, mesh.opacity ? mesh.opacity->number : tracer::Number(-1.0f));
        told.push_back(mesh.opacity ? mesh.opacity->cutoff.value_or(-1) : -1);
    }
}

inline void tell_camera(const Document& document, std::vector<float>& told) {
    tracer::FilmSettings settings;
    const tracer::AnyCameraParameters parameters = tracer::read_camera(document, document.root(), settings);
    settings.width = 7;
    settings.height = 5;
    const tracer::Camera camera(parameters, settings.resolution());
    const tracer::Film film(settings, settings.whole());
    for (const glm::vec2 u : {glm::vec2(0.1f, 0.6f), glm::vec2(0.5f, 0.5f), glm::vec2(0.9f, 0.3f)}) {
        const tracer::CameraRay ray = camera.generate(film.sample_position(2, 1, u), u);
        tell(told, ray.origin);
        tell(told, ray.direction);
    }
}

inline void tell_transform(const Document& document, std::vector<float>& told) {
    const tracer::Transform t = tracer::read_transform(document, document.root());
    for (int i = 0; i < 3; ++i) tell(told, glm::vec3(t.matrix[i]));
    tell(told, glm::vec3(t.by));
}

inline void tell_settings(const Document& document, std::vector<float>& told) {
    tracer::FilmSettings film;
    const tracer::RenderSettings s = tracer::read_settings(document, document.root(), film);
    for (const int i : {film.width, film.height, s.samples, s.max_depth}) told.push_back(static_cast<float>(i));
    told.push_back(static_cast<float>(s.seed));
    told.insert(told.end(), {s.exposure_ev, s.caustics ? 1.0f : 0.0f, s.photons, s.photon_radius});
    told.insert(told.end(), {s.noise, s.guiding ? 1.0f : 0.0f, s.spectral ? 1.0f : 0.0f});
    told.insert(told.end(), {s.shutter.x, s.shutter.y});
    told.push_back(static_cast<float>(s.view ? s.view->size() : 0));
}

inline std::vector<Case> cases_of_materials() {
    std::vector<Case> all;
    const auto material = [&](const std::string& name, const std::string& needed,
                              std::map<std::string, std::string> instead = {}) {
        all.push_back({"Materials", name, needed, "{\"" + name + "\": ", "}", tell_material, std::move(instead)});
    };
    const std::string free_path = R"("ior": 1.5, "albedo": [0.9, 0.9, 0.8], "mean_free_path": [1, 2, 3])";
    const std::string measured = R"("ior": 1.5, "medium": "cream", "scale": 1)";
    const std::string dense =
        R"("ior": 1.5, "absorption": [1, 2, 3], "density": {"sphere": {"radius": 1}}, "density_depth": 0.5)";
    const std::string by_voxels = R"("ior": 1.5, "absorption": [1, 2, 3])";
    // A bump needs a height, and a height a bump.
    const auto bumped = [](const std::string& needed, std::map<std::string, std::string> instead) {
        for (const char* const key : {"bump", "bump_height"})
            instead[key] = needed + (needed.empty() ? "" : ", ") + R"("bump": {"marble": {}}, "bump_height": 0.1)";
        return instead;
    };
    material(
        "clear", R"("ior": 1.5)",
        bumped(
            R"("ior": 1.5)",
            {{"color_distance", R"("ior": 1.5, "color": [0.2, 0.5, 0.8])"},
             {"albedo", free_path},
             {"mean_free_path", free_path},
             {"medium", measured},
             {"scale", measured},
             {"anisotropy", R"("ior": 1.5, "scattering": [1, 1, 1])"},
             {"phase_function", R"("ior": 1.5, "scattering": [1, 1, 1])"},
             {"emission", R"("ior": 1.5, "absorption": [1, 1, 1])"},
             {"emission_spectrum", R"("ior": 1.5, "absorption": [1, 1, 1], "emission": [1, 1, 1])"},
             {"density", dense},
             {"density_depth", dense},
             {"density_grid", by_voxels},
             {"temperature_grid", dense + R"(, "emission": [1, 1, 1])"},
             {"emission_temperature",
              dense +
                  R"(, "emission": [1, 1, 1], "temperature_grid": {"file": "layer.pgm", "spacing": [1, 1, 1], "factor": 2000})"},
             {"film_ior", R"("ior": 1.5, "film_thickness": 300)"},
             {"glass", R"("glass": "bk7")"}}));
    material("diffuse", R"("color": [0.1, 0.2, 0.3])", bumped(R"("color": [0.1, 0.2, 0.3])", {}));
    const std::string index = R"("eta": [1, 2, 3], "k": [2, 3, 4])";
    material("conductor", R"("metal": "gold")",
             bumped(R"("metal": "gold")",
                    {{"eta", index},
                     {"k", index},
                     {"reflectance", R"("reflectance": [0.1, 0.2, 0.3])"},
                     {"film_ior", R"("metal": "gold", "film_thickness": 300)"},
                     {"grain_along", R"("metal": "gold", "roughness": 0.3)"},
                     {"grain_around", R"("metal": "gold", "roughness": 0.3)"},
                     {"grain_through", R"("metal": "gold", "roughness": 0.3, "grain_around": [0, 0, 1])"},
                     {"grain_aspect", R"("metal": "gold", "roughness": 0.3, "grain_along": [1, 0, 0])"}}));
    material(
        "coated", R"("color": [0.1, 0.2, 0.3])",
        bumped(R"("color": [0.1, 0.2, 0.3])", {{"film_ior", R"("color": [0.1, 0.2, 0.3], "film_thickness": 300)"}}));
    material("principled", "",
             bumped("", {{"film_ior", R"("film_thickness": 300)"},
                         {"film_weight", R"("film_thickness": 300)"},
                         {"grain_through", R"("grain_around": [0, 0, 1])"},
                         {"grain_aspect", R"("grain_along": [1, 0, 0])"},
                         {"emission_color", R"("emission_radiance": 1)"},
                         {"emission_spectrum", R"("emission_radiance": 1)"},
                         {"group", R"("emission_radiance": 1)"}}));
    material("glowing", "");
    const std::string tinted = R"("color": [0.1, 0.2, 0.3], "thickness": 0.5)";
    material("thin_glass", "", bumped("", {{"thickness", tinted}, {"color_distance", tinted}}));
    const std::string sheet = R"("color": [0.1, 0.2, 0.3], "transmission": [0.3, 0.2, 0.1])";
    material("thin_diffuse", sheet, bumped(sheet, {}));
    material("two_sided",
             R"("front": {"diffuse": {"color": [0.1, 0.2, 0.3]}}, "back": {"diffuse": {"color": [1, 1, 1]}})");
    material("mix", R"("first": {"diffuse": {"color": [0.1, 0.2, 0.3]}}, "second": {"diffuse": {"color": [1, 1, 1]}})");
    return all;
}

inline void add_cases_of_phase_functions(std::vector<Case>& all) {
    for (const auto& [name, needed] : {std::pair("henyey_greenstein", ""),
                                       {"rayleigh", ""},
                                       {"draine", ""},
                                       {"droplets", ""},
                                       {"mix", R"("first": {"rayleigh": {}}, "second": {"droplets": {}})"}})
        all.push_back(
            {"Phase functions", name, needed,
             fmt::format(R"({{"clear": {{"ior": 1, "scattering": [1, 1, 1], "phase_function": {{"{}": )", name), "}}}",
             tell_material});
}

inline std::vector<Case> cases() {
    std::vector<Case> all = cases_of_materials();
    add_cases_of_phase_functions(all);
    for (const char* const name : {"wood", "speckle", "marble", "checker"})
        all.push_back(
            {"Textures", name, "", fmt::format("{{\"diffuse\": {{\"color\": {{\"{}\": ", name), "}}}", tell_material});
    const std::string scene = R"({"phases": {"sand": {}}, "material": {")";
    const auto texture = [&](const std::string& name, const std::string& needed) {
        all.push_back({"Textures", name, needed, scene + R"(diffuse": {"color": {")" + name + "\": ", "}}}}",
                       tell_material_of_scene});
    };
    texture("field", R"("of": {"sphere": {"radius": 1}}, "ramp": [[0, [0, 0, 0]], [1, [1, 1, 1]]])");
    texture("per_copy", R"("ramp": [[0, [0, 0, 0]], [1, [1, 1, 1]]])");
    texture("measured", R"("reflectance": [[450, 0.1], [600, 0.8]])");
    texture("image", R"("file": "sky.hdr")");
    texture("mesh_image", R"("file": "sky.hdr")");
    texture("vertex_color", "");
    all.push_back({"Number textures", "field", R"("of": {"sphere": {"radius": 1}}, "ramp": [[-2, 0], [2, 0.5]])",
                   scene + R"(coated": {"color": [1, 1, 1], "roughness": {"field": )", "}}}}", tell_material_of_scene});
    all.push_back({"Number textures", "mesh_image", R"("file": "sky.hdr")",
                   scene + R"(coated": {"color": [1, 1, 1], "roughness": {"mesh_image": )", "}}}}",
                   tell_material_of_scene});
    all.push_back({"Number textures", "per_copy", R"("ramp": [[0, 0], [1, 0.5]])",
                   scene + R"(coated": {"color": [1, 1, 1], "roughness": {"per_copy": )", "}}}}",
                   tell_material_of_scene});
    all.push_back({"Normal maps", "normal_map", R"("file": "sky.hdr")",
                   scene + R"(diffuse": {"color": [1, 1, 1], "normal_map": )", "}}}", tell_material_of_scene});
    const std::string images = R"("file": "layer.pgm", "spacing": [0.5, 0.4, 0.6])";
    const std::string aside = images + R"(, "translate": [0.25, 0.15, -0.4])";
    all.push_back({"Voxel grids",
                   "voxels",
                   images,
                   R"({"clear": {"ior": 1, "absorption": [1, 2, 3], "density_grid": )",
                   "}}",
                   tell_material,
                   {{"rotate_z", aside}, {"y_up", aside}}});
    const auto light = [&](const std::string& name, const std::string& needed) {
        all.push_back({"Lights", name, needed, "{\"lights\": [{\"" + name + "\": ", "}]}", tell_lights});
    };
    light("constant", "");
    light("gradient", R"("zenith": [1, 0.5, 0], "horizon": "#808080", "ground": [0, 0, 0.5])");
    light("image", R"("file": "sky.hdr")");
    light("sky", "");
    light("sun", R"("direction": [1, 1, 1])");
    light("rectangle", R"("centre": [0, 0, 3], "target": [0, 0, 0], "width": 9, "height": 4)");
    light("sphere", R"("centre": [0, 0, 3], "radius": 2)");
    light("spheres", R"("centres": [[0, 0, 3], [3, 0, 3]], "radius": 0.5)");
    light("point", R"("position": [0, 0, 3])");
    light("spot", R"("position": [0, 0, 3], "target": [1, 0, 1])");
    light("ies", R"("file": "lamp.ies", "position": [0, 0, 3], "target": [1, 0.5, 0])");
    all.push_back({"Lights", "portal", R"("centre": [0, 0, 3], "target": [0, 0, 0], "width": 9, "height": 4)",
                   R"({"lights": [{"constant": {}}, {"portal": )", "}]}", tell_lights});
    const auto mesh = [&](const std::string& name, const std::string& needed) {
        const std::string members = R"("material": {"diffuse": {"color": [0.5, 0.5, 0.5]}})" + needed;
        all.push_back({"Meshes",
                       name,
                       members,
                       "[{\"" + name + "\": ",
                       "}]",
                       tell_meshes,
                       {{"opacity_cutoff", members + R"(, "opacity": 0.25)"}}});
    };
    for (const char* const format : {"obj", "ply", "stl"}) mesh(format, fmt::format(", \"file\": \"mesh.{}\"", format));
    all.push_back({"Meshes",
                   "gltf",
                   R"("file": "mesh.glb")",
                   "[{\"gltf\": ",
                   "}]",
                   tell_meshes,
                   {{"panes", R"("file": "pane.glb", "imported": true)"}}});
    mesh("floor", "");
    mesh("backdrop", "");
    const std::string camera = R"("position": [0, -5, 0], "look_at": [0, 0, 0])";
    const std::string lens = camera + R"(, "lens_radius": 0.1)";
    for (const char* const name : {"thin_lens", "tilt_shift"})
        all.push_back({"Cameras",
                       name,
                       camera,
                       fmt::format("{{\"{}\": ", name),
                       "}",
                       tell_camera,
                       {{"focus_distance", lens},
                        {"focus_at", lens},
                        {"tilt", lens},
                        {"blades", lens},
                        {"blade_rotation", lens + R"(, "blades": 5)"}}});
    for (const char* const name : {"panorama", "dome"})
        all.push_back({"Cameras", name, camera, fmt::format("{{\"{}\": ", name), "}", tell_camera});
    all.push_back({"Cameras", "orthographic", camera + R"(, "height": 3)", "{\"orthographic\": ", "}", tell_camera});
    const auto transform = [&](const std::string& name, const std::string& needed) {
        all.push_back({"Transforms", name, needed, "{\"" + name + "\": ", "}", tell_transform});
    };
    transform("translate", R"("by": [1, 2, 3])");
    transform("rotate", R"("angle": 30)");
    transform("scale", R"("factor": 2)");
    transform("stretch", R"("factors": [1, 2, 3])");
    transform("affine", "");
    all.push_back({"Render settings", "render", "", "", "", tell_settings});
    return all;
}

}  // namespace phasetree::tests
