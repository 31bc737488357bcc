// The node reference and the schema are derived from the nodes; the committed copies must be what the program prints.
//     phasetree nodes --markdown > scenes/nodes.md; phasetree nodes --json-schema > scenes/scene.schema.json

#include "phasetree/io/reference.hpp"
#include "phasetree/model/handle.hpp"
#include "tree/node.hpp"
#include "source_directory.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <sstream>

using namespace phasetree;

namespace {

std::string committed(const std::string& file) {
    std::ifstream in(source_directory() + "/scenes/" + file);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

}  // namespace

TEST_CASE("the committed reference page and schema are those of the nodes") {
    CHECK(committed("nodes.md") == node_reference_markdown());
    CHECK(committed("scene.schema.json") == scene_json_schema());
}

TEST_CASE("every node describes itself and all its parameters, in both references") {
    const std::string text = node_reference_text(), schema = scene_json_schema();
    const auto check = [&]<class N>() {
        CAPTURE(N::info.name);
        CHECK(!N::info.name.empty());
        CHECK(!N::info.summary.empty());
        CHECK(!N::info.equation.empty());
        CHECK(text.find("  " + std::string(N::info.name)) != std::string::npos);
        CHECK(schema.find("\"" + std::string(N::info.name) + "\"") != std::string::npos);
        const N node{};
        for_each_parameter(node, [&](const auto&, const Parameter& p) {
            CAPTURE(p.name);
            CHECK(!p.name.empty());
            CHECK(!p.description.empty());
            CHECK(schema.find("\"" + std::string(p.name) + "\"") != std::string::npos);
        });
    };
    for_each_type(FieldNodes(), check);
    for_each_type(PhasedNodes(), check);
}
