#pragma once

#include <filesystem>
#include <glm/fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "phasetree/io/kind.hpp"
#include "phasetree/io/object_reader.hpp"

namespace phasetree {

/// The type of a parameter's value: in words, such as "number" or "[x, y, z]", and as a JSON Schema (JSON text).
struct ValueType {
    std::string name;
    std::string schema;
};

/// Defines how a member of type T that is listed as a P (Parameter, ColourParameter, …) is read and described, in three
/// static functions:
///
///     T read(const Document&, Value, std::string_view what, const P&);  // throws SceneError
///     ValueType describe(const P&);
///     std::string written(const T&);  // JSON as in a file, or a word such as "none"
///
/// Programs specialise it for their own types. A parameter list with a member of any other type does not compile.
template <class T, class P = Parameter>
struct ParameterType;

/// Types that need no further description.
template <class T>
concept PlainParameter = io::one_of<T, bool, int, unsigned, float, double, std::string, glm::vec2, glm::vec3>;

template <PlainParameter T>
struct ParameterType<T, Parameter> {
    static T read(const Document& document, Value value, std::string_view what, const Parameter& p) {
        return as<T>(document, value, what, range_of(p.limits));
    }
    static ValueType describe(const Parameter&);
    static std::string written(const T&);
};

template <>
struct ParameterType<glm::vec3, ColourParameter> {
    static glm::vec3 read(const Document&, Value, std::string_view what, const ColourParameter&);
    static ValueType describe(const ColourParameter&);
    static std::string written(const glm::vec3&);
};

template <>
struct ParameterType<glm::vec3, RgbParameter> : ParameterType<glm::vec3, Parameter> {
    static ValueType describe(const RgbParameter& p) {
        return {"[r, g, b]", ParameterType<glm::vec3, Parameter>::describe(p).schema};
    }
};

template <>
struct ParameterType<glm::vec3, DirectionParameter> {
    static glm::vec3 read(const Document&, Value, std::string_view what, const DirectionParameter&);
    static ValueType describe(const DirectionParameter&);
    static std::string written(const glm::vec3&);
};

template <>
struct ParameterType<std::string, ChoiceParameter> {
    static std::string read(const Document&, Value, std::string_view what, const ChoiceParameter&);
    static ValueType describe(const ChoiceParameter&);
    static std::string written(const std::string&);
};

/// A file, resolved relative to the scene's folder and restricted by Document::with_files_within().
template <>
struct ParameterType<std::filesystem::path, Parameter> {
    static std::filesystem::path read(const Document&, Value, std::string_view what, const Parameter&);
    static ValueType describe(const Parameter&);
    static std::string written(const std::filesystem::path&);
};

/// An optional value; empty if it is missing.
template <class T, class P>
struct ParameterType<std::optional<T>, P> {
    static std::optional<T> read(const Document& document, Value value, std::string_view what, const P& p) {
        return ParameterType<T, P>::read(document, value, what, p);
    }
    static ValueType describe(const P& p) { return ParameterType<T, P>::describe(p); }
    static std::string written(const std::optional<T>& v) { return v ? ParameterType<T, P>::written(*v) : "none"; }
};

/// The schema of a colour whose components are within these limits.
ValueType colour_type(const Limits&);

}  // namespace phasetree
