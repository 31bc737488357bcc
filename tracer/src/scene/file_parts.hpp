// The parts of a scene file: one list of the top-level keys, which determines their names, the reference and the
// schema.
#pragma once

#include <optional>

#include "phasetree/io/read_kind.hpp"
#include "scene/parameter_types.hpp"

namespace phasetree::tracer {

struct FileParts {
    static constexpr KindInfo info{"scene", "The keys of a scene file."};

    std::optional<Value> schema{};
    std::optional<Value> version{};
    std::optional<Value> phases{};
    std::optional<Value> shapes{};
    std::optional<Value> tree{};
    std::optional<Value> objects{};
    std::optional<Value> groups{};
    std::optional<Value> instances{};
    std::optional<Value> meshes{};
    std::optional<Value> lights{};
    std::optional<Value> background{};
    std::optional<Value> camera{};
    std::optional<Value> render{};

    template <class V>
    static void parameters(V&& v) {
        using P = FileParts;
        v(&P::schema, PartParameter{{"$schema", "",
                                     "For editors: where the schema is by which they complete and check the file, "
                                     "such as \"scene.schema.json\". It says nothing about the scene.",
                                     limits::any, true},
                                    "name of a file",
                                    R"({"type": "string"})"});
        v(&P::version, PartParameter{{"version", "", "The version of this format."}, "1", R"({"const": 1})"});
        v(&P::phases,
          PartParameter{{"phases", "",
                         "The phases by their names, and the material of each: all that the tree names. A scene of "
                         "meshes alone has neither phases nor a tree.",
                         limits::any, true},
                        "object of materials",
                        R"({"type": "object", "minProperties": 1, "maxProperties": 63,
                                        "additionalProperties": {"$ref": "#/definitions/material"}})"});
        v(&P::shapes,
          PartParameter{{"shapes", "", "Named parts of the tree, to be used in many places.", limits::any, true},
                        "object of fields and objects",
                        R"({"type": "object", "additionalProperties": {"anyOf": [
                                        {"$ref": "#/definitions/field"}, {"$ref": "#/definitions/object"}]}})"});
        v(&P::tree,
          PartParameter{
              {"tree", "",
               "The object that is shown. It needs \"phases\". Beside \"objects\" it is one more, which comes "
               "first and is called \"tree\".",
               limits::any, true},
              "object",
              R"({"$ref": "#/definitions/object"})"});
        v(&P::objects, PartParameter{{"objects", "", "Several objects, instead of a tree.", limits::any, true},
                                     "list of objects",
                                     R"({"type": "array", "minItems": 1,
                                         "items": {"$ref": "#/definitions/placed_object"}})"});
        v(&P::groups,
          PartParameter{{"groups", "", "Places of objects and of other groups, to be placed together by instances.",
                         limits::any, true},
                        "object of lists of instances",
                        R"({"type": "object", "additionalProperties": {"type": "array", "minItems": 1,
                                        "items": {"$ref": "#/definitions/instance"}}})"});
        v(&P::instances,
          PartParameter{{"instances", "", "Where objects and groups stand, as often as wanted.", limits::any, true},
                        "list of instances",
                        R"({"type": "array", "minItems": 1, "items": {"$ref": "#/definitions/instance"}})"});
        v(&P::meshes,
          PartParameter{{"meshes", "", "What stands beside the object, or without one in a vacuum.", limits::any, true},
                        "list of meshes",
                        R"({"type": "array", "items": {"$ref": "#/definitions/mesh"}})"});
        v(&P::lights,
          PartParameter{{"lights", "", "What shines. An image needs one light at least.", limits::any, true},
                        "list of lights",
                        R"({"type": "array", "items": {"$ref": "#/definitions/light"}})"});
        v(&P::background, PartParameter{{"background", "", "What the camera sees instead of the lights at infinity.",
                                         limits::any, true},
                                        "colour",
                                        R"({"$ref": "#/definitions/colour"})"});
        v(&P::camera,
          PartParameter{
              {"camera", "", "Where the image is taken from."}, "camera", R"({"$ref": "#/definitions/camera"})"});
        v(&P::render, PartParameter{{"render", "", "How large the image is, and how it is made.", limits::any, true},
                                    "render",
                                    R"({"$ref": "#/definitions/render"})"});
    }
};

}  // namespace phasetree::tracer
