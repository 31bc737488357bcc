// JSON text as a person would lay out a scene file.
#pragma once

#include <algorithm>
#include <cstddef>
#include <glm/vec3.hpp>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include <fmt/format.h>

namespace phasetree::tracer::gltf_import {

using SceneJson = nlohmann::ordered_json;

/// The number as a double that prints with as few digits as the float.
inline double short_number(float x) {
    return std::stod(fmt::format("{}", x));
}
/// The number rounded to six digits.
inline double rounded(double x) {
    return std::stod(fmt::format("{:.6g}", x)) + 0.0;  // no −0
}
inline SceneJson short_numbers(const glm::vec3& v) {
    return {short_number(v.x), short_number(v.y), short_number(v.z)};
}
inline SceneJson rounded(const glm::dvec3& v) {
    return {rounded(v.x), rounded(v.y), rounded(v.z)};
}

namespace detail {

constexpr std::size_t line_width = 120;

inline std::string on_one_line(const SceneJson& value) {
    if (!value.is_structured()) return value.dump();
    std::string text;
    for (const auto& [key, member] : value.items()) {
        if (!text.empty()) text += ", ";
        if (value.is_object()) text += SceneJson(key).dump() + ": ";
        text += on_one_line(member);
    }
    return value.is_object() ? "{" + text + "}" : "[" + text + "]";
}

// Whether an object has only numbers and texts, followed by one list or object.
inline bool ends_in_structure(const SceneJson& value) {
    if (!value.is_object() || value.empty() || !std::prev(value.end())->is_structured()) return false;
    return std::all_of(value.begin(), std::prev(value.end()), [](const SceneJson& v) { return !v.is_structured(); });
}

// `column` is the column at which the text begins; `after` is the number of characters that follow it on its last line.
inline std::string laid_out(const SceneJson& value, std::size_t indent, std::size_t column, std::size_t after) {
    std::string line = on_one_line(value);
    if (!value.is_structured() || column + line.size() + after <= line_width) return line;
    if (ends_in_structure(value)) {  // {"set": {"phase": "ice", "of": {…}}}
        std::string start = "{";
        for (auto member = value.begin(); member != value.end(); ++member) {
            const bool is_last = std::next(member) == value.end();
            start += SceneJson(member.key()).dump() + ": ";
            start += is_last ? laid_out(*member, indent, column + start.size(), after + 1) : member->dump() + ", ";
        }
        return start + "}";
    }
    std::string text(1, value.is_object() ? '{' : '[');
    std::size_t left = value.size();
    for (const auto& [key, member] : value.items()) {
        const std::string name = value.is_object() ? SceneJson(key).dump() + ": " : "";
        text += "\n" + std::string(indent + 2, ' ') + name + laid_out(member, indent + 2, indent + 2 + name.size(), 1);
        if (--left > 0) text += ",";
    }
    return text + "\n" + std::string(indent, ' ') + (value.is_object() ? '}' : ']');
}

}  // namespace detail

/// The text of a scene: a paragraph for each member, and lines of up to 120 characters. Each phase has its own line.
inline std::string scene_text(const SceneJson& scene) {
    std::string text = "{";
    for (const auto& [key, member] : scene.items()) {
        text += text.size() == 1 ? "\n  " : ",\n\n  ";
        text += SceneJson(key).dump() + ": ";
        if (key == "phases" && member.size() > 1) {
            std::string phases;
            for (const auto& [name, phase] : member.items()) {
                const std::string start = SceneJson(name).dump() + ": ";
                phases += phases.empty() ? "\n    " : ",\n    ";
                phases += start + detail::laid_out(phase, 4, 4 + start.size(), 1);
            }
            text += "{" + phases + "\n  }";
        } else {
            text += detail::laid_out(member, 2, key.size() + 6, 1);
        }
    }
    return text + "\n}\n";
}

}  // namespace phasetree::tracer::gltf_import
