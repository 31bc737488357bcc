// The contents of scene files are defined once, in lists of parameters. The committed reference pages and schema are
// what the program writes, and the readers do what these promise.
//     phasetree nodes --markdown scenes/reference; phasetree nodes --json-schema > scenes/scene.schema.json

#include "scene/reference.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "phasetree/io/meant_kind.hpp"
#include "phasetree/io/suggest.hpp"
#include "scene/image_parameters.hpp"
#include "scene/read_parts.hpp"
#include "source_directory.hpp"
#include "support/json_schema.hpp"
#include "tracer/scene/scene_cases.hpp"

namespace test_scene_reference {

using namespace phasetree;
using namespace phasetree::tests;
using support::bytes_of;

namespace {

std::string committed(const std::string& file) {
    return bytes_of(source_directory() + "/scenes/" + file);
}

std::filesystem::path reference_folder() {
    return source_directory() + "/scenes/reference";
}

/// Whether an object within the value has this key.
bool uses(Value value, const std::string& key) {
    if (value.is_object() && value.find(key)) return true;
    if (!value.is_object() && !value.is_array()) return false;
    for (const Value part : value)
        if (uses(part, key)) return true;
    return false;
}

const JsonSchema& schema() {
    static const JsonSchema read(tracer::scene_json_schema());
    return read;
}

/// The limits of a number among this property's values, without "[]", "$ref" and "allOf"; nothing for properties
/// without numbers.
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

/// A vector of the property's length that begins with this number, or a list of one such vector.
std::string vector_of(Value property, const std::string& first, const std::string& rest = "0.75") {
    if (const auto either = property.find("anyOf")) return vector_of((*either)[either->size() - 1], first, rest);
    const auto items = property.find("items");
    if (items && is_vector(*items)) return "[" + vector_of(*items, first, rest) + "]";
    const auto length = property.find("minItems");
    std::string text = "[" + first;
    for (int i = 1; i < (length ? static_cast<int>(length->number()) : 3); ++i) text += ", " + rest;
    return text + "]";
}

Value properties_of(const Case& c) {
    const std::map<std::string, std::string> definitions{{"Materials", "material"},
                                                         {"Textures", "texture"},
                                                         {"Number textures", "number_texture"},
                                                         {"Lights", "light"},
                                                         {"Meshes", "mesh"},
                                                         {"Cameras", "camera"},
                                                         {"Transforms", "transform"},
                                                         {"Phase functions", "phase_function"}};
    for (const char* const with_one_kind : {"Render settings", "Normal maps", "Voxel grids"})
        if (c.chapter == with_one_kind) return *schema().definition(c.name).find("properties");
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

/// Checks that "colour" and "center" are read like "color" and "centre", and that a key in both spellings is an error.
void check_both_spellings(const Case& c, const std::string& key, const std::string& value) {
    const Document usual = c.with(key, value);
    std::string other = key;
    for (const auto& [from, to] : {std::pair("color", "colour"), std::pair("centre", "center")})
        if (const std::size_t at = key.find(from); at != key.npos) other.replace(at, std::string(from).size(), to);
    REQUIRE(other != key);
    const std::string in_file = fmt::format("\"{}\": ", key), in_other = fmt::format("\"{}\": ", other);
    std::string text = usual.text();
    const std::size_t at = text.rfind(in_file);
    text.replace(at, in_file.size(), in_other);
    CHECK(c.told(Document::from_text(text, usual.name())) == c.told(usual));
    const auto error = error_of(c, Document::from_text(text.insert(at, in_file + value + ", "), usual.name()));
    REQUIRE(error);
    CHECK(error->message().find(fmt::format("has both \"{}\" and \"{}\"", key, other)) != std::string::npos);
}

/// Where the last occurrence of this begins, from 1.
std::size_t column_of(const Document& document, const std::string& part) {
    const std::size_t found = document.text().rfind(part);
    REQUIRE(found != std::string::npos);
    return found + 1;
}

}  // namespace

TEST_CASE("the committed reference pages and schema are what the program writes") {
    // The texts are long, so they are not printed.
    std::set<std::string> files;
    for (const tracer::ReferencePage& page : tracer::scene_reference_pages(reference_folder())) {
        files.insert(page.file);
        CAPTURE(page.file);
        const bool is_page_current = committed("reference/" + page.file) == page.text;
        CHECK_MESSAGE(is_page_current, "to be rewritten: phasetree nodes --markdown scenes/reference");
    }
    for (const auto& entry : std::filesystem::directory_iterator(reference_folder()))
        if (entry.path().extension() == ".md") CHECK(files.contains(entry.path().filename().string()));
    const bool is_schema_current = committed("scene.schema.json") == tracer::scene_json_schema();
    CHECK_MESSAGE(is_schema_current, "to be rewritten: phasetree nodes --json-schema > scenes/scene.schema.json");
}

TEST_CASE("every kind has an example that uses it and a picture, and none is left of a kind that has gone") {
    const std::vector<Chapter> nodes = node_chapters();
    std::uintmax_t bytes = 0;
    for (const Chapter& chapter : tracer::scene_chapters()) {
        if (std::ranges::find(nodes, chapter.title, &Chapter::title) != nodes.end() ||
            chapter.title == tracer::chapter_without_pictures)
            continue;
        const std::filesystem::path folder = reference_folder() / file_stem(chapter);
        std::set<std::string> kinds{"studio"};
        for (const KindPage& page : chapter.pages) {
            CAPTURE(page.example);
            kinds.insert(page.name);
            const std::filesystem::path picture = reference_folder() / (page.example + ".jpg");
            CHECK_MESSAGE(std::filesystem::exists(reference_folder() / (page.example + ".json")), "write this example");
            REQUIRE_MESSAGE(std::filesystem::exists(picture), "scenes/reference/render.py renders it");
            CHECK(bytes_of(picture.string()).starts_with("\xFF\xD8"));
            bytes += std::filesystem::file_size(picture);
            const Document example = Document::from_text(bytes_of(reference_folder() / (page.example + ".json")));
            CHECK(uses(example.root(), page.name == "scene"    ? "tree"
                                       : page.name == "voxels" ? "density_grid"
                                                               : page.name));
        }
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            const std::filesystem::path file = entry.path();
            if (file.extension() != ".json" && file.extension() != ".jpg") continue;
            CAPTURE(file.string());
            CHECK(kinds.contains(file.stem().string()));
        }
    }
    CHECK(bytes > 0);
    CHECK(bytes < 1'000'000);
}

TEST_CASE("a kind without an example is an error that names the file") {
    const support::TemporaryDirectory empty;
    CHECK_THROWS_WITH(tracer::scene_reference_pages(empty.path()),
                      fmt::format("{}: cannot read this example; every kind needs one, of members of a scene",
                                  (empty / "scene-file/scene.json").string())
                          .c_str());
}

TEST_CASE("every kind is in the page, in the schema and in these tests, with the same keys") {
    std::map<std::string, std::set<std::string>> tested;
    for (const Case& c : cases()) tested[c.chapter].insert(c.name);
    for (const Chapter& chapter : tracer::scene_chapters()) {
        const std::vector<Chapter> nodes = node_chapters();
        if (chapter.title == "Scene file" || chapter.title == "Placed objects" ||
            chapter.title == tracer::chapter_without_pictures ||
            std::ranges::find(nodes, chapter.title, &Chapter::title) != nodes.end())
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
        // A conductor that names no metal needs two numbers. The metal is optional.
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
            const std::string needs =
                fmt::format("{} \"{}\"", c.name == "conductor" ? "requires" : "needs", left_out.key());
            CHECK(missing->message().find(needs) != std::string::npos);
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
    // For each, a value other than the default or the required one.
    const std::map<std::string, std::string> others{
        {"metal", "\"iron\""},
        {"filter", "\"box\""},
        {"view", "\"Raw\""},
        {"sun", "false"},
        {"y_up", "true"},
        {"imported", "true"},
        {"panes", "true"},
        {"smooth", "false"},
        {"visible_to_camera", "false"},
        {"group", "\"key\""},
        {"medium", "\"ketchup\""},
        {"bump", R"({"checker": {"size": 0.25}})"},
        {"glass", "\"sf11\""},
        {"abbe_number", "40"},
        {"density", R"({"sphere": {"radius": 0.5}})"},
        {"spectral", "true"},
        {"spectrum", R"({"blackbody": 3000})"},
        {"emission_spectrum", R"({"blackbody": 3000})"},
        {"absorption_spectrum", "[[450, 0], [650, 3]]"},
        {"reflectance", "[[500, 0.25]]"},
        {"caustics", "true"},
        {"guiding", "true"},
        {"green_down", "true"},
        {"channel", "\"green\""},
        {"normal_map", R"({"file": "sky.hdr"})"},
        {"phase_function", R"({"rayleigh": {}})"},
        {"density_grid", R"({"file": "layer.pgm", "spacing": [1, 1, 1]})"},
        {"temperature_grid", R"({"file": "layer.pgm", "spacing": [1, 1, 1], "factor": 2000})"}};
    for (const Case& c : cases()) {
        CAPTURE(c.name);
        for (const Value property : properties_of(c)) {
            const std::string key(property.key());
            CAPTURE(key);
            // Only the command uses the frame rate of a film (command/frames).
            if (key == "file" || key == "frames_per_second") continue;
            if (key == "grid") continue;  // images have none: volume/openvdb
            std::string value = vector_of(property, "0.25");
            if (key == "of") value = R"({"sphere": {"radius": 1.5}})";
            if (key == "ramp") value = c.chapter == "Textures" ? "[[0, [1, 0, 1]]]" : "[[0, 0.75]]";
            const bool is_part_of_mix = c.name == "mix" && (key == "first" || key == "second");
            const bool is_material = key == "material" || (is_part_of_mix && c.chapter == "Materials") ||
                                     (c.name == "two_sided" && (key == "front" || key == "back"));
            if (is_material) value = R"({"diffuse": {"color": [0.1, 0.5, 0.5]}})";
            if (const auto numbers = numbers_of(property); numbers && !is_vector(property))
                value = numbers->find("type")->string() == "integer" ? "5" : key.ends_with("ior") ? "1.75" : "0.75";
            if (is_part_of_mix && c.chapter == "Phase functions") value = R"({"draine": {}})";
            if (key == "turbidity" || c.name == "droplets") value = "5";
            if (key == "emission_temperature") value = "3000";
            // Not at the lamp itself, and visible from it.
            if (key == "centre") value = "[0.25, 0.5, 5]";
            const bool is_of_metal = c.name == "conductor" && key == "reflectance";
            if (others.contains(key) && !is_of_metal) value = others.at(key);
            CHECK(c.told(c.with(key, value)) != c.told(c.document(c.needed_with(key))));
            if (has_other_spelling(key)) check_both_spellings(c, key, value);
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
            if (key == "shutter") continue;  // It closes after it opens, so its limits are not those of each number.
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
                    const std::size_t value =
                        column_of(document, found) + key.size() + 4 + text_with(number).find_first_not_of('[');
                    CHECK(error->column() == value);
                }
                ++count;
            };
            // As close as floats can distinguish.
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
                // In a list that is correct except for one element, the error is at that element.
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

TEST_CASE("names from other programs stand for kinds that exist, and are not kinds of the same chapter themselves") {
    const std::vector<Chapter> chapters = tracer::scene_chapters();
    for (const auto& [elsewhere, here] : names_elsewhere()) {
        CAPTURE(elsewhere);
        bool exists = false;
        for (const Chapter& chapter : chapters) {
            const auto has = [&](std::string_view name) {
                return std::ranges::find(chapter.pages, name, &KindPage::name) != chapter.pages.end();
            };
            exists = exists || has(here);
            CHECK_FALSE((has(here) && has(elsewhere)));
        }
        CHECK(exists);
    }
}

}  // namespace test_scene_reference
