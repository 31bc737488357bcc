// A kind's reader, page and schema are all derived from its list of parameters.

#include <doctest/doctest.h>

#include <functional>
#include <glm/glm.hpp>

#include "phasetree/io/read_kind.hpp"
#include "phasetree/io/reference.hpp"

namespace test_kind {

using namespace phasetree;

namespace {

std::vector<std::string_view> shapes() {
    return {"round", "square"};
}

struct Lamp {
    static constexpr KindInfo info{"lamp", "A lamp."};

    float size = 1;
    float hue = 0.25f;
    int bulbs = 3;
    bool is_on = true;
    glm::vec3 colour{0.5f};
    glm::vec3 towards{0, 0, 1};
    std::string shape = "round";
    std::optional<float> age{};
    std::filesystem::path file{};

    template <class V>
    static void parameters(V&& v) {
        v(&Lamp::size, Parameter{"size", "m", "Its size.", Limits{.low = 0.1f, .high = 1e15f}});
        v(&Lamp::hue, Parameter{"hue", "", "Its hue.", Limits{.low = 0, .high = 1, .high_open = true}, true});
        v(&Lamp::bulbs, Parameter{"bulbs", "", "How many bulbs.", Limits{.low = 1, .high = 8}, true});
        v(&Lamp::is_on, Parameter{"on", "", "Whether it is on.", limits::any, true});
        v(&Lamp::colour, ColourParameter{{"colour", "", "Its colour.", limits::fraction, true}});
        v(&Lamp::towards, DirectionParameter{{"towards", "", "Where it shines.", limits::any, true}});
        v(&Lamp::shape, ChoiceParameter{{"shape", "", "Its shape.", limits::any, true}, shapes});
        v(&Lamp::age, Parameter{"age", "s", "Its age.", limits::non_negative, true});
        v(&Lamp::file, Parameter{"file", "", "Its picture.", limits::any, true});
    }
};

struct Torch {
    static constexpr KindInfo info{"torch", "A torch."};
    template <class V>
    static void parameters(V&&) {}
};

Lamp read(const std::string& text) {
    const Document document = Document::from_text(text, "folder/lamp.json");
    return read_kind<Lamp>(document, document.root(), "the lamp", [](const Lamp& lamp) { return lamp; });
}

std::string error_of(
    const std::string& text, const std::function<void(const Lamp&)>& make = [](const Lamp&) {}) {
    const Document document = Document::from_text(text, "a");
    try {
        (void)read_kind<Lamp>(document, document.root(), "the lamp", [&](const Lamp& lamp) {
            make(lamp);
            return lamp;
        });
    } catch (const SceneError& e) {
        return std::to_string(e.column()) + ": " + e.message() + (e.suggestion() ? " → " + *e.suggestion() : "");
    }
    return "";
}

}  // namespace

TEST_CASE("what is missing has its default, and what is there is read") {
    const Lamp plain = read(R"({"size": 2})");
    CHECK(plain.size == 2);
    CHECK(plain.hue == 0.25f);
    CHECK(plain.is_on);
    CHECK(!plain.age);
    const Lamp lamp = read(
        R"({"size": 2, "hue": 0, "bulbs": 8, "on": false, "colour": "#ff0000", "towards": [0, 3, 0], "shape": "square",
            "age": 0, "file": "x.png"})");
    CHECK(lamp.hue == 0);
    CHECK(lamp.bulbs == 8);
    CHECK(!lamp.is_on);
    CHECK(lamp.colour == glm::vec3(1, 0, 0));
    CHECK(lamp.towards == glm::vec3(0, 3, 0));
    CHECK(lamp.shape == "square");
    CHECK(lamp.age == 0.0f);
    CHECK(lamp.file == "folder/x.png");
}

