// The outline of a scene: its parts with their pointers, also while something else in the scene is wrong.
#include "studio/outline.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "source_directory.hpp"
#include "studio/layout.hpp"
#include "studio/pointer.hpp"

namespace test_outline {

using namespace phasetree;
using namespace phasetree::tracer::studio;

namespace {

const Vocabulary& vocabulary() {
    static const Vocabulary words;
    return words;
}

const OutlineEntry* find(const std::vector<OutlineEntry>& entries, std::string_view pointer) {
    for (const OutlineEntry& entry : entries) {
        if (entry.pointer == pointer) return &entry;
        if (const OutlineEntry* found = find(entry.children, pointer)) return found;
    }
    return nullptr;
}

const OutlineParameter* parameter(const OutlineEntry& entry, std::string_view name) {
    for (const OutlineParameter& p : entry.parameters)
        if (p.name == name) return &p;
    return nullptr;
}

// Checks that every pointer leads to its value, and that every kind is known. Returns the number of entries.
std::size_t check_entries(const Document& document, const std::vector<OutlineEntry>& entries) {
    std::size_t count = entries.size();
    for (const OutlineEntry& entry : entries) {
        CHECK(value_at(document, entry.pointer).offset() == entry.value->offset());
        CHECK_MESSAGE((entry.of || entry.kind == "reference" || entry.kind == "group" || entry.kind == "list"),
                      entry.pointer);
        for (const OutlineParameter& p : entry.parameters) {
            CHECK(value_at(document, p.pointer).offset() == p.value->offset());
            CHECK_MESSAGE(p.is_known, p.pointer);
        }
        count += check_entries(document, entry.children);
    }
    return count;
}

// The number of nodes of a tree: objects with one member whose key is a kind's. The object of its parameters is none.
std::size_t nodes_in(Value value) {
    std::size_t count = 0;
    const bool is_node = value.is_object() && value.size() == 1 &&
                         (vocabulary().find("field", value[0].key()) || vocabulary().find("object", value[0].key()));
    for (const Value child : is_node ? value[0] : value) count += nodes_in(child);
    return count + (is_node ? 1 : 0);
}

std::size_t entries_in(const OutlineEntry& entry) {
    std::size_t count = entry.kind != "reference" && (entry.type == "field" || entry.type == "object") ? 1 : 0;
    for (const OutlineEntry& child : entry.children) count += entries_in(child);
    return count;
}

}  // namespace

TEST_CASE("every scene of the gallery has an outline of known kinds, with every node of its tree") {
    std::size_t scenes = 0;
    for (const auto& file : std::filesystem::directory_iterator(std::filesystem::path(source_directory()) / "scenes")) {
        if (file.path().extension() != ".json" || file.path().filename() == "scene.schema.json") continue;
        CAPTURE(file.path().string());
        const Document document = Document::from_file(file.path());
        const Outline outline = outline_of(document, vocabulary());
        CHECK(check_entries(document, outline.entries) > 4);
        for (const char* const key : {"tree", "shapes"}) {
            const auto part = document.root().find(key);
            if (!part) continue;
            std::size_t count = 0;
            for (const OutlineEntry& entry : outline.entries)
                if (entry.pointer.starts_with(std::string("/") + key)) count += entries_in(entry);
            std::size_t nodes = 0;
            if (key == std::string_view("tree"))
                nodes = nodes_in(*part);
            else
                for (const Value shape : *part) nodes += nodes_in(shape);
            CHECK(count == nodes);
        }
        ++scenes;
    }
    CHECK(scenes > 30);
}

TEST_CASE("an outline says what everything is and where it stands") {
    const Document document = Document::from_text(R"({"version": 1, "phases": {
  "a/b": {"diffuse": {"colour": {"wood": {"seed": 3}}}, "density": 700},
  "glass": {"clear": {"ior": {"keys": [[0, 1.3], [1, 1.5]]}, "density": "ball"}}},
"shapes": {"ball": {"sphere": {"radius": 0.50}}, "two": {"translate": {"by": [0, 0, 1], "of": {"set": {"phase": "glass", "of": "ball"}}}}},
"tree": {"over": ["two", {"remove": {"phases": ["glass", "a/b"], "of": {"set": {"phase": "a/b", "of": {"union": ["ball", {"box": {"size": [1, 1, 1], "raduis": 2}}]}}}}}, {"nonsense": {"of": 1}}]},
"lights": [{"sun": {"direction": [0, 0, 1]}}],
"camera": {"position": [0, 0, 1], "look_at": [0, 0, 0]}})");
    const Outline outline = outline_of(document, vocabulary());
    const auto at = [&](std::string_view pointer) -> const OutlineEntry& {
        const OutlineEntry* found = find(outline.entries, pointer);
        REQUIRE_MESSAGE(found, pointer);
        return *found;
    };
    CHECK(at("").kind == "scene");
    CHECK(at("/camera").kind == "thin_lens");
    CHECK(at("/lights/0").kind == "sun");
    CHECK(at("/lights/0").type == "light");
    CHECK(at("/phases/a~1b").kind == "diffuse");
    CHECK(at("/phases/a~1b").label == "a/b");
    CHECK(parameter(at("/phases/a~1b"), "density")->pointer == "/phases/a~1b/density");
    CHECK(at("/phases/a~1b/diffuse/colour").kind == "wood");
    CHECK(at("/phases/a~1b/diffuse/colour").slot == "color");
    CHECK(parameter(at("/phases/glass"), "ior")->is_keyed);
    CHECK(at("/phases/glass/clear/density").label == "ball");
    CHECK(at("/shapes/ball").type == "field");
    CHECK(at("/shapes/two").type == "object");
    CHECK(at("/shapes/two/translate/of").type == "object");
    CHECK(parameter(at("/shapes/ball"), "radius")->value->written() == "0.50");
    CHECK(at("/tree").kind == "over");
    CHECK(at("/tree/over/0").kind == "reference");
    CHECK(at("/tree/over/1").phases == std::vector<std::string>{"glass", "a/b"});
    CHECK(at("/tree/over/1/remove/of").slot == "of");
    CHECK(at("/tree/over/1/remove/of/set/of/union/1").kind == "box");
    CHECK_FALSE(parameter(at("/tree/over/1/remove/of/set/of/union/1"), "raduis")->is_known);
    CHECK(at("/tree/over/2").kind == "nonsense");
    CHECK_FALSE(at("/tree/over/2").of);
}

