// Every kind of mistake in a JSON text, with the exact position and message.

#include <doctest/doctest.h>

#include <string>
#include <string_view>
#include <vector>

#include "phasetree/io/document.hpp"

namespace test_bad_text {

using phasetree::Document;
using phasetree::SceneError;

namespace {

struct Bad {
    std::string text;
    std::size_t line, column;
    std::string message;
    std::string suggestion = {};
};

std::vector<Bad> structure() {
    return {
        // Nothing, or not all of it.
        {"", 1, 1, "the file is empty"},
        {" \n\t\r\n", 1, 1, "the file is empty"},
        {"\xEF\xBB\xBF", 1, 1, "the file is empty"},
        {"// nothing\n", 1, 11, "the file contains only comments"},
        {"{", 1, 2, "the file ends inside an object that was opened at line 1"},
        {"\n\n{ \"a\": 1\n\n", 3, 9, "the file ends inside an object that was opened at line 3"},
        {"{\"a\"", 1, 5, "the file ends inside an object that was opened at line 1"},
        {"{\"a\":", 1, 6, "the file ends inside an object that was opened at line 1"},
        {"{\"a\":1,", 1, 8, "the file ends inside an object that was opened at line 1"},
        {"{\r\n\"a\":\r\n[1,\r\n2", 4, 2, "the file ends inside an array that was opened at line 3"},
        {"{\r\"a\":\r[1,\r2", 4, 2, "the file ends inside an array that was opened at line 3"},
        {"[1, [2], ", 1, 9, "the file ends inside an array that was opened at line 1"},
        // The indentation is more informative than the end.
        {"{\n  \"a\": {\"b\": {\"c\": 1},\n  \"d\": 2\n}\n", 4, 2,
         "the file ends inside an object that was opened at line 1; by the indentation, line 2 lacks a '}'"},
        {"{\n  \"a\": {\n    \"b\": 1,\n    \"c\": [2, 3],\n  \"d\": {\"e\": 4}\n}", 6, 2,
         "the file ends inside an object that was opened at line 1; by the indentation, line 4 lacks a '}'"},
        {"{\n  \"a\": [[1, 2], [3, 4],\n  \"b\": 5\n}", 3, 6,
         "expected ',' or ']', found ':'; by the indentation, line 2 lacks a ']'"},
        {"{\n  \"a\": [\n    {\"b\": [1, {\"c\": 2}]},\n    {\"b\": [{\"c\": 2},\n    {\"b\": [3]}\n  ],\n  \"d\": "
         "5\n}",
         8, 2, "the file ends inside an array that was opened at line 2; by the indentation, line 4 lacks a ']'"},
        {"{\n  \"a\": [\n    {\"b\": {\"c\": 2},\n    \"d\"\n  ]\n}", 5, 3,
         "expected ':' after the key \"d\", found ']'; by the indentation, line 3 lacks a '}'"},
        {"{\n  \"a\": [\n    {\"b\": {\"c\": 2},\n    {\"d\": 3}\n  ]\n}", 4, 5,
         "expected a key in double quotes, found '{'"},
        {"{\n  \"a\": {\n    \"b\": {\"c\": 2}},\n    \"d\": {\"e\": 3}\n  },\n  \"f\": 4\n}", 5, 4,
         "expected the end of the file, found ','; by the indentation, line 3 has a '}' too many"},
        // Comments are no indentation, nor are values below their keys.
        {"{\n  \"a\": {},\n  /* x */ \"b\": 1\n}}", 4, 2, "expected the end of the file, found '}'"},
        {"{\n/* c */ \"a\": 1,\n\"b\": [2}", 3, 8, "expected ',' or ']', found '}'"},
        {"{\"a\":\n    [1],\n\"b\": [2}", 3, 8, "expected ',' or ']', found '}'"},
        {"\xEF\xBB\xBF\n", 1, 1, "the file is empty"},
        // Texts with little indentation or none.
        {"{\n\"a\": {\"b\": {\"c\": 1},\n\"d\": 2\n}\n", 4, 2,
         "the file ends inside an object that was opened at line 1; by the indentation, line 2 lacks a '}'"},
        {"{\n\"a\": {\n\"b\": 1,\n\"d\": 2\n}\n", 5, 2, "the file ends inside an object that was opened at line 1"},
        // Brackets, commas, colons.
        {"}", 1, 1, "expected a value, found '}'"},
        {"{\"a\": }", 1, 7, "expected a value, found '}'"},
        {"{\"a\": , }", 1, 7, "expected a value, found ','"},
        {"[,1]", 1, 2, "expected a value, found ','"},
        {"[1,,2]", 1, 4, "expected a value, found ','"},
        {"[1 2]", 1, 4, "expected ',' or ']', found '2'"},
        {"[1, 2}", 1, 6, "expected ',' or ']', found '}'"},
        {"[1 : 2]", 1, 4, "expected ',' or ']', found ':'"},
        {"{\"a\": 1]", 1, 8, "expected ',' or '}', found ']'"},
        {"{\"a\": 1\n \"b\": 2}", 2, 2, "expected ',' or '}', found \"b\""},
        {"[1,\n2, // two\n]", 2, 2, "remove the comma before ']'"},
        {"{\"a\": 1,}", 1, 8, "remove the comma before '}'"},
        {"{,}", 1, 2, "expected a key in double quotes, found ','"},
        {"{\"a\": 1,,}", 1, 9, "expected a key in double quotes, found ','"},
        {"{1: 2}", 1, 2, "expected a key in double quotes, found '1'"},
        {"{radius: 2}", 1, 2, "expected a key in double quotes, found 'radius'"},
        {"{\"a\" 1}", 1, 6, "expected ':' after the key \"a\", found '1'"},
        {"{\"a\" = 1}", 1, 6, "expected ':' after the key \"a\", found '='"},
        {"{\"a\", 1}", 1, 5, "expected ':' after the key \"a\", found ','"},
        {"{\"a\":: 1}", 1, 6, "expected a value, found ':'"},
        {"{} {}", 1, 4, "expected the end of the file, found '{'"},
        {"1 true", 1, 3, "expected the end of the file, found 'true'"},
        // Comments.
        {"[1, /* two ]", 1, 5, "unterminated comment: no */ follows"},
        {"{} /*", 1, 4, "unterminated comment: no */ follows"},
        {"[1 / 2]", 1, 4, "expected ',' or ']', found '/'"},
        {"[1/**/2]", 1, 7, "expected ',' or ']', found '2'"},
        {"[tr/**/ue]", 1, 2, "expected a value, found 'tr'", "true"},
        {"[\"//\", \"/*\", \"\\\"/*\", /]", 1, 22, "expected a value, found '/'"},
        {"# a scene\n{}", 1, 1, "a comment begins with // or /*, not with #"},
    };
}

std::vector<Bad> words_and_numbers() {
    return {
        // Words.
        {"[True]", 1, 2, "expected a value, found 'True'", "true"},
        {"[flase]", 1, 2, "expected a value, found 'flase'", "false"},
        {"[tru", 1, 2, "expected a value, found 'tru'", "true"},
        {"[nullptr]", 1, 2, "expected a value, found 'nullptr'", "null"},
        {"[red]", 1, 2, "expected a value, found 'red'"},
        {"[@]", 1, 2, "expected a value, found '@'"},
        {"[\x1b[31m]", 1, 2, "expected a value, found '␛'"},
        {"[\xff\xfe]", 1, 2, "expected a value, found '��'"},
        {"{'a': 1}", 1, 2, "strings must be in \"double quotes\", not in 'single quotes'"},
        {"['a']", 1, 2, "strings must be in \"double quotes\", not in 'single quotes'"},
        // Numbers.
        {"[NaN]", 1, 2, "'NaN' is not a finite number"},
        {"[-nan]", 1, 2, "'-nan' is not a finite number"},
        {"{\"r\": Infinity}", 1, 7, "'Infinity' is not a finite number"},
        {"{\"r\": -Infinity}", 1, 7, "'-Infinity' is not a finite number"},
        {"[+inf]", 1, 2, "'+inf' is not a finite number"},
        {"[0, 1e999]", 1, 5, "'1e999' is not a finite number"},
        {"-1e999", 1, 1, "'-1e999' is not a finite number"},
        {"[" + std::string(400, '9') + "]", 1, 2, "'" + std::string(39, '9') + "…' is not a finite number"},
        {"[01]", 1, 2, "'01' is not a valid JSON number", "1"},
        {"01", 1, 1, "'01' is not a valid JSON number", "1"},
        {"[-007.5]", 1, 2, "'-007.5' is not a valid JSON number", "-7.5"},
        {"[.5]", 1, 2, "'.5' is not a valid JSON number", "0.5"},
        {"[-.5]", 1, 2, "'-.5' is not a valid JSON number", "-0.5"},
        {"[1.]", 1, 2, "'1.' is not a valid JSON number", "1"},
        {"[2.e3]", 1, 2, "'2.e3' is not a valid JSON number", "2e3"},
        {"[+1]", 1, 2, "'+1' is not a valid JSON number", "1"},
        {"[-]", 1, 2, "'-' is not a valid JSON number"},
        {"[1e]", 1, 2, "'1e' is not a valid JSON number"},
        {"[1e+]", 1, 2, "'1e+' is not a valid JSON number"},
        {"[0x10]", 1, 2, "'0x10' is not a valid JSON number"},
        {"[1_000]", 1, 2, "'1_000' is not a valid JSON number"},
        {"[1.5f]", 1, 2, "'1.5f' is not a valid JSON number"},
        {"[1.2.3]", 1, 2, "'1.2.3' is not a valid JSON number"},
        {"[truest]", 1, 2, "expected a value, found 'truest'", "true"},
    };
}

std::vector<Bad> strings_and_bytes() {
    return {
        // Strings.
        {"[\"abc", 1, 2, "unterminated string: no closing quote on this line"},
        {"[\"abc\n\"]", 1, 2, "unterminated string: no closing quote on this line"},
        {"{\"abc\r\n: 1}", 1, 2, "unterminated string: no closing quote on this line"},
        {"[\"abc\\", 1, 2, "unterminated string: no closing quote on this line"},
        {"[\"abc\\u12", 1, 2, "unterminated string: no closing quote on this line"},
        {"[\"a\tb\"]", 1, 4, "write a tab inside a string as \\t"},
        {"[\"a\x01z\"]", 1, 4, "write a control character inside a string as \\u0001"},
        {"[\"C:\\dir\"]", 1, 5, "'\\d' is not an escape sequence; write a backslash as \\\\"},
        {"[\"\\u12x4\"]", 1, 3, "\\u must be followed by four hexadecimal digits"},
        {"[\"é\\ud83d\"]", 1, 4, "unpaired surrogate: \\ud800 to \\udbff must be followed by \\udc00 to \\udfff"},
        {"[\"\\udc00\"]", 1, 3, "unpaired surrogate: \\ud800 to \\udbff must be followed by \\udc00 to \\udfff"},
        {"[\"a\\u0000b\"]", 1, 4, "a string must not contain the null character"},
        {"{\"a\\u0000b\": 1}", 1, 4, "a string must not contain the null character"},
        {"[\"ab\xff\"]", 1, 5, "this byte is not valid UTF-8; save the file as UTF-8"},
        {"[\"\xc0\xaf\"]", 1, 3, "this byte is not valid UTF-8; save the file as UTF-8"},
        {"[\"\xed\xa0\x80\"]", 1, 3, "this byte is not valid UTF-8; save the file as UTF-8"},
        {"[\"\xe2\x82\"]", 1, 3, "this byte is not valid UTF-8; save the file as UTF-8"},
        // Keys.
        {"{\"a\": 1,\n \"b\": 2, \"a\": 3}", 2, 10, "the key \"a\" is already used at line 1"},
        {"{\"a\": 1, \"\\u0061\": 3}", 1, 10, "the key \"a\" is already used at line 1"},
        {"{\"\": 1, \"\": {}}", 1, 9, "the key \"\" is already used at line 1"},
        // Bytes.
        {std::string("{\"a\": 1}\n\0", 10), 2, 1, "a null byte: this is not UTF-8 text"},
        {std::string("// a\0b\n{}", 9), 1, 5, "a null byte: this is not UTF-8 text"},
        {"\xEF\xBB{}", 1, 1, "expected a value, found '��'"},
        // Columns count code points, and neither the byte order mark nor a tab's width.
        {"\xEF\xBB\xBF[x]", 1, 2, "expected a value, found 'x'"},
        {"\t\t[\"äöü→𝄞\",\tx]", 1, 13, "expected a value, found 'x'"},
        {"/* äöü */ // →\r\n\t/*\n*/ x", 3, 4, "expected a value, found 'x'"},
    };
}

std::vector<Bad> bad_texts() {
    std::vector<Bad> all;
    for (const std::vector<Bad>& some : {structure(), words_and_numbers(), strings_and_bytes()})
        all.insert(all.end(), some.begin(), some.end());
    return all;
}

}  // namespace

TEST_CASE("a wrong text is told with its place and plain words") {
    CHECK(bad_texts().size() >= 40);
    for (const Bad& bad : bad_texts()) {
        CAPTURE(bad.text);
        try {
            Document::from_text(bad.text, "bad.json");
            FAIL_CHECK("was accepted");
        } catch (const SceneError& error) {
            CHECK(error.file() == "bad.json");
            CHECK(error.line() == bad.line);
            CHECK(error.column() == bad.column);
            CHECK(error.message() == bad.message);
            CHECK(error.suggestion().value_or("") == bad.suggestion);
        }
    }
}

TEST_CASE("UTF-16 is recognised") {
    for (const std::string& text : {std::string("\xFF\xFE{\0}\0", 6), std::string("\xFE\xFF\0{\0}", 6)}) {
        CHECK_THROWS_WITH_AS(Document::from_text(text), "<text>: the file is UTF-16; save it as UTF-8", SceneError);
    }
}

TEST_CASE("of several repeated keys the first is told, also in a wide object") {
    std::string text = "{";
    for (int i = 0; i < 100; ++i) text += "\"k" + std::to_string(i) + "\": 0,\n";
    text += "\"k70\": 1,\n\"k3\": 2}";
    CHECK_THROWS_WITH_AS(Document::from_text(text, "f"),
                         "f:101:1: the key \"k70\" is already used at line 71\n  \"k70\": 1,\n  ^", SceneError);
}

TEST_CASE("nesting ends at 1216 levels") {
    const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
    CHECK_NOTHROW(Document::from_text(nested(1216)));
    try {
        Document::from_text("\n" + nested(1217));
        FAIL("was accepted");
    } catch (const SceneError& error) {
        CHECK(error.message() == "nested deeper than 1216 levels");
        CHECK(error.line() == 2);
        CHECK(error.column() == 1217);
    }
    std::string objects;
    for (int i = 0; i < 100'000; ++i) objects += "{\"a\":";
    for (const std::string& text : {std::string(100'000, '['), nested(100'000), objects}) {
        CHECK_THROWS_AS(Document::from_text(text), SceneError);
    }
}

}  // namespace test_bad_text
