#include "phasetree/io/reference.hpp"

#include <fmt/format.h>

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
    return {{"phase or list of phases", Json{{"anyOf", {phase, list_of(phase)}}}.dump()}, "all"};
}
// A single number may be given instead of a list of one.
template <class T>
NodeParameter described(const std::vector<T>&, const Parameter& p) {
    const ValueType item = described(T{}, p).type;
    const std::string name = fmt::format("list of {}s", item.name), schema = list_of(Json::parse(item.schema)).dump();
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
    for_each_parameter(node, [&](const auto& value, const Parameter& p) {
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

// The text in brackets after a description.
std::string limits_of(const ParameterPage& p) {
    if (!p.optional) return p.limits;
    return fmt::format("{}{}default {}", p.limits, p.limits.empty() ? "" : "; ", p.default_value);
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
        {"Fields", "A field is a signed distance, negative inside.", pages_of_nodes(PlainFields())},
        {"Objects", "An object has several phases, exactly one of which contains any point.",
         pages_of_nodes(Objects())},
        {"Warps", "A warp deforms a field or an object; the result is of the same kind.",
         pages_of_nodes(detail::Map<WarpedPhased, Warps>::type())}};
    for (Chapter& chapter : chapters) {
        std::string folder = chapter.title;
        folder.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(folder.front())));
        for (KindPage& page : chapter.pages) page.example = fmt::format("nodes/{}/{}", folder, page.name);
    }
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

std::string reference_markdown(std::span<const Chapter> chapters) {
    std::string text;
    for (const Chapter& chapter : chapters) {
        text += fmt::format("\n## {}\n\n{}\n", chapter.title, chapter.text);
        for (const KindPage& page : chapter.pages) {
            text += fmt::format("\n### {}\n\n{}{}\n", page.name, page.summary,
                                page.section.empty() ? "" : fmt::format(" Section {}.", page.section));
            if (!page.example.empty())
                text +=
                    fmt::format("\n[![An example of {}]({}.jpg)]({}.json)\n", page.name, page.example, page.example);
            if (!page.equation.empty()) text += fmt::format("\n`{}`\n", page.equation);
            text += "\n| parameter | type | unit | | limits |\n|---|---|---|---|---|\n";
            for (const ParameterPage& p : page.parameters)
                text +=
                    fmt::format("| `{}` | {} | {} | {} | {} |\n", p.name, p.type, p.unit, p.description, limits_of(p));
        }
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
