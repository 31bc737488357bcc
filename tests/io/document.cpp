// Correct texts are read correctly: values, order, keys, and the position of each in the text.

#include "phasetree/io/document.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <cmath>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace test_document {

using phasetree::Document;
using phasetree::Kind;
using phasetree::SceneError;
using phasetree::Value;
using phasetree::ValueIterator;

static_assert(std::forward_iterator<ValueIterator>);
static_assert(sizeof(Value) <= 2 * sizeof(void*));

namespace {

const std::string sample = R"(// A scene.
{
    "version": 1, /* the only one */ "name": "gläs \u00e9\ud83d\ude00 \"q\" \\ \/ \n",
    "numbers": [0, -0.0, 1.5e3, -12, 2E-2, 1e-999, 18446744073709551617],
    "words": [true, false, null],
    "empty": {"list": [], "object": {}, "": ""},
    "shapes": [{"sphere": {"radius": 1}}, /* , : "x" */ {"box": [1, 2, 3]}] // last
}
// end)";

// Compares the first character of every value and key in the sample with the positions in the document.
void check_positions(const Document& document, Value value) {
    const std::string_view rest = std::string_view(document.text()).substr(value.offset());
    CAPTURE(rest.substr(0, 20));
    switch (value.kind()) {
        case Kind::null:
            CHECK(rest.starts_with("null"));
            break;
        case Kind::boolean:
            CHECK(rest.starts_with(value.boolean() ? "true" : "false"));
            break;
        case Kind::string:
            CHECK(rest.starts_with('"'));
            break;
        case Kind::array:
            CHECK(rest.starts_with('['));
            break;
        case Kind::object:
            CHECK(rest.starts_with('{'));
            break;
        case Kind::number:
            CHECK(std::stold(std::string(value.written())) == doctest::Approx(value.number()));
            break;
    }
    for (const Value child : value) {
        if (value.is_object()) {
            const std::string_view key = std::string_view(document.text()).substr(child.key_offset());
            CHECK(key.starts_with('"'));
            if (key[1] != '\\') CHECK(key.substr(1).starts_with(child.key()));
            CHECK(child.key_offset() < child.offset());
        } else {
            CHECK(child.key().empty());
            CHECK(child.key_offset() == child.offset());
        }
        check_positions(document, child);
    }
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
        text.replace(at, from.size(), to);
    }
    return text;
}