TEST_CASE("a limit is the decimal number that it was written as") {
    CHECK(read(R"({"size": 0.1})").size == 0.1f);
    CHECK(read(R"({"size": 1e15})").size == 1e15f);
    CHECK(error_of(R"({"size": 0.0999999999})") ==
          "10: \"size\" must be at least 0.1 and at most 1e15, but is 0.0999999999");
    CHECK(error_of(R"({"size": 1.0000001e15})") ==
          "10: \"size\" must be at least 0.1 and at most 1e15, but is 1.0000001e15");
    // Limits whose floats are beyond them.
    const auto read_within = [](const char* text, const Limits& l) {
        const Document document = Document::from_text(text, "a");
        return as<float>(document, document.root(), "it", range_of(l));
    };
    CHECK(read_within("1e30", {.high = 1e30f}) == 1e30f);
    CHECK(read_within("0.1", {.high = 0.1f}) == 0.1f);
    CHECK_THROWS_AS((void)read_within("0.1", {.high = 0.1f, .high_open = true}), SceneError);
    CHECK_THROWS_AS((void)read_within("0.10000000001", {.high = 0.1f}), SceneError);
    CHECK_THROWS_AS((void)read_within("0.99999999999", {.high = 1, .high_open = true}), SceneError);
    CHECK(describe(range_of({.low = -1e30f, .low_open = true})) == "more than -1e30");
    CHECK(describe(range_of({.high = 10000000})) == "at most 10000000");
    CHECK(describe(range_of({.low = 0, .high = 16777216})) == "at least 0 and at most 16777216");
}

TEST_CASE("what is wrong is told at its place") {
    CHECK(error_of("[]") == "1: the lamp must be an object, but is an array");
    CHECK(error_of("{}") == "1: the lamp needs \"size\"");
    CHECK(error_of(R"({"sise": 1})") == "2: the lamp needs \"size\", but has \"sise\" → size");
    CHECK(error_of(R"({"size": 1, "hu": 1})") == "13: unknown key \"hu\" in the lamp → hue");
    CHECK(error_of(R"({"size": 1, "hue": 1})") == "20: \"hue\" must be at least 0 and less than 1, but is 1");
    CHECK(error_of(R"({"size": 1, "bulbs": 1.5})") == "22: \"bulbs\" must be a whole number, but is 1.5");
    CHECK(error_of(R"({"size": 1, "on": 1})") == "19: \"on\" must be true or false, but is a number");
    CHECK(error_of(R"({"size": 1, "colour": [0, 2, 0]})") ==
          "27: item 2 of \"colour\" must be at least 0 and at most 1, but is 2");
    CHECK(error_of(R"({"size": 1, "towards": [0, 0, 0]})") == "24: \"towards\" must not be zero");
    CHECK(error_of(R"({"size": 1, "shape": "sqare"})") ==
          "22: \"shape\" must be one of \"round\", \"square\", but is \"sqare\" → square");
    CHECK(error_of(R"({"size": 1, "file": 1})") == "21: \"file\" must be a string, but is a number");
}

TEST_CASE("what a kind's own code finds is told at the parameter, at its key, or at the object") {
    const std::string text = R"({"size": 1, "hue": 0.5})";
    const auto fail = [](const auto& error) { return [=](const Lamp&) { throw error; }; };
    CHECK(error_of(text, fail(ParameterError("hue", "is grey"))) == "20: is grey");
    CHECK(error_of(text, fail(ParameterError("hue", "is grey", ParameterError::Place::key))) == "13: is grey");
    CHECK(error_of(text, fail(ParameterError("age", "is missing"))) == "1: the lamp needs \"age\"");
    // An unknown key is reported first: it may be the one that seems to be missing.
    CHECK(error_of(R"({"size": 1, "agee": 3})", fail(ParameterError("hue", "requires \"age\""))) ==
          "13: unknown key \"agee\" in the lamp → age");
    CHECK(error_of(text, fail(std::invalid_argument("is no lamp"))) == "1: is no lamp");
}

