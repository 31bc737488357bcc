// The catalogue of the studio: everything that the reference describes, with templates that the readers accept.
#include "studio/catalogue.hpp"

#include <unistd.h>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>

#include "scene/read_parts.hpp"
#include "scene/reference.hpp"
#include "scene/scene.hpp"
#include "source_directory.hpp"
#include "studio/templates.hpp"

namespace test_catalogue {

using namespace phasetree;
using namespace phasetree::tracer;
using namespace phasetree::tracer::studio;

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

fs::path scenes() {
    return fs::path(source_directory()) / "scenes";
}

const Vocabulary& vocabulary() {
    static const Vocabulary words;
    return words;
}

std::string replaced(std::string text, std::string_view from, std::string_view by) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += by.size())
        text.replace(at, from.size(), by);
    return text;
}

// The file that a kind's example in the reference names, as an absolute path: the last one, because a mesh that it is
// shown on comes first. Examples of nodes are trees of a scene in `scenes/nodes`, and others are members of one in
// `scenes`.
std::string file_of_example(const CatalogueKind& kind) {
    const fs::path example = scenes() / (kind.picture + ".json");
    std::ifstream in(example);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::size_t key = text.rfind("\"file\": \"");
    REQUIRE_MESSAGE(key != std::string::npos, example);
    const std::size_t begin = key + 9;
    const bool is_node = kind.picture.starts_with("nodes/");
    return ((is_node ? scenes() / "nodes" : scenes()) / text.substr(begin, text.find('"', begin) - begin)).string();
}

// Two images with as many phases as the template has.
std::string stack_of_labels() {
    const fs::path folder = fs::temp_directory_path();
    for (const char* const layer : {"0", "1"})
        std::ofstream(folder / fmt::format("phasetree-labels-{}_{}.pgm", ::getpid(), layer), std::ios::binary)
            << "P5\n2 2\n255\n"
            << '\1' << '\2' << '\2' << '\1';
    return (folder / fmt::format("phasetree-labels-{}_#.pgm", ::getpid())).string();
}

constexpr const char* tree = R"({"set": {"phase": "a", "of": {"sphere": {"radius": 0.5}}}})";

// A scene with these members instead of usual ones.
std::string scene(std::string material, std::string object, const std::string& members = "") {
    const auto has = [&](const char* key) { return members.find(fmt::format("\"{}\":", key)) != std::string::npos; };
    std::string text = R"({"version": 1, "phases": {"a": )" + material + R"(, "b": {"diffuse": {"color": [1, 1, 1]}}})";
    if (!has("objects") || !object.empty()) text += ", \"tree\": " + (object.empty() ? tree : object);
    if (!has("lights")) text += R"(, "lights": [{"constant": {}}])";
    if (!members.empty()) text += ", " + members;
    const bool has_camera = members.starts_with("\"camera\":");
    if (!has_camera) text += R"(, "camera": {"position": [0, -50, 1], "look_at": [0, 0, 0]})";
    return text + "}";
}

constexpr const char* diffuse = R"({"diffuse": {"color": [0.5, 0.5, 0.5]}, "density": 1000})";

// A scene with an instance of the kind at a place of its type.
std::string scene_with(const CatalogueKind& kind, const std::string& instance) {
    const std::string& type = kind.type;
    const auto mesh = [&](const std::string& material) {
        const bool needs_colors = kind.name == "vertex_color";
        const std::string file =
            needs_colors ? file_of_example(kind) : (scenes() / "reference/meshes/vase.obj").string();
        return std::string("\"meshes\": [{\"") + (file.ends_with(".ply") ? "ply" : "obj") + R"(": {"file": ")" + file +
               R"(", "material": )" + material + "}}]";
    };
    if (type == "field") return scene(diffuse, R"({"set": {"phase": "a", "of": )" + instance + "}}");
    if (type == "object") return scene(diffuse, instance);
    if (type == "material") return kind.for_meshes_only ? scene(diffuse, "", mesh(instance)) : scene(instance, "");
    if (type == "light") return scene(diffuse, "", "\"lights\": [" + instance + R"(, {"constant": {}}])");
    if (type == "mesh") return scene(diffuse, "", "\"meshes\": [" + instance + "]");
    if (type == "camera") return scene(diffuse, "", "\"camera\": " + instance);
    if (type == "render") return scene(diffuse, "", "\"render\": " + instance);
    if (type == "statement") return scene(diffuse, "", "\"expect\": [" + instance + "]");
    if (type == "texture") return scene(diffuse, "", mesh(R"({"diffuse": {"color": )" + instance + "}}"));
    if (type == "number_texture")
        return scene(diffuse, "", mesh(R"({"diffuse": {"color": [1, 1, 1], "roughness": )" + instance + "}}"));
    if (type == "normal_map")
        return scene(diffuse, "", mesh(R"({"diffuse": {"color": [1, 1, 1], "normal_map": )" + instance + "}}"));
    if (type == "phase_function")
        return scene(R"({"clear": {"ior": 1, "scattering": [1, 1, 1], "phase_function": )" + instance + "}}", "");
    if (type == "voxels")
        return scene(R"({"clear": {"ior": 1, "scattering": [1, 1, 1], "density_grid": )" + instance + "}}", "");
    const std::string object = std::string(R"("objects": [{"name": "object", "tree": )") + tree;
    if (type == "transform") return scene(diffuse, "", object + R"(, "transform": )" + instance + "}]");
    if (type == "placed_object") return scene(diffuse, "", "\"objects\": [" + instance + "]");
    if (type == "instance") return scene(diffuse, "", object + R"(}], "instances": [)" + instance + "]");
    REQUIRE_MESSAGE(type == "scene", type);
    return "";
}

