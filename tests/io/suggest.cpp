#include "phasetree/io/suggest.hpp"

#include <doctest/doctest.h>

#include <array>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "phasetree/io/meant_kind.hpp"

namespace test_suggest {

using phasetree::closest, phasetree::meant_kind, phasetree::valid_names;

TEST_CASE("a misspelt word finds the one that was meant") {
    const std::vector<std::string> keys = {"radius", "center", "height", "material", "from", "to", "r"};
    CHECK(closest("raduis", keys) == "radius");   // a swap
    CHECK(closest("radus", keys) == "radius");    // a letter missing
    CHECK(closest("raddius", keys) == "radius");  // one too many
    CHECK(closest("radios", keys) == "radius");   // a wrong one
    CHECK(closest("RADIUS", keys) == "radius");   // case
    CHECK(closest("centre", keys) == "center");
    CHECK(closest("heigth", keys) == "height");
    CHECK(closest("mateirals", keys) == "material");
    CHECK(closest("form", keys) == "from");
    CHECK(closest("ot", keys) == "to");
}

TEST_CASE("what is far from everything finds nothing") {
    const std::vector<std::string> keys = {"radius", "center", "to", "r"};
    CHECK_FALSE(closest("colour", keys));
    CHECK_FALSE(closest("x", keys));
    CHECK_FALSE(closest("at", keys));
    CHECK_FALSE(closest("", keys));
    CHECK_FALSE(closest("radius", std::vector<std::string>{}));
    CHECK_FALSE(closest("radius", {"", "diameter"}));
    CHECK_FALSE(closest(std::string(100'000, 'a'), {std::string(100'000, 'a')}));
}

TEST_CASE("the nearest wins, and the first of equally near ones") {
    CHECK(closest("sphre", {"spheres", "sphere"}) == "sphere");
    CHECK(closest("bix", {"box", "bin"}) == "box");
    CHECK(closest("bix", {"bin", "box"}) == "bin");
}

TEST_CASE("letters are code points") {
    CHECK(closest("glas", {"gläs"}) == "gläs");
    CHECK(closest("é", {"è"}) == std::nullopt);  // one letter of one is all of it
    CHECK(closest("漢字", {"漢子"}) == "漢子");
}

TEST_CASE("any range of strings will do") {
    const std::set<std::string> phases = {"glass", "sand"};
    CHECK(closest("glas", phases) == "glass");
    const std::array<std::string_view, 2> views = {"sand", "wood"};
    CHECK(closest("snad", views) == "sand");
}

TEST_CASE("an unknown kind is what other programs call so, or the nearest by spelling") {
    const std::vector<std::string> shapes = {"tube", "box", "sphere", "boxes"};
    CHECK(meant_kind("cube", shapes) == "box");
    CHECK(meant_kind("pipe", shapes) == "tube");
    CHECK(meant_kind("shpere", shapes) == "sphere");
    CHECK(meant_kind("cube", std::vector<std::string>{"tube"}) == "tube");  // where there is no box
    CHECK_FALSE(meant_kind("teapot", shapes));
}

TEST_CASE("valid names are listed unless there are none or too many") {
    std::vector<std::string> names;
    CHECK(valid_names("key", names) == "");
    names.emplace_back("radius");
    CHECK(valid_names("key", names) == "; the only key is \"radius\"");
    names.emplace_back("of");
    CHECK(valid_names("phase", names) == "; the phases are \"radius\", \"of\"");
    names.resize(12, "more");
    CHECK(valid_names("key", names).ends_with("\"more\""));
    names.emplace_back("one too many");
    CHECK(valid_names("key", names) == "");
}

}  // namespace test_suggest
