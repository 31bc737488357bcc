// Operations on the text of a scene, by examples: how they lay out what they write, and what is impossible.
#include "studio/operation.hpp"

#include <doctest/doctest.h>

#include <initializer_list>
#include <string>

#include "studio/vocabulary.hpp"

namespace test_operations {

using namespace phasetree;
using namespace phasetree::tracer::studio;

namespace {

const Vocabulary& vocabulary() {
    static const Vocabulary words;
    return words;
}

std::string after(const std::string& text, const Operation& operation) {
    std::string result = applied(Document::from_text(text), operation, vocabulary());
    (void)Document::from_text(result);  // valid, without trailing commas
    return result;
}

// The error of an operation; empty if there is none.
std::string error_of(const std::string& text, const Operation& operation) {
    try {
        (void)after(text, operation);
        return "";
    } catch (const SceneError& e) {
        return e.what();
    }
}

std::string in_lines(std::initializer_list<const char*> lines) {
    std::string text;
    for (const char* const line : lines) text += std::string(text.empty() ? "" : "\n") + line;
    return text;
}

}  // namespace

TEST_CASE("a new item of a list is written in the style of its neighbours") {
    const InsertValue append{"/of/-", R"({"sphere":{"radius":1.50}})"},
        prepend{"/of/0", R"({"sphere":{"radius":1.50}})"};
    SUBCASE("on one line") {
        CHECK(after(R"({"of": [{"box": {}}]})", append) == R"({"of": [{"box": {}}, {"sphere": {"radius": 1.50}}]})");
        CHECK(after(R"({"of": [{"box": {}}]})", prepend) == R"({"of": [{"sphere": {"radius": 1.50}}, {"box": {}}]})");
        CHECK(after(R"({"of": []})", append) == R"({"of": [{"sphere": {"radius": 1.50}}]})");
    }
    SUBCASE("on lines of their own") {
        const std::string text = in_lines({"{", "  \"of\": [", "    1,  // one", "    // two", "    2", "  ]", "}"});
        CHECK(after(text, append) == in_lines({"{", "  \"of\": [", "    1,  // one", "    // two", "    2,",
                                               "    {\"sphere\": {\"radius\": 1.50}}", "  ]", "}"}));
        CHECK(after(text, prepend) == in_lines({"{", "  \"of\": [", "    {\"sphere\": {\"radius\": 1.50}},",
                                                "    1,  // one", "    // two", "    2", "  ]", "}"}));
        CHECK(after(text, InsertValue{"/of/1", "0"}) ==
              in_lines({"{", "  \"of\": [", "    1,  // one", "    0,", "    // two", "    2", "  ]", "}"}));
    }
    SUBCASE("aligned with the first") {
        const std::string text = in_lines({R"({"of": [{"a": 1},)", R"(        {"b": 2}]})"});
        CHECK(after(text, append) ==
              in_lines({R"({"of": [{"a": 1},)", R"(        {"b": 2},)", R"(        {"sphere": {"radius": 1.50}}]})"}));
        CHECK(after(text, prepend) ==
              in_lines({R"({"of": [{"sphere": {"radius": 1.50}},)", R"(        {"a": 1},)", R"(        {"b": 2}]})"}));
    }
    SUBCASE("into an empty list of a text of several lines") {
        const std::string text = in_lines({"{", "\t\"of\": []", "}"});
        CHECK(after(text, append) ==
              in_lines({"{", "\t\"of\": [", "\t\t{\"sphere\": {\"radius\": 1.50}}", "\t]", "}"}));
        CHECK(after(text, InsertValue{"/of/0", "1"}) == in_lines({"{", "\t\"of\": [1]", "}"}));
        CHECK(after(in_lines({"{", "  \"of\": [  // none yet", "  ]", "}"}), append) ==
              in_lines({"{", "  \"of\": [  // none yet", "    {\"sphere\": {\"radius\": 1.50}}", "  ]", "}"}));
    }
    SUBCASE("after a comment on the last line") {
        CHECK(after("[\n  1 // one\n]", InsertValue{"/1", "2"}) == "[\n  1, // one\n  2\n]");
        CHECK(after("[\n  1 /* one */ ]", InsertValue{"/-", "2"}) == "[\n  1, /* one */\n  2 ]");
    }
    SUBCASE("a long one is broken as its readers expect") {
        const std::string long_value =
            R"({"over":[{"set":{"phase":"water","of":{"cylinder":{"radius":0.25,"height":0.5}}}},{"set":{"phase":"glass","of":{"sphere":{"radius":0.125}}}}]})";
        CHECK(after("{\n  \"of\": []\n}", InsertValue{"/of/-", long_value}) ==
              in_lines({"{", "  \"of\": [", "    {\"over\": [",
                        R"(      {"set": {"phase": "water", "of": {"cylinder": {"radius": 0.25, "height": 0.5}}}},)",
                        R"(      {"set": {"phase": "glass", "of": {"sphere": {"radius": 0.125}}}})", "    ]}", "  ]",
                        "}"}));
    }
}

TEST_CASE("new members go to the end of an object, and removed ones leave no commas and no empty lines") {
    CHECK(after(R"({"a": 1})", SetValue{"/b", "2"}) == R"({"a": 1, "b": 2})");
    CHECK(after("{\n  \"a\": 1\n}\n", SetValue{"/b", "[1,2]"}) == "{\n  \"a\": 1,\n  \"b\": [1, 2]\n}\n");
    CHECK(after("{}", InsertValue{"/a~1b~0", "true"}) == R"({"a/b~": true})");
    CHECK(after("{\r\n  \"a\": 1\r\n}", SetValue{"/b", "2"}) == "{\r\n  \"a\": 1,\r\n  \"b\": 2\r\n}");
    CHECK(after(R"({"a": 1, "b": 2, "c": 3})", RemoveValue{"/b"}) == R"({"a": 1, "c": 3})");
    CHECK(after(R"({"a": 1, "b": 2, "c": 3})", RemoveValue{"/c"}) == R"({"a": 1, "b": 2})");
    CHECK(after(R"({"a": 1, "b": 2})", RemoveValue{"/a"}) == R"({"b": 2})");
    CHECK(after(R"({"a": 1 })", RemoveValue{"/a"}) == "{}");
    CHECK(after("[\n  1,\n  2\n]", RemoveValue{"/1"}) == "[\n  1\n]");
    CHECK(after("[\n  1,\n  2\n]", RemoveValue{"/0"}) == "[\n  2\n]");
    CHECK(after("[\n  1\n]", RemoveValue{"/0"}) == "[]");
    SUBCASE("comments stay") {
        CHECK(after("[\n  1, // one\n  2\n]", RemoveValue{"/1"}) == "[\n  1 // one\n]");
        CHECK(after("[\n  1, // one\n  2\n]", RemoveValue{"/0"}) == "[\n  // one\n  2\n]");
        CHECK(after("[\n  // one\n  1,\n  // two\n  2\n]", RemoveValue{"/0"}) == "[\n  // one\n  // two\n  2\n]");
        CHECK(after("[\n  // one\n  1\n]", RemoveValue{"/0"}) == "[\n  // one\n]");
    }
}

TEST_CASE("numbers keep their notation, and what is set is as short as it was given") {
    CHECK(after(R"({"r": 0.30, "s": 1e-3})", SetValue{"/r", "0.350"}) == R"({"r": 0.350, "s": 1e-3})");
    CHECK(after(R"({"r": /* m */ 0.30 // half
})",
                SetValue{"/r", "2"}) == "{\"r\": /* m */ 2 // half\n}");
    CHECK(after(" // all\n 1 // end\n", SetValue{"", "{\"a\":1}"}) == " // all\n {\"a\": 1} // end\n");
}