TEST_CASE("the kind of a thing is its one key") {
    using Kinds = TypeList<Lamp, Torch>;
    const auto kind_of = [](const std::string& text) -> std::string {
        const Document document = Document::from_text(text, "a");
        try {
            std::string name = "none";
            with_kind(Kinds(), document, document.root(), "a light", [&]<class Kind>(Value member) {
                name = std::string(Kind::info.name) + " " + std::to_string(member.size());
            });
            return name;
        } catch (const SceneError& e) {
            return std::to_string(e.column()) + ": " + e.message() + (e.suggestion() ? " → " + *e.suggestion() : "");
        }
    };
    CHECK(kind_of(R"({"torch": {}})") == "torch 0");
    CHECK(kind_of(R"({"lamp": {"size": 1}})") == "lamp 1");
    CHECK(kind_of(R"({"troch": {}})") ==
          "2: a light cannot be of the kind \"troch\"; choose from \"lamp\", \"torch\" → torch");
    CHECK(kind_of("{}") ==
          "1: a light must have one member, named after its kind, but has 0; the kinds are \"lamp\", \"torch\"");
    CHECK(
        kind_of("3") ==
        "1: a light must be an object {\"kind\": {…}}, where the kind is one of \"lamp\", \"torch\", but is a number");
}

TEST_CASE("page and schema show types, units, limits and defaults") {
    const KindPage page = page_of<Lamp>();
    CHECK(page.name == "lamp");
    REQUIRE(page.parameters.size() == 9);
    const Chapter chapter{"Small lamps", "All of them.", {page}};
    CHECK(file_stem(chapter) == "small-lamps");
    CHECK(reference_index({&chapter, 1}) == R"(| chapter | |
|---|---|
| [Small lamps](small-lamps.md) | [`lamp`](small-lamps.md#lamp) |
)");
    CHECK(reference_markdown(chapter) == R"(# Small lamps

All of them.

## lamp

A lamp.

| parameter | type | unit | | limits |
|---|---|---|---|---|
| `size` | number | m | Its size. | at least 0.1 and at most 1e15 |
| `hue` | number |  | Its hue. | at least 0 and less than 1; default 0.25 |
| `bulbs` | whole number |  | How many bulbs. | at least 1 and at most 8; default 3 |
| `on` | true or false |  | Whether it is on. | default true |
| `colour` | colour |  | Its colour. | at least 0 and at most 1; default [0.5, 0.5, 0.5] |
| `towards` | [x, y, z], not all zero |  | Where it shines. | default [0, 0, 1] |
| `shape` | `"round"`, `"square"` |  | Its shape. | default "round" |
| `age` | number | s | Its age. | zero or more; default none |
| `file` | name of a file |  | Its picture. | default none |
)");
    // Several kinds have a table of contents, with the first sentence of each.
    KindPage torch = page;
    torch.name = "torch";
    torch.summary = "Burns. It needs air.";
    torch.parameters.clear();
    torch.example = "lamps/torch";
    torch.snippet = R"({"torch": {}})";
    const Chapter both{"Lamps", "Two of them.", {page, torch}};
    const std::string text = reference_markdown(both);
    CHECK(
        text.starts_with("# Lamps\n\nTwo of them.\n\n| | |\n|---|---|\n| [`lamp`](#lamp) | A lamp. |\n"
                         "| [`torch`](#torch) | Burns. |\n\n## lamp\n"));
    CHECK(
        text.ends_with("\n## torch\n\nBurns. It needs air.\n\n"
                       "[![An example of torch](lamps/torch.jpg)](lamps/torch.json)\n\n"
                       "```json\n{\"torch\": {}}\n```\n\nIt has no parameters.\n"));
    const Document schema = Document::from_text(schema_of(page));
    const Value properties = *schema.root().find("properties");
    CHECK(schema.root().find("required")->size() == 1);
    CHECK(!schema.root().find("additionalProperties")->boolean());
    // Instead of a number there may be keys.
    const auto number = [&](const char* name) { return (*properties.find(name)->find("anyOf"))[1]; };
    CHECK((*properties.find("size")->find("anyOf"))[0].find("$ref")->string() == "#/definitions/keys");
    CHECK(number("size").find("minimum")->number() == 0.1);
    CHECK(number("size").find("maximum")->number() == 1e15);
    CHECK(!properties.find("size")->find("default"));
    CHECK(number("hue").find("exclusiveMaximum")->number() == 1);
    CHECK(properties.find("hue")->find("default")->number() == 0.25);
    CHECK(properties.find("shape")->find("enum")->size() == 2);
    CHECK(properties.find("shape")->find("default")->string() == "round");
    CHECK(!properties.find("age")->find("default"));
}

}  // namespace test_kind