std::string prepared(const CatalogueKind& kind) {
    std::string text = template_of(kind);
    if (text.find(file_placeholder) != std::string::npos)
        text = replaced(text, file_placeholder, kind.name == "labels" ? stack_of_labels() : file_of_example(kind));
    text = replaced(replaced(text, phase_placeholder, "a"), other_phase_placeholder, "b");
    return replaced(text, object_placeholder, "object");
}

}  // namespace

TEST_CASE("the catalogue has every kind of the reference") {
    std::set<std::string> in_reference, in_catalogue;
    for (const Chapter& chapter : scene_chapters())
        for (const KindPage& page : chapter.pages) in_reference.insert(file_stem(chapter) + "/" + page.name);
    for (const CatalogueKind& kind : vocabulary().kinds()) {
        in_catalogue.insert(kind.chapter + "/" + kind.name);
        CHECK(vocabulary().find(kind.type, kind.name) != nullptr);
    }
    CHECK(in_reference == in_catalogue);
}

TEST_CASE("the reader accepts every template at a place of its type") {
    for (const CatalogueKind& kind : vocabulary().kinds()) {
        const std::string text = scene_with(kind, prepared(kind));
        CAPTURE(kind.type);
        CAPTURE(text);
        if (text.empty()) continue;  // the scene itself, which is checked with each of the others
        try {
            const Document document = Document::from_text(text);
            if (kind.type != "field" && kind.type != "object") {
                (void)read_scene(document);
                continue;
            }
            const Phased object = read_tree(document, file_readers()).object;
            const Bounds bounds = phasetree::bounds(object);
            // How large a file's content is, is not the template's.
            if (!bounds.finite() || template_of(kind).find(file_placeholder) != std::string::npos) continue;
            CHECK(bounds.diagonal() > 0.3f);
            CHECK(bounds.diagonal() < 8.0f);
        } catch (const std::exception& e) {
            FAIL_CHECK(std::string(e.what()));
        }
    }
    for (const char* const layer : {"0", "1"})
        fs::remove(fs::temp_directory_path() / fmt::format("phasetree-labels-{}_{}.pgm", ::getpid(), layer));
}

TEST_CASE("the catalogue marks the materials that the reader rejects in phases, and no others") {
    std::set<std::string> marked, rejected;
    for (const CatalogueKind& kind : vocabulary().kinds()) {
        if (kind.for_meshes_only) marked.insert(kind.name);
        if (kind.type != "material") continue;
        try {
            (void)read_scene(Document::from_text(scene(prepared(kind), "")));
        } catch (const std::exception& e) {
            rejected.insert(kind.name);
        }
    }
    CHECK(marked == rejected);
    CHECK(marked == std::set<std::string>{"thin_glass", "thin_diffuse", "two_sided"});
    for (const Json& kind : Json::parse(written_catalogue(vocabulary(), {}))["kinds"])
        CHECK(kind["for_meshes_only"] ==
              (kind["type"] == "material" && marked.contains(kind["kind"].get<std::string>())));
}

