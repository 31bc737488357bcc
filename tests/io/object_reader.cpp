// Typed access to the members of an object: the values, and messages about mistakes.

#include "phasetree/io/object_reader.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <string>
#include <vector>

namespace test_object_reader {

using phasetree::as;
using phasetree::Document;
using phasetree::ObjectReader;
using phasetree::Range;
using phasetree::SceneError;
using phasetree::Value;

namespace {

struct Bad {
    std::string text;
    std::function<void(ObjectReader&)> read;
    std::size_t line, column;
    std::string message;
    std::string suggestion = {};
};

template <class T>
auto required(std::string key, Range range = {}) {
    return [=](ObjectReader& reader) { reader.required<T>(key, range); };
}

auto colour(Range range = Range::not_negative()) {
    return [=](ObjectReader& reader) { reader.required_colour("c", range); };
}

void finish_sphere(ObjectReader& reader) {
    reader.optional<float>("radius", 1.0f);
    (void)reader.value("center");
    reader.allow({"material"});
    reader.finish();
}

const std::vector<Bad>& bad_objects() {
    static const std::string either = "\"c\" must be [r, g, b] or \"#rrggbb\", but ";
    static const std::vector<Bad> table = {
        // Keys.
        {"\n {}", required<float>("radius"), 2, 2, "the sphere needs \"radius\""},
        {"{\n \"raduis\": 1}", required<float>("radius"), 2, 2, "the sphere needs \"radius\", but has \"raduis\"",
         "radius"},
        {"{\n \"raduis\": 1}", finish_sphere, 2, 2, "unknown key \"raduis\" in the sphere", "radius"},
        {"{\"color\": 1}", finish_sphere, 1, 2,
         "unknown key \"color\" in the sphere; the keys are \"radius\", \"center\", \"material\""},
        {"{\"radius\": 2, \"Center\": 1, \"x\": 2}", finish_sphere, 1, 15, "unknown key \"Center\" in the sphere",
         "center"},
        {"{\"center\": 1, \"centre\": 1}", finish_sphere, 1, 15,
         "the sphere has both \"center\" and \"centre\"; remove one of them"},
        {"{\"x\": 1}", [](ObjectReader& reader) { reader.finish(); }, 1, 2, "unknown key \"x\" in the sphere"},
        // Kinds.
        {"{\"r\": \"1\"}", required<float>("r"), 1, 7, "\"r\" must be a number, but is a string"},
        {"{\"r\": null}", required<double>("r"), 1, 7, "\"r\" must be a number, but is null"},
        {"{\"r\": [1]}", required<int>("r"), 1, 7, "\"r\" must be a whole number, but is an array"},
        {"{\"r\": 1}", required<bool>("r"), 1, 7, "\"r\" must be true or false, but is a number"},
        {"{\"r\": true}", required<std::string>("r"), 1, 7, "\"r\" must be a string, but is a boolean"},
        {"{\"r\": {}}", required<glm::vec3>("r"), 1, 7, "\"r\" must be three numbers [x, y, z], but is an object"},
        {"{\"r\": [1, 2]}", required<glm::vec3>("r"), 1, 7, "\"r\" must be three numbers [x, y, z], but has 2"},
        {"{\"r\": []}", required<glm::vec2>("r"), 1, 7, "\"r\" must be two numbers [x, y], but has 0"},
        {"{\"r\": [1, 2, 3, 4]}", required<glm::dvec3>("r"), 1, 7, "\"r\" must be three numbers [x, y, z], but has 4"},
        {"{\"r\": [1, \"x\"]}", required<glm::vec2>("r"), 1, 11, "item 2 of \"r\" must be a number, but is a string"},
        {"{\"r\": 1}", required<std::vector<int>>("r"), 1, 7, "\"r\" must be an array, but is a number"},
        {"{\"r\": [1,\n 2.5]}", required<std::vector<int>>("r"), 2, 2,
         "item 2 of \"r\" must be a whole number, but is 2.5"},
        {"{\"r\": [[1, 2], [3, null]]}", required<std::vector<glm::vec2>>("r"), 1, 20,
         "item 2 of item 2 of \"r\" must be a number, but is null"},
        // Ranges.
        {"{\"r\": -1}", required<float>("r", Range::positive()), 1, 7, "\"r\" must be positive, but is -1"},
        {"{\"r\": 0.0}", required<float>("r", Range::positive()), 1, 7, "\"r\" must be positive, but is 0.0"},
        {"{\"r\": -0.5}", required<double>("r", Range::not_negative()), 1, 7,
         "\"r\" must be zero or more, but is -0.5"},
        {"{\"r\": 2}", required<double>("r", Range::between(0, 1)), 1, 7,
         "\"r\" must be at least 0 and at most 1, but is 2"},
        {"{\"r\": 180}", required<double>("r", {.min = 0, .max = 180, .min_is_open = true, .max_is_open = true}), 1, 7,
         "\"r\" must be more than 0 and less than 180, but is 180"},
        {"{\"r\": 0}", required<int>("r", Range::at_least(1)), 1, 7, "\"r\" must be at least 1, but is 0"},
        {"{\"r\": 1}", required<int>("r", Range::above(1)), 1, 7, "\"r\" must be more than 1, but is 1"},
        {"{\"r\": 9}", required<int>("r", Range::at_most(8)), 1, 7, "\"r\" must be at most 8, but is 9"},
        {"{\"r\": 8}", required<int>("r", Range::below(8)), 1, 7, "\"r\" must be less than 8, but is 8"},
        {"{\"r\": [1, 0, 1]}", required<glm::vec3>("r", Range::positive()), 1, 11,
         "item 2 of \"r\" must be positive, but is 0"},
        {"{\"r\": [[1, 2], [3, -4]]}", required<std::vector<glm::dvec2>>("r", Range::positive()), 1, 20,
         "item 2 of item 2 of \"r\" must be positive, but is -4"},
        // What does not fit its type.
        {"{\"r\": 1e300}", required<float>("r"), 1, 7, "\"r\" must be at most 3.4028235e+38, but is 1e300"},
        {"{\"r\": -1e300}", required<float>("r"), 1, 7, "\"r\" must be at least -3.4028235e+38, but is -1e300"},
        {"{\"r\": 1e-60}", required<float>("r", Range::positive()), 1, 7,
         "\"r\" must be positive as a 32-bit float, but is 1e-60"},
        // Subnormal numbers are zero where rays are traced.
        {"{\"r\": 1e-39}", required<float>("r", Range::positive()), 1, 7,
         "\"r\" must be positive as a 32-bit float, but is 1e-39"},
        {"{\"r\": 1.5}", required<int>("r"), 1, 7, "\"r\" must be a whole number, but is 1.5"},
        {"{\"r\": 2147483648}", required<int>("r"), 1, 7, "\"r\" must be at most 2147483647, but is 2147483648"},
        {"{\"r\": -2147483649}", required<int>("r"), 1, 7, "\"r\" must be at least -2147483648, but is -2147483649"},
        {"{\"r\": -1}", required<unsigned>("r"), 1, 7, "\"r\" must be at least 0, but is -1"},
        {"{\"r\": 1e300}", required<unsigned>("r"), 1, 7, "\"r\" must be at most 4294967295, but is 1e300"},
        // Colours.
        {"{}", colour(), 1, 1, "the sphere needs \"c\""},
        {"{\"c\": 1}", colour(), 1, 7, either + "is a number"},
        {"{\"c\": [1, 2]}", colour(), 1, 7, either + "has 2"},
        {"{\"c\": \"red\"}", colour(), 1, 7, either + "is \"red\""},
        {"{\"c\": \"#12345g\"}", colour(), 1, 7, either + "is \"#12345g\""},
        {"{\"c\": \"#123\"}", colour(), 1, 7, either + "is \"#123\""},
        {"{\"c\": [1, 2, -3]}", colour(), 1, 14, "item 3 of \"c\" must be zero or more, but is -3"},
        {"{\"c\": [0, 0, 2]}", colour(Range::between(0, 1)), 1, 14,
         "item 3 of \"c\" must be at least 0 and at most 1, but is 2"},
        {"{\"c\": \"#ff00ff\"}", colour(Range::positive()), 1, 7,
         "\"c\" must be positive in each component, but #ff00ff is 0 in linear light"},
    };
    return table;
}

}  // namespace

TEST_CASE("a wrong object is told with its place and plain words") {
    for (const Bad& bad : bad_objects()) {
        CAPTURE(bad.text);
        CAPTURE(bad.message);
        const Document document = Document::from_text(bad.text, "bad.json");
        try {
            ObjectReader reader(document, document.root(), "the sphere");
            bad.read(reader);
            FAIL_CHECK("was accepted");
        } catch (const SceneError& error) {
            CHECK(error.line() == bad.line);
            CHECK(error.column() == bad.column);
            CHECK(error.message() == bad.message);
            CHECK(error.suggestion().value_or("") == bad.suggestion);
        }
    }
}

TEST_CASE("every type is read") {
    const Document document = Document::from_text(R"({
        "float": 0.1, "double": 0.1, "int": -7, "unsigned": 4294967295, "bool": true, "string": "é",
        "vec2": [1, 2], "vec3": [1, 2, 3], "vec4": [1, 2, 3, 4], "dvec3": [0.1, 0.2, 0.3],
        "ints": [1, 2.0, 3e0], "strings": ["a", "b"], "points": [[1, 2, 3], [4, 5, 6]], "flags": [true, false],
        "largest": 3.4028234663852886e38, "none": []
    })");
    ObjectReader reader(document, document.root(), "the test");
    CHECK(reader.required<float>("float") == 0.1f);
    CHECK(reader.required<double>("double") == 0.1);
    CHECK(reader.required<int>("int") == -7);
    CHECK(reader.required<unsigned>("unsigned") == 4294967295u);
    CHECK(reader.required<bool>("bool"));
    CHECK(reader.required<std::string>("string") == "é");
    CHECK(reader.required<glm::vec2>("vec2") == glm::vec2(1, 2));
    CHECK(reader.required<glm::vec3>("vec3") == glm::vec3(1, 2, 3));
    CHECK(reader.required<glm::vec4>("vec4") == glm::vec4(1, 2, 3, 4));
    CHECK(reader.required<glm::dvec3>("dvec3") == glm::dvec3(0.1, 0.2, 0.3));
    CHECK(reader.required<std::vector<int>>("ints") == std::vector<int>{1, 2, 3});
    CHECK(reader.required<std::vector<std::string>>("strings") == std::vector<std::string>{"a", "b"});
    CHECK(reader.required<std::vector<glm::vec3>>("points") == std::vector{glm::vec3(1, 2, 3), glm::vec3(4, 5, 6)});
    CHECK(reader.required<std::vector<bool>>("flags") == std::vector<bool>{true, false});
    CHECK(reader.required<float>("largest") == std::numeric_limits<float>::max());
    CHECK(reader.required<std::vector<double>>("none").empty());
    CHECK_NOTHROW(reader.finish());
}

