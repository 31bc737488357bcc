// The reference of the nodes, as page, text and schema, follows from the nodes' own definitions.
// tracer/scene/scene_reference.cpp tests the reference of whole scene files, including the path tracer's kinds.

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
    struct Described {
        NodeInfo info;
        std::vector<std::string> names, descriptions;
    };
    const auto check = [&](const Described& node, const Value& among, bool has_own_page) {
        CAPTURE(node.info.name);
        CHECK(!node.info.name.empty());
        CHECK(!node.info.summary.empty());
        CHECK(!node.info.equation.empty());
        CHECK(text.find("  " + std::string(node.info.name)) != std::string::npos);
        CHECK(markdown.find("\n## " + std::string(node.info.name) + "\n") != std::string::npos);
        const auto page = std::ranges::find(pages, node.info.name, &KindPage::name);
        REQUIRE(page != pages.end());
        REQUIRE(among.find(node.info.name));
        Value object = *among.find(node.info.name);
        if (const auto either = object.find("anyOf")) object = (*either)[0];
        for (std::size_t i = 0; i < node.names.size(); ++i) {
            CAPTURE(node.names[i]);
            CHECK(!node.names[i].empty());
            CHECK(!node.descriptions[i].empty());
            const auto property = object.find("properties")->find(node.names[i]);
            REQUIRE(property);
            CHECK(property->find("description")->string().starts_with(node.descriptions[i]));
            REQUIRE(i < page->parameters.size());
            CHECK(page->parameters[i].name == node.names[i]);
        }
        if (has_own_page) CHECK(node.names.size() == page->parameters.size());
        CHECK(object.find("properties")->size() == node.names.size());
    };
    const auto described = []<class N>() {
        Described node{.info = N::info, .names = {}, .descriptions = {}};
        const N plain{};
        for_each_parameter(plain, [&](const auto&, const Parameter& p) {
            node.names.emplace_back(p.name);
            node.descriptions.emplace_back(p.description);
        });
        return node;
    };
    // A warp has one page, that of objects, where the phases to warp can be chosen.
    for_each_type(FieldNodes(), [&]<class N>() {
        check(described.template operator()<N>(), fields, !has_node<Warps>(N::info.name));
    });
    for_each_type(PhasedNodes(), [&]<class N>() { check(described.template operator()<N>(), objects, true); });
}

}  // namespace test_reference