TEST_CASE("a parameter has the control for its type, with its limits, unit and default") {
    const auto parameter = [](const char* type, const char* kind, const char* name) {
        const CatalogueKind* found = vocabulary().find(type, kind);
        REQUIRE(found);
        const KindParameter* p = found->parameter(name);
        REQUIRE_MESSAGE(p, name);
        return *p;
    };
    const KindParameter radius = parameter("field", "sphere", "radius");
    CHECK(radius.control == "length");
    CHECK(radius.low == 0.0);
    CHECK(radius.low_is_open);
    CHECK_FALSE(radius.high);
    CHECK(radius.is_required);
    CHECK(radius.may_be_keyed);
    CHECK(parameter("field", "rotate", "angle").control == "angle");
    CHECK(parameter("field", "rotate", "axis").control == "direction");
    CHECK(parameter("field", "translate", "of").slot->type == "field");
    CHECK(parameter("object", "translate", "of").slot->type == "object");
    CHECK(parameter("object", "over", "of").slot->is_list);
    CHECK(parameter("object", "set", "phase").control == "phase");
    CHECK(parameter("object", "remove", "phases").control == "phases");
    CHECK(parameter("field", "capsule", "from").control == "point");
    CHECK(parameter("field", "box", "size").control == "vector");
    CHECK(parameter("field", "mesh", "file").control == "file");
    CHECK(parameter("field", "polar_array", "count").control == "integer");
    const KindParameter metal = parameter("material", "conductor", "metal");
    CHECK(metal.control == "choice");
    CHECK(metal.choices.front() == "aluminium");
    const KindParameter color = parameter("material", "diffuse", "color");
    CHECK(color.control == "color");
    CHECK(color.slot->type == "texture");
    CHECK(parameter("material", "diffuse", "colour").name == "color");
    CHECK(parameter("material", "clear", "absorption_spectrum").control == "spectrum");
    CHECK(parameter("material", "clear", "density").control == "slot");
    CHECK(parameter("material", "mix", "first").slot->type == "opaque_material");
    CHECK(parameter("light", "sky", "sun").control == "boolean");
    CHECK(parameter("light", "constant", "radiance").default_value == "[1, 1, 1]");
    CHECK(parameter("statement", "apart", "phases").control == "phases");
    CHECK(vocabulary().find("object", "over")->lone_parameter()->name == "of");
    CHECK_FALSE(vocabulary().find("object", "set")->lone_parameter());
}

TEST_CASE("pictures are those of the reference, and no other file is named") {
    for (const CatalogueKind& kind : vocabulary().kinds())
        if (!kind.picture.empty()) {
            const auto file = picture_file(vocabulary(), scenes(), kind.picture + ".jpg");
            REQUIRE(file);
            CHECK_MESSAGE(fs::exists(*file), file->string());
        }
    for (const char* const name :
         {"", "../CONTRIBUTING.md", "nodes/fields/sphere.json", "nodes/fields/../fields/sphere.jpg"})
        CHECK_FALSE(picture_file(vocabulary(), scenes(), name));
    const Json json = Json::parse(written_catalogue(vocabulary(), scenes()));
    for (const Json& kind : json["kinds"])
        if (kind["kind"] == "sphere" && kind["type"] == "field")
            CHECK(kind["picture"] == "pictures/nodes/fields/sphere.jpg");
    CHECK(Json::parse(written_catalogue(vocabulary(), {}))["kinds"][0]["picture"].is_null());
}

TEST_CASE("parameters that exclude or require others are those of the kind, with initial values") {
    int requirements = 0;
    for (const CatalogueKind& kind : vocabulary().kinds()) {
        const auto check_names = [&](const std::vector<std::string_view>& names) {
            for (const std::string_view name : names) CHECK_MESSAGE(kind.parameter(name), kind.name << ": " << name);
        };
        for (const auto& names : kind.relations.exclusive) check_names(names);
        check_names(kind.relations.one_of);
        for (const Requirement& r : kind.relations.requirements) {
            ++requirements;
            check_names({r.parameter});
            check_names(r.any_of);
            CHECK_MESSAGE((r.initial.empty() || Json::accept(r.initial)), r.parameter);
        }
    }
    CHECK(requirements > 15);
    const Json catalogue = Json::parse(written_catalogue(vocabulary(), {}));
    for (const Json& kind : catalogue["kinds"]) {
        if (kind["kind"] != "clear") continue;
        const Json medium{{"parameter", "medium"}, {"any_of", {"scale"}}, {"initial", "25"}};
        const Json& all = kind["relations"]["requirements"];
        CHECK(std::find(all.begin(), all.end(), medium) != all.end());
        CHECK(kind["relations"]["one_of"] == Json({"ior", "glass"}));
    }
}

}  // namespace test_catalogue
