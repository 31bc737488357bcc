#include "phasetree/io/parameter_type.hpp"

#include <fmt/format.h>

#include <glm/glm.hpp>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/json/utf8.hpp"
#include "phasetree/io/keys.hpp"
#include "phasetree/io/suggest.hpp"

namespace phasetree {

namespace {

using Json = nlohmann::ordered_json;

Json with_limits(Json schema, const Limits& l) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Range range = range_of(l);
    if (range.min > -infinity) schema[range.min_is_open ? "exclusiveMinimum" : "minimum"] = range.min;
    if (range.max < infinity) schema[range.max_is_open ? "exclusiveMaximum" : "maximum"] = range.max;
    return schema;
}

Json or_keys(const Json& schema) {
    return Json::parse(schema_of_keyed(schema.dump()));
}

Json number(const Limits& l) {
    return or_keys(with_limits({{"type", "number"}}, l));
}

Json list_of_numbers(int count, const Limits& l) {
    return or_keys({{"type", "array"}, {"minItems", count}, {"maxItems", count}, {"items", number(l)}});
}

Json string_in_json() {
    return {{"type", "string"}};
}

template <class Vector>
std::string list_written(const Vector& v) {
    std::string text = "[";
    for (glm::length_t i = 0; i < v.length(); ++i) text += fmt::format("{}{}", i > 0 ? ", " : "", v[i]);
    return text + "]";
}

}  // namespace

template <PlainParameter T>
ValueType ParameterType<T, Parameter>::describe(const Parameter& p) {
    if constexpr (std::is_same_v<T, bool>) {
        return {"true or false", Json{{"type", "boolean"}}.dump()};
    } else if constexpr (std::is_same_v<T, std::string>) {
        return {"text", string_in_json().dump()};
    } else if constexpr (std::is_same_v<T, int>) {
        return {"whole number", with_limits({{"type", "integer"}}, p.limits).dump()};
    } else if constexpr (std::is_same_v<T, unsigned>) {
        Json schema = with_limits({{"type", "integer"}}, p.limits);
        if (!schema.contains("minimum") && !schema.contains("exclusiveMinimum")) schema["minimum"] = 0;
        if (!schema.contains("maximum") && !schema.contains("exclusiveMaximum"))
            schema["maximum"] = std::numeric_limits<unsigned>::max();
        return {"whole number", schema.dump()};
    } else if constexpr (std::is_same_v<T, glm::vec2>) {
        return {"[x, y]", list_of_numbers(2, p.limits).dump()};
    } else if constexpr (std::is_same_v<T, glm::vec3>) {
        return {"[x, y, z]", list_of_numbers(3, p.limits).dump()};
    } else {
        return {"number", number(p.limits).dump()};
    }
}

template <PlainParameter T>
std::string ParameterType<T, Parameter>::written(const T& v) {
    if constexpr (std::is_same_v<T, std::string>)
        return Json(v).dump();
    else if constexpr (std::is_same_v<T, glm::vec2> || std::is_same_v<T, glm::vec3>)
        return list_written(v);
    else
        return fmt::format("{}", v);
}

template struct ParameterType<bool, Parameter>;
template struct ParameterType<int, Parameter>;
template struct ParameterType<unsigned, Parameter>;
template struct ParameterType<float, Parameter>;
template struct ParameterType<double, Parameter>;
template struct ParameterType<std::string, Parameter>;
template struct ParameterType<glm::vec2, Parameter>;
template struct ParameterType<glm::vec3, Parameter>;

using Colour = ParameterType<glm::vec3, ColourParameter>;
glm::vec3 Colour::read(const Document& document, Value value, std::string_view what, const ColourParameter& p) {
    return as_colour(document, value, what, range_of(p.limits));
}
ValueType Colour::describe(const ColourParameter& p) {
    return colour_type(p.limits);
}
std::string Colour::written(const glm::vec3& v) {
    return list_written(v);
}

ValueType colour_type(const Limits& l) {
    const Json hexadecimal{{"type", "string"}, {"pattern", "^#[0-9a-fA-F]{6}$"}};
    return {"colour", Json{{"anyOf", {hexadecimal, list_of_numbers(3, l)}}}.dump()};
}

using Direction = ParameterType<glm::vec3, DirectionParameter>;
glm::vec3 Direction::read(const Document& document, Value value, std::string_view what, const DirectionParameter& p) {
    const glm::vec3 direction = as<glm::vec3>(document, value, what, range_of(p.limits));
    if (direction == glm::vec3(0)) throw document.error(value, fmt::format("{} must not be zero", what));
    return direction;
}
ValueType Direction::describe(const DirectionParameter& p) {
    return {"[x, y, z], not all zero", list_of_numbers(3, p.limits).dump()};
}
std::string Direction::written(const glm::vec3& v) {
    return list_written(v);
}

using Choice = ParameterType<std::string, ChoiceParameter>;
std::string Choice::read(const Document& document, Value value, std::string_view what, const ChoiceParameter& p) {
    const std::string word = as<std::string>(document, value, what);
    const std::vector<std::string_view> choices = p.choices();
    std::string list;
    for (const std::string_view choice : choices) {
        if (choice == word) return word;
        list += fmt::format("{}\"{}\"", list.empty() ? "" : ", ", choice);
    }
    throw document.error(value, fmt::format("{} must be one of {}, but is {}", what, list, io::in_quotes(word)),
                         closest(word, choices));
}
ValueType Choice::describe(const ChoiceParameter& p) {
    Json all = Json::array();
    std::string list;
    for (const std::string_view choice : p.choices()) {
        all.push_back(std::string(choice));
        list += fmt::format("{}`\"{}\"`", list.empty() ? "" : ", ", choice);
    }
    return {list, Json{{"enum", all}}.dump()};
}
std::string Choice::written(const std::string& v) {
    return Json(v).dump();
}

using File = ParameterType<std::filesystem::path, Parameter>;
std::filesystem::path File::read(const Document& document, Value value, std::string_view what, const Parameter&) {
    (void)as<std::string>(document, value, what);
    return document.file(value);
}
ValueType File::describe(const Parameter&) {
    return {"name of a file", Json{{"type", "string"}, {"minLength", 1}}.dump()};
}
std::string File::written(const std::filesystem::path& v) {
    return v.empty() ? "none" : Json(v.string()).dump();
}

}  // namespace phasetree
