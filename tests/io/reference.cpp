// The reference of the nodes, as page, text and schema, follows from the nodes' own definitions. What a whole scene
// file may say, the path tracer's kinds too, is in tracer/scene/scene_reference.cpp.

#include "phasetree/io/reference.hpp"

#include <doctest/doctest.h>

#include "phasetree/io/document.hpp"
#include "phasetree/model/handle.hpp"
#include "source_directory.hpp"
#include "tree/node.hpp"

namespace test_reference {

using namespace phasetree;

namespace {

std::vector<KindPage> pages_of_nodes() {
    std::vector<KindPage> pages;
    for (const Chapter& chapter : node_chapters())
        pages.insert(pages.end(), chapter.pages.begin(), chapter.pages.end());
    return pages;
}

template <class List>
bool has_node(std::string_view name) {
    bool found = false;
    for_each_type(List(), [&]<class N>() { found = found || N::info.name == name; });
    return found;
}

}  // namespace

TEST_CASE("a text that is one of several words is described by these words and its default") {
    const std::vector<KindPage> pages = pages_of_nodes();
    const auto mesh = std::ranges::find(pages, "mesh", &KindPage::name);
    REQUIRE(mesh != pages.end());
    const ParameterPage& rule = mesh->parameters.at(1);
    CHECK(rule.type == "`\"winding_number\"`, `\"even_odd\"`, `\"non_zero\"`");
    CHECK(rule.default_value == "\"winding_number\"");
    CHECK(rule.schema == R"({"enum":["winding_number","even_odd","non_zero"]})");
}

TEST_CASE("every node describes itself and all its parameters, in the page and in the schema") {
    const std::vector<KindPage> pages = pages_of_nodes();
    const std::string text = reference_text(node_chapters());
    std::string markdown;
    for (const Chapter& chapter : node_chapters()) markdown += reference_markdown(chapter);
    const Document schema = Document::from_text(scene_schema({}, {}));
    const Value definitions = *schema.root().find("definitions");
    const auto nodes = [&](const char* name) {
        return *(*definitions.find(name)->find("anyOf"))[1].find("properties");
    };
    const Value fields = nodes("field"), objects = nodes("object");
    CHECK(fields.size() == FieldNodes::size);
    CHECK(objects.size() == PhasedNodes::size);
    const auto check = [&]<class N>(const Value& among) {
        CAPTURE(N::info.name);
        CHECK(!N::info.name.empty());
        CHECK(!N::info.summary.empty());
        CHECK(!N::info.equation.empty());
        CHECK(text.find("  " + std::string(N::info.name)) != std::string::npos);
        CHECK(markdown.find("\n## " + std::string(N::info.name) + "\n") != std::string::npos);
        const auto page = std::ranges::find(pages, N::info.name, &KindPage::name);
        REQUIRE(page != pages.end());
        REQUIRE(among.find(N::info.name));
        Value object = *among.find(N::info.name);
        if (const auto either = object.find("anyOf")) object = (*either)[0];
        const N node{};
        std::size_t count = 0;
        for_each_parameter(node, [&](const auto&, const Parameter& p) {
            CAPTURE(p.name);
            CHECK(!p.name.empty());
            CHECK(!p.description.empty());
            const auto property = object.find("properties")->find(p.name);
            REQUIRE(property);
            CHECK(property->find("description")->string().starts_with(p.description));
            REQUIRE(count < page->parameters.size());
            CHECK(page->parameters[count++].name == p.name);
        });
        // A warp has one page, that of objects, where the phases to warp can be chosen.
        const bool has_own_page = !has_node<Warps>(N::info.name) || &among == &objects;
        if (has_own_page) CHECK(count == page->parameters.size());
        CHECK(object.find("properties")->size() == count);
    };
    for_each_type(FieldNodes(), [&]<class N>() { check.template operator()<N>(fields); });
    for_each_type(PhasedNodes(), [&]<class N>() { check.template operator()<N>(objects); });
}

}  // namespace test_reference
