#include "phasetree/io/reference.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

#include "tree/node.hpp"

namespace phasetree {

namespace {

using Json = nlohmann::ordered_json;

/// What a parameter's type is called, how its default is written, and its JSON Schema. One overload a type.
struct TypeOf {
    std::string name;
    std::string default_value;
    Json schema;
};

Json with_limits(Json schema, const Limits& l) {
    if (l.low > limits::any.low) schema[l.low_open ? "exclusiveMinimum" : "minimum"] = l.low;
    if (l.high < limits::any.high) schema[l.high_open ? "exclusiveMaximum" : "maximum"] = l.high;
    return schema;
}
Json reference_to(const char* what) {
    return {{"$ref", fmt::format("#/definitions/{}", what)}};
}
Json list_of(Json items) {
    return {{"type", "array"}, {"minItems", 1}, {"items", std::move(items)}};
}

TypeOf type_of(float v, const Limits& l) {
    return {"number", fmt::format("{}", v), with_limits({{"type", "number"}}, l)};
}
TypeOf type_of(int v, const Limits& l) {
    return {"whole number", fmt::format("{}", v), with_limits({{"type", "integer"}}, l)};
}
TypeOf type_of(const glm::vec3& v, const Limits& l) {
    return {"[x, y, z]",
            fmt::format("[{}, {}, {}]", v.x, v.y, v.z),
            {{"type", "array"}, {"minItems", 3}, {"maxItems", 3}, {"items", with_limits({{"type", "number"}}, l)}}};
}
TypeOf type_of(const glm::vec2& v, const Limits& l) {
    return {"[x, y]",
            fmt::format("[{}, {}]", v.x, v.y),
            {{"type", "array"}, {"minItems", 2}, {"maxItems", 2}, {"items", with_limits({{"type", "number"}}, l)}}};
}
template <class Content>
TypeOf type_of(const FromFile<Content>&, const Limits&) {
    return {"name of a file", "none", {{"type", "string"}, {"minLength", 1}}};
}
TypeOf type_of(const Field&, const Limits&) {
    return {"field", "none", reference_to("field")};
}
TypeOf type_of(const Phased&, const Limits&) {
    return {"object", "none", reference_to("object")};
}
TypeOf type_of(Phase, const Limits&) {
    return {"phase", "", {{"type", "string"}}};
}
TypeOf type_of(PhaseSet, const Limits&) {
    return {"phase or list of phases", "all", {{"anyOf", {{{"type", "string"}}, list_of({{"type", "string"}})}}}};
}
template <class T>
TypeOf type_of(const std::vector<T>&, const Limits& l) {
    const TypeOf item = type_of(T{}, l);
    return {fmt::format("list of {}s", item.name), "[]", list_of(item.schema)};
}

/// A number by itself may stand for a list of one.
TypeOf with_one_for_all(const TypeOf& list) {
    return {"number or " + list.name, list.default_value, {{"anyOf", {list.schema["items"], list.schema}}}};
}

struct Described {
    Parameter parameter;
    TypeOf type;
};

struct NodePage {
    NodeInfo info;
    std::vector<Described> parameters;
    bool list_alone = false;  ///< its one required parameter is a list, which may stand for the parameters
};

template <class N>
NodePage page_of() {
    NodePage page{N::info, {}, false};
    const N node{};
    std::size_t required = 0, lists = 0;
    for_each_parameter(node, [&](const auto& value, const Parameter& p) {
        const TypeOf type = type_of(value, p.limits);
        page.parameters.push_back({p, p.one_for_all ? with_one_for_all(type) : type});
        if (p.optional) return;
        ++required;
        if constexpr (requires { value.front(); }) ++lists;
    });
    page.list_alone = required == 1 && lists == 1;
    return page;
}

struct Chapter {
    std::string title, text;
    std::vector<NodePage> pages;
};

template <class... Ns>
std::vector<NodePage> pages_of(TypeList<Ns...>) {
    return {page_of<Ns>()...};
}

std::vector<Chapter> chapters() {
    return {{"Fields", "A field is one signed distance, negative inside.", pages_of(PlainFields())},
            {"Objects", "An object has several phases, of which exactly one is at any point.", pages_of(Objects())},
            {"Warps", "A warp deforms a field or an object, and is what its child is.",
             pages_of(detail::Map<WarpedPhased, Warps>::type())}};
}

std::string limits_of(const Described& d) {
    std::string text;
    if (d.parameter.limits != limits::any) text += detail::describe(d.parameter.limits);
    if (d.parameter.optional) {
        if (!text.empty()) text += "; ";
        text += fmt::format("default {}", d.type.default_value);
    }
    return text;
}

Json schema_of(const NodePage& page) {
    Json properties = Json::object(), required = Json::array();
    for (const Described& d : page.parameters) {
        Json property = d.type.schema;
        std::string text(d.parameter.description);
        if (!d.parameter.unit.empty()) text += fmt::format(" [{}]", d.parameter.unit);
        if (property.contains("$ref")) property = {{"allOf", {property}}};  // draft 7 ignores what stands beside $ref
        property["description"] = text;
        properties[std::string(d.parameter.name)] = property;
        if (!d.parameter.optional) required.push_back(std::string(d.parameter.name));
    }
    Json object{
        {"type", "object"}, {"properties", properties}, {"required", required}, {"additionalProperties", false}};
    Json result = object;
    if (page.list_alone) {
        for (const Described& d : page.parameters)
            if (!d.parameter.optional) result = {{"anyOf", {object, d.type.schema}}};
    }
    std::string text = fmt::format("{} {}", page.info.summary, page.info.equation);
    if (!page.info.section.empty()) text += fmt::format(" (Section {})", page.info.section);
    result["description"] = text;
    return result;
}

template <class... Ns>
Json choice(TypeList<Ns...> nodes) {
    Json properties = Json::object();
    for (const NodePage& page : pages_of(nodes)) properties[std::string(page.info.name)] = schema_of(page);
    return {{"anyOf",
             {{{"type", "string"}, {"description", "The name of a shape."}},
              {{"type", "object"},
               {"minProperties", 1},
               {"maxProperties", 1},
               {"additionalProperties", false},
               {"properties", properties}}}}};
}

/// {"kind": {…}} for one of some kinds.
Json one_kind(std::initializer_list<const char*> kinds) {
    Json properties = Json::object();
    for (const char* kind : kinds) properties[kind] = {{"type", "object"}};
    return {{"type", "object"},
            {"minProperties", 1},
            {"maxProperties", 1},
            {"additionalProperties", false},
            {"properties", properties}};
}

}  // namespace

std::string node_reference_text() {
    std::string text;
    for (const Chapter& chapter : chapters()) {
        text += fmt::format("{}\n{}\n\n", chapter.title, chapter.text);
        for (const NodePage& page : chapter.pages) {
            text += fmt::format("  {}{}\n      {}\n      {}\n", page.info.name,
                                page.info.section.empty() ? "" : fmt::format("  (Section {})", page.info.section),
                                page.info.summary, page.info.equation);
            for (const Described& d : page.parameters) {
                const std::string bounds = limits_of(d);
                text += fmt::format("      {:<16} {}{}: {}{}\n", d.parameter.name, d.type.name,
                                    d.parameter.unit.empty() ? "" : fmt::format(" in {}", d.parameter.unit),
                                    d.parameter.description, bounds.empty() ? "" : fmt::format(" ({})", bounds));
            }
            text += "\n";
        }
    }
    return text;
}

std::string node_reference_markdown() {
    std::string text =
        "# Nodes\n\nWritten by `phasetree nodes --markdown` from the nodes' own definitions. Sections are the "
        "paper's.\n";
    for (const Chapter& chapter : chapters()) {
        text += fmt::format("\n## {}\n\n{}\n", chapter.title, chapter.text);
        for (const NodePage& page : chapter.pages) {
            text += fmt::format(
                "\n### {}\n\n{}{}\n\n`{}`\n\n| parameter | type | unit | | limits |\n|---|---|---|---|---|\n",
                page.info.name, page.info.summary,
                page.info.section.empty() ? "" : fmt::format(" Section {}.", page.info.section), page.info.equation);
            for (const Described& d : page.parameters)
                text += fmt::format("| `{}` | {} | {} | {} | {} |\n", d.parameter.name, d.type.name, d.parameter.unit,
                                    d.parameter.description, limits_of(d));
        }
    }
    return text;
}

std::string scene_json_schema() {
    Json schema;
    schema["$schema"] = "http://json-schema.org/draft-07/schema#";
    schema["title"] = "phasetree scene";
    schema["type"] = "object";
    schema["additionalProperties"] = false;
    schema["required"] = {"version", "phases", "tree", "camera"};
    Json& p = schema["properties"];
    p["version"] = {{"const", 1}};
    p["phases"] = {{"type", "object"}, {"minProperties", 1}, {"additionalProperties", reference_to("material")}};
    p["shapes"] = {{"type", "object"},
                   {"additionalProperties", {{"anyOf", {reference_to("field"), reference_to("object")}}}}};
    p["tree"] = reference_to("object");
    p["meshes"] = {{"type", "array"}, {"items", one_kind({"obj", "floor", "backdrop"})}};
    p["lights"] = {{"type", "array"},
                   {"items", one_kind({"constant", "gradient", "image", "sky", "sun", "rectangle", "sphere"})}};
    p["background"] = reference_to("colour");
    p["camera"] = {{"type", "object"}, {"required", {"position", "look_at"}}};
    p["render"] = {{"type", "object"}};
    Json& d = schema["definitions"];
    d["colour"] = {{"anyOf",
                    {{{"type", "string"}, {"pattern", "^#[0-9a-fA-F]{6}$"}},
                     {{"type", "array"}, {"minItems", 3}, {"maxItems", 3}, {"items", {{"type", "number"}}}}}}};
    d["material"] = one_kind({"clear", "diffuse", "conductor", "coated"});
    d["field"] = choice(FieldNodes());
    d["object"] = choice(PhasedNodes());
    return schema.dump(1) + "\n";
}

}  // namespace phasetree