TEST_CASE("anything that is JSON has an outline, and it has a limit") {
    for (
        const char* const text :
        {"1", "[]", "{}", "null", R"({"tree": 1})", R"({"tree": []})", R"({"tree": {}})", R"({"tree": {"over": {}}})",
         R"({"phases": [1, {}], "shapes": [1], "lights": {"a": 1}, "camera": [], "groups": [], "objects": [{}, 1]})",
         R"({"shapes": {"a": "b", "b": "a", "c": {"translate": {"of": "c"}}}, "tree": {"translate": []}})",
         R"({"phases": {"a": 1, "b": [], "c": {"diffuse": 1}, "d": {"density": 1}}, "render": 1})",
         R"({"meshes": [{"obj": "x"}], "instances": [{"transform": [1, {"rotate": 2}]}], "objects": [{"phases": {"a": 1}}]})"})
        CHECK_NOTHROW(outline_of(Document::from_text(text), vocabulary()));
    std::string many = R"({"tree": {"over": ["a")";
    for (int i = 0; i < 100; ++i) many += ", \"a\"";
    const Outline outline = outline_of(Document::from_text(many + "]}}"), vocabulary(), 50);
    CHECK(outline.has_more);
    CHECK(outline.entries.back().children.size() < 50);
    std::string deep = "\"a\"";
    for (int i = 0; i < 400; ++i) deep = R"({"mirror": {"of": )" + deep + "}}";
    CHECK(outline_of(Document::from_text("{\"tree\": " + deep + "}"), vocabulary()).entries.size() == 2);
}

}  // namespace test_outline