TEST_CASE("optional, maybe, value and allow") {
    const Document document = Document::from_text(R"({"a": 1, "b": {"c": 2}, "d": null})");
    ObjectReader reader(document, document.root(), "the test");
    CHECK(reader.optional("a", 5) == 1);
    CHECK(reader.optional("z", 5) == 5);
    CHECK(reader.optional<std::string>("y", "fallback") == "fallback");
    CHECK(reader.maybe<int>("a") == 1);
    CHECK_FALSE(reader.maybe<int>("x"));
    CHECK(reader.required_value("b").find("c")->number() == 2);
    CHECK_FALSE(reader.value("w"));
    CHECK_THROWS_AS(reader.finish(), SceneError);
    reader.allow({"d", "e"});
    CHECK_NOTHROW(reader.finish());
    CHECK(reader.what() == "the test");
    CHECK(reader.object().offset() == 0);
}

TEST_CASE("an object must be one") {
    const Document document = Document::from_text("[[1]]", "f");
    CHECK_THROWS_WITH_AS(ObjectReader(document, document.root()[0], "the camera"),
                         "f:1:2: the camera must be an object, but is an array\n  [[1]]\n   ^", SceneError);
}

TEST_CASE("a value is read without an object") {
    const Document document = Document::from_text("[1, 2]", "f");
    CHECK(as<glm::vec2>(document, document.root(), "the size") == glm::vec2(1, 2));
    CHECK_THROWS_WITH_AS(as<glm::vec3>(document, document.root(), "the size"),
                         "f:1:1: the size must be three numbers [x, y, z], but has 2\n  [1, 2]\n  ^", SceneError);
}

TEST_CASE("colours: linear numbers, or sRGB in hexadecimal") {
    const Document document = Document::from_text(R"({"a": [0.25, 2, 0], "b": "#0080Ff", "c": "#0a0b00"})");
    ObjectReader reader(document, document.root(), "the test");
    CHECK(reader.required_colour("a") == glm::vec3(0.25f, 2, 0));
    const glm::vec3 b = reader.required_colour("b");
    CHECK(b.x == 0);
    // ((128/255 + 0.055) / 1.055)^2.4
    CHECK(b.y == doctest::Approx(0.21586050011389926).epsilon(1e-6));
    CHECK(b.z == 1);
    const glm::vec3 c = reader.optional_colour("c", glm::vec3(9));
    CHECK(c.x == doctest::Approx(10 / 255.0 / 12.92).epsilon(1e-6));                           // the linear piece
    CHECK(c.y == doctest::Approx(std::pow((11 / 255.0 + 0.055) / 1.055, 2.4)).epsilon(1e-6));  // and the first beyond
    CHECK(reader.optional_colour("d", glm::vec3(9)) == glm::vec3(9));
    CHECK_NOTHROW(reader.finish());
}

}  // namespace test_object_reader