TEST_CASE("a value is wrapped and unwrapped on the spot") {
    const std::string flat = R"({"tree": {"sphere": {"radius": 0.5}}})";
    const WrapValue wrap{"/tree", R"({"translate": {"by": [0, 0, 1], "of": null}})"};
    const std::string wrapped = R"({"tree": {"translate": {"by": [0, 0, 1], "of": {"sphere": {"radius": 0.5}}}}})";
    CHECK(after(flat, wrap) == wrapped);
    CHECK(after(wrapped, UnwrapValue{"/tree", "/tree/translate/of"}) == flat);
    const std::string block = in_lines({"{", "  \"tree\": {\"over\": [", "    1, // one", "    2", "  ]}", "}"});
    const std::string block_wrapped =
        in_lines({"{", "  \"tree\": {\"translate\": {\"by\": [0, 0, 1], \"of\": {\"over\": [", "    1, // one", "    2",
                  "  ]}}}", "}"});
    CHECK(after(block, wrap) == block_wrapped);
    CHECK(after(block_wrapped, UnwrapValue{"/tree", "/tree/translate/of"}) == block);
    const std::string aligned = in_lines({R"({"tree": {"over": [1,)", R"(                   2]}})"});
    const std::string aligned_wrapped =
        in_lines({R"({"tree": {"translate": {"by": [0, 0, 1], "of": {"over": [1,)",
                  R"(                                                         2]}}}})"});
    CHECK(after(aligned, wrap) == aligned_wrapped);
    CHECK(after(aligned_wrapped, UnwrapValue{"/tree", "/tree/translate/of"}) == aligned);
    const std::string union_of_two = in_lines({"{", "  \"tree\": {\"union\": [", "    {\"box\": {}},",
                                               "    {\"sphere\": {", "      \"radius\": 1", "    }}", "  ]}", "}"});
    CHECK(after(union_of_two, UnwrapValue{"/tree", "/tree/union/1"}) ==
          in_lines({"{", "  \"tree\": {\"sphere\": {", "    \"radius\": 1", "  }}", "}"}));
}

