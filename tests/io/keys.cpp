// Animated numbers, vectors and colours: their values at a time, and messages about wrong keys.

#include "phasetree/io/keys.hpp"

#include <doctest/doctest.h>

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "phasetree/io/object_reader.hpp"

namespace test_keys {

using namespace phasetree;

namespace {

template <class T>
T at(const std::string& text, double seconds, const Range& range = {}) {
    const Document document = Document::from_text(text, "keys.json").at(seconds);
    return as<T>(document, document.root(), "\"x\"", range);
}

}  // namespace

TEST_CASE("a number between keys") {
    const std::string keys = R"({"keys": [[-1, 10], [1, 20], [2, -4]]})";
    CHECK(at<double>(keys, -7) == 10);
    CHECK(at<double>(keys, -1) == 10);
    CHECK(at<double>(keys, 0) == 15);
    CHECK(at<double>(keys, 1) == 20);
    CHECK(at<double>(keys, 1.25) == 14);
    CHECK(at<double>(keys, 2) == -4);
    CHECK(at<double>(keys, 1e300) == -4);
    CHECK(at<float>(keys, 0.5) == 17.5f);
    const std::string smooth = R"({"between": "smooth", "keys": [[0, 0], [4, 32]]})";
    CHECK(at<double>(smooth, 0) == 0);
    CHECK(at<double>(smooth, 1) == 5);  // 3/16 − 2/64 of the way
    CHECK(at<double>(smooth, 2) == 16);
    CHECK(at<double>(smooth, 3) == 27);
    CHECK(at<double>(R"({"keys": [[-1e308, 1], [1e308, 3]]})", 0) == 2);
}

TEST_CASE("a value that stays stays to the bit, and none leaves the range of its keys") {
    const std::string same = R"({"keys": [[0, 0.1], [3, 0.1]]})";
    for (int i = 0; i < 100; ++i) CHECK(at<float>(same, 0.03 * i) == 0.1f);
    const std::string rises = R"({"keys": [[0, 0.1], [3, 0.7]]})";
    for (int i = 0; i <= 1000; ++i) {
        const float x = at<float>(rises, 0.003 * i, Range::positive());
        CHECK(x >= 0.1f);
        CHECK(x <= 0.7f);
    }
}

TEST_CASE("vectors as a whole and by their numbers, colours in either form, lists by their items") {
    CHECK(at<glm::vec3>(R"({"keys": [[0, [1, 2, 3]], [2, [3, 2, 1]]]})", 1) == glm::vec3(2, 2, 2));
    CHECK(at<glm::vec2>(R"([5, {"keys": [[0, 0], [2, 1]]}])", 1) == glm::vec2(5, 0.5f));
    CHECK(at<std::vector<float>>(R"([1, {"keys": [[0, 0], [2, 1]]}])", 1) == std::vector<float>{1, 0.5f});
    const Document document = Document::from_text(R"({"keys": [[0, "#ffffff"], [2, [0, 0.5, 1]]]})").at(1);
    CHECK(as_colour(document, document.root(), "\"x\"") == glm::vec3(0.5f, 0.75f, 1));
}

TEST_CASE("many keys, and the times of all within a value") {
    std::string keys = "[0, 0]";
    for (int i = 1; i < 5000; ++i) keys += ", [" + std::to_string(i) + ", " + std::to_string(i * i) + "]";
    CHECK(at<double>("{\"keys\": [" + keys + "]}", 4321.5) == (4321.0 * 4321 + 4322.0 * 4322) / 2);
    const Document document =
        Document::from_text(R"([{"a": {"keys": [[1, 0], [2, 0]]}}, [0, {"keys": [[-3, {"b": []}], [1, 0]]}]])");
    CHECK(times_of_keys(document.root()) == std::vector<double>{1, 2, -3, 1});
}

TEST_CASE("what is wrong with keys is told with its place") {
    struct Bad {
        std::string text;
        std::size_t column;
        std::string message;
    };
    const std::vector<Bad> table{
        {R"({"keys": 1})", 10, "\"keys\" must be a list of two or more [seconds, value]"},
        {R"({"keys": [[0, 1]]})", 10, "\"keys\" must be a list of two or more [seconds, value]"},
        {R"({"keys": [[0, 1], 2]})", 19, "a key must be [seconds, value]"},
        {R"({"keys": [[0, 1], [1, 2, 3]]})", 19, "a key must be [seconds, value]"},
        {R"({"keys": [[1, 1], [0.5, 2]]})", 20,
         "a key must be later than the one before it, but 0.5 s comes after 1 s"},
        {R"({"keys": [[1, 1], [1, 2]]})", 20, "a key must be later than the one before it, but 1 s comes after 1 s"},
        {R"({"keys": [["a", 1], [1, 2]]})", 12, "the time of a key must be a number, but is a string"},
        {R"({"keys": [[0, 1], [NaN, 2]]})", 20, ""},
        {R"({"keys": [[0, 1], [1e999, 2]]})", 20, ""},
        {R"({"keys": [[0, 1], [1, -2]]})", 23, "\"x\" must be positive, but is -2"},
        {R"({"keys": [[0, 1], [1, [2]]]})", 23, "\"x\" must be a number, but is an array"},
        {R"({"keys": [[0, 1], [1, {"keys": []}]]})", 23, "the value of a key must not have keys"},
        {R"({"keys": [[0, 1], [1, 2]], "between": "smoth"})", 39,
         "\"between\" must be \"linear\" or \"smooth\", but is \"smoth\""},
        {R"({"keys": [[0, 1], [1, 2]], "ease": 1})", 28, "unknown key \"ease\" in the animated value"},
        {R"({"key": [[0, 1], [1, 2]]})", 1, "\"x\" must be a number, but is an object"}};
    for (const Bad& bad : table) {
        CAPTURE(bad.text);
        try {
            (void)at<float>(bad.text, 0, Range::positive());
            CHECK_MESSAGE(false, "there was no error");
        } catch (const SceneError& e) {
            CHECK(e.line() == 1);
            CHECK(e.column() == bad.column);
            CHECK(std::string(e.what()).find(bad.message) != std::string::npos);
            CAPTURE(e.what());
        }
    }
    std::string many = "[-1, 0]";
    for (std::size_t i = 0; i < Keys::most; ++i) many += ",[" + std::to_string(i) + ",0]";
    CHECK_THROWS_WITH_AS((void)at<float>("{\"keys\":[" + many + "]}", 0),
                         doctest::Contains("\"keys\" has 100001 keys; the limit is 100000"), SceneError);
}

}  // namespace test_keys
