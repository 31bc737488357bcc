// The appearance of an error: a line that names the position, the source line, and a caret under the position.

#include "phasetree/io/error.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace test_error {

using phasetree::SceneError;

namespace {

std::string shown(std::string_view text, std::size_t offset) {
    return SceneError("f", text, offset, "m").what();
}

std::size_t code_points(std::string_view text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

}  // namespace

TEST_CASE("with and without a position, with and without a suggestion") {
    CHECK(std::string(SceneError("scene.json", "no such file").what()) == "scene.json: no such file");
    CHECK(std::string(SceneError("a", "no such file", "b").what()) == "a: no such file (did you mean \"b\"?)");
    const SceneError error("scene.json", "{\n  \"raduis\": 2\n}", 4, "unknown key", "radius");
    CHECK(std::string(error.what()) ==
          "scene.json:2:3: unknown key (did you mean \"radius\"?)\n    \"raduis\": 2\n    ^");
    CHECK(error.file() == "scene.json");
    CHECK(error.line() == 2);
    CHECK(error.column() == 3);
    CHECK(error.message() == "unknown key");
    CHECK(error.quoted_line() == "  \"raduis\": 2");
    CHECK(error.suggestion() == "radius");
    const SceneError copy = error;
    CHECK(std::string(copy.what()) == error.what());
}

TEST_CASE("line ends, tabs, the byte order mark, and the end of the text") {
    CHECK(shown("a\nb\nc", 2) == "f:2:1: m\n  b\n  ^");
    CHECK(shown("a\r\nb\r\nc", 3) == "f:2:1: m\n  b\n  ^");
    CHECK(shown("a\rb\rc", 2) == "f:2:1: m\n  b\n  ^");
    CHECK(shown("ab\r\nc", 2) == "f:1:3: m\n  ab\n    ^");
    CHECK(shown("ab\r\nc", 3) == "f:1:4: m\n  ab\n    ^");
    CHECK(shown("\ta\tb", 3) == "f:1:4: m\n  \ta\tb\n  \t \t^");
    CHECK(shown("\xEF\xBB\xBFxy", 4) == "f:1:2: m\n  xy\n   ^");
    CHECK(shown("\xEF\xBB\xBFxy", 0) == "f:1:1: m\n  xy\n  ^");
    CHECK(shown("", 0) == "f:1:1: m\n  \n  ^");
    CHECK(shown("ab", 2) == "f:1:3: m\n  ab\n    ^");
    CHECK(shown("ab", 99) == "f:1:3: m\n  ab\n    ^");
    CHECK(shown("ab\n", 3) == "f:2:1: m\n  \n  ^");
}

TEST_CASE("columns count code points, the caret counts what they take on a terminal") {
    CHECK(shown("äöx", 4) == "f:1:3: m\n  äöx\n    ^");
    CHECK(shown("漢字x", 6) == "f:1:3: m\n  漢字x\n      ^");
    CHECK(shown("e\u0301x", 3) == "f:1:3: m\n  e\u0301x\n   ^");
    CHECK(shown("äöx", 3) == "f:1:2: m\n  äöx\n   ^");  // inside ö
}

TEST_CASE("nothing in the text reaches the terminal as a command") {
    CHECK(shown("a\x1b[31mb\x7f\x01", 2) == "f:1:3: m\n  a␛[31mb␡␁\n    ^");
    CHECK(shown("a\xff\xc3(b", 4) == "f:1:5: m\n  a��(b\n      ^");
    CHECK(shown("a\u202Eb\u0085c", 0) == "f:1:1: m\n  a�b�c\n  ^");
    CHECK(std::string(SceneError("a\nb", "m\x1b\n", "s\n").what()) == "a␊b: m␛␊ (did you mean \"s␊\"?)");
}

TEST_CASE("long lines are shown around the caret, in at most 120 columns") {
    std::string line;
    for (int i = 0; i < 100; ++i) line += "0123456789";
    for (const std::size_t offset :
         {std::size_t{0}, std::size_t{40}, std::size_t{500}, std::size_t{990}, line.size()}) {
        CAPTURE(offset);
        const std::string what = shown(line, offset);
        const std::size_t quoted_at = what.find('\n') + 1, caret_at = what.rfind('\n') + 1;
        const std::string quoted = what.substr(quoted_at, caret_at - 1 - quoted_at), caret = what.substr(caret_at);
        CHECK(code_points(quoted) <= 120);
        CHECK(quoted.find("…") != std::string::npos);
        // The ellipsis is three bytes wide and one column.
        const std::size_t shift = quoted.substr(2).starts_with("…") ? 2 : 0;
        const std::size_t under = caret.size() - 1 + shift;
        if (offset < line.size()) {
            REQUIRE(under < quoted.size());
            CHECK(quoted[under] == line[offset]);
        } else {
            CHECK(under == quoted.size());
        }
    }
    const auto widest = [](std::string_view unit, std::size_t columns_a_unit) {
        std::string text;
        for (int i = 0; i < 1000; ++i) text += unit;
        return (code_points(SceneError("f", text, text.size() / 2, "m").quoted_line()) - 2) * columns_a_unit + 2 + 2;
    };
    CHECK(widest("\t", 8) <= 120);
    CHECK(widest("漢", 2) <= 120);
    CHECK(widest("\u0301", 1) <= 120);
    CHECK(widest("\xff", 1) <= 120);
    CHECK(widest("\x80", 1) <= 120);
}

}  // namespace test_error