TEST_CASE("a moved value takes its lines along and the indentation of where it goes") {
    const std::string text = in_lines({"{", "  \"a\": [", "    {", "      \"x\": 1 // here", "    },", "    2", "  ],",
                                       "  \"b\": {", "    \"c\": [", "      3", "    ]", "  }", "}"});
    CHECK(after(text, MoveValue{"/a/0", "/b/c/1"}) ==
          in_lines({"{", "  \"a\": [", "    2", "  ],", "  \"b\": {", "    \"c\": [", "      3,", "      {",
                    "        \"x\": 1 // here", "      }", "    ]", "  }", "}"}));
    CHECK(after("[1, 2, 3]", MoveValue{"/0", "/2"}) == "[2, 3, 1]");
    CHECK(after("[1, 2, 3]", MoveValue{"/2", "/0"}) == "[3, 1, 2]");
    CHECK(after("[1, 2, 3]", MoveValue{"/0", "/-"}) == "[2, 3, 1]");
}

TEST_CASE("renaming a phase or a shape renames its uses, and nothing else that is spelt alike") {
    const std::string text = R"({"version": 1,
"phases": {"glass": {"clear": {"ior": 1.5}}, "water": {"clear": {"glass": "water"}}},
"shapes": {"glass": {"sphere": {"radius": 1}}},
"tree": {"over": [{"set": {"phase": "glass", "of": "glass"}}, {"remove": {"phases": ["glass", "water"], "of": {"set": {"phase": "water", "of": {"union": ["glass"]}}}}}]},
"expect": [{"present": {"phase": "glass"}}, {"apart": {"phases": ["glass", "water"], "at_least": 1}}]})";
    std::string phases = after(text, RenameKey{"/phases/glass", "crystal", true});
    CHECK(phases == R"({"version": 1,
"phases": {"crystal": {"clear": {"ior": 1.5}}, "water": {"clear": {"glass": "water"}}},
"shapes": {"glass": {"sphere": {"radius": 1}}},
"tree": {"over": [{"set": {"phase": "crystal", "of": "glass"}}, {"remove": {"phases": ["crystal", "water"], "of": {"set": {"phase": "water", "of": {"union": ["glass"]}}}}}]},
"expect": [{"present": {"phase": "crystal"}}, {"apart": {"phases": ["crystal", "water"], "at_least": 1}}]})");
    const std::string shapes = after(text, RenameKey{"/shapes/glass", "ball", true});
    CHECK(shapes.find(R"("shapes": {"ball": )") != std::string::npos);
    CHECK(shapes.find(R"({"set": {"phase": "glass", "of": "ball"}})") != std::string::npos);
    CHECK(shapes.find(R"({"union": ["ball"]})") != std::string::npos);
    CHECK(after(text, RenameKey{"/phases/glass", "crystal", false}).find(R"("phase": "crystal")") == std::string::npos);
}

TEST_CASE("what is impossible is said with its place") {
    const std::string text = "{\n  \"radius\": 1, \"of\": [1]\n}";
    CHECK(error_of(text, SetValue{"/raduis/x", "1"}).find("<text>:1:1: there is no \"raduis\" here") == 0);
    CHECK(error_of(text, SetValue{"/raduis/x", "1"}).find("did you mean \"radius\"?") != std::string::npos);
    CHECK(error_of(text, RemoveValue{"/of/1"}).find("<text>:2:22: the list has 1 item,") == 0);
    CHECK(error_of(text, InsertValue{"/radius", "1"}).find("<text>:2:3: there is a \"radius\" already") == 0);
    CHECK(error_of(text, InsertValue{"/of/01", "1"}) != "");
    CHECK(error_of(text, InsertValue{"/of/18446744073709551616", "1"}) != "");
    CHECK(error_of(text, SetValue{"/of/-", "1"}) != "");
    CHECK(error_of(text, SetValue{"/radius", "1,"}).find("<value>:1:") == 0);
    CHECK(error_of(text, MoveValue{"/of", "/of/0"}).find("into itself") != std::string::npos);
    CHECK(error_of(text, RemoveValue{""}) != "");
    CHECK(error_of(text, RemoveValue{"of"}).find("not a JSON pointer") != std::string::npos);
    CHECK(error_of(text, RemoveValue{"/a~"}).find("not a JSON pointer") != std::string::npos);
    CHECK(error_of(text, WrapValue{"/of", "{}"}).find("one null") != std::string::npos);
    CHECK(error_of(text, WrapValue{"/of", "[null, null]"}).find("one null") != std::string::npos);
    CHECK(error_of(text, UnwrapValue{"/of", "/radius"}).find("is not inside") != std::string::npos);
    CHECK(error_of(text, RenameKey{"/radius", "of"}) != "");
    CHECK(error_of(text, RenameKey{"/of/0", "a"}) != "");
    CHECK(error_of(text, RenameKey{"/radius", "a", true}).find("only for phases and shapes") != std::string::npos);
}

}  // namespace test_operations
