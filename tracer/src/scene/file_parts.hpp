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
    std::optional<Value> unit{};
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
    std::optional<Value> expect{};

    template <class V>
    static void parameters(V&& v) {
        using P = FileParts;
        v(&P::schema, PartParameter{{"$schema", "",
                                     "For editors: the location of the JSON Schema with which they complete and check "
                                     "the file, such as \"scene.schema.json\". Ignored by phasetree.",
                                     limits::any, true},
                                    "name of a file",
                                    R"({"type": "string"})"});
        v(&P::version, PartParameter{{"version", "", "Version of the format."}, "1", R"({"const": 1})"});
        v(&P::unit, PartParameter{{"unit", "",
                                   "Unit of the lengths: \"mm\", \"cm\", \"m\" or \"in\", for measures, drawings and "
                                   "files of other programs. It does not affect rendering. By default, a metre.",
                                   limits::any, true},
                                  "text",
                                  R"({"$ref": "#/definitions/unit"})"});
        v(&P::phases, PartParameter{{"phases", "",
                                     "The phases of the tree: their names and their materials. A phase may also have a "
                                     "\"density\" in kg/m³, from 0 to 10¹², beside its material; it does not affect "
                                     "rendering. A scene of meshes alone has neither phases nor a tree.",
                                     limits::any, true},
                                    "object of materials",
                                    R"({"type": "object", "minProperties": 1, "maxProperties": 63,
                                        "additionalProperties": {"$ref": "#/definitions/phase"}})"});
        v(&P::shapes,
          PartParameter{{"shapes", "", "Named parts of the tree that can be used several times.", limits::any, true},
                        "object of fields and objects",
                        R"({"type": "object", "additionalProperties": {"anyOf": [
                                        {"$ref": "#/definitions/field"}, {"$ref": "#/definitions/object"}]}})"});
        v(&P::tree, PartParameter{{"tree", "",
                                   "The object to show. Requires \"phases\". Together with \"objects\" it is one more "
                                   "object, which comes first and is named \"tree\".",
                                   limits::any, true},
                                  "object",
                                  R"({"$ref": "#/definitions/object"})"});
        v(&P::objects, PartParameter{{"objects", "", "Several objects instead of a single tree.", limits::any, true},
                                     "list of objects",
                                     R"({"type": "array", "minItems": 1,
                                         "items": {"$ref": "#/definitions/placed_object"}})"});
        v(&P::groups,
          PartParameter{
              {"groups", "", "Groups of instances of objects and of other groups, which can be instanced as a whole.",
               limits::any, true},
              "object of lists of instances",
              R"({"type": "object", "additionalProperties": {"type": "array", "minItems": 1,
                                        "items": {"$ref": "#/definitions/instance"}}})"});
        v(&P::instances,
          PartParameter{{"instances", "", "Instances of objects and groups.", limits::any, true},
                        "list of instances",
                        R"({"type": "array", "minItems": 1, "items": {"$ref": "#/definitions/instance"}})"});
        v(&P::meshes,
          PartParameter{{"meshes", "", "Meshes in addition to the object, or on their own: opaque, or thin like panes.",
                         limits::any, true},
                        "list of meshes",
                        R"({"type": "array", "items": {"$ref": "#/definitions/mesh"}})"});
        v(&P::lights, PartParameter{{"lights", "", "Light sources. An image needs at least one.", limits::any, true},
                                    "list of lights",
                                    R"({"type": "array", "items": {"$ref": "#/definitions/light"}})"});
        v(&P::background,
          PartParameter{
              {"background", "", "Colour that the camera sees instead of the lights at infinity.", limits::any, true},
              "colour",
              R"({"$ref": "#/definitions/colour"})"});
        v(&P::camera, PartParameter{{"camera", "", "The camera."}, "camera", R"({"$ref": "#/definitions/camera"})"});
        v(&P::render,
          PartParameter{{"render", "", "Size of the image and settings of the renderer.", limits::any, true},
                        "render",
                        R"({"$ref": "#/definitions/render"})"});
        v(&P::expect, PartParameter{{"expect", "",
                                     "Statements about the object that \"phasetree check --prove\" proves or refutes. "
                                     "They change no picture.",
                                     limits::any, true},
                                    "list of statements",
                                    R"({"type": "array", "items": {"$ref": "#/definitions/expectation"}})"});
    }
};

}  // namespace phasetree::tracer
