// What a scene file can say is said once, in lists of parameters: the committed reference page and schema are what the
// program prints, and what they promise is what the readers do.
//     phasetree nodes --markdown > scenes/nodes.md; phasetree nodes --json-schema > scenes/scene.schema.json

#include "scene/reference.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "film/film.hpp"
#include "lights/light_kinds.hpp"
#include "phasetree/io/suggest.hpp"
#include "phasetree_support/temporary_directory.hpp"
#include "scene/camera_kinds.hpp"
#include "scene/image_parameters.hpp"
#include "scene/material_kinds.hpp"
#include "scene/mesh_kinds.hpp"
#include "scene/read_parts.hpp"
#include "scene/read_transform.hpp"
#include "source_directory.hpp"
#include "support/json_schema.hpp"

using namespace phasetree;
using phasetree::tests::JsonSchema;
using support::bytes_of;
using support::TemporaryDirectory;
using support::write_text;

namespace {

std::string committed(const std::string& file) {
    return bytes_of(source_directory() + "/scenes/" + file);
}

const JsonSchema& schema() {
    static const JsonSchema read(committed("scene.schema.json"));
    return read;
}

/// A folder with an image and a mesh for what needs a file.
const TemporaryDirectory& folder() {
    static const TemporaryDirectory made;
    static const bool is_filled = [] {
        std::string image = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n";
        for (int i = 0; i < 32; ++i) image += std::string(1, static_cast<char>(0x20 + 2 * i)) + "\x40\x60\x80";
        write_text(made / "sky.hdr", image);
        write_text(made / "mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        write_text(made / "lamp.ies", "TILT=NONE\n1 1 1 3 2 1 2 0 0 0\n1 1 0\n0 90 180\n0 90\n5 2 1\n3 2 1\n");
        return true;
    }();
    REQUIRE(is_filled);
    return made;
}

/// A kind of thing: where the schema describes it, the members that it needs at least, and how it is read. `text` is
/// an object of its parameters; what is read is told in numbers that show what became of them.
struct Case {
    std::string chapter, name, needed;
    std::string before, after;  ///< around the object, to make of it what the reader reads
    void (*read)(const Document&, std::vector<float>& told);
    /// Members to stand in place of `needed` where a key would not go with those.
    std::map<std::string, std::string> instead = {};

    Document document(const std::string& members) const {
        return Document::from_text(before + "{" + members + "}" + after, (folder() / "scene.json").string());
    }
    std::string needed_with(const std::string& key) const {
        const auto found = instead.find(key);
        return found == instead.end() ? needed : found->second;
    }
    /// `members` and whatever else is needed; the member of this key comes last.
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

void tell(std::vector<float>& told, const glm::vec3& v) {
    told.insert(told.end(), {v.x, v.y, v.z});
}

void tell(std::vector<float>& told, const tracer::Texture& texture) {
    for (int i = 0; i < 20; ++i) {
        const float t = 0.173f * static_cast<float>(i);
        const glm::vec3 p(t, 0.31f - 2.1f * t, 0.7f * t * t);
        tell(told, color_at(texture, {p, {0.36f, 0.48f, 0.8f}, glm::vec2(t, 0.3f * t)}));
    }
}

void tell(std::vector<float>& told, const tracer::Number& number) {
    for (const float t : {0.0f, 0.4f, 1.7f}) told.push_back(number_at(number, {t, 0.5f * t, -t}));
}

void tell(std::vector<float>& told, const tracer::Material& material) {
    told.push_back(static_cast<float>(material.index()));
    std::visit(
        [&](const auto& m) {
            if constexpr (requires { m.ior; }) told.push_back(m.ior);
            if constexpr (requires { m.dispersion; }) told.push_back(m.dispersion ? m.dispersion->index(450.0f) : 0.0f);
            if constexpr (requires { m.interior; }) {
                // Estimates, of which several show what one hides: that nothing is left whatever the density is.
                for (std::uint32_t i = 0; i < 8; ++i) {
                    tracer::Sampler sampler(i, 0, 0, 0);
                    const tracer::Way way{glm::vec3(0, 0, -0.9f), glm::vec3(0, 0, 1), 1};
                    tell(told, transmittance(m.interior, way, sampler));
                    const tracer::Flight flight = fly(m.interior, way, glm::vec3(1), sampler);
                    tell(told, flight.weight);
                    tell(told, flight.emitted);
                }
                if (const auto* phase = phase_function(m.interior)) told.push_back(phase->g());
            }
            if constexpr (requires { m.roughness; }) tell(told, m.roughness);
            if constexpr (requires { m.film; }) {
                tell(told, m.film ? m.film->thickness : tracer::Number(-1.0f));
                told.push_back(m.film ? m.film->ior : 0);
            }
            if constexpr (requires { m.color; }) tell(told, m.color);
            if constexpr (requires { m.eta; }) {
                tell(told, m.eta);
                tell(told, m.k);
            }
        },
        material);
}

void tell_material(const Document& document, std::vector<float>& told) {
    tell(told, tracer::read_material(document, document.root()));
}

// Of a scene, in which a field can be read.
void tell_material_of_scene(const Document& document, std::vector<float>& told) {
    tell(told, tracer::read_material(document, *document.root().find("material")));
}

void tell_lights(const Document& document, std::vector<float>& told) {
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

void tell_meshes(const Document& document, std::vector<float>& told) {
    for (const tracer::Mesh& mesh : tracer::read_meshes(document, document.root())) {
        for (const glm::vec3& v : mesh.vertices) tell(told, v);
        for (const glm::vec3& v : mesh.normals) tell(told, v);
        for (const glm::uvec3& t : mesh.triangles) tell(told, glm::vec3(t));
        tell(told, mesh.material);
    }
}

void tell_camera(const Document& document, std::vector<float>& told) {
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

void tell_transform(const Document& document, std::vector<float>& told) {
    const tracer::Transform t = tracer::read_transform(document, document.root());
    for (int i = 0; i < 3; ++i) tell(told, glm::vec3(t.matrix[i]));
    tell(told, glm::vec3(t.by));
}

void tell_settings(const Document& document, std::vector<float>& told) {
    tracer::FilmSettings film;
    const tracer::RenderSettings s = tracer::read_settings(document, document.root(), film);
    for (const int i : {film.width, film.height, s.samples, s.max_depth}) told.push_back(static_cast<float>(i));
    told.push_back(static_cast<float>(s.seed));
    told.insert(told.end(), {s.exposure_ev, s.caustics ? 1.0f : 0.0f, s.photons, s.photon_radius});
    told.push_back(s.noise);
    told.push_back(static_cast<float>(s.view ? s.view->size() : 0));
}

std::vector<Case> cases() {
    std::vector<Case> all;
    const auto material = [&](const std::string& name, const std::string& needed,
                              std::map<std::string, std::string> instead = {}) {
        all.push_back({"Materials", name, needed, "{\"" + name + "\": ", "}", tell_material, std::move(instead)});
    };
    const std::string free_path = R"("ior": 1.5, "albedo": [0.9, 0.9, 0.8], "mean_free_path": [1, 2, 3])";
    const std::string measured = R"("ior": 1.5, "medium": "cream", "scale": 1)";
    const std::string dense =
        R"("ior": 1.5, "absorption": [1, 2, 3], "density": {"sphere": {"radius": 1}}, "density_depth": 0.5)";
    material("clear", R"("ior": 1.5)",
             {{"color_distance", R"("ior": 1.5, "color": [0.2, 0.5, 0.8])"},
              {"albedo", free_path},
              {"mean_free_path", free_path},
              {"medium", measured},
              {"scale", measured},
              {"anisotropy", R"("ior": 1.5, "scattering": [1, 1, 1])"},
              {"emission", R"("ior": 1.5, "absorption": [1, 1, 1])"},
              {"density", dense},
              {"density_depth", dense},
              {"film_ior", R"("ior": 1.5, "film_thickness": 300)"},
              {"glass", R"("glass": "bk7")"}});
    material("diffuse", R"("color": [0.1, 0.2, 0.3])");
    const std::string index = R"("eta": [1, 2, 3], "k": [2, 3, 4])";
    material("conductor", R"("metal": "gold")",
             {{"eta", index}, {"k", index}, {"film_ior", R"("metal": "gold", "film_thickness": 300)"}});
    material("coated", R"("color": [0.1, 0.2, 0.3])",
             {{"film_ior", R"("color": [0.1, 0.2, 0.3], "film_thickness": 300)"}});
    for (const char* const name : {"wood", "speckle", "marble", "checker"})
        all.push_back(
            {"Textures", name, "", fmt::format("{{\"diffuse\": {{\"color\": {{\"{}\": ", name), "}}}", tell_material});
    const std::string scene = R"({"phases": {"sand": {}}, "material": {")";
    const auto texture = [&](const std::string& name, const std::string& needed) {
        all.push_back({"Textures", name, needed, scene + R"(diffuse": {"color": {")" + name + "\": ", "}}}}",
                       tell_material_of_scene});
    };
    texture("field", R"("of": {"sphere": {"radius": 1}}, "ramp": [[0, [0, 0, 0]], [1, [1, 1, 1]]])");
    texture("image", R"("file": "sky.hdr")");
    texture("mesh_image", R"("file": "sky.hdr")");
    all.push_back({"Numbers", "field", R"("of": {"sphere": {"radius": 1}}, "ramp": [[-2, 0], [2, 0.5]])",
                   scene + R"(coated": {"color": [1, 1, 1], "roughness": {"field": )", "}}}}", tell_material_of_scene});
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
    light("point", R"("position": [0, 0, 3])");
    light("spot", R"("position": [0, 0, 3], "target": [1, 0, 1])");
    light("ies", R"("file": "lamp.ies", "position": [0, 0, 3], "target": [1, 0.5, 0])");
    all.push_back({"Lights", "portal", R"("centre": [0, 0, 3], "target": [0, 0, 0], "width": 9, "height": 4)",
                   R"({"lights": [{"constant": {}}, {"portal": )", "}]}", tell_lights});
    const auto mesh = [&](const std::string& name, const std::string& needed) {
        all.push_back({"Meshes", name, R"("material": {"diffuse": {"color": [0.5, 0.5, 0.5]}})" + needed,
                       "[{\"" + name + "\": ", "}]", tell_meshes});
    };
    mesh("obj", R"(, "file": "mesh.obj")");
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
    all.push_back({"Image", "render", "", "", "", tell_settings});
    return all;
}

/// Without "[]", "$ref" and "allOf", what limits a number of this property's values; nothing for what has no numbers.
std::optional<Value> numbers_of(Value property) {
    if (const auto either = property.find("anyOf")) {
        for (const Value one : *either)
            if (const auto found = numbers_of(one)) return found;
        return std::nullopt;
    }
    if (const auto items = property.find("items")) return numbers_of(*items);
    const auto type = property.find("type");
    if (type && (type->string() == "number" || type->string() == "integer")) return property;
    return std::nullopt;
}

bool is_vector(Value property) {
    if (const auto either = property.find("anyOf")) return is_vector((*either)[either->size() - 1]);
    return property.find("items").has_value();
}

/// A vector as long as the property is, which begins with this.
std::string vector_of(Value property, const std::string& first, const std::string& rest = "0.75") {
    if (const auto either = property.find("anyOf")) return vector_of((*either)[either->size() - 1], first, rest);
    const auto length = property.find("minItems");
    std::string text = "[" + first;
    for (int i = 1; i < (length ? static_cast<int>(length->number()) : 3); ++i) text += ", " + rest;
    return text + "]";
}

Value properties_of(const Case& c) {
    const std::map<std::string, std::string> definitions{
        {"Materials", "material"}, {"Textures", "texture"}, {"Numbers", "number_texture"}, {"Lights", "light"},
        {"Meshes", "mesh"},        {"Cameras", "camera"},   {"Transforms", "transform"}};
    if (c.chapter == "Image") return *schema().definition(c.name).find("properties");
    Value kinds = schema().definition(definitions.at(c.chapter));
    if (c.chapter == "Transforms") kinds = (*kinds.find("anyOf"))[0];
    if (c.chapter == "Textures" || c.chapter == "Cameras") kinds = (*kinds.find("anyOf"))[1];
    return *kinds.find("properties")->find(c.name)->find("properties");
}

std::optional<SceneError> error_of(const Case& c, const Document& document) {
    try {
        (void)c.told(document);
    } catch (const SceneError& e) {
        return e;
    }
    return std::nullopt;
}

/// Where the last occurrence of this begins, from 1.
std::size_t column_of(const Document& document, const std::string& part) {
    const std::size_t found = document.text().rfind(part);
    REQUIRE(found != std::string::npos);
    return found + 1;
}

}  // namespace

TEST_CASE("the committed reference page and schema are what the program prints") {
    CHECK(committed("nodes.md") == tracer::scene_reference_markdown());
    CHECK(committed("scene.schema.json") == tracer::scene_json_schema());
}

TEST_CASE("every kind is in the page, in the schema and in these tests, with the same keys") {
    std::map<std::string, std::set<std::string>> tested;
    for (const Case& c : cases()) tested[c.chapter].insert(c.name);
    for (const Chapter& chapter : tracer::scene_chapters()) {
        if (chapter.title == "Scene file" || chapter.title == "Fields" || chapter.title == "Objects" ||
            chapter.title == "Warps" || chapter.title == "Objects and instances")
            continue;
        CAPTURE(chapter.title);
        CHECK(!chapter.text.empty());
        for (const KindPage& page : chapter.pages) {
            CAPTURE(page.name);
            CHECK(!page.summary.empty());
            CHECK(tested[chapter.title].erase(page.name) == 1);
            const auto all = cases();
            const auto one = std::ranges::find_if(
                all, [&](const Case& c) { return c.chapter == chapter.title && c.name == page.name; });
            REQUIRE(one != all.end());
            const Value properties = properties_of(*one);
            if (page.name != "sphere") CHECK(properties.size() == page.parameters.size());
            for (const ParameterPage& p : page.parameters) {
                CAPTURE(p.name);
                CHECK(p.description.ends_with('.'));
                CHECK(properties.find(p.name));
            }
        }
        CHECK(tested[chapter.title].empty());
    }
}

TEST_CASE("what is needed at least is enough, and each of it is needed") {
    for (const Case& c : cases()) {
        CAPTURE(c.name);
        const Document document = c.document(c.needed);
        const auto error = error_of(c, document);
        CHECK(!error);
        // A conductor needs two numbers where it names no metal; it is the metal that may be left out.
        const Document needed = Document::from_text("{" + c.needed_with(c.name == "conductor" ? "k" : "") + "}");
        for (const Value left_out : needed.root()) {
            std::string members;
            for (const Value member : needed.root()) {
                if (member.key() == left_out.key()) continue;
                members += (members.empty() ? "" : ", ") + ("\"" + std::string(member.key()) + "\": ") +
                           Case::text_of(needed, member);
            }
            const auto missing = error_of(c, c.document(members));
            REQUIRE(missing);
            CHECK(missing->message().find(fmt::format("needs \"{}\"", left_out.key())) != std::string::npos);
        }
    }
}

TEST_CASE("a default is what is read when the key is left out") {
    int count = 0;
    for (const Case& c : cases()) {
        CAPTURE(c.name);
        for (const Value property : properties_of(c)) {
            const auto fallback = property.find("default");
            if (!fallback) continue;
            const std::string key(property.key());
            CAPTURE(key);
            const std::vector<float> without = c.told(c.document(c.needed_with(key)));
            const std::vector<float> with = c.told(c.with(key, Case::text_of(c.document(""), *fallback)));
            CHECK(with == without);
            ++count;
        }
    }
    CHECK(count > 50);
}

TEST_CASE("every key changes what is read") {
    // Another value than the default, or than what is needed, for each.
    const std::map<std::string, std::string> others{{"metal", "\"iron\""},
                                                    {"filter", "\"box\""},
                                                    {"view", "\"Raw\""},
                                                    {"sun", "false"},
                                                    {"y_up", "true"},
                                                    {"smooth", "false"},
                                                    {"visible_to_camera", "false"},
                                                    {"group", "\"key\""},
                                                    {"medium", "\"ketchup\""},
                                                    {"glass", "\"sf11\""},
                                                    {"abbe_number", "40"},
                                                    {"density", R"({"sphere": {"radius": 0.5}})"},
                                                    {"caustics", "true"}};
    for (const Case& c : cases()) {
        CAPTURE(c.name);
        for (const Value property : properties_of(c)) {
            const std::string key(property.key());
            CAPTURE(key);
            if (key == "file") continue;
            std::string value = vector_of(property, "0.25");
            if (key == "of") value = R"({"sphere": {"radius": 1.5}})";
            if (key == "ramp") value = c.chapter == "Textures" ? "[[0, [1, 0, 1]]]" : "[[0, 0.75]]";
            if (key == "material") value = R"({"diffuse": {"color": [0.1, 0.5, 0.5]}})";
            if (const auto numbers = numbers_of(property); numbers && !is_vector(property))
                value = numbers->find("type")->string() == "integer" ? "5" : key.ends_with("ior") ? "1.75" : "0.75";
            if (key == "turbidity") value = "5";
            // Not where the lamp itself is, and seen from it.
            if (key == "centre") value = "[0.25, 0.5, 5]";
            if (others.contains(key)) value = others.at(key);
            CHECK(c.told(c.with(key, value)) != c.told(c.document(c.needed_with(key))));
        }
    }
}

TEST_CASE("limits: refused outside, at the number's place, and accepted at the limit if it belongs to them") {
    int count = 0;
    for (const Case& c : cases()) {
        CAPTURE(c.name);
        for (const Value property : properties_of(c)) {
            const auto numbers = numbers_of(property);
            if (!numbers) continue;
            const std::string key(property.key());
            CAPTURE(key);
            const bool is_integer = numbers->find("type")->string() == "integer";
            const std::string inside = c.name == "render" || key == "ior" || key == "turbidity" ? "2" : "0.5";
            const auto text_with = [&](double number) {
                const std::string text = fmt::format("{}", number);
                return is_vector(property) ? vector_of(property, text, inside) : text;
            };
            const auto check = [&](double number, bool is_allowed) {
                CAPTURE(number);
                const Document document = c.with(key, text_with(number));
                const auto error = error_of(c, document);
                CHECK(error.has_value() == !is_allowed);
                if (error) {
                    CAPTURE(error->what());
                    CHECK(error->message().find(fmt::format("\"{}\"", key)) != std::string::npos);
                    const std::string found = fmt::format("\"{}\": {}", key, text_with(number));
                    const std::size_t value = column_of(document, found) + key.size() + 4 + is_vector(property);
                    CHECK(error->column() == value);
                }
                ++count;
            };
            // As near as a float tells the two apart.
            const auto beyond = [&](double limit, double sign) {
                return is_integer ? limit + sign : limit + sign * std::max(std::abs(limit) * 1e-6, 1e-6);
            };
            if (const auto l = numbers->find("minimum")) {
                check(l->number(), true);
                check(beyond(l->number(), -1), false);
            }
            if (const auto l = numbers->find("maximum")) {
                check(l->number(), true);
                check(beyond(l->number(), 1), false);
            }
            if (const auto l = numbers->find("exclusiveMinimum")) {
                check(l->number(), false);
                check(beyond(l->number(), 1), true);
            }
            if (const auto l = numbers->find("exclusiveMaximum")) {
                check(l->number(), false);
                check(beyond(l->number(), -10), true);
            }
        }
    }
    CHECK(count > 100);
}

TEST_CASE("a value of the wrong type, a misspelt key, a key twice: each has its place") {
    for (const Case& c : cases()) {
        CAPTURE(c.name);
        for (const Value property : properties_of(c)) {
            const std::string key(property.key());
            CAPTURE(key);
            for (const char* const wrong : {"null", "{\"a\": 1, \"b\": 2}", "[[1]]"}) {
                const Document document = c.with(key, wrong);
                const auto error = error_of(c, document);
                REQUIRE(error);
                const std::size_t at = column_of(document, fmt::format("\"{}\": ", key)) + key.size() + 4;
                // A list that is right but for what is in it is wrong there.
                CHECK(error->column() >= at);
                CHECK(error->column() <= at + 1);
            }
            const std::string misspelt = key.substr(0, 1) + key;
            const Document document = c.with(misspelt, "1");
            const auto error = error_of(c, document);
            REQUIRE(error);
            CHECK(error->column() == column_of(document, fmt::format("\"{}\"", misspelt)));
            CHECK(error->suggestion() == key);
            CHECK_THROWS_AS((void)c.document(fmt::format("\"{0}\": 1, \"{0}\": 1", key)), SceneError);
        }
    }
}

TEST_CASE("every scene of the gallery is as the schema says") {
    int count = 0;
    for (const char* const where : {"/scenes", "/scenes/benchmark", "/scenes/objects"}) {
        for (const auto& entry : std::filesystem::directory_iterator(source_directory() + where)) {
            if (entry.path().extension() != ".json" || entry.path().filename() == "scene.schema.json") continue;
            CAPTURE(entry.path());
            const Document document = Document::from_file(entry.path());
            const std::string mistake = schema().mistake(document.root());
            CHECK(mistake == "");
            ++count;
        }
    }
    CHECK(count >= 30);
}

TEST_CASE("the schema refuses what the reader refuses") {
    const std::string begin = R"({"version": 1, "phases": {"glass": {"clear": {"ior": 1.5}}},
        "tree": {"set": {"phase": "glass", "of": {"sphere": {"radius": 1}}}})";
    const std::string camera = R"("camera": {"position": [0, -5, 0], "look_at": [0, 0, 0]})";
    const auto mistake = [](const std::string& text) {
        const Document document = Document::from_text(text);
        return schema().mistake(document.root());
    };
    CHECK(mistake(begin + ", " + camera + "}") == "");
    CHECK(mistake(begin + "}") != "");
    for (const char* const wrong :
         {R"("lights": {})", R"("lights": [{"sun": {}}])", R"("lights": [{"sun": {"direction": [0, 1]}}])",
          R"("lights": [{"shpere": {"centre": [0, 0, 3], "radius": 1}}])",
          R"("lights": [{"sphere": {"centre": [0, 0, 3], "radius": 0}}])", R"("lights": [{"constant": {}, "sky": {}}])",
          R"("lights": [{"constant": {"radiance": "white"}}])",
          R"("meshes": [{"floor": {"material": {"clear": {"ior": 1.5}}}}])", R"("meshes": [{"floor": {}}])",
          R"("meshes": [{"floor": {"material": {"diffuse": {"color": {"wood": {"axes": 1}}}}}}])",
          R"("render": {"samples": 1.5})", R"("render": {"spp": 1})", R"("background": [0, 0])", R"("lamps": [])"}) {
        CAPTURE(wrong);
        CHECK(mistake(begin + ", " + camera + ", " + wrong + "}") != "");
        CHECK_THROWS_AS((void)tracer::read_scene(Document::from_text(begin + ", " + camera + ", " + wrong + "}")),
                        SceneError);
    }
}

TEST_CASE("an image has the size and the settings that the page promises, with or without \"render\"") {
    const std::string scene = R"({"version": 1, "phases": {"glass": {"clear": {"ior": 1.5}}},
        "tree": {"set": {"phase": "glass", "of": {"sphere": {"radius": 1}}}},
        "camera": {"position": [0, -5, 0], "look_at": [0, 0, 0]})";
    const Value promised = *schema().definition("render").find("properties");
    const auto number = [&](const char* key) { return promised.find(key)->find("default")->number(); };
    for (const char* const end : {"}", R"(, "render": {}})"}) {
        const tracer::Scene read = tracer::read_scene(Document::from_text(scene + end));
        CHECK(read.film.width == number("width"));
        CHECK(read.film.height == number("height"));
        CHECK(read.settings.samples == number("samples"));
        CHECK(read.settings.seed == number("seed"));
        CHECK(read.settings.max_depth == number("max_depth"));
        CHECK(static_cast<double>(read.settings.exposure_ev) == number("exposure"));
        CHECK(!read.settings.caustics);
        CHECK(static_cast<double>(read.settings.photons) == number("photons"));
        CHECK(static_cast<double>(read.settings.photon_radius) == number("photon_radius"));
        CHECK(!read.settings.view);
    }
}
