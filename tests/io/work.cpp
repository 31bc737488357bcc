// Few lines that request much work before anything is traced: they are rejected, with their position.
#include <doctest/doctest.h>

#include <string>

#include "phasetree/io/error.hpp"
#include "phasetree/io/tree.hpp"
#include "source_directory.hpp"

namespace test_work {

using namespace phasetree;

namespace {

std::string scene(const std::string& shapes, const std::string& field) {
    return "{\"version\": 1, \"phases\": {\"a\": {}}, \"shapes\": {" + shapes +
           "},\n\"tree\": {\"set\": {\"phase\": \"a\", \"of\":\n" + field + "}}}";
}

/// s0 … s40, each made of the last.
std::string forty(const std::string& first, const std::string& before, const std::string& between,
                  const std::string& after) {
    std::string text = "\"s0\": " + first;
    for (int i = 0; i < 40; ++i) {
        const std::string last = "\"s" + std::to_string(i) + "\"";
        text += ",\n\"s" + std::to_string(i + 1) + "\": " + before + last + between + last + after;
    }
    return text;
}

const std::string ball = "{\"sphere\": {\"radius\": 1}}";
const std::string two_copies = forty(ball, "{\"union\": [{\"translate\": {\"by\": [0.1, 0, 0], \"of\": ",
                                     "}}, {\"translate\": {\"by\": [0, 0.13, 0], \"of\": ", "}}]}");

/// The error message.
std::string said_of(const std::string& text) {
    try {
        (void)read_tree(Document::from_text(text));
    } catch (const SceneError& e) {
        return e.what();
    }
    return "nothing";
}

}  // namespace

TEST_CASE("a scatter over what stands for billions is rejected at its place") {
    const std::string said =
        said_of(scene(two_copies, "{\"scatter\": {\"on\": \"s40\", \"of\": \"s0\", \"count\": 10}}"));
    CAPTURE(said);
    CHECK(said.find(":43:2: scatter: the object needs more than 500000 instructions") != std::string::npos);
}

TEST_CASE("blobs of blobs, forty levels, are few instructions") {
    const std::string text = scene(forty(ball, "{\"blob\": {\"radii\": [1], \"of\": [", ", ", "]}}"), "\"s40\"");
    CHECK(said_of(text) == "nothing");
}

TEST_CASE("more work than a node may do is rejected at its place") {
    const std::string fine =
        "{\"displace\": {\"of\": {\"sphere\": {\"radius\": 1}}, \"amplitude\": 0.01, \"scale\": 0.01, "
        "\"octaves\": 6}}";
    const std::string strewn = said_of(
        scene("", "{\"scatter\": {\"on\": " + fine + ", \"of\": " + ball + ", \"count\": 100000, \"spacing\": 100}}"));
    CAPTURE(strewn);
    CHECK(strewn.find(":3:2: scatter: preparing this node exceeds the limit") != std::string::npos);
    const std::string file = source_directory() + "/scenes/assets/bunny.siren.json";
    const std::string sampled = said_of(scene("", "{\"siren\": {\"file\": \"" + file + "\", \"samples\": 10000000}}"));
    CAPTURE(sampled);
    CHECK(sampled.find(":3:2: siren: preparing this node exceeds the limit") != std::string::npos);
}

}  // namespace test_work
