#include "phasetree/io/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>

#include "phasetree/io/keys.hpp"
#include "tree/node.hpp"

namespace phasetree {

namespace {

using Json = nlohmann::ordered_json;

Json reference_to(std::string_view what) {
    return {{"$ref", fmt::format("#/definitions/{}", what)}};
}
Json list_of(Json items) {
    return {{"type", "array"}, {"minItems", 1}, {"items", std::move(items)}};
}

// The description of a node's parameter: the type of its values, and how the current value is written. There is one
// overload per type.
struct NodeParameter {
    ValueType type;
    std::string written;
};

template <PlainParameter T>
NodeParameter described(const T& v, const Parameter& p) {
    return {ParameterType<T>::describe(p), ParameterType<T>::written(v)};
}
NodeParameter described(const std::string& v, const ChoiceParameter& p) {
    return {ParameterType<std::string, ChoiceParameter>::describe(p), ParameterType<std::string>::written(v)};
}
template <class Content>
NodeParameter described(const FromFile<Content>&, const Parameter& p) {
    return {ParameterType<std::filesystem::path>::describe(p), "none"};
}
NodeParameter described(const Field&, const Parameter&) {
    return {{"field", schema_reference("field")}, "none"};
}
NodeParameter described(const Phased&, const Parameter&) {
    return {{"object", schema_reference("object")}, "none"};
}
NodeParameter described(Phase, const Parameter&) {
    return {{"phase", R"({"type": "string"})"}, ""};
}
NodeParameter described(PhaseSet, const Parameter&) {
    const Json phase{{"type", "string"}};
    return {{"phase or list of phases", Json{{"anyOf", {phase, list_of(phase)}}}.dump()}, "none"};
}
// A single number may be given instead of a list of one.
template <class T>
NodeParameter described(const std::vector<T>&, const Parameter& p) {
    const ValueType item = described(T{}, p).type;
    const std::string name = fmt::format("list of {}{}", item.name, item.name.ends_with(']') ? "" : "s"),
                      schema = list_of(Json::parse(item.schema)).dump();
    if (p.one_for_all) return {{"number or " + name, schema_of_either(item.schema, schema)}, "[]"};
    return {{name, schema}, "[]"};
}

template <class N>
KindPage page_of_node() {
    KindPage page;
    page.name = N::info.name;
    page.section = N::info.section;
    page.equation = N::info.equation;
    page.summary = N::info.summary;
    const N node{};
    std::size_t required = 0, lists = 0;
    for_each_parameter(node, [&](const auto& value, const auto& p) {
        const NodeParameter d = described(value, p);
        page.parameters.push_back(parameter_page(p, d.type, d.written));
        if (p.optional) return;
        ++required;
        if constexpr (requires { value.front(); }) ++lists;
    });
    page.list_alone = required == 1 && lists == 1;
    return page;
}

template <class... Ns>
std::vector<KindPage> pages_of_nodes(TypeList<Ns...>) {
    return {page_of_node<Ns>()...};
}

// Whether a node is made from other nodes.
template <class N>
bool has_children() {
    bool found = false;
    const N node{};
    for_each_parameter(node, [&]<class T>(const T&, const Parameter&) {
        found = found || std::is_same_v<T, Field> || std::is_same_v<T, std::vector<Field>> || std::is_same_v<T, Phased>;
    });
    return found;
}

// Only those that have children, or only those that have none.
template <bool HasChildren, class... Ns>
std::vector<KindPage> pages_of_nodes(TypeList<Ns...>) {
    std::vector<KindPage> pages;
    (
        [&] {
            if (has_children<Ns>() == HasChildren) pages.push_back(page_of_node<Ns>());
        }(),
        ...);
    return pages;
}

// The text in brackets after a description.
std::string limits_of(const ParameterPage& p) {
    if (!p.optional) return p.limits;
    return fmt::format("{}{}default {}", p.limits, p.limits.empty() ? "" : "; ", p.default_value);
}

std::string first_sentence(const std::string& text) {
    return text.substr(0, std::min(text.find(". "), text.size() - 1)) + ".";
}

// The section of a kind in a page of Markdown.
std::string section_of(const KindPage& page) {
    std::string text = fmt::format("\n## {}\n\n{}{}\n", page.name, page.summary,
                                   page.section.empty() ? "" : fmt::format(" Section {}.", page.section));
    if (!page.example.empty())
        text += fmt::format("\n[![An example of {0}]({1}.jpg)]({1}.json)\n", page.name, page.example);
    if (!page.snippet.empty()) text += fmt::format("\n```json\n{}\n```\n", page.snippet);
    if (!page.equation.empty()) text += fmt::format("\n`{}`\n", page.equation);
    if (page.parameters.empty()) return text + "\nIt has no parameters.\n";
    text += "\n| parameter | type | unit | | limits |\n|---|---|---|---|---|\n";
    for (const ParameterPage& p : page.parameters)
        text += fmt::format("| `{}` | {} | {} | {} | {} |\n", p.name, p.type, p.unit, p.description, limits_of(p));
    return text;
}

Json property_of(const ParameterPage& p) {
    Json property = Json::parse(p.schema);
    if (property.contains("$ref")) property = {{"allOf", {property}}};  // draft 7 ignores everything next to $ref
    property["description"] = p.unit.empty() ? p.description : fmt::format("{} [{}]", p.description, p.unit);
    if (p.optional && Json::accept(p.default_value)) property["default"] = Json::parse(p.default_value);
    return property;
}

Json object_of(const KindPage& page) {
    Json properties = Json::object(), required = Json::array();
    for (const ParameterPage& p : page.parameters) {
        properties[p.name] = property_of(p);
        if (!p.optional) required.push_back(p.name);
    }
    return {{"type", "object"}, {"properties", properties}, {"required", required}, {"additionalProperties", false}};
}

// A node of one of several kinds, or the name of a shape.
template <class... Ns>
Json node_of(TypeList<Ns...> nodes) {
    return {{"anyOf",
             {{{"type", "string"}, {"description", "The name of a shape."}},
              Json::parse(schema_of_one(pages_of_nodes(nodes)))}}};
}

}  // namespace

ParameterPage parameter_page(const Parameter& p, const ValueType& type, std::string default_value) {
    ParameterPage page;
    page.name = p.name;
    page.type = type.name;
    page.unit = p.unit;
    page.description = p.description;
    if (p.limits != limits::any) page.limits = describe(range_of(p.limits));
    if (p.optional) page.default_value = std::move(default_value);
    page.optional = p.optional;
    page.schema = type.schema;
    return page;
}

std::vector<Chapter> node_chapters() {
    std::vector<Chapter> chapters{
        {"Shapes",
         "A field is one signed distance, negative inside. Fields that are called exact are the distance to the "
         "surface; others are lower bounds on it. These fields are not made from other nodes.",
         pages_of_nodes<false>(PlainFields())},
        {"Operators on fields", "These fields are made from other nodes: combined, rounded, repeated or bounded.",
         pages_of_nodes<true>(PlainFields())},
        {"Objects", "An object has several phases. Each point lies in exactly one of them, or in the vacuum.",
         pages_of_nodes(Objects())},
        {"Warps", "A warp deforms a field or an object. The result is of the same type.",
         pages_of_nodes(detail::Map<WarpedPhased, Warps>::type())}};
    const char* const folders[] = {"fields", "fields", "objects", "warps"};
    for (std::size_t i = 0; i < chapters.size(); ++i)
        for (KindPage& page : chapters[i].pages) page.example = fmt::format("../nodes/{}/{}", folders[i], page.name);
    return chapters;
}

std::string reference_text(std::span<const Chapter> chapters) {
    std::string text;
    for (const Chapter& chapter : chapters) {
        text += fmt::format("{}\n{}\n\n", chapter.title, chapter.text);
        for (const KindPage& page : chapter.pages) {
            text += fmt::format("  {}{}\n      {}\n", page.name,
                                page.section.empty() ? "" : fmt::format("  (Section {})", page.section), page.summary);
            if (!page.equation.empty()) text += fmt::format("      {}\n", page.equation);
            for (const ParameterPage& p : page.parameters) {
                const std::string bounds = limits_of(p);
                text += fmt::format("      {:<16} {}{}: {}{}\n", p.name, p.type,
                                    p.unit.empty() ? "" : fmt::format(" in {}", p.unit), p.description,
                                    bounds.empty() ? "" : fmt::format(" ({})", bounds));
            }
            text += "\n";
        }
    }
    return text;
}

std::string file_stem(const Chapter& chapter) {
    std::string stem;
    for (const char c : chapter.title)
        stem += c == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return stem;
}

std::string reference_markdown(const Chapter& chapter) {
    std::string text = fmt::format("# {}\n\n{}\n", chapter.title, chapter.text);
    if (chapter.pages.size() > 1) {
        text += "\n| | |\n|---|---|\n";
        for (const KindPage& page : chapter.pages)
            text += fmt::format("| [`{0}`](#{0}) | {1} |\n", page.name, first_sentence(page.summary));
    }
    for (const KindPage& page : chapter.pages) text += section_of(page);
    return text;
}

std::string reference_index(std::span<const Chapter> chapters) {
    std::string text = "| chapter | |\n|---|---|\n";
    for (const Chapter& chapter : chapters) {
        const std::string file = file_stem(chapter) + ".md";
        text += fmt::format("| [{}]({}) |", chapter.title, file);
        for (const KindPage& page : chapter.pages) text += fmt::format(" [`{0}`]({1}#{0})", page.name, file);
        text += " |\n";
    }
    return text;
}

std::string schema_of(const KindPage& page) {
    const Json object = object_of(page);
    Json result = object;
    if (page.list_alone) {
        for (const ParameterPage& p : page.parameters)
            if (!p.optional) result = {{"anyOf", {object, Json::parse(p.schema)}}};
    }
    std::string text = page.summary;
    if (!page.equation.empty()) text += " " + page.equation;
    if (!page.section.empty()) text += fmt::format(" (Section {})", page.section);
    result["description"] = text;
    return result.dump();
}

std::string schema_of_one(std::span<const KindPage> pages) {
    Json properties = Json::object();
    for (const KindPage& page : pages) properties[page.name] = Json::parse(schema_of(page));
    return Json{{"type", "object"},
                {"minProperties", 1},
                {"maxProperties", 1},
                {"additionalProperties", false},
                {"properties", properties}}
        .dump();
}

std::string schema_reference(std::string_view definition) {
    return reference_to(definition).dump();
}

std::string schema_of_either(const std::string& one, const std::string& other) {
    return Json{{"anyOf", {Json::parse(one), Json::parse(other)}}}.dump();
}

std::string scene_schema(const KindPage& file, std::span<const std::pair<std::string, std::string>> definitions) {
    Json schema;
    schema["$schema"] = "http://json-schema.org/draft-07/schema#";
    schema["title"] = "phasetree scene";
    const Json object = object_of(file);
    for (const char* const key : {"type", "additionalProperties", "required", "properties"})
        schema[key] = object.at(key);
    Json& all = schema["definitions"];
    for (const auto& [name, text] : definitions) all[name] = Json::parse(text);
    all["keys"] = Json::parse(schema_of_keys());
    all["field"] = node_of(FieldNodes());
    all["object"] = node_of(PhasedNodes());
    return schema.dump(1) + "\n";
}

}  // namespace phasetree