double seconds_of(const auto& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

TEST_CASE("values, order and keys") {
    const Document document = Document::from_text(sample);
    const Value root = document.root();
    REQUIRE(root.is_object());
    std::vector<std::string_view> keys;
    for (const Value member : root) keys.push_back(member.key());
    CHECK(keys == std::vector<std::string_view>{"version", "name", "numbers", "words", "empty", "shapes"});
    CHECK(root.find("version")->number() == 1);
    CHECK(root.find("name")->string() == "gläs é😀 \"q\" \\ / \n");
    const Value numbers = *root.find("numbers");
    REQUIRE(numbers.size() == 7);
    CHECK(numbers[0].number() == 0);
    CHECK(std::signbit(numbers[1].number()));
    CHECK(numbers[2].number() == 1500);
    CHECK(numbers[3].number() == -12);
    CHECK(numbers[4].number() == 0.02);
    CHECK(numbers[4].written() == "2E-2");
    CHECK(numbers[5].number() == 0);
    CHECK(numbers[6].number() == 18446744073709551616.0);
    const Value words = *root.find("words");
    CHECK(words[0].boolean());
    CHECK_FALSE(words[1].boolean());
    CHECK(words[2].is_null());
    const Value empty = *root.find("empty");
    CHECK(empty[0].is_array());
    CHECK(empty[0].size() == 0);
    CHECK(empty[0].begin() == empty[0].end());
    CHECK(empty[1].is_object());
    CHECK(empty.find("")->string().empty());
    CHECK(root.find("shapes")->operator[](0).find("sphere")->find("radius")->number() == 1);
    CHECK_FALSE(root.find("shape"));
    CHECK_FALSE(numbers.find("shape"));
    CHECK(root.key().empty());
}

TEST_CASE("what a program asks wrongly is a logic_error") {
    const Document document = Document::from_text("[1, \"a\"]");
    const Value root = document.root();
    CHECK_THROWS_AS(root.number(), std::logic_error);
    CHECK_THROWS_AS(root[0].string(), std::logic_error);
    CHECK_THROWS_AS(root[1].boolean(), std::logic_error);
    CHECK_THROWS_AS(root[2], std::out_of_range);
    CHECK_THROWS_AS(root[0][0], std::out_of_range);
}

TEST_CASE("every value knows its place, whatever stands between") {
    for (const std::string_view line_end : {"\n", "\r\n", "\r"}) {
        for (const std::string_view blank : {" ", "\t", " /* \", [ é 𝄞 */ "}) {
            for (const std::string_view mark : {"", "\xEF\xBB\xBF"}) {
                std::string text = replaced(sample, "    ", blank);
                text = std::string(mark) + replaced(text, "\n", line_end);
                const Document document = Document::from_text(text);
                CHECK(document.root().find("shapes")->size() == 2);
                check_positions(document, document.root());
            }
        }
    }
}

TEST_CASE("a text can be a single value") {
    CHECK(Document::from_text("12").root().number() == 12);
    CHECK(Document::from_text(" -1.5e1 ").root().number() == -15);
    CHECK(Document::from_text("\"a\"").root().string() == "a");
    CHECK(Document::from_text("null//").root().is_null());
    CHECK(Document::from_text("true/**/").root().offset() == 0);
}

TEST_CASE("values outlive the Document they came from while a copy lives") {
    Document kept = Document::from_text("[\"kept\"]");
    const Value value = [&] {
        const Document copy = kept;
        return copy.root()[0];
    }();
    const Document moved = std::move(kept);
    CHECK(value.string() == "kept");
}

TEST_CASE("wide objects are found in by key") {
    std::string text = "{";
    for (int i = 0; i < 5000; ++i) {
        text += (i > 0 ? ", \"" : "\"") + std::to_string(i * 7919 % 5000) + "\": {\"x\": " + std::to_string(i) + "}";
    }
    // Another wide object inside and one behind: each has its own index.
    text += ", \"in\": {";
    for (int i = 0; i < 40; ++i)
        text += (i > 0 ? ",\"" : "\"") + std::string(static_cast<std::size_t>(i), 'a') + "\":" + std::to_string(i);
    text += "}}";
    const Document document = Document::from_text(text);
    CHECK(document.root().size() == 5001);
    for (int i = 0; i < 5000; ++i) {
        REQUIRE(document.root().find(std::to_string(i * 7919 % 5000))->find("x")->number() == i);
    }
    CHECK(document.root().find("in")->find("aaa")->number() == 3);
    CHECK_FALSE(document.root().find("in")->find("b"));
    CHECK_FALSE(document.root().find("5000"));
}

TEST_CASE("20 MB are read in reasonable time") {
    // Wide arrays, wide objects, one long string. About a second each in Release; the limit only has to tell
    // linear from quadratic, and holds under a sanitizer on a slow machine.
    constexpr std::size_t bytes = 20'000'000;
    constexpr double limit = 60;
    std::string array = "[1";
    while (array.size() < bytes) array += ",1";
    array += "]";
    std::string object = "{\"k\":0";
    for (int i = 0; object.size() < bytes; ++i) object += ",\"" + std::to_string(i) + "\":0";
    object += "}";
    const std::string string = '"' + std::string(bytes, 'a') + '"';
    std::size_t size = 0;
    CHECK(seconds_of([&] { size = Document::from_text(array).root().size(); }) < limit);
    CHECK(size == bytes / 2);
    CHECK(seconds_of([&] { size = Document::from_text(object).root().size(); }) < limit);
    CHECK(size > bytes / 13);
    CHECK(seconds_of([&] { size = Document::from_text(string).root().string().size(); }) < limit);
    CHECK(size == bytes);

    // Wrong at the very end, and on one line of 20 MB.
    CHECK(seconds_of([&] {
              array.back() = '}';
              CHECK_THROWS_AS(Document::from_text(array), SceneError);
              CHECK_THROWS_AS(Document::from_text("[\"" + std::string(bytes, 'a')), SceneError);
              CHECK_THROWS_AS(Document::from_text("/*" + std::string(bytes, '\n')), SceneError);
          }) < limit);
}

TEST_CASE("a truncated text is an error at every byte") {
    const std::size_t complete = sample.rfind('}') + 1;
    for (std::size_t length = 0; length < sample.size(); ++length) {
        CAPTURE(length);
        const std::string text = sample.substr(0, length);
        // A comment cut to its first slash is an error, too.
        const bool is_good = length >= complete && !(length > 0 && text.back() == '/' && text[length - 2] != '/');
        if (is_good) {
            CHECK_NOTHROW(Document::from_text(text));
        } else {
            CHECK_THROWS_AS(Document::from_text(text), SceneError);
        }
    }
}

TEST_CASE("random damage is read or told, and never crashes") {
    // std::mt19937 is the same everywhere; the distributions of the library are not, hence the remainders.
    std::mt19937 random(20240607);
    const std::string_view likely = "{}[],:\"\\/*-+.eE0123456789 tfn\n\r\t\xEF\xBB\xBF\xFF";
    int accepted = 0, told = 0;
    for (int i = 0; i < 10'000; ++i) {
        std::string text = sample;
        const unsigned changes = 1 + random() % 4;
        for (unsigned change = 0; change < changes; ++change) {
            const std::size_t at = random() % text.size();
            const char byte = random() % 2 == 0 ? likely[random() % likely.size()] : static_cast<char>(random() % 256);
            switch (random() % 4) {
                case 0:
                    text[at] = byte;
                    break;
                case 1:
                    text.insert(at, 1, byte);
                    break;
                case 2:
                    text.erase(at, 1 + random() % 3);
                    break;
                default:
                    text.insert(at, text.substr(random() % text.size(), random() % 8));
                    break;
            }
        }
        try {
            const Document document = Document::from_text(text);
            ++accepted;
        } catch (const SceneError& error) {
            ++told;
            // The diagnosis agrees with the parser about where the text is wrong: it has found something there.
            CAPTURE(text);
            CAPTURE(error.what());
            CHECK(error.message() != "this string cannot be read");
            CHECK(error.line() >= 1);
            CHECK(error.column() >= 1);
            for (const char c : error.message()) CHECK(static_cast<unsigned char>(c) >= 0x20);
            for (const std::string_view valid : {"0", "1", "-12", "true", "false", "null", "{", "["}) {
                CHECK(error.message() != "expected a value, found '" + std::string(valid) + "'");
            }
        }
    }
    CHECK(accepted > 500);
    CHECK(told > 5000);
}

}  // namespace test_document
