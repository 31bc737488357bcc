// Parameters that are lists of points.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "phasetree/io/parameter_type.hpp"

namespace phasetree {

template <>
struct ParameterType<std::vector<glm::vec3>, Parameter> {
    using Point = ParameterType<glm::vec3, Parameter>;

    static std::vector<glm::vec3> read(const Document& document, Value value, std::string_view what,
                                       const Parameter& p) {
        return as<std::vector<glm::vec3>>(document, value, what, range_of(p.limits));
    }
    static ValueType describe(const Parameter& p) {
        const ValueType point = Point::describe(p);
        return {"list of " + point.name, R"({"type": "array", "items": )" + point.schema + "}"};
    }
    static std::string written(const std::vector<glm::vec3>& points) {
        std::string text;
        for (const glm::vec3& point : points) text += (text.empty() ? "" : ", ") + Point::written(point);
        return "[" + text + "]";
    }
};

}  // namespace phasetree
