// The numbers in a scene's text: which ones are listed, and how they are replaced.
#include "view/numbers.hpp"

#include <doctest/doctest.h>

namespace test_numbers {

using namespace phasetree;
using namespace phasetree::tracer::view;

namespace {

Document document(const std::string& text) {
    return Document::from_text(text, "scene.json");
}

}  // namespace

TEST_CASE("every number is listed by its pointer, with its line, but for the version") {
    const auto found =
        numbers_of(document("{\"version\": 1, // 2\n\"a/b\": {\"c~d\": [3,\r\n 4.5e1]},\r\"e\": [{\"f\": -0.25}]}"));
    REQUIRE(found.numbers.size() == 3);
    CHECK(found.numbers[0].pointer == "/a~1b/c~0d/0");
    CHECK(found.numbers[0].line == 2);
    CHECK(found.numbers[1].pointer == "/a~1b/c~0d/1");
    CHECK(found.numbers[1].line == 3);
    CHECK(found.numbers[1].value == 45);
    CHECK(found.numbers[2].pointer == "/e/0/f");
    CHECK(found.numbers[2].line == 4);
    CHECK_FALSE(found.has_more);
}

TEST_CASE("members that have numbers in them are known by where their keys begin") {
    const std::string text = R"({"tree": {"set": {"phase": "a", "of": {"sphere": {"radius": 1}}}}, "name": "b"})";
    const auto found = numbers_of(document(text));
    const auto pointer = [&](const char* key) {
        const auto member = found.members.find(text.find(key));
        return member == found.members.end() ? std::string("none") : member->second;
    };
    CHECK(pointer("\"sphere\"") == "/tree/set/of/sphere");
    CHECK(pointer("\"set\"") == "/tree/set");
    CHECK(pointer("\"phase\"") == "none");
    CHECK(pointer("\"name\"") == "none");
}

TEST_CASE("of a file of very many numbers the first are listed") {
    std::string text = "{\"list\": [0";
    for (std::size_t i = 0; i < TextNumbers::most; ++i) text += ", 1";
    const auto found = numbers_of(document(text + "]}"));
    CHECK(found.numbers.size() == TextNumbers::most);
    CHECK(found.has_more);
}

TEST_CASE("numbers are replaced, and all else of the text stays") {
    const Document text = document("{ /* 1 */ \"a\": [1, 20.50, 3],\n\t\"b\": {\"c\": -1e2} } // end");
    CHECK(with_numbers(text, {}) == text.text());
    CHECK(with_numbers(text, {{"/a/1", 20.5}}) == text.text());
    CHECK(with_numbers(text, {{"/a/0", 0.1}, {"/a/1", 7}, {"/b/c", 0.001}}) ==
          "{ /* 1 */ \"a\": [0.1, 7, 3],\n\t\"b\": {\"c\": 0.001} } // end");
    // And what stands behind them is found again.
    const NumberEdits edits{{"/a/0", 0.125}, {"/a/1", 7}, {"/b/c", 0.001}};
    const std::string edited = with_numbers(text, edits);
    for (const char* const word : {"/* 1 */", "\"a\"", "3]", "\"b\"", "// end"})
        CHECK(offset_in_original(text, edits, edited.find(word)) == text.text().find(word));
    CHECK(offset_in_original(text, {}, 5) == 5);
    // What the file no longer has counts for nothing.
    CHECK(with_numbers(text, {{"/a/3", 1}, {"/b", 2}, {"/b/d", 3}, {"", 4}}) == text.text());
}

}  // namespace test_numbers
